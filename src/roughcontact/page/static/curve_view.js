// The curve: its loads chosen, its points as they come, what stands beside it.

import { chart, clear } from "./charts.js";
import { curveTable } from "./curve_table.js";
import { UNITS } from "./load_bar.js";
import { facts, list } from "./numbers.js";
import { statement } from "./statement.js";
import { theoryList } from "./theory_list.js";
import { trouble } from "./trouble.js";
import { request } from "./wire.js";
import { loadText } from "./words.js";

const ALONG = { force: "force", pressure: "nominal_pressure", depth: "depth" };
// What follows from the predictions of a theory by a fixed factor.
const OVER_AREA = { interfacial_stiffness_per_area: "interfacial_stiffness", contact_fraction: "contact_area" };
const by = (id) => document.getElementById(id);

export function curveView({ recipe, known, usual, failed, ended }) {
  let running = null;
  let current = null; // { loads, columns, points, end }
  let kept = null;
  let state = null; // the load under the hand, and its numbers
  const [command, python] = [statement(by("curve_command")), statement(by("curve_python"))];
  const theories = theoryList(by("theories"), known, beside);
  const say = (text) => (by("curve_said").textContent = text);

  // What the user wants of the loads, as the server takes it.
  function wanted() {
    const control = by("loads").value;
    if (!control) return { control: "force" };
    return { control, start: by("from").value, end: by("to").value, count: by("count").valueAsNumber || 0 };
  }

  async function start() {
    const loads = wanted();
    const run = { points: [], loads, columns: [], end: null, theories: [] };
    forget();
    current = run;
    show();
    const sent = request("back", "curve", { ...recipe.now, load: null, loads }, {}, (header) => run === current && heard(run, header));
    running = { sent, run };
    show();
    try {
      const end = await sent.ended;
      const field = run === current && trouble("curve", end);
      if (field) say("");
      else if (run === current && end.message) say([end.message, end.remedy].filter(Boolean).join(" "));
      else if (run === current && end.how === "stopped") say("Stopped before the first point.");
    } catch (error) {
      failed(error);
    }
    if (running && running.run === run) running = null;
    if (run === current && run.points.length) await beside();
    show();
  }

  function heard(run, header) {
    if (header.type === "doing") say(`${header.words} …`);
    else if (header.type === "stated") {
      command(header.command);
      python(header.python);
    } else if (header.type === "loads") {
      Object.assign(run, header);
      list(by("curve_notes"), header.notes);
      offer(header.columns);
      show();
      say("");
    } else if (header.type === "point") {
      run.points.push(header);
      draw();
    } else if (header.type === "curve") {
      run.end = header;
      facts(by("curve_facts"), header.facts);
      list(by("curve_notes"), [...run.notes, ...header.notes]);
      draw();
      ended();
    } else if (header.type === "theory") theories.heard(header);
    progress(run);
  }

  function progress(run) {
    const done = run.points.length;
    [by("progress").max, by("progress").value] = [run.count || 1, done];
    if (!run.count || !done) return;
    const open = run.points.filter((each) => !each.resolved).length;
    const stopped = run.end && run.end.stopped ? "Stopped: " : "";
    say(`${stopped}${done} of ${run.count} points${open ? `, ${open} of them not resolved by the grid (open circles)` : ""}.`);
  }

  // The quantities that can be shown.
  function offer(columns) {
    const before = by("quantity").value || "stiffness";
    by("quantity").replaceChildren(...columns.filter(({ name }) => !["force", "nominal_pressure", "residual"].includes(name))
      .map(({ name, label }) => new Option(label, name)));
    by("quantity").value = columns.some(({ name }) => name === before) ? before : "stiffness";
  }

  // Theories are asked for when the points are there, and what the command needs to give the same columns.
  async function beside() {
    const run = current;
    if (!run || running || !run.points.length) return;
    run.theories = theories.chosen;
    try {
      const sent = request("back", "theories", { ...recipe.now, load: null, loads: loads() }, {}, (header) => run === current && heard(run, header));
      const end = await sent.ended;
      if (end.message && run === current) say([end.message, end.remedy].filter(Boolean).join(" "));
      run.theories = theories.chosen;
    } catch (error) {
      failed(error);
    }
    draw();
  }

  // The loads of the curve as far as they are computed, and what stands beside them.
  function loads() {
    if (!current || !current.points.length) return undefined;
    const { control } = current.loads;
    const whole = current.end && !current.end.stopped;
    const more = { theories: current.theories, conducting: by("quantity").value.includes("conductance") };
    return whole ? { ...current.loads, ...more } : { control, values: current.points.map((each) => each.load), ...more };
  }

  function lines(run, colour, name) {
    const along = ALONG[current.loads.control];
    const of = (resolved, kind, label) => {
      const some = run.points.filter((each) => each.resolved === resolved);
      return { x: some.map((each) => each[along]), y: some.map((each) => each[by("quantity").value]), kind, colour, label };
    };
    return [of(true, "points", name), of(false, "rings", `${name}, not resolved`)].filter(({ x }) => x.length);
  }

  function draw() {
    if (!current || !current.columns.length) return;
    const name = by("quantity").value;
    const log = by("axes").value === "logarithmic";
    const column = (wanted) => current.columns.find((each) => each.name === wanted);
    const along = ALONG[current.loads.control];
    const series = lines(current, "--accent", kept ? "this surface" : "computed");
    if (kept) series.push(...lines(kept.curve, "--second", `kept: ${kept.name}`));
    const x = current.points.map((each) => each[along]);
    const { fit } = current.end || {};
    if (fit && name === "stiffness" && along === "force") {
      series.push({ x: fit.force, y: fit.stiffness, label: `power law, exponent ${fit.exponent.toFixed(3)}`, kind: "line", colour: "--ink-soft" });
    }
    for (const line of theories.lines(OVER_AREA[name] || name)) {
      const scale = OVER_AREA[name] ? current.points[0][name] / current.points[0][OVER_AREA[name]] : 1;
      series.push({ ...line, x, y: line.y.map((value) => (value === null ? null : value * scale)), kind: "line" });
    }
    if (state && Number.isFinite(state[name]) && state[along] > 0) {
      series.push({ x: [state[along]], y: [state[name]], label: "the load shown", kind: "mark", colour: "--mark" });
    }
    chart(by("curve"), { x: { ...column(along), log }, y: { ...column(name), log }, count: current.points.length, series, clicked: (place) => {
      const near = (each) => Math.abs(Math.log(each[along] / place));
      choose([...current.points].sort((a, b) => near(a) - near(b))[0]);
    } });
    curveTable(by("points"), current, state, choose);
  }

  function choose(point) {
    const { control } = current.loads;
    recipe.change((next) => (next.load = { control, text: loadText(point.load, UNITS[control], 6) }));
  }

  function show() {
    const ready = Boolean(usual("force") && recipe.now.load);
    [by("start").disabled, by("stop").disabled] = [Boolean(running) || !ready, !running];
    by("progress").hidden = !running;
    by("of_curve").hidden = !current || !current.columns.length;
  }

  // A curve belongs to its surface and bodies: with others it ends.
  function forget() {
    if (running) running.sent.stop().catch(failed);
    running = current = null;
    theories.forget();
    clear(by("curve"));
    for (const id of ["curve_facts", "curve_notes", "points"]) by(id).replaceChildren();
    say("Start presses the surface by rising loads.");
  }

  by("start").onclick = start;
  by("stop").onclick = () => running && running.sent.stop().catch(failed);
  by("axes").onchange = draw;
  by("quantity").onchange = () => { draw(); beside(); };
  by("loads").onchange = ({ target: { value: control } }) => {
    by("range").hidden = !control;
    if (!control || !usual(control)) return;
    const [, high, start] = usual(control);
    [by("from").value, by("to").value] = [loadText(start / 30, UNITS[control], 1), loadText(Math.min(30 * start, high), UNITS[control], 1)];
  };

  return {
    show,
    forget,
    loads,
    get facts() {
      return current && current.end ? current.end.facts : [];
    },
    get kept() {
      return current && current.points.length ? structuredClone(current) : { points: [], loads: { control: "force" }, columns: [] };
    },
    keep(other) {
      kept = other;
      draw();
    },
    // The load that is shown, with its numbers.
    answered(record) {
      state = record;
      draw();
    },
  };
}
