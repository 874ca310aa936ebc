// The form of a part of a job, made from the server's description of its fields: everyday fields first, all others folded.

import { put } from "./typing.js";

const make = (kind, more = {}, ...inside) => {
  const made = Object.assign(document.createElement(kind), more);
  made.append(...inside);
  return made;
};
const option = (value, text = value) => new Option(text, value);
const words = (text) => text.replaceAll("-", " ");
const TRUTHS = [["", "by the file"], ["yes", "yes"], ["no", "no"]];

// `usual(name)` returns the first value of a field that is chosen among several. A form without a separate group has its
// title on the choice, or on its folded part.
export function form(recipe, part, { title, fields, one_of, at_most }, { usual = () => undefined, alone = false } = {}) {
  const group = [...one_of, ...at_most];
  const field = (name) => fields.find((each) => each.name === name);
  const controls = new Map(fields.map((each) => [each.name, control(each)]));
  const lines = new Map(fields.map((each) => [each.name, line(each)]));
  const values = () => recipe.now[part] || {};
  let offered = "";
  const chosen = () => group.find((name) => name in values()) || "";

  function set(name, value) {
    recipe.change((next) => {
      const now = (next[part] = { ...next[part] });
      if (value === "" || value === false || value.length === 0) delete now[name];
      else now[name] = value;
      if (group.includes(name) && value === "") now[name] = ""; // it stays the chosen field
      for (const { name: other, needs } of fields) if (needs && !(needs in now)) delete now[other];
    });
  }

  function choose(name) {
    recipe.change((next) => {
      const now = (next[part] = { ...next[part] });
      for (const { name: other, needs } of fields) if (group.includes(other) || (needs && !(needs in now))) delete now[other];
      if (name) now[name] = usual(name) ?? (field(name).names.length ? field(name).example : "");
      for (const { name: other, needs } of fields) if (needs in now && usual(other)) now[other] = usual(other);
    });
  }

  // The input element of a field, with a function that shows a value in it.
  function control(each) {
    const { name, label, kind, choices, names, example } = each;
    const id = `${part}.${name}`;
    const pair = example.split(",");
    if (kind === "flag") {
      const box = make("input", { id, type: "checkbox", onchange: () => set(name, box.checked) });
      return { root: box, show: (value) => (box.checked = Boolean(value)) };
    }
    if (pair.length > 1 && pair.every((word) => names.includes(word))) {
      const picked = pair.map((_, k) => make("select", { id: k ? `${id}.${k + 1}` : id, onchange: () => set(name, picked.map((all) => all.value).join(",")) }, ...names.map((word) => option(word))));
      picked.forEach((all, k) => all.setAttribute("aria-label", `${label}, ${k + 1}`));
      return { root: make("span", { className: "both" }, ...picked), show: (value) => value && value.split(",").forEach((word, k) => (picked[k].value = word)) };
    }
    if (kind === "choice" || kind === "truth") {
      const list = kind === "truth" ? TRUTHS : [...(each.default === null ? [["", "–"]] : []), ...choices.map((word) => [word, words(word)])];
      const picked = make("select", { id, onchange: () => set(name, kind !== "truth" || !picked.value ? picked.value : picked.value === "yes") }, ...list.map((entry) => option(...entry)));
      return { root: picked, show: (value) => (picked.value = value === true ? "yes" : value === false ? "no" : value ?? each.default ?? "") };
    }
    const plain = { id, placeholder: kind === "texts" ? example : each.default || example, autocomplete: "off", spellcheck: false };
    if (kind === "texts") {
      const area = make("textarea", { ...plain, rows: 2, onchange: () => set(name, area.value.split("\n").map((text) => text.trim()).filter(Boolean)) });
      return { root: area, show: (value) => put(area, (value || []).join("\n")) };
    }
    const input = make("input", { ...plain, onchange: () => set(name, input.value.trim()) });
    if (!names.length) return { root: input, show: (value) => put(input, value || "") };
    input.setAttribute("list", `${id}_names`);
    const known = make("datalist", { id: `${id}_names` }, ...names.map((word) => option(word)));
    return { root: make("span", {}, input, known), show: (value) => put(input, value || "") };
  }

  function line({ name, label, help, kind }) {
    const made = make("label", { title: help, className: kind === "flag" ? "check" : "" }, ...(kind === "flag" ? [controls.get(name).root, ` ${label}`] : [`${label} `, controls.get(name).root]));
    made.dataset.help = help;
    return made;
  }

  const way = make("select", { id: part, onchange: () => choose(way.value) }, ...(one_of.length ? [] : [option("", "none given")]), ...group.map((name) => option(name, field(name).label)));
  const root = make("fieldset", {}, make("legend", { className: "unseen", textContent: title }));
  if (group.length > 1) {
    root.append(make("label", { title: field(group[0]).help }, `${alone ? title.split(" (")[0] : "Given by"} `, way));
    root.lastChild.dataset.help = field(group[0]).help;
  }
  const more = make("details", { className: "more" }, make("summary"));
  const first = fields.some(({ everyday }) => everyday) || (alone && fields.length > 1);
  const rest = alone && !fields.some(({ everyday }) => everyday) ? title : part === "preparation" ? "More steps" : "More";
  for (const each of fields) (each.everyday || !first ? root : more).append(lines.get(each.name));
  if (more.children.length > 1) root.append(more);

  function show() {
    const now = values();
    way.value = chosen();
    for (const { name, needs } of fields) {
      const other = group.length > 1 && group.includes(name) && name !== chosen();
      lines.get(name).hidden = other || Boolean(needs && !(needs in now));
      controls.get(name).show(now[name]);
    }
    const within = fields.filter(({ name }) => more.contains(lines.get(name)));
    const set = within.filter(({ name }) => name in now).length;
    more.hidden = within.every(({ name }) => lines.get(name).hidden);
    more.querySelector("summary").textContent = set ? `${rest} (${set} set)` : rest;
  }
  show();

  return {
    root,
    show,
    // An empty field shows the value from the file.
    hint(name, text) {
      const input = document.getElementById(`${part}.${name}`);
      if (input) input.placeholder = text || field(name).example;
    },
    // The names in a file that can be chosen in a field.
    offer(name, list) {
      if (offered === JSON.stringify(list)) return; // keeps the focus
      offered = JSON.stringify(list);
      const picked = make("select", { id: `${part}.${name}`, onchange: () => set(name, picked.value) }, option("", "by name"), ...list.map((entry) => option(...entry)));
      controls.get(name).root.replaceWith(picked);
      controls.set(name, { root: picked, show: (value) => (picked.value = value || "") });
      show();
    },
  };
}

// A form of the fields that one job has and another has not.
export function rest({ fields, ...form }, other) {
  const known = (other ? other.fields : []).map(({ name }) => name);
  return { ...form, fields: fields.filter(({ name }) => !known.includes(name)) };
}

// The help of the field with the focus, for devices without a hovering pointer.
export function helpLine(root) {
  const tell = ({ target }) => {
    const about = target.closest("[data-help]");
    root.textContent = about ? about.dataset.help : "";
    root.hidden = !about;
  };
  addEventListener("focusin", tell);
  addEventListener("focusout", () => (root.hidden = true));
}
