// The two bodies: by name, by Young's modulus and Poisson's ratio of each, or by their reduced modulus; and a hardness.

import { loadText, written } from "./words.js";

const by = (id) => document.getElementById(id);
const NUMBERS = ["young", "poisson", "young2", "poisson2", "modulus"];
const digits = (value) => `${Number((value / 1e9).toPrecision(6))} GPa`;

export const waysOf = (bodies) => (bodies.materials ? "materials" : "modulus" in bodies ? "modulus" : "constants");

export function bodyFields(recipe, materials) {
  const names = [...Object.keys(materials), "rigid"];
  let known = null; // what the server last said of them

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
    const least = known && known.hardness ? known.hardness : 2e9;
    put(bodies, "hardness", target.value === "number" ? loadText(least, "Pa") : target.value);
  });
  by("hardness").onchange = ({ target }) => recipe.change(({ bodies }) => put(bodies, "hardness", target.value));

  function put(bodies, name, value) {
    if (value.trim()) bodies[name] = value.trim();
    else if (name === "modulus") bodies.modulus = "";
    else delete bodies[name];
  }

  // The same bodies, given in another way, as far as they are known.
  function otherwise(bodies, way) {
    const number = bodies.hardness && !/^[a-z]/i.test(bodies.hardness) ? { hardness: bodies.hardness } : {};
    if (way === "materials") return { materials: ["steel", "aluminium"], ...number };
    if (way === "modulus") return { modulus: known ? digits(known.modulus) : "100 GPa", ...number };
    const found = (bodies.materials || ["steel", "rigid"]).map((name) => known && known.materials.find((each) => each.name === name));
    const [first, second] = found[0] ? found : [found[1], null];
    const own = { young: first ? digits(first.young) : "205 GPa", poisson: String(first ? first.poisson : 0.29) };
    return { ...own, ...(second ? { young2: digits(second.young), poisson2: String(second.poisson) } : {}), ...number };
  }

  function show() {
    const { bodies } = recipe.now;
    const way = waysOf(bodies);
    by("given").value = way;
    for (const each of ["materials", "constants", "modulus"]) by(`by_${each}`).hidden = each !== way;
    if (bodies.materials) [by("first").value, by("second").value] = bodies.materials;
    for (const id of NUMBERS) by(id).value = bodies[id] || "";
    const metals = [...new Set(bodies.materials || [])].filter((name) => name !== "rigid");
    by("hard").replaceChildren(new Option("none: elastic", ""), ...metals.map((name) => new Option(`of ${name}`, name)), new Option("a number", "number"));
    const named = metals.includes(bodies.hardness);
    by("hard").value = !bodies.hardness ? "" : named ? bodies.hardness : "number";
    by("hardness_line").hidden = !bodies.hardness || named;
    by("hardness").value = named ? "" : bodies.hardness || "";
  }

  return {
    show,
    say(found) {
      known = found;
      const lines = [`Reduced modulus E* ${written(found.modulus, "Pa", 4)}`];
      for (const each of found.materials) {
        lines.push(`${each.name}: ${each.grade}; E ${written(each.young, "Pa", 4)}, ν ${each.poisson}, hardness ${written(each.hardness, "Pa", 3)}`);
      }
      by("bodies_said").replaceChildren(...[...new Set(lines)].map((line) => Object.assign(document.createElement("li"), { textContent: line })));
    },
  };
}
