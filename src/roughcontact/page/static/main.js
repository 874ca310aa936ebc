// The page: what the user does changes the recipe, and the recipe says what is to be computed.

import { bodyFields } from "./bodies.js";
import { chart } from "./charts.js";
import { cropFields } from "./crop.js";
import { holdings } from "./holds.js";
import { mapView } from "./map.js";
import { BLANK, EXAMPLES, example, fresh, history, titleOf } from "./recipe.js";
import { settings } from "./settings.js";
import { shortcuts } from "./shortcuts.js";
import { trouble } from "./trouble.js";
import { begin, order, upload } from "./wire.js";
import { welcome } from "./welcome.js";
import { loadText, loadValue } from "./words.js";

const UNITS = { pressure: "Pa", force: "N", depth: "m" };
const PATIENCE = 400; // milliseconds that a load may take before a newer one stops it
const MAPS = ["look", "press", "cut"]; // what the middle of the page waits for
const LULL = 250; // milliseconds without another wish, before what takes longer is begun
// What an answer follows from; a load that moves on meanwhile still shows its maps.
const BASES = { look: ["source", "preparation"], study: ["source", "preparation"], bodies: ["bodies"] };
const by = (id) => document.getElementById(id);
let spans = null;
let largest = Infinity;
let points = [];
let curving = null;
let front = null;
let dragged = null;
let lull = null;
let bodies = null; // when the server has said which materials it knows
const names = {}; // of files, by what the server calls them
const wanted = { look: false, press: false, cut: null, bodies: true, study: false };

const say = (text) => (by("said").textContent = text);
const map = mapView(by("map"), { root: by("scale"), canvas: by("strip"), low: by("low"), high: by("high") }, {
  over: (text) => (by("over").textContent = text),
  crop: (part) => { by("crop").click(); crop.dragged(part); },
  small: () => say("A crop holds at least 4 × 4 cells: drag further, or type rows and columns under Preparation."),
  axis: () => {},
  cut: (axis, place) => { wanted.cut = { axis, place: place + 1 }; pump(); },
});
const recipe = history(changed);
const crop = cropFields(recipe);
const fields = settings(recipe);
const holds = holdings(recipe, crop);
const place = welcome(EXAMPLES, (each) => source(example(each)));

function changed(now, before) {
  const differs = (name) => JSON.stringify(now[name]) !== JSON.stringify(before[name]);
  if (differs("source") || differs("preparation")) {
    wanted.look = wanted.study = Boolean(now.source);
    holds.wait();
    map.clear("pressure", "gap", ...(differs("source") ? ["heights"] : []));
    spans = null;
  }
  if (differs("source")) {
    crop.of(null);
    fields.forget();
    holds.forget();
    place.of(titleOf(now.source, names));
  }
  if (differs("bodies")) wanted.bodies = true;
  if (["source", "preparation", "bodies"].some(differs)) forget();
  if (["source", "preparation", "bodies", "load"].some(differs)) wanted.press = Boolean(now.source);
  show();
  pump();
}

// A curve belongs to its surface and bodies: with others it ends.
function forget() {
  if (curving) curving.stop().catch(failed);
  points = [];
  by("curve").replaceChildren();
}

function show() {
  const { source, load } = recipe.now;
  [by("undo").disabled, by("redo").disabled] = [!recipe.can.undo, !recipe.can.redo];
  const title = titleOf(source, names);
  by("name").textContent = title;
  document.title = title ? `${title} – roughcontact` : "roughcontact";
  for (const each of [fields, crop, bodies, holds]) each.show();
  for (const name of ["slider", "load", "start"]) by(name).disabled = !spans || !load;
  if (!load) return;
  by("control").value = load.control;
  by("load").value = load.text;
  const value = loadValue(load.text, UNITS[load.control]);
  if (!spans || !(value > 0) || dragged) return;
  const [low, high] = spans[load.control];
  by("slider").value = String((200 * Math.log(value / low)) / Math.log(high / low));
}

function failed(error) {
  say(error.message);
}

function ended(end, job) {
  const field = trouble(job, end);
  // A file that leaves something open asks for it.
  if (field && end.lacking && document.activeElement === document.body) field.focus();
  if (end.message) say([end.message, end.remedy].filter(Boolean).join(" "));
  return end.how === "done";
}

async function pump() {
  by("view").setAttribute("aria-busy", String(MAPS.some((job) => wanted[job] || (front && front.job === job))));
  if (front) {
    const stale = front.job === "study" ? next() !== "study" : wanted.look || (front.job === "press" && wanted.press);
    if (stale && !front.timer) front.timer = setTimeout(front.sent.stop, front.job === "study" ? 0 : PATIENCE);
    return;
  }
  const job = next();
  clearTimeout(lull);
  if (job === "study") lull = setTimeout(() => !front && next() === "study" && perform("study"), LULL);
  else if (job) perform(job);
}

const next = () => ["look", "press", "cut", "bodies", "study"].find((job) => wanted[job]);

async function perform(job) {
  const more = job === "cut" ? wanted.cut : { pixels: map.pixels() };
  wanted[job] = job === "cut" ? null : false;
  const basis = () => JSON.stringify(job in BASES ? BASES[job].map((name) => recipe.now[name]) : recipe.now);
  const asked = basis();
  const sent = order("front", job, { ...recipe.now, source: recipe.now.source || BLANK }, more, (header, data) => {
    // An answer to what is no longer asked for is dropped; while the slider moves, its maps still follow.
    if ((wanted.look && !(job in BASES)) || (asked !== basis() && !dragged)) return;
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
  ended(end, job);
  if (job === "look" && end.how !== "done") wanted.press = wanted.study = false;
  if (job === "look" && end.message && !map.has("heights")) place.refused(end, titleOf(recipe.now.source, names));
  if (job === "study" && end.how === "stopped") wanted.study = true;
  pump();
}

function heard(header, data) {
  if (header.type === "map") { map.set(header.map, header, data); place.done(); }
  else if (header.type === "doing") say(`${header.words} …`);
  else if (header.type === "channels") { fields.channels(header.channels); holds.channels(header.channels); }
  else if (header.type === "surface") { surface(header); tell(header); }
  else if (header.type === "bodies") bodies.say(header);
  else if (["doubts", "heights", "spectrum", "roughness"].includes(header.type)) holds.study(header);
  else if (header.type === "span") spanned(header);
  else if (header.type === "numbers") { tell(header); say(""); }
  else if (header.type === "pressures") {
    chart(by("pressures"), { x: { label: "pressure", unit: "Pa" }, y: { label: "density", unit: "" }, zero: true,
      series: [{ ...header, label: "computed", kind: "area", colour: "--accent" }] });
  } else if (header.type === "cut") {
    const line = (y, colour) => ({ x: header.x, y, kind: "line", gaps: true, colour });
    chart(by("cut"), { x: { label: `along the ${header.axis}`, unit: "m" }, y: { label: "height over the flat", unit: "m" },
      series: [line(header.before, "--ink-soft"), line(header.under, "--accent")] });
  }
}

function surface(header) {
  crop.of(header.raw);
  fields.of(header.raw);
  holds.surface(header);
}

function spanned({ pressure, force, depth }) {
  spans = pressure ? { pressure, force, depth } : null;
  if (!spans) return say("The surface is flat: there is no scale of loads.");
  if (!recipe.now.load) {
    recipe.change((next) => (next.load = { control: "pressure", text: loadText(pressure[2], "Pa") }), false);
  }
  show();
}

function tell({ facts, notes = [], warned = [], command, python }) {
  by("facts").replaceChildren(...facts.flatMap(([name, value]) => [element("dt", name), element("dd", value)]));
  by("notes").replaceChildren(...[...notes, ...warned].map((line) => element("li", line)));
  [by("command").textContent, by("python").textContent] = [command, python];
}

function element(kind, text) {
  const made = document.createElement(kind);
  made.textContent = text;
  return made;
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

async function curve() {
  points = [];
  [by("start").disabled, by("stop").disabled] = [true, false];
  curving = order("back", "curve", { ...recipe.now, load: null }, {}, (header) => {
    if (header.type === "point") { points.push(header); drawCurve(); }
    else if (header.type === "doing") say(`${header.words} …`);
    else if (header.type === "loads") say(header.notes.join(" "));
    else if (header.type === "curve" && header.fit) say(`Stiffness grows as force to the power ${header.fit.exponent.toFixed(3)}.`);
  });
  try {
    ended(await curving.ended);
  } catch (error) {
    failed(error);
  }
  curving = null;
  [by("start").disabled, by("stop").disabled] = [false, true];
}

function drawCurve() {
  const of = (resolved, kind) => {
    const some = points.filter((each) => each.resolved === resolved);
    return { x: some.map((each) => each.force), y: some.map((each) => each.stiffness), kind, colour: "--accent" };
  };
  chart(by("curve"), { x: { label: "force", unit: "N", log: true }, y: { label: "stiffness", unit: "N/m", log: true },
    series: [of(true, "points"), of(false, "rings")],
    clicked: (force) => recipe.change((next) => (next.load = { control: "force", text: `${force.toPrecision(6)} N` })) });
}

async function exported(kind) {
  const loads = points.length ? { control: "force", values: points.map((each) => each.load) } : undefined;
  const sent = order("back", "export", { ...recipe.now, loads }, { kind, of: "load" }, (header, data) => {
    if (header.type !== "file") return;
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([data])), download: header.name });
    link.click();
    URL.revokeObjectURL(link.href);
  });
  ended(await sent.ended);
}

function listen() {
  by("file").onchange = (event) => event.target.files[0] && opened(event.target.files[0]);
  const dragging = (on) => document.body.classList.toggle("dragged", on);
  addEventListener("dragover", (event) => { event.preventDefault(); dragging(true); });
  addEventListener("dragleave", (event) => event.relatedTarget || dragging(false));
  addEventListener("drop", (event) => { event.preventDefault(); dragging(false); if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  EXAMPLES.forEach((each, k) => by("example").add(new Option(`${each.name}: ${each.about}`, k)));
  by("example").onchange = ({ target }) => { if (target.value) source(example(EXAMPLES[target.value])); target.value = ""; };
  by("control").onchange = ({ target }) => spans && recipe.change((next) => (next.load = { control: target.value, text: loadText(spans[target.value][2], UNITS[target.value]) }));
  by("load").onchange = ({ target }) => recipe.change((next) => (next.load.text = target.value));
  by("slider").oninput = ({ target }) => {
    dragged = dragged || structuredClone(recipe.now);
    const [low, high] = spans[recipe.now.load.control];
    recipe.change((next) => (next.load.text = loadText(low * (high / low) ** (target.value / 200), UNITS[next.load.control])), false);
  };
  by("slider").onchange = () => { const before = dragged; dragged = null; if (before) recipe.remember(before); };
  for (const button of document.querySelectorAll("[data-map]")) button.onclick = () => {
    map.state.which = button.dataset.map;
    for (const each of document.querySelectorAll("[data-map]")) each.setAttribute("aria-pressed", String(each === button));
    map.paint();
  };
  by("crop").onclick = () => { map.state.mode = map.state.mode === "crop" ? "cut" : "crop"; by("crop").setAttribute("aria-pressed", String(map.state.mode === "crop")); };
  by("colours").onchange = ({ target }) => { map.state.colours = target.value; map.paint(); };
  [by("undo").onclick, by("redo").onclick] = [recipe.undo, recipe.redo];
  by("start").onclick = curve;
  by("stop").onclick = () => curving && curving.stop().catch(failed);
  by("export").onchange = ({ target }) => { if (target.value) exported(target.value).catch(failed); target.value = ""; };
  shortcuts({ ...recipe, leave: () => map.state.mode === "crop" && by("crop").click() });
  new MutationObserver(() => map.paint()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  for (const each of document.querySelectorAll("#settings .group")) each.open = innerWidth >= 760;
}

try {
  const begun = await begin();
  largest = begun.largest;
  bodies = bodyFields(recipe, begun.materials);
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
