// The page: what the user does changes the recipe, and the recipe says what is to be computed.

import { bodyFields } from "./bodies.js";
import { comparison } from "./comparison.js";
import { cropFields } from "./crop.js";
import { curveView } from "./curve_view.js";
import { cutView } from "./cut_view.js";
import { exports } from "./exports.js";
import { loadBar } from "./load_bar.js";
import { mapView } from "./map.js";
import { numbersView } from "./numbers.js";
import { progressBar } from "./progress.js";
import { BLANK, EXAMPLES, example, fresh, history, titleOf } from "./recipe.js";
import { settings } from "./settings.js";
import { shortcuts } from "./shortcuts.js";
import { surfaceView } from "./surface_view.js";
import { trouble } from "./trouble.js";
import { begin, request, upload } from "./wire.js";
import { welcome } from "./welcome.js";

const PATIENCE = 400; // milliseconds that a load may take before a newer one stops it
const MAPS = ["look", "press", "cut"]; // what the middle of the page waits for
const LULL = 250; // milliseconds without another wish, before what takes longer is begun
// What an answer follows from; a load that moves on meanwhile still shows its maps.
const BASES = { look: ["source", "preparation"], study: ["source", "preparation"], bodies: ["bodies"] };
const by = (id) => document.getElementById(id);
let largest = Infinity;
let front = null;
let lull = null;
let bodies = null; // when the server has said which materials it knows
let curve = null; // and which theories
const names = {}; // of files, by what the server calls them
const wanted = { look: false, press: false, cut: false, bodies: true, study: false };

const say = (text) => (by("said").textContent = text);
const working = progressBar(by("working"), by("said"));
const map = mapView(by("map"), { root: by("scale"), canvas: by("strip"), low: by("low"), high: by("high") }, {
  over: (text, cell) => { by("over").textContent = text; cut.pointed(cell); },
  crop: (part) => { by("crop").click(); crop.dragged(part); },
  small: () => say("A crop holds at least 4 × 4 cells: drag further, or type rows and columns under Preparation."),
  cut: (axis, place) => cut.at(axis, place),
});
const recipe = history(changed);
const crop = cropFields(recipe);
const fields = settings(recipe);
const surfaceCard = surfaceView(recipe, crop);
const load = loadBar(recipe);
const numbers = numbersView();
const cut = cutView(map, () => { wanted.cut = true; pump(); });
const compare = comparison({ recipe, map, failed, changed: (kept) => curve.keep(kept), curveFacts: () => curve.facts });
const place = welcome(EXAMPLES, (each) => source(example(each)));

function changed(now, before) {
  const differs = (name) => JSON.stringify(now[name]) !== JSON.stringify(before[name]);
  if (differs("source") || differs("preparation")) {
    wanted.look = wanted.study = Boolean(now.source);
    surfaceCard.wait();
    map.clear("pressure", "gap", ...(differs("source") ? ["heights"] : []));
    load.forget();
    cut.forget();
    numbers.forget(differs("source"));
  }
  if (differs("source")) {
    crop.of(null);
    fields.forget();
    surfaceCard.forget();
    place.of(titleOf(now.source, names));
    by("keep").disabled = true;
  }
  if (differs("bodies")) wanted.bodies = true;
  if (["source", "preparation", "bodies"].some(differs)) curve.forget();
  if (["source", "preparation", "bodies", "load"].some(differs)) wanted.press = Boolean(now.source);
  show();
  pump();
}

function show() {
  const { source } = recipe.now;
  [by("undo").disabled, by("redo").disabled] = [!recipe.can.undo, !recipe.can.redo];
  const title = titleOf(source, names);
  by("name").textContent = title;
  document.title = title ? `${title} – roughcontact` : "roughcontact";
  for (const each of [fields, crop, bodies, surfaceCard, load, curve]) each.show();
}

function failed(error) {
  say(error.message);
}

function ended(end, job) {
  const field = trouble(job, end);
  // A file that leaves something open asks for it.
  if (field && end.lacking && document.activeElement === document.body) field.focus();
  if (end.message) say(field === by("load") ? "" : [end.message, end.remedy].filter(Boolean).join(" "));
  return end.how === "done";
}

// Of what runs, only what is no longer asked for is stopped; under a moving slider maps follow as fast as they come.
async function pump() {
  by("view").setAttribute("aria-busy", String(MAPS.some((job) => wanted[job] || (front && front.job === job))));
  if (front) {
    const stale = front.job === "study" ? next() !== "study" : wanted.look || (front.job === "press" && wanted.press && !load.dragged);
    if (stale && !front.timer) front.timer = setTimeout(front.sent.stop, front.job === "study" ? 0 : PATIENCE);
    return;
  }
  const job = next();
  clearTimeout(lull);
  if (job === "study") lull = setTimeout(() => !front && next() === "study" && perform("study"), LULL);
  else if (job) perform(job);
}

const next = () => ["bodies", "look", "press", "cut", "study"].find((job) => wanted[job]);

async function perform(job) {
  const more = job === "cut" ? cut.wanted : { pixels: map.pixels() };
  wanted[job] = false;
  if (!more) return pump();
  const basis = () => JSON.stringify(job in BASES ? BASES[job].map((name) => recipe.now[name]) : recipe.now);
  const asked = basis();
  const sent = request("front", job, { ...recipe.now, source: recipe.now.source || BLANK }, more, (header, data) => {
    // An answer to what is no longer asked for is dropped; while the slider moves, its maps still follow.
    if ((wanted.look && !(job in BASES)) || (asked !== basis() && !load.dragged)) return;
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
  working.end();
  ended(end, job);
  if (job === "look" && end.how !== "done" && !wanted.look) {
    wanted.press = wanted.study = false;
    surfaceCard.refused();
  }
  if (job === "look" && end.message && !map.has("heights")) place.refused(end, titleOf(recipe.now.source, names));
  if (job === "press" && end.how === "done") wanted.cut = true;
  if (job === "study" && !wanted.study) {
    if (end.how === "stopped") wanted.study = true;
    else surfaceCard.done();
  }
  pump();
}

function heard(header, data) {
  if (header.type === "map") { map.set(header.map, header, data); place.done(); }
  else if (header.type === "progress") working.heard(header);
  else if (header.type === "channels") { fields.channels(header.channels); surfaceCard.channels(header.channels); }
  else if (header.type === "surface") { surface(header); numbers.tell(header); }
  else if (header.type === "bodies") bodies.say(header);
  else if (["warnings", "heights", "spectrum", "roughness"].includes(header.type)) surfaceCard.study(header);
  else if (header.type === "span") load.spanned(header) || say("The surface is flat: there is no scale of loads.");
  else if (header.type === "state") { load.answered(header); cut.answered(header); say(header.warning); }
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

function surface(header) {
  crop.of(header.raw);
  fields.of(header.raw);
  surfaceCard.surface(header);
}

async function opened(file) {
  if (file.size > largest) return say(`The file is larger than ${Math.round(largest / 2 ** 20)} MB.`);
  say(`Reading ${file.name} …`);
  try {
    given(await upload(file));
  } catch (error) {
    failed(error);
  }
}

function given({ file, name }) {
  names[file] = name;
  source({ kind: "file", file });
}

function source(found) {
  recipe.change((next) => Object.assign(next, { source: found, preparation: fresh(), load: null }));
}

function listen() {
  by("file").onchange = (event) => event.target.files[0] && opened(event.target.files[0]);
  const dragging = (on) => document.body.classList.toggle("dragged", on);
  addEventListener("dragover", (event) => { event.preventDefault(); dragging(true); });
  addEventListener("dragleave", (event) => event.relatedTarget || dragging(false));
  addEventListener("drop", (event) => { event.preventDefault(); dragging(false); if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  EXAMPLES.forEach((each, k) => by("example").add(new Option(`${each.name}: ${each.about}`, k)));
  by("example").onchange = ({ target }) => { if (target.value) source(example(EXAMPLES[target.value])); target.value = ""; };
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
  shortcuts({ ...recipe, leave: () => map.state.mode === "crop" && by("crop").click() });
  new MutationObserver(() => { map.paint(); compare.show(); }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  for (const each of document.querySelectorAll("#settings .group, #curves details[open]")) each.open = innerWidth >= 760;
}

try {
  const begun = await begin();
  largest = begun.largest;
  bodies = bodyFields(recipe, begun.materials);
  curve = curveView({ recipe, known: begun.theories, usual: load.usual, failed, ended: compare.show });
  listen();
  document.querySelector("main").inert = false; // before, nobody would answer
  show();
  pump();
  const [early] = by("file").files; // chosen before the server had answered
  if (early) opened(early);
  else if (begun.given) given(begun.given);
} catch (error) {
  failed(error);
}
