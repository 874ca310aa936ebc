// The two bodies: by name, by Young's modulus and Poisson's ratio of each, or by their reduced modulus; and a hardness.

import { put as fill } from "./typing.js";
import { loadText, written } from "./words.js";

const by = (id) => document.getElementById(id);
const NUMBERS = ["young", "poisson", "young2", "poisson2", "modulus"];
const digits = (value) => `${Number((value / 1e9).toPrecision(6))} GPa`;

export const waysOf = (bodies) => (bodies.materials ? "materials" : "modulus" in bodies ? "modulus" : "constants");

export function bodyFields(recipe, materials) {
  const names = [...Object.keys(materials), "rigid"];
  let known = null; // what the server last said, and of which bodies

  const text = () => JSON.stringify(recipe.now.bodies);

  for (const id of ["first", "second"]) for (const name of names) by(id).add(new Option(name));
  ["first", "second"].forEach((id, k) => {
    by(id).onchange = ({ target }) => recipe.change(({ bodies }) => {
      // A hardness by name goes with its body.
      if (bodies.hardness === bodies.materials[k]) {
        if (target.value === "rigid") delete bodies.hardness;
        else bodies.hardness = target.value;
      }
      bodies.materials[k] = target.value;
    });
  });
  for (const id of NUMBERS) by(id).onchange = ({ target }) => recipe.change(({ bodies }) => put(bodies, id, target.value));
  by("given").onchange = ({ target }) => recipe.change((next) => (next.bodies = otherwise(next.bodies, target.value)));
  by("hard").onchange = ({ target }) => recipe.change(({ bodies }) => {
    const before = materials[bodies.hardness];
    put(bodies, "hardness", target.value === "number" ? loadText(before ? before.hardness : 2e9, "Pa") : target.value);
  });
  by("hardness").onchange = ({ target }) => recipe.change(({ bodies }) => put(bodies, "hardness", target.value));

  function put(bodies, name, value) {
    if (value.trim()) bodies[name] = value.trim();
    else if (name === "modulus") bodies.modulus = "";
    else delete bodies[name];
  }

  // The same bodies, given in another way; a reduced modulus that is not computed yet is left to the user.
  function otherwise(bodies, way) {
    const number = bodies.hardness && !/^[a-z]/i.test(bodies.hardness) ? { hardness: bodies.hardness } : {};
    if (way === "materials") return { materials: ["steel", "aluminium"], ...number };
    if (way === "modulus") return { modulus: known && known.of === text() ? digits(known.modulus) : "", ...number };
    const [first, second] = (bodies.materials || ["steel"]).filter((name) => name !== "rigid").map((name) => materials[name]);
    const own = first ? { young: digits(first.young), poisson: String(first.poisson) } : {};
    return { ...own, ...(second ? { young2: digits(second.young), poisson2: String(second.poisson) } : {}), ...number };
  }

  function show() {
    const { bodies } = recipe.now;
    const way = waysOf(bodies);
    by("given").value = way;
    for (const each of ["materials", "constants", "modulus"]) by(`by_${each}`).hidden = each !== way;
    if (bodies.materials) [by("first").value, by("second").value] = bodies.materials;
    for (const id of NUMBERS) fill(by(id), bodies[id] || "");
    const metals = [...new Set(bodies.materials || [])].filter((name) => name !== "rigid");
    by("hard").replaceChildren(new Option("none: elastic", ""), ...metals.map((name) => new Option(`of ${name}`, name)), new Option("a number", "number"));
    const named = metals.includes(bodies.hardness);
    by("hard").value = !bodies.hardness ? "" : named ? bodies.hardness : "number";
    by("hardness_line").hidden = !bodies.hardness || named;
    fill(by("hardness"), named ? "" : bodies.hardness || "");
  }

  return {
    show,
    say(found) {
      known = { ...found, of: text() };
      const lines = [`Reduced modulus E* ${written(found.modulus, "Pa", 4)}`];
      for (const name of (recipe.now.bodies.materials || []).filter((each) => each !== "rigid")) {
        const { grade, young, poisson, hardness } = materials[name];
        lines.push(`${name}: ${grade}; E ${written(young, "Pa", 4)}, ν ${poisson}, hardness ${written(hardness, "Pa", 3)}`);
      }
      by("bodies_said").replaceChildren(...[...new Set(lines)].map((line) => Object.assign(document.createElement("li"), { textContent: line })));
    },
  };
}
