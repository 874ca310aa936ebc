// Properties of the surface: warnings about it, its size, the distribution of its heights, its spectrum, its roughness.

import { chart, clear } from "./charts.js";
import { facts as listed, list } from "./numbers.js";
import { written } from "./words.js";

const by = (id) => document.getElementById(id);
// The label of the button beside a warning, by its step of the preparation.
const MEND = {
  despike: "Fill the spikes",
  level: "Remove the plane",
  form: "Remove a quadratic form",
  crop: "Crop to the larger part",
  fill: "Fill the missing points",
  mask: "Mask these points",
};

function element(kind, text, more = {}) {
  return Object.assign(document.createElement(kind), { textContent: text }, more);
}

export function surfaceView(recipe) {
  let warnings = [];
  let rough = false; // whether the heights have a distribution; a flat has none

  function mended([step, value]) {
    const given = recipe.now.preparation[step];
    if (Array.isArray(given)) return given.includes(value);
    return step === "level" ? given === "plane" || given === "quadratic" : Boolean(given);
  }

  function mend([step, value]) {
    return recipe.change(({ preparation }) => (preparation[step] = Array.isArray(preparation[step]) ? [...preparation[step], value] : value || true));
  }

  function showWarnings() {
    by("warnings").replaceChildren(...warnings.map(({ kind, words, remedy, step, left }) => {
      const line = document.createElement("li");
      const done = step !== null && mended(step);
      line.className = done && !left ? "mended" : "";
      line.append(element("strong", kind), element("span", step ? words : `${words}; ${remedy}`));
      if (done) line.append(element("em", left ? "the preparation leaves some" : "corrected by the preparation"));
      else if (step) line.append(element("button", MEND[step[0]], { type: "button", onclick: () => mend(step) }));
      return line;
    }));
  }

  function table(root, head, rows) {
    const line = (cells, kind) => {
      const row = document.createElement("tr");
      row.append(...cells.map((cell, k) => element(k || kind === "th" ? kind : "th", cell, kind === "th" ? { scope: "col" } : k ? {} : { scope: "row" })));
      return row;
    };
    const [top, body] = [document.createElement("thead"), document.createElement("tbody")];
    top.append(line(head, "th"));
    body.append(...rows.map((row) => line(row, "td")));
    root.replaceChildren(top, body);
  }

  return {
    show: showWarnings,
    forget() {
      warnings = [];
      showWarnings();
      by("surface_shown").hidden = true;
      by("surface_none").hidden = false;
      by("read_warnings").replaceChildren();
      by("channels").replaceChildren();
    },
    // Until the study is done, the page shows that of another preparation.
    wait() {
      rough = false;
      by("surface").setAttribute("aria-busy", "true");
      by("surface_shown").classList.add("stale");
    },
    done() {
      by("surface").setAttribute("aria-busy", "false");
      by("surface_shown").classList.remove("stale");
      if (rough) return;
      for (const id of ["distribution", "spectrum"]) clear(by(id));
      by("roughness").replaceChildren();
    },
    refused: () => by("surface").setAttribute("aria-busy", "false"),
    channels(found) {
      table(by("channels"), ["Channel", "Points", "Unit", "Size"], found.map(({ name, shape, unit, size, is_height }) => [
        is_height ? name : `${name} (not heights)`, shape.join(" × "), unit === null ? "not stated" : String(unit),
        size === null ? "not stated" : size.map((side) => written(side, "m", 3)).join(" × "),
      ]));
    },
    surface({ facts, warned }) {
      by("channels").closest("details").hidden = recipe.now.source.kind !== "file";
      by("surface_shown").hidden = false;
      by("surface_none").hidden = true;
      const shown = facts.filter(([name]) => name !== "history");
      listed(by("surface_facts"), shown);
      list(by("read_warnings"), warned);
      list(by("history"), facts.filter(([name]) => name === "history").map(([, line]) => line));
    },
    study(header) {
      if (header.type === "warnings") {
        warnings = header.warnings;
        showWarnings();
      } else if (header.type === "heights") {
        rough = true;
        chart(by("distribution"), { x: { label: "height", unit: "m" }, y: { label: "density", unit: "", per: true }, zero: true, beyond: header.beyond, height: 170, label: "Distribution of the heights", series: [
          { x: header.x, y: header.y, label: "measured", kind: "area", colour: "--accent" },
          { x: header.x, y: header.normal, label: "normal", kind: "line", colour: "--ink-soft", dash: [5, 4] },
        ] });
      } else if (header.type === "spectrum") {
        chart(by("spectrum"), { x: { label: "wavenumber", unit: "rad/m", log: true }, y: { label: "density", unit: header.unit, log: true }, height: 200, label: "Power spectrum", series: [
          { x: header.x, y: header.y, label: "power spectrum", kind: "line", colour: "--accent" },
        ] });
      } else if (header.type === "roughness") {
        table(by("roughness"), ["Parameter", "Meaning", "Value"], header.facts);
      }
    },
  };
}
