// The page: what the user does changes the recipe, and the recipe says what is to be computed.

import { chart } from "./charts.js";
import { mapView } from "./map.js";
import { EXAMPLES, example, fresh, history } from "./recipe.js";
import { begin, order, upload } from "./wire.js";
import { loadText, loadValue } from "./words.js";

const UNITS = { pressure: "Pa", force: "N", depth: "m" };
const PATIENCE = 400; // milliseconds that a load may take before a newer one stops it
const by = (id) => document.getElementById(id);
let spans = null;
let largest = Infinity;
let points = [];
let curving = null;
let front = null;
let dragged = null;
const wanted = { look: false, press: false, cut: null };

const say = (text) => (by("said").textContent = text);
const map = mapView(by("map"), { root: by("scale"), canvas: by("strip"), low: by("low"), high: by("high") }, {
  over: (text) => (by("over").textContent = text),
  crop: cropped,
  axis: () => {},
  cut: (axis, place) => { wanted.cut = { axis, place: place + 1 }; pump(); },
});
const recipe = history(changed);

function changed(now, before) {
  const differs = (name) => JSON.stringify(now[name]) !== JSON.stringify(before[name]);
  if (differs("source") || differs("preparation")) {
    wanted.look = Boolean(now.source);
    map.clear("pressure", "gap", ...(differs("source") ? ["heights"] : []));
    spans = null;
  }
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
  const { source, preparation, bodies, load } = recipe.now;
  [by("undo").disabled, by("redo").disabled] = [!recipe.can.undo, !recipe.can.redo];
  by("open").hidden = !source || source.kind !== "file";
  for (const name of ["level", "despike", "short_cutoff", "long_cutoff"]) by(name).value = preparation[name] || "";
  by("fill").checked = preparation.fill;
  by("uncrop").hidden = !preparation.crop;
  [by("first").value, by("second").value] = bodies.materials;
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

function ended(end) {
  if (end.message) say([end.message, end.remedy].filter(Boolean).join(" "));
  return end.how === "done";
}

async function pump() {
  by("view").setAttribute("aria-busy", String(Boolean(front || wanted.look || wanted.press || wanted.cut)));
  if (front) {
    const stale = (front.job === "press" && (wanted.press || wanted.look)) || (front.job === "look" && wanted.look);
    if (stale && !front.timer) front.timer = setTimeout(front.sent.stop, PATIENCE);
    return;
  }
  const job = wanted.look ? "look" : wanted.press ? "press" : wanted.cut ? "cut" : null;
  if (!job) return;
  const more = job === "cut" ? wanted.cut : { pixels: map.pixels() };
  wanted[job] = job === "cut" ? null : false;
  const asked = JSON.stringify(recipe.now);
  const sent = order("front", job, recipe.now, more, (header, data) => {
    // An answer to what is no longer asked for is dropped; while the slider moves, its maps still follow.
    if (wanted.look || (asked !== JSON.stringify(recipe.now) && !dragged)) return;
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
  pump();
}

function heard(header, data) {
  if (header.type === "map") map.set(header.map, header, data);
  else if (header.type === "doing") say(`${header.words} …`);
  else if (header.type === "channels") channels(header.channels);
  else if (header.type === "surface") tell(header);
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

function channels(found) {
  by("channel").replaceChildren(...found.map((each) => new Option(each.name)));
  const chosen = recipe.now.source.channel;
  if (chosen) by("channel").value = chosen;
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
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => { event.preventDefault(); if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  EXAMPLES.forEach((each, k) => by("example").add(new Option(`${each.name}: ${each.about}`, k)));
  by("example").onchange = ({ target }) => target.value && source({ name: EXAMPLES[target.value].name, ...example(EXAMPLES[target.value]) });
  for (const name of ["channel", "unit", "width"]) by(name).onchange = ({ target }) => recipe.change((next) => (next.source[name] = target.value || null));
  for (const name of ["level", "despike", "short_cutoff", "long_cutoff"]) by(name).onchange = ({ target }) => recipe.change((next) => (next.preparation[name] = target.value || null));
  by("fill").onchange = ({ target }) => recipe.change((next) => (next.preparation.fill = target.checked));
  by("uncrop").onclick = () => recipe.change((next) => (next.preparation.crop = null));
  ["first", "second"].forEach((name, k) => (by(name).onchange = ({ target }) => recipe.change((next) => (next.bodies.materials[k] = target.value))));
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
  matchMedia("(prefers-color-scheme: dark)").onchange = () => map.paint();
}

try {
  const given = await begin();
  largest = given.largest;
  for (const name of ["first", "second"]) for (const each of [...Object.keys(given.materials), "rigid"]) by(name).add(new Option(each));
  listen();
  show();
  if (given.given) source({ kind: "file", ...given.given });
} catch (error) {
  failed(error);
}
