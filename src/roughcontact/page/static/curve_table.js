// The points of a curve as a table: each row opens its contact, by mouse and by keys.

import { element } from "./numbers.js";
import { digits, scaleFor } from "./words.js";

const COLUMNS = [
  "force", "nominal_pressure", "depth", "stiffness", "interfacial_stiffness_per_area", "contact_fraction", "mean_gap", "spots", "residual",
  "hydraulic_gap", "transmissivity", "flow_factor", "percolates",
  "spots_conductance_per_area", "gas_conductance_per_area", "radiation_conductance_per_area", "joint_conductance_per_area",
  "reflection", "error_amplification", "best_frequency",
];

// Without `chosen` the rows are not clickable.
export function curveTable(root, { columns, points }, current, chosen) {
  const clickable = Boolean(chosen);
  // Keep the focus of the keyboard.
  const focused = [...root.querySelectorAll("button")].indexOf(document.activeElement);
  const shown = COLUMNS.map((name) => columns.find((each) => each.name === name)).filter(Boolean);
  const branched = points.some(({ branch }) => branch);
  const scales = shown.map(({ name, unit }) => scaleFor(points.map((point) => point[name]), unit));
  const head = element("tr", "");
  if (branched) head.append(Object.assign(element("th", "branch"), { scope: "col" }));
  for (const [k, { label }] of shown.entries()) {
    const cell = element("th", scales[k].unit ? `${label} [${scales[k].unit}]` : label);
    cell.scope = "col";
    head.append(cell);
  }
  const body = document.createElement("tbody");
  for (const point of points) {
    const row = element("tr", "");
    if (branched) row.append(element("td", point.branch));
    for (const [k, { name }] of shown.entries()) {
      const value = point[name] === null ? "∞" : digits(point[name] * scales[k].factor, name === "residual" ? 2 : 4);
      if (k || !clickable || !["", "loading"].includes(point.branch)) {
        row.append(element("td", value));
        continue;
      }
      const cell = element("th", "");
      cell.scope = "row";
      const button = Object.assign(element("button", value), { type: "button", title: "Show this contact" });
      button.setAttribute("aria-label", `Show the contact at ${value} ${scales[k].unit}${point.resolved ? "" : ", not resolved"}`);
      if (!point.resolved) button.className = "unresolved";
      button.onclick = () => chosen(point);
      cell.append(button);
      row.append(cell);
    }
    if (current && Math.abs(point.force / current.force - 1) < 1e-4) row.setAttribute("aria-current", "true");
    body.append(row);
  }
  const top = document.createElement("thead");
  top.append(head);
  root.replaceChildren(...(clickable ? [element("caption", "Choose a force to show its contact.")] : []), top, body);
  if (focused >= 0) body.querySelectorAll("button")[focused]?.focus({ preventScroll: true });
}
