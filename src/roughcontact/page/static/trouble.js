// Errors of fields, as sentences beside them; each job removes its own errors.

const said = new Map();

// The field of a place such as "preparation.crop", or the first visible field of its part.
function fieldOf(place) {
  for (let name = place; name; name = name.includes(".") ? name.slice(0, name.lastIndexOf(".")) : "") {
    const field = document.getElementById(name);
    if (field && !field.closest("[hidden]")) return field;
  }
  const [part] = place.split(".");
  return [...document.querySelectorAll(`[id^="${part}."]`)].find((each) => !each.closest("[hidden]") && each.matches("input, select, textarea")) || null;
}

function show(field, text) {
  const place = `${field.id}_trouble`;
  let line = document.getElementById(place);
  if (!text) {
    field.removeAttribute("aria-invalid");
    field.removeAttribute("aria-errormessage");
    if (line) line.remove();
    return;
  }
  if (!line) {
    line = Object.assign(document.createElement("p"), { className: "trouble", id: place, role: "alert" });
    (field.closest("label") || field).after(line);
  }
  for (let folded = field.closest("details"); folded; folded = folded.parentElement.closest("details")) folded.open = true;
  line.textContent = text;
  field.setAttribute("aria-invalid", "true");
  field.setAttribute("aria-errormessage", place);
}

// Show the error of a job beside the fields that it names; return the first field.
export function trouble(job, { faults = [] }) {
  for (const field of said.get(job) || []) show(field, "");
  const fields = new Map();
  for (const { places, message } of faults) {
    for (const field of places.map(fieldOf)) if (field && !fields.has(field)) fields.set(field, message);
  }
  said.set(job, [...fields.keys()]);
  for (const [field, words] of fields) show(field, words);
  return said.get(job)[0] || null;
}
