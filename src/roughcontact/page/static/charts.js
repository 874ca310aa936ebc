// Curves on uPlot: distributions, cuts, loading curves; redrawn when their size or the colours change.

import { digits, scaleFor } from "./words.js";

/* global uPlot */

// Only the decades of a logarithmic axis have lines: with all lines the chart would be unreadable.
const decade = (at) => at !== null && Math.abs(Math.log10(at) - Math.round(Math.log10(at))) < 1e-6;
const decades = (_, splits) => splits.map((at) => (decade(at) ? at : null));
// If labels of all decades would overlap, only every second or third decade has one.
function labelled(ticks, log, most) {
  const every = log ? Math.ceil(ticks.filter(decade).length / most) : 1;
  return every > 1 ? ticks.map((at) => (decade(at) && Math.round(Math.log10(at)) % every === 0 ? at : null)) : ticks;
}
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const shown = new Set();

// Series: { label, x, y, kind: "line" | "points" | "rings" | "mark" | "area", colour, dash, gaps }. Axes: { label, unit, log };
// `y.per` marks a density over x, `beyond` is a note on values outside. `clicked(x)` and `hovered(k)` get positions in the units of the series.
export function chart(root, spec) {
  root.spec = spec;
  if (!shown.has(root)) {
    shown.add(root);
    let width = 0;
    new ResizeObserver(() => {
      if (Math.abs(root.clientWidth - width) < 2) return;
      width = root.clientWidth;
      if (root.spec) draw(root);
    }).observe(root);
  }
  draw(root);
}

export function clear(root) {
  if (root.plot) root.plot.destroy();
  root.plot = root.spec = null;
  root.replaceChildren();
}

// A line across a chart at a position along x; null removes it.
export function mark(root, x) {
  if (!root.plot) return;
  root.quiet = true;
  const left = x === null ? -10 : root.plot.valToPos(x * root.factor, "x");
  root.plot.setCursor({ left, top: left < 0 ? -10 : 1 });
  root.quiet = false;
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
new MutationObserver(redraw).observe(document.documentElement, { attributes: true });

function redraw() {
  for (const root of shown) if (root.spec) draw(root);
}

function draw(root) {
  const { x, y, series, zero = false, height = 0, label = "", count = null, beyond = "" } = root.spec;
  if (root.plot) root.plot.destroy();
  root.plot = null;
  const width = root.clientWidth;
  const scaleX = scaleFor(series.flatMap((each) => [...each.x]), x.unit);
  const scaleY = y.per ? { factor: 1 / scaleX.factor, unit: `1/${scaleX.unit}` } : scaleFor(series.flatMap((each) => [...each.y]), y.unit);
  const { xs, columns } = together(series, scaleX.factor, scaleY.factor, x.log, y.log);
  root.factor = scaleX.factor;
  root.replaceChildren();
  if (!xs.length || !width) return;
  const em = 0.8 * parseFloat(getComputedStyle(document.documentElement).fontSize);
  const font = `${em}px system-ui, sans-serif`;
  const ratio = { ink: css("--ink-soft"), grid: css("--line-soft") };
  const tall = height || Math.min(Math.max(220, 0.5 * width), 560);
  const axis = (of, scale, most) => ({
    label: of.label + (scale.unit ? ` [${scale.unit}]` : ""),
    labelFont: font,
    font,
    stroke: ratio.ink,
    labelSize: 1.7 * em,
    labelGap: 2,
    grid: { stroke: ratio.grid, width: 1, ...(of.log ? { filter: decades } : {}) },
    ticks: { stroke: ratio.grid, width: 1, size: 4 },
    values: (_, ticks) => labelled(ticks, of.log, most).map((tick) => (tick === null ? "" : digits(tick, 3))),
  });
  const readout = Object.assign(document.createElement("p"), { className: "readout" });
  const units = { x: scaleX.unit, y: scaleY.unit };
  const options = {
    width,
    height: tall,
    padding: [10, 22, 0, 0],
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, points: { size: 8 } },
    scales: {
      x: { time: false, ...(x.log ? { distr: 3 } : { range: (_, low, high) => apart(low, high) }) },
      y: y.log ? { distr: 3 } : { range: (_, low, high) => (zero ? [Math.min(0, low), high * 1.05 || 1] : uPlot.rangeNum(...apart(low, high), 0.1, true)) },
    },
    axes: [
      { ...axis(x, scaleX, width / (5 * em)), size: 2.5 * em },
      { ...axis(y, scaleY, tall / (3 * em)), size: (_, ticks) => 14 + 0.58 * em * Math.max(2, ...(ticks || []).map((each) => each.length)) },
    ],
    series: [{}, ...series.map(drawn)],
    hooks: { setCursor: [(plot) => pointed(root, plot, readout, units)] },
  };
  root.plot = new uPlot(options, [xs, ...columns], root);
  if (series.length > 1) root.append(legend(series));
  if (beyond) root.append(Object.assign(document.createElement("p"), { className: "beyond", textContent: beyond }));
  root.append(readout);
  root.setAttribute("role", "img");
  root.setAttribute("aria-label", `${label || y.label}: ${y.label} against ${x.label}, ${count ?? xs.length} points`);
  root.plot.over.addEventListener("click", () => {
    const { idx } = root.plot.cursor;
    if (root.spec.clicked && idx !== null && idx !== undefined) root.spec.clicked(xs[idx] / scaleX.factor);
  });
}

// The ends of an axis: values that differ only by rounding have no ticks between them.
function apart(low, high) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  return high - low > 1e-6 * size ? [low, high] : [low - (0.05 * size || 1), high + (0.05 * size || 1)];
}

// The values under the cursor, in words.
function pointed(root, plot, readout, units) {
  const { idx, left } = plot.cursor;
  const on = idx !== null && idx !== undefined && left >= 0;
  if (root.spec.hovered && !root.quiet) root.spec.hovered(on ? idx : null);
  if (!on) return readout.replaceChildren();
  const words = [`${root.spec.x.label} ${digits(plot.data[0][idx], 4)} ${units.x}`];
  root.spec.series.forEach((each, k) => {
    const value = plot.data[k + 1][idx];
    if (value !== undefined && value !== null && !each.silent) words.push(`${each.label} ${digits(value, 4)} ${units.y}`);
  });
  if (root.spec.more) words.push(root.spec.more(idx));
  return readout.replaceChildren(words.join("   "));
}

function legend(series) {
  const list = Object.assign(document.createElement("ul"), { className: "legend" });
  // For several series with the same label, the legend shows the one with marks.
  const named = new Map([...series].reverse().sort((a, b) => Boolean(b.silent) - Boolean(a.silent)).map((each) => [each.label, each]));
  for (const each of series.filter((one) => named.get(one.label) === one)) {
    const item = document.createElement("li");
    const swatch = document.createElement("span");
    swatch.className = `swatch ${each.kind}${each.dash ? " dashed" : ""}`;
    swatch.style.color = colourOf(each);
    item.append(swatch, each.label);
    list.append(item);
  }
  return list;
}

const colourOf = (each) => (each.colour.startsWith("--") ? css(each.colour) : each.colour);

function drawn(each) {
  const stroke = colourOf(each);
  const line = each.kind === "line" || each.kind === "area";
  const points = { show: !line, size: each.kind === "mark" ? 15 : 7, width: each.kind === "mark" ? 2.5 : 1.5, stroke };
  if (each.gaps) Object.assign(points, { show: true, size: 4, filter: lone });
  points.fill = each.kind === "points" || line ? stroke : each.kind === "mark" ? `${stroke}22` : css("--card");
  return {
    label: each.label,
    stroke,
    width: line ? 2 : 0,
    dash: each.dash,
    spanGaps: line && !each.gaps,
    fill: each.kind === "area" ? `${stroke}33` : undefined,
    points,
    paths: line ? undefined : () => null,
  };
}

// Values without a neighbour, which a line would not show.
function lone(plot, series) {
  const values = plot.data[series];
  const there = (k) => values[k] !== null && values[k] !== undefined;
  return values.map((_, k) => k).filter((k) => there(k) && !there(k - 1) && !there(k + 1));
}

// All series on one axis, as uPlot requires; values that a logarithmic axis cannot show, and rounding errors on it, are left out.
function together(series, factorX, factorY, logX, logY) {
  const places = new Set();
  for (const each of series) for (const value of each.x) if (!logX || value > 0) places.add(value);
  const sorted = [...places].sort((a, b) => a - b);
  const index = new Map(sorted.map((value, k) => [value, k]));
  const least = logY ? 1e-12 * Math.max(0, ...series.flatMap((each) => [...each.y]).filter(Number.isFinite)) : -Infinity;
  const columns = series.map((each) => {
    const column = new Array(sorted.length).fill(undefined);
    each.x.forEach((value, k) => {
      const height = each.y[k];
      const there = Number.isFinite(height) && height > least;
      const at = index.get(value);
      if (at !== undefined) column[at] = there ? height * factorY : null;
    });
    return column;
  });
  return { xs: sorted.map((value) => value * factorX), columns };
}
