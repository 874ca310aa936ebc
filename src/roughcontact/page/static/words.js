// Numbers in the form for people, and for the command line.

const PREFIXES = { "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T" };
// Units with a power, which also applies to their prefix.
const POWERS = { "m²": 2, "m³": 3, "m⁴": 4 };
// Customary unit in machine design, for any number.
const FIXED = { "Pa/m": { factor: 1e-12, unit: "N/µm/mm²" } };

function scaleOf(value, unit) {
  if (!unit || !Number.isFinite(value) || value === 0) return { factor: 1, unit };
  if (FIXED[unit]) return FIXED[unit];
  const power = POWERS[unit] || 1;
  // The margin keeps 1e-6, which rounding may put just below, at one micro.
  let exponent = 3 * Math.floor((Math.log10(Math.abs(value) * (1 + 1e-9)) + 2 * (power - 1)) / (3 * power));
  exponent = Math.min(Math.max(exponent, -12), unit.startsWith("m") ? 3 : 12);
  return { factor: 10 ** (-exponent * power), unit: PREFIXES[exponent] + unit };
}

// The scale that suits the largest of some values.
export function scaleFor(values, unit) {
  let largest = 0;
  for (const value of values) if (Number.isFinite(value)) largest = Math.max(largest, Math.abs(value));
  return scaleOf(largest, unit);
}

export function digits(value, count = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return "∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, power] = value.toExponential(count - 1).split("e");
    return `${Number(mantissa) === 1 ? "" : `${Number(mantissa)}·`}10${superscript(Number(power))}`;
  }
  return String(Number(value.toPrecision(count)));
}

function superscript(power) {
  return String(power).replace(/./g, (c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] || "⁻");
}

export function written(value, unit, count = 4) {
  if (value === null || !Number.isFinite(value)) return digits(value);
  const { factor, unit: shown } = scaleOf(value, unit);
  return `${digits(value * factor, count)} ${shown || ""}`.trim();
}

// A load in the form of the command line: a few digits, and a unit in ASCII.
export function loadText(value, unit, count = 3) {
  const rounded = Number(value.toPrecision(count));
  const { factor, unit: shown } = scaleOf(rounded, unit);
  return `${Number((rounded * factor).toPrecision(count))} ${shown.replace("µ", "u")}`;
}

// The number in a text such as "12.3 MPa", with a prefix that this page writes; otherwise null.
export function loadValue(text, unit) {
  const found = /^\s*([\d.]+(?:e[+-]?\d+)?)\s*([a-zA-Zµ/]*)\s*$/i.exec(text);
  if (!found) return null;
  const [, number, given] = found;
  if (given === "") return Number(number);
  if (!given.endsWith(unit)) return null;
  const prefix = given.slice(0, given.length - unit.length).replace("u", "µ");
  const power = Object.keys(PREFIXES).find((key) => PREFIXES[key] === prefix);
  return power === undefined ? null : Number(number) * 10 ** Number(power);
}
