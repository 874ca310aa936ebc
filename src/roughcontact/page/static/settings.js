// Fields whose value is a part of the recipe: what a file leaves open, and the steps of the preparation.

import { put } from "./typing.js";
import { written } from "./words.js";

const by = (id) => document.getElementById(id);
const text = (value) => value.trim() || null;
const DEGREES = 12; // of a polynomial that is removed

const FIELDS = [
  ...["channel", "unit", "width", "height"].map((id) => ({ id, part: "source", read: text })),
  ...["despike", "level", "form", "short_cutoff", "long_cutoff"].map((id) => ({ id, part: "preparation", read: text })),
  { id: "downsample", part: "preparation", read: (value) => (value === "" || value === "1" ? null : Number(value)) },
];
const EDGES = { "": null, free: false, periodic: true };
const EDGE_WORDS = {
  "": "A map is free where its file does not say that it repeats itself.",
  free: "One patch pressed alone: nothing touches beyond its edges.",
  periodic: "The map repeats itself in both directions, without end.",
};

const CUT = "A part of a map that repeats itself does not: along what the crop cuts it is free.";

export function settings(recipe) {
  for (let degree = 2; degree <= DEGREES; degree++) by("form").add(new Option(`polynomial of degree ${degree}`, degree));
  for (const { id, part, read } of FIELDS) {
    by(id).onchange = ({ target }) => recipe.change((next) => (next[part][id] = read(target.value)));
  }
  by("fill").onchange = ({ target }) => recipe.change((next) => (next.preparation.fill = target.checked));
  by("periodic").onchange = ({ target }) => recipe.change((next) => (next.source.periodic = EDGES[target.value]));

  function show() {
    const { source, preparation } = recipe.now;
    const file = source !== null && source.kind === "file";
    by("open").hidden = !file;
    by("edges").hidden = by("edges_said").hidden = !source;
    const kept = { source: source || {}, preparation };
    for (const { id, part } of FIELDS) put(by(id), kept[part][id] ?? "");
    by("fill").checked = preparation.fill;
    if (!source) return;
    by("periodic").options[0].hidden = by("periodic").options[0].disabled = !file;
    const edges = source.periodic === true ? "periodic" : source.periodic === false || !file ? "free" : "";
    by("periodic").value = edges;
    by("edges_said").textContent = edges === "periodic" && preparation.crop ? CUT : EDGE_WORDS[edges];
  }

  return {
    show,
    channels(found) {
      const heights = found.filter((each) => each.is_height);
      const others = found.filter((each) => !each.is_height);
      const group = (label, some) => {
        const made = Object.assign(document.createElement("optgroup"), { label });
        made.append(...some.map((each) => new Option(each.name)));
        return made;
      };
      by("channel").replaceChildren(
        new Option("by name", ""),
        ...(heights.length ? [group("Heights", heights)] : []),
        ...(others.length ? [group("Other", others)] : []),
      );
      const chosen = recipe.now.source.channel || "";
      by("channel").value = chosen;
      const { unit } = found.find((each) => each.name === chosen) || heights[0] || {};
      if (unit) by("unit").placeholder = typeof unit === "string" ? unit : `${unit} m`;
    },
    // What the file itself says stands in the empty fields.
    of(raw) {
      const [length, width] = raw.lengths.map((side) => written(side, "m", 4));
      by("width").placeholder = width;
      by("height").placeholder = length;
      by("missing").textContent = raw.missing || "none";
    },
    // Nothing is known of a file that could not be read.
    forget() {
      for (const id of ["unit", "width", "height"]) by(id).placeholder = { unit: "such as um", width: "such as 1 mm", height: "square cells" }[id];
      by("missing").textContent = "";
    },
  };
}
