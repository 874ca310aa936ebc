// What is told of a load: notes first, then facts, the distribution of the pressure, and how to compute the same.

import { chart, clear } from "./charts.js";
import { statement } from "./statement.js";

const by = (id) => document.getElementById(id);

export function numbersView() {
  const [command, python] = [statement(by("command")), statement(by("python"))];
  let warned = [];
  return {
    tell(header) {
      warned = header.warned || warned;
      facts(by("facts"), header.facts);
      list(by("notes"), [...(header.notes || []), ...warned]);
      command(header.command);
      python(header.python);
    },
    pressures({ x, y }) {
      chart(by("pressures"), {
        x: { label: "pressure", unit: "Pa" },
        y: { label: "density", per: true },
        zero: true,
        height: 180,
        series: [{ x, y, label: "density", kind: "area", colour: "--accent" }],
      });
    },
    forget: () => clear(by("pressures")),
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
