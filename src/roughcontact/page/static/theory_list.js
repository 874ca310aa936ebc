// Theories to overlay on a curve: the choice, their errors, and why a theory does not apply.

import { element } from "./numbers.js";

const COLOURS = ["#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c564b"]; // distinct to every eye
const DASHES = [[8, 4], [2, 3], [10, 3, 2, 3]];

export function theoryList(root, known, changed) {
  const rows = new Map();
  Object.entries(known).forEach(([name, about], k) => {
    const label = Object.assign(element("label", ""), { className: "theory" });
    const box = Object.assign(document.createElement("input"), { type: "checkbox", value: name });
    const words = document.createElement("span");
    const said = Object.assign(element("small", ""), { className: "soft" });
    words.append(element("strong", name), element("small", about), said);
    label.append(box, words);
    root.append(label);
    rows.set(name, { box, said, colour: COLOURS[k % COLOURS.length], dash: DASHES[k % DASHES.length], found: null });
    box.onchange = () => {
      if (box.checked) said.textContent = "computing …";
      changed();
    };
  });

  return {
    get chosen() {
      return [...rows].filter(([, { box }]) => box.checked).map(([name]) => name);
    },
    heard({ name, refused, ...found }) {
      const row = rows.get(name);
      row.found = refused ? null : found;
      row.said.textContent = refused ? `Does not apply: ${refused}.` : `rms of ln(predicted/computed): ${found.words}`;
      if (refused) row.box.checked = false;
    },
    forget() {
      for (const row of rows.values()) [row.found, row.said.textContent] = [null, ""];
    },
    // The lines of the chosen theories that predict the quantity.
    lines(quantity) {
      return [...rows.values()]
        .filter(({ box, found }) => box.checked && found && found.predicted[quantity])
        .map(({ box, found, colour, dash }) => ({ label: box.value, y: found.predicted[quantity], colour, dash }));
    },
  };
}
