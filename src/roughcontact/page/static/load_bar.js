// The load: its kind, a slider on a logarithmic scale, and its text.

import { put } from "./typing.js";
import { loadText, loadValue } from "./words.js";

const STEPS = 200;
const by = (id) => document.getElementById(id);

export function loadBar(recipe) {
  let spans = null;
  let units = {}; // of the loads; those of a profile differ from those of a map
  let state = null; // the load of the last answer as pressure, force and depth
  let dragged = null;
  let automatic = ""; // the load that the page has chosen, until the user chooses another
  let renewed = false; // whether it must be chosen again, for another surface

  function show() {
    const { load } = recipe.now;
    const [[control, text]] = Object.entries(load || { pressure: "" });
    for (const name of ["slider", "load"]) by(name).disabled = !spans || !load;
    if (!load) return;
    by("control").value = control;
    put(by("load"), text);
    by("slider").setAttribute("aria-valuetext", text);
    const value = loadValue(text, units[control]);
    if (!spans || !(value > 0) || dragged) return;
    const [low, high] = spans[control];
    by("slider").value = String((STEPS * Math.log(value / low)) / Math.log(high / low));
  }

  by("control").onchange = ({ target: { value: control } }) => {
    if (!spans) return;
    // The same state by another kind of load, if its value is known.
    const text = state ? loadText(state[control], units[control], 4) : loadText(spans[control][2], units[control]);
    recipe.change((next) => (next.load = { [control]: text }));
  };
  by("load").onchange = ({ target }) => {
    // A number without a unit has the unit of the value before it.
    const [unit] = /[a-zµ].*$/i.exec(Object.values(recipe.now.load)[0]) || [units[by("control").value]];
    const text = /^\s*[\d.]+(e[+-]?\d+)?\s*$/i.test(target.value) ? `${target.value.trim()} ${unit}` : target.value;
    recipe.change((next) => (next.load = { [by("control").value]: text }));
    show();
  };
  by("slider").oninput = ({ target }) => {
    dragged = dragged || structuredClone(recipe.now);
    const { value: control } = by("control");
    const [low, high] = spans[control];
    const text = loadText(low * (high / low) ** (target.value / STEPS), units[control]);
    recipe.change((next) => (next.load = { [control]: text }), false);
  };
  by("slider").onchange = () => {
    const before = dragged;
    dragged = null;
    if (before) recipe.remember(before);
  };

  return {
    show,
    get dragged() {
      return Boolean(dragged);
    },
    get ready() {
      return Boolean(spans && recipe.now.load);
    },
    // The ends of the slider; a flat surface has none.
    spanned({ pressure, force, depth, units: all }) {
      units = all;
      spans = pressure ? { pressure, force, depth } : null;
      if (spans && (!recipe.now.load || renewed)) {
        automatic = loadText(pressure[2], units.pressure);
        recipe.change((next) => (next.load = { pressure: automatic }), false);
      }
      renewed = false;
      show();
      return Boolean(spans);
    },
    answered: (header) => (state = header),
    // Another surface, or another preparation, has other loads.
    forget(another) {
      spans = state = null;
      renewed ||= another && JSON.stringify(recipe.now.load) === JSON.stringify({ pressure: automatic });
    },
    unit: (control) => units[control],
    usual: (control) => spans && spans[control],
  };
}
