// The page: what the user does changes the recipe, and the recipe says what is to be computed.

import { comparison } from "./comparison.js";
import { curveView } from "./curve_view.js";
import { cutView } from "./cut_view.js";
import { exports } from "./exports.js";
import { loadBar } from "./load_bar.js";
import { mapView } from "./map.js";
import { numbersView } from "./numbers.js";
import { EXAMPLES, example, fresh, history } from "./recipe.js";
import { begin, order, upload } from "./wire.js";

const PATIENCE = 400; // milliseconds that a load may take before a newer one stops it
const by = (id) => document.getElementById(id);
let largest = Infinity;
let front = null;
let curve = null; // when the server has said which theories it knows
const wanted = { look: false, press: false, cut: false };

const say = (text) => (by("said").textContent = text);
const map = mapView(by("map"), { root: by("scale"), canvas: by("strip"), low: by("low"), high: by("high") }, {
  over: (text, cell) => { by("over").textContent = text; cut.pointed(cell); },
  crop: cropped,
  cut: (axis, place) => cut.at(axis, place),
});
const recipe = history(changed);
const numbers = numbersView();
const load = loadBar(recipe);
const cut = cutView(map, () => { wanted.cut = true; pump(); });
const compare = comparison({ recipe, map, failed, changed: (kept) => curve.keep(kept), curveFacts: () => curve.facts });

function changed(now, before) {
  const differs = (name) => JSON.stringify(now[name]) !== JSON.stringify(before[name]);
  if (differs("source") || differs("preparation")) {
    wanted.look = Boolean(now.source);
    map.clear("pressure", "gap", ...(differs("source") ? ["heights"] : []));
    load.forget();
    cut.forget();
    numbers.forget();
  }
  if (["source", "preparation", "bodies"].some(differs)) curve.forget();
  if (["source", "preparation", "bodies", "load"].some(differs)) wanted.press = Boolean(now.source);
  show();
  pump();
}

function show() {
  const { source, preparation, bodies } = recipe.now;
  [by("undo").disabled, by("redo").disabled] = [!recipe.can.undo, !recipe.can.redo];
  by("open").hidden = !source || source.kind !== "file";
  for (const name of ["level", "despike", "short_cutoff", "long_cutoff"]) by(name).value = preparation[name] || "";
  by("fill").checked = preparation.fill;
  by("uncrop").hidden = !preparation.crop;
  [by("first").value, by("second").value] = bodies.materials;
  load.show();
  curve.show();
}

function failed(error) {
  say(error.message);
}

function ended(end) {
  if (end.message) say([end.message, end.remedy].filter(Boolean).join(" "));
  return end.how === "done";
}

async function pump() {
  if (front) {
    const stale = (front.job === "press" && (wanted.press || wanted.look)) || (front.job === "look" && wanted.look);
    if (stale && !front.timer) front.timer = setTimeout(front.sent.stop, PATIENCE);
    return;
  }
  const job = wanted.look ? "look" : wanted.press ? "press" : wanted.cut ? "cut" : null;
  if (!job) return;
  const more = job === "cut" ? cut.wanted : { pixels: map.pixels() };
  wanted[job] = false;
  if (!more) return;
  const asked = JSON.stringify(recipe.now);
  const sent = order("front", job, recipe.now, more, (header, data) => {
    // An answer to what is no longer asked for is dropped; while the slider moves, its maps still follow.
    if (wanted.look || (asked !== JSON.stringify(recipe.now) && !load.dragged)) return;
    heard(header, data);
  });
  front = { job, sent, timer: null };
  let end = { how: "refused" };
  try {
    end = await sent.ended;
  } catch (error) {
    failed(error);
  }
  clearTimeout(front.timer);
  front = null;
  ended(end);
  if (job === "look" && end.how !== "done") wanted.press = false;
  if (job === "press" && end.how === "refused") load.refused();
  if (job === "press" && end.how === "done") wanted.cut = true;
  pump();
}

function heard(header, data) {
  if (header.type === "map") map.set(header.map, header, data);
  else if (header.type === "doing") say(`${header.words} …`);
  else if (header.type === "channels") channels(header.channels);
  else if (header.type === "surface") numbers.tell(header);
  else if (header.type === "span") load.spanned(header) || say("The surface is flat: there is no scale of loads.");
  else if (header.type === "state") { load.answered(header); cut.answered(header); say(header.advice); }
  else if (header.type === "numbers") answered(header);
  else if (header.type === "pressures") numbers.pressures(header);
  else if (header.type === "cut") cut.heard(header);
}

function answered(header) {
  numbers.tell(header);
  curve.answered(header.point);
  compare.answered(header.facts);
  by("keep").disabled = false;
  show();
}

function channels(found) {
  by("channel").replaceChildren(...found.map((each) => new Option(each.name)));
  const chosen = recipe.now.source.channel;
  if (chosen) by("channel").value = chosen;
}

function cropped([top, bottom, left, right]) {
  by("crop").click();
  recipe.change(({ preparation }) => {
    const [y, , x] = preparation.crop || [0, 0, 0, 0];
    preparation.crop = [y + top, y + bottom, x + left, x + right];
  });
}

async function opened(file) {
  if (file.size > largest) return say(`The file is larger than ${Math.round(largest / 2 ** 20)} MB.`);
  say(`Reading ${file.name} …`);
  try {
    source({ kind: "file", ...(await upload(file)) });
  } catch (error) {
    failed(error);
  }
}

function source({ name, ...found }) {
  by("name").textContent = name;
  recipe.change((next) => Object.assign(next, { source: found, preparation: fresh(), load: null }));
}

function listen() {
  by("file").onchange = (event) => event.target.files[0] && opened(event.target.files[0]);
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => { event.preventDefault(); if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  EXAMPLES.forEach((each, k) => by("example").add(new Option(`${each.name}: ${each.about}`, k)));
  by("example").onchange = ({ target }) => target.value && source({ name: EXAMPLES[target.value].name, ...example(EXAMPLES[target.value]) });
  for (const name of ["channel", "unit", "width"]) by(name).onchange = ({ target }) => recipe.change((next) => (next.source[name] = target.value || null));
  for (const name of ["level", "despike", "short_cutoff", "long_cutoff"]) by(name).onchange = ({ target }) => recipe.change((next) => (next.preparation[name] = target.value || null));
  by("fill").onchange = ({ target }) => recipe.change((next) => (next.preparation.fill = target.checked));
  by("uncrop").onclick = () => recipe.change((next) => (next.preparation.crop = null));
  ["first", "second"].forEach((name, k) => (by(name).onchange = ({ target }) => recipe.change((next) => (next.bodies.materials[k] = target.value))));
  for (const button of document.querySelectorAll("[data-map]")) button.onclick = () => {
    map.state.which = button.dataset.map;
    for (const each of document.querySelectorAll("[data-map]")) each.setAttribute("aria-pressed", String(each === button));
    map.paint();
    compare.show();
  };
  by("crop").onclick = () => { map.state.mode = map.state.mode === "crop" ? "cut" : "crop"; by("crop").setAttribute("aria-pressed", String(map.state.mode === "crop")); };
  by("colours").onchange = ({ target }) => { map.state.colours = target.value; map.paint(); compare.show(); };
  [by("undo").onclick, by("redo").onclick] = [recipe.undo, recipe.redo];
  by("keep").onclick = () => compare.keep(curve.kept);
  exports(by("export"), { wanted: () => ({ ...recipe.now, loads: curve.loads() }), say, failed });
  matchMedia("(prefers-color-scheme: dark)").onchange = () => map.paint();
}

try {
  const given = await begin();
  largest = given.largest;
  for (const name of ["first", "second"]) for (const each of [...Object.keys(given.materials), "rigid"]) by(name).add(new Option(each));
  curve = curveView({ recipe, known: given.theories, usual: load.usual, failed, ended: compare.show });
  listen();
  show();
  if (given.given) source({ kind: "file", ...given.given });
} catch (error) {
  failed(error);
}
