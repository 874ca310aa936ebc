// The numbers of a load: notes, facts, the distribution of pressure, and the commands that compute the same.

import { chart, clear } from "./charts.js";
import { statement } from "./statement.js";

const by = (id) => document.getElementById(id);

export function numbersView() {
  const [command, python] = [statement(by("command")), statement(by("python"))];
  return {
    tell(header) {
      facts(by("facts"), header.facts);
      list(by("notes"), header.notes || []);
      command(header.command);
      python(header.python);
    },
    pressures({ x, y, unit, beyond }) {
      chart(by("pressures"), {
        x: { label: "pressure", unit },
        y: { label: "density", per: true },
        beyond,
        zero: true,
        height: 180,
        series: [{ x, y, label: "density", kind: "area", colour: "--accent" }],
      });
    },
    // Clear the numbers of another preparation; for another surface, also the facts.
    forget(all) {
      clear(by("pressures"));
      if (!all) return;
      for (const id of ["facts", "notes"]) by(id).replaceChildren();
      command("");
      python("");
    },
  };
}

export function facts(root, lines) {
  root.replaceChildren(...lines.flatMap(([name, value]) => [element("dt", name), element("dd", value)]));
}

export function list(root, lines) {
  root.replaceChildren(...lines.map((line) => element("li", line)));
}

export function element(kind, text) {
  return Object.assign(document.createElement(kind), { textContent: text });
}
