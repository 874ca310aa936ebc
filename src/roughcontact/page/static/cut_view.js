// The cut: one row or column through the undeformed surface and the deformed gap, linked with the map.

import { chart, mark } from "./charts.js";
import { put } from "./typing.js";
import { written } from "./words.js";

const ROUNDING = 1e-13; // metres
const by = (id) => document.getElementById(id);

// `map` shows the position of the cut; `ask(axis, place)` requests its computation.
export function cutView(map, ask) {
  let chosen = false;
  let last = null;

  function at(axis, place) {
    chosen = true;
    [by("cut_axis").value, by("cut_place").value] = [axis, place + 1];
    map.place(axis, place);
    ask();
  }

  by("cut_axis").onchange = ({ target }) => {
    const { row, column } = map.middle();
    at(target.value, target.value === "row" ? row : column);
  };
  by("cut_place").oninput = ({ target }) => target.validity.valid && at(by("cut_axis").value, target.valueAsNumber - 1);

  return {
    at,
    get wanted() {
      return by("of_cut").hidden ? null : { axis: by("cut_axis").value, place: Number(by("cut_place").value) };
    },
    // By default the cut goes through the highest pressure.
    answered({ highest: [row] }) {
      by("of_cut").hidden = false;
      if (!chosen) {
        [by("cut_axis").value, by("cut_place").value] = ["row", row + 1];
        map.place("row", row);
      }
    },
    forget() {
      chosen = false;
      last = null;
      by("of_cut").hidden = true;
    },
    // The map reports the position of its pointer.
    pointed(cell) {
      if (last) mark(by("cut"), cell ? last.x[last.axis === "row" ? cell.column : cell.row] : null);
    },
    heard(header) {
      last = header;
      // A closed gap may differ from 0 by rounding.
      const [gap, under] = [header.gap, header.under].map((line) => line.map((value) => (value !== null && Math.abs(value) < ROUNDING ? 0 : value)));
      by("cut_place").max = header.count;
      put(by("cut_place"), header.place + 1);
      by("cut_at").textContent = header.across === null ? "" : `${header.axis === "row" ? "y" : "x"} = ${written(header.across, "m", 3)}`;
      by("cut_places").hidden = header.across === null; // a profile has one row
      const line = (y, label, colour, more) => ({ x: header.x, y, label, kind: "line", gaps: true, colour, ...more });
      chart(by("cut"), {
        x: { label: header.axis === "row" ? "x" : "y", unit: "m" },
        y: { label: "height over the flat", unit: "m" },
        label: `Cut along ${header.axis} ${header.place + 1}`,
        series: [
          line(header.before, "undeformed surface", "--ink-soft", { dash: [5, 4] }),
          line(under, "deformed surface", "--accent"),
          line(header.x.map(() => 0), "flat body", "--second", { silent: true }),
        ],
        more: (k) => `gap ${written(gap[k], "m", 3)}   pressure ${written(header.pressure[k], header.unit, 3)}`,
        hovered: (k) => map.mark(k === null ? null : header.axis === "row" ? { row: header.place, column: k } : { row: k, column: header.place }),
      });
    },
  };
}
