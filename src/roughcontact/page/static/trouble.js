// What is wrong with a field, in a sentence beside it; each job takes back what it said itself.

// The server's names of fields, where those of the page differ.
const PLACES = { size: "width", crop: "crop_top" };
const said = new Map();

function show(id, text) {
  const field = document.getElementById(id);
  if (!field) return;
  const place = `${id}_trouble`;
  let line = document.getElementById(place);
  if (!text) {
    field.removeAttribute("aria-invalid");
    field.removeAttribute("aria-errormessage");
    if (line) line.remove();
    return;
  }
  if (!line) {
    line = Object.assign(document.createElement("p"), { className: "trouble", id: place, role: "alert" });
    (field.closest("[data-field]") || field.closest("label") || field).after(line);
  }
  line.textContent = text;
  field.setAttribute("aria-invalid", "true");
  field.setAttribute("aria-errormessage", place);
}

// Show how a job ended beside the fields that it names; return the first of them.
export function trouble(job, { field, lacking = [], message = "", remedy = "" }) {
  for (const id of said.get(job) || []) show(id, "");
  const names = field ? [field] : lacking;
  const ids = names.map((name) => PLACES[name] || name);
  said.set(job, ids);
  ids.forEach((id, k) => show(id, k ? "This is needed as well." : [message, remedy].filter(Boolean).join(" ")));
  return ids.length ? document.getElementById(ids[0]) : null;
}
