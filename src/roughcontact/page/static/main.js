// The page: the user changes the recipe, and the page computes its answers.

import { comparison } from "./comparison.js";
import { dragged } from "./crop.js";
import { curveView } from "./curve_view.js";
import { cutView } from "./cut_view.js";
import { exports } from "./exports.js";
import { form, helpLine } from "./form.js";
import { loadBar } from "./load_bar.js";
import { mapView } from "./map.js";
import { element, list, numbersView } from "./numbers.js";
import { progressBar } from "./progress.js";
import { examplesOf, fresh, history, jobOf, partsOf, profileOf, titleOf } from "./recipe.js";
import { shortcuts } from "./shortcuts.js";
import { surfaceView } from "./surface_view.js";
import { trouble } from "./trouble.js";
import { begin, request, upload } from "./wire.js";
import { welcome } from "./welcome.js";
import { written } from "./words.js";

const PATIENCE = 400; // milliseconds after which a newer load stops the current one
const MAPS = ["look", "press", "cut"]; // jobs that the middle of the page shows
const LATER = ["flattened", "traction"]; // maps from the curve
const LULL = 250; // milliseconds without another request, before a longer job begins
const BLANK = { kind: "example", example: "ground" }; // placeholder in requests that need no surface
const by = (id) => document.getElementById(id);
let largest = Infinity;
let front = null;
let lull = null;
let forms = null; // the server's description of the fields
let curve = null;
let raw = null; // the surface before its preparation
let same = {}; // equivalent values of other fields of the bodies
let examples = [];
let place = null;
const shown = { source: null }; // the current forms, by their parts
const names = {}; // names of files, by their names on the server
const wanted = { look: false, press: false, cut: false, bodies: true, study: false };

const say = (text) => (by("said").textContent = text);
const working = progressBar(by("working"), by("said"));
const map = mapView(by("map"), { root: by("scale"), canvas: by("strip"), low: by("low"), high: by("high"), ringed: by("ringed") }, {
  over: (text, cell) => { by("over").textContent = text; cut.pointed(cell); },
  crop(part) {
    by("crop").click();
    recipe.change(({ preparation }) => (preparation.crop = dragged(part, preparation.crop, raw.shape, map.state.fields.heights.cells)));
  },
  small: () => say("A crop needs at least 4 × 4 cells: drag over more cells, or type the rows and columns under Preparation."),
  cut: (axis, place) => cut.at(axis, place),
});
const recipe = history(changed);
const surfaceCard = surfaceView(recipe);
const load = loadBar(recipe);
const numbers = numbersView();
const cut = cutView(map, () => { wanted.cut = true; pump(); });
const compare = comparison({ recipe, jobOf: (state) => jobOf("press", state, forms), map, failed, changed: (kept) => curve.keep(kept), curveFacts: () => curve.facts });

// The job of the recipe for a request.
const JOBS = { look: "surface", study: "surface", bodies: "curve", press: "press", cut: "press" };
function asked(question) {
  const { now } = recipe;
  if (question === "bodies") return { job: "curve", source: BLANK, bodies: now.bodies, plastic: jobOf("curve", now, forms).plastic };
  if (question === "press" ? !load.ready : JOBS[question] === "surface" && profileOf(now)) {
    const { source, preparation, bodies, contact } = jobOf("curve", now, forms);
    return { job: "curve", source, preparation, bodies, contact };
  }
  return jobOf(JOBS[question], now, forms);
}

function changed(now, before) {
  const differs = (name) => JSON.stringify(now[name]) !== JSON.stringify(before[name]);
  const other = differs("source") || profileOf(now) !== profileOf(before);
  if (other || differs("preparation")) {
    wanted.look = wanted.study = Boolean(now.source);
    surfaceCard.wait();
    map.spikes([]);
    map.clear("pressure", "gap", ...(other ? ["heights"] : []));
    load.forget(other);
    cut.forget();
    numbers.forget(other);
  }
  if (other) {
    surfaceCard.forget();
    place.of(titleOf(now.source, names, examples));
    by("keep").disabled = true;
  }
  const pressed = partsOf("press", forms).some(differs);
  if (differs("bodies") || differs("plastic")) wanted.bodies = true;
  if (differs("kind") || partsOf("press", forms).some((part) => part !== "load" && differs(part))) {
    curve.forget();
    map.clear(...LATER);
  }
  if (pressed) wanted.press = Boolean(now.source);
  show();
  pump();
}

function show() {
  const { source } = recipe.now;
  [by("undo").disabled, by("redo").disabled] = [!recipe.can.undo, !recipe.can.redo];
  const title = titleOf(source, names, examples);
  by("name").textContent = title;
  document.title = title ? `${title} – roughcontact` : "roughcontact";
  if (source && shown.kind !== source.kind) {
    shown.kind = source.kind;
    shown.source = form(recipe, "source", forms.sources[source.kind]);
    by("source_form").replaceChildren(shown.source.root);
  }
  const [control = "pressure"] = Object.keys(recipe.now.load || {});
  shown.plastic.hint("after", forms.jobs.press.load.fields.find(({ name }) => name === control).example);
  for (const name of LATER) by(name).hidden = !map.has(name);
  for (const part of ["source", "preparation", "bodies", "plastic", "contact"]) if (shown[part]) shown[part].show();
  for (const each of [surfaceCard, load, curve]) each.show();
}

function failed(error) {
  say(error.message);
}

function ended(end, job) {
  const field = trouble(job, end);
  // The first field that the file requires gets the focus.
  if (field && field.id.startsWith("source.") && document.activeElement === document.body) field.focus();
  if (end.message) say(field === by("load") ? "" : end.message);
  by("again").hidden = end.how !== "died";
  return end.how === "done";
}

// Grey parts of the page are marked as busy.
function busy(now) {
  for (const id of ["view", "numbers"]) by(id).setAttribute("aria-busy", String(now));
  by("curves").setAttribute("aria-busy", String(now && by("start").disabled));
  by("load").placeholder = now && by("load").disabled ? "computing …" : "";
}

// Request all answers to the recipe again, after a process has died.
function again() {
  by("again").hidden = true;
  Object.assign(wanted, { look: true, press: true, bodies: true, study: true });
  pump();
}

// Only obsolete requests are stopped; while the slider moves, maps are shown as fast as they are computed.
async function pump() {
  busy(MAPS.some((job) => wanted[job] || (front && front.job === job)));
  if (front) {
    const stale = front.job === "bodies" ? false : front.job === "study" ? next() !== "study" : wanted.look || (front.job === "press" && wanted.press && !load.dragged);
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
  const basis = () => JSON.stringify(asked(job));
  const before = basis();
  const answers = asked(job).job; // a press without a load first gets suitable loads, then the contact
  const sent = request("front", job, asked(job), more, (header, data) => {
    // Obsolete answers are dropped, except maps while the slider moves.
    if ((wanted.look && JOBS[job] === "press") || (before !== basis() && !load.dragged)) return;
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
  if (JOBS[job] === "press" || job === "look") by("numbers").classList.toggle("stale", !["done", "stopped"].includes(end.how));
  if (job === "look" && end.how !== "done" && !wanted.look) {
    wanted.press = wanted.study = false;
    surfaceCard.refused();
  }
  if (job === "look" && end.message && !map.has("heights")) place.refused(end, titleOf(recipe.now.source, names, examples));
  if (job === "press" && end.how === "done" && load.ready) wanted[answers === "press" ? "cut" : "press"] = true;
  if (job === "study" && !wanted.study) {
    if (end.how === "stopped") wanted.study = true;
    else surfaceCard.done();
  }
  pump();
}

function heard(header, data) {
  if (header.type === "map") { map.set(header.map, header, data); place.done(); }
  else if (header.type === "progress") working.heard(header);
  else if (header.type === "channels") { channels(header.channels); surfaceCard.channels(header.channels); }
  else if (header.type === "surface") { surface(header); numbers.tell(header); }
  else if (header.type === "bodies") told(header);
  else if (["warnings", "heights", "spectrum", "roughness"].includes(header.type)) surfaceCard.study(header);
  else if (header.type === "spikes") map.spikes(header.places);
  else if (header.type === "span") load.spanned(header) || say("The surface is flat, so the page cannot choose a load: open a rough surface.");
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
  raw = header.raw;
  shown.source.hint("size", [...new Set(raw.lengths.map((side) => written(side, "m", 4)))].join(" x "));
  surfaceCard.surface(header);
}

function channels(found) {
  const shownAs = ({ name, is_height }) => [name, is_height ? name : `${name} (not heights)`];
  shown.source.offer("channel", found.map(shownAs));
  const { unit } = found.find(({ name }) => name === recipe.now.source.channel) || found.find(({ is_height }) => is_height) || {};
  shown.source.hint("unit", typeof unit === "number" ? `${unit} m` : unit);
}

function told(header) {
  same = header.same;
  list(by("bodies_said"), header.lines);
}

async function opened(file) {
  if (file.size > largest) return say(`The file is larger than ${Math.round(largest / 2 ** 20)} MB: use the command line.`);
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
  const { source: open, preparation } = recipe.now;
  if (JSON.stringify([open, preparation]) === JSON.stringify([found, fresh(found)])) return again();
  recipe.change((next) => Object.assign(next, { source: found, preparation: fresh(found), load: null }));
}

function listen() {
  by("file").onchange = (event) => event.target.files[0] && opened(event.target.files[0]);
  const dragging = (on) => document.body.classList.toggle("dragged", on);
  addEventListener("dragover", (event) => { event.preventDefault(); dragging(true); });
  addEventListener("dragleave", (event) => event.relatedTarget || dragging(false));
  addEventListener("drop", (event) => { event.preventDefault(); dragging(false); if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  examples.forEach((each, k) => by("example").add(new Option(`${each.name}: ${each.about}`, k)));
  by("example").onchange = ({ target }) => { if (target.value) source(examples[target.value].source); target.value = ""; };
  for (const button of document.querySelectorAll("[data-map]")) button.onclick = () => {
    map.state.which = button.dataset.map;
    for (const each of document.querySelectorAll("[data-map]")) each.setAttribute("aria-pressed", String(each === button));
    map.paint();
    compare.show();
  };
  by("crop").onclick = () => { map.state.mode = map.state.mode === "crop" ? "cut" : "crop"; by("crop").setAttribute("aria-pressed", String(map.state.mode === "crop")); };
  by("colours").onchange = ({ target }) => { map.state.colours = target.value; map.paint(); compare.show(); };
  [by("undo").onclick, by("redo").onclick, by("again").onclick] = [recipe.undo, recipe.redo, again];
  by("keep").onclick = () => compare.keep(curve.kept);
  exports(by("export"), { load: () => asked(load.ready ? "press" : "look"), curve: () => curve.job(), source: () => recipe.now.source, say, failed });
  helpLine(by("help"));
  shortcuts({ ...recipe, leave: () => map.state.mode === "crop" && by("crop").click() });
  new MutationObserver(() => { map.paint(); compare.show(); }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  for (const each of document.querySelectorAll("#settings .group[open], #curves details[open]")) each.open = innerWidth >= 760;
}

// The parts before a surface is pressed: one group for each part, with its title.
function groups() {
  for (const part of ["preparation", "bodies", "plastic", "contact"]) {
    const made = forms.jobs.press[part];
    shown[part] = form(recipe, part, made, { usual: (name) => (part === "bodies" ? same[name] : undefined) });
    const group = Object.assign(element("details", ""), { className: "group", open: part === "preparation" || part === "bodies" });
    const summary = element("summary", "");
    summary.append(element("h2", made.title));
    group.append(summary, shown[part].root);
    if (part === "bodies") group.append(by("bodies_said"));
    by("groups").append(group);
  }
}

// The state that the tab keeps when it is reloaded; its file must still be on the server.
const KEPT = "roughcontact";
const kept = JSON.parse(sessionStorage.getItem(KEPT) || "{}");
function goesOn({ recipe: before, names: had }, files) {
  if (!before || !before.source) return null;
  const { kind, file } = before.source;
  return kind !== "file" || (had[file] && had[file] === files[file]) ? before : null;
}

try {
  const begun = await begin(kept.session);
  Object.assign(names, begun.files);
  ({ largest, forms } = begun);
  examples = examplesOf(forms);
  place = welcome(examples.slice(0, 4), (each) => source(each.source));
  groups();
  curve = curveView({ recipe, forms, known: begun.theories, load, failed, ended: compare.show, mapped: (header, data) => { map.set(header.map, header, data); show(); } });
  listen();
  document.querySelector("main").inert = false; // handlers are only set now
  show();
  pump();
  const before = goesOn(kept, begun.files);
  const [early] = by("file").files; // chosen before the first answer of the server
  if (early) opened(early);
  else if (before) recipe.change((next) => Object.assign(next, before));
  else if (begun.given) given(begun.given);
  else if (kept.recipe && kept.recipe.source) say(`The server no longer has ${kept.names[kept.recipe.source.file]}: drop it again.`);
  addEventListener("pagehide", () => sessionStorage.setItem(KEPT, JSON.stringify({ session: begun.session, recipe: recipe.now, names })));
} catch (error) {
  failed(error);
}
