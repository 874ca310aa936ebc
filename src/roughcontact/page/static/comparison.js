// Two surfaces side by side under one load: the kept one and the open one.

import { mapView } from "./map.js";
import { element } from "./numbers.js";
import { request } from "./wire.js";

const by = (id) => document.getElementById(id);

function view(name) {
  const root = by(`${name}_scale`);
  const [low, high] = root.querySelectorAll("span");
  const made = mapView(by(`${name}_map`), { root, canvas: root.querySelector("canvas"), low, high }, { over() {}, crop() {}, cut() {} });
  made.state.mode = "none";
  return made;
}

export function comparison({ recipe, jobOf, map, failed, changed, curveFacts }) {
  const [before, now] = [view("kept"), view("other")];
  [before.state.beside, now.state.beside] = [now, before];
  let kept = null;
  let asked = null; // of the kept surface: { load, sent }
  let current = null;

  // Press the kept surface by the load of the open one; only the newest load counts.
  async function follow() {
    const { load } = recipe.now;
    if (!kept || asked || !load || JSON.stringify(load) === kept.answered) return;
    const text = JSON.stringify(load);
    const held = kept;
    asked = text;
    by("kept_said").textContent = "computing …";
    let end = {};
    try {
      end = await request("back", "press", jobOf({ ...held.recipe, load }), { pixels: 512 }, (header, data) => {
        if (held !== kept) return;
        if (header.type === "map") before.set(header.map, header, data);
        else if (header.type === "numbers") held.facts = header.facts;
      }).ended;
    } catch (error) {
      failed(error);
    }
    asked = null;
    held.answered = text;
    if (held === kept) {
      by("kept_said").textContent = end.message ? `${held.name}: ${end.message}` : "";
      show();
      follow();
    }
  }

  function show() {
    by("comparison").hidden = !kept;
    if (!kept) return;
    [by("kept_name").textContent, by("other_name").textContent] = [`Kept: ${kept.name}`, `Open: ${by("name").textContent}`];
    for (const each of [before, now]) Object.assign(each.state, { which: map.state.which, colours: map.state.colours, place: null });
    now.state.fields = map.state.fields;
    for (const [each, canvas, name] of [[before, "kept_map", kept.name], [now, "other_map", by("name").textContent]]) {
      each.fit();
      each.paint();
      by(canvas).setAttribute("aria-label", `${map.state.which} of ${name}`);
    }
    const { end } = kept.curve;
    table([...(kept.facts || []), ...(end ? end.facts : [])], [...(current || []), ...curveFacts()]);
  }

  function table(left, right) {
    const head = element("tr", "");
    head.append(...["", kept.name, by("name").textContent].map((words) => Object.assign(element("th", words), { scope: "col" })));
    const other = new Map(right);
    const body = left.map(([name, value]) => {
      const row = element("tr", "");
      row.append(Object.assign(element("th", name), { scope: "row" }), element("td", value), element("td", other.get(name) || "–"));
      return row;
    });
    by("both").replaceChildren(head, ...body);
  }

  by("drop_kept").onclick = () => {
    kept = null;
    show();
    changed(null);
  };

  return {
    keep(curve) {
      kept = { name: by("name").textContent, recipe: structuredClone(recipe.now), curve, facts: current, answered: JSON.stringify(recipe.now.load) };
      before.state.fields = { ...map.state.fields };
      changed(kept);
      show();
    },
    answered(facts) {
      current = facts;
      show();
      follow();
    },
    show,
  };
}
