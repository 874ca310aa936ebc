// The curve: increasing loads, a loop, or adhesive surfaces; its points as they come, and theories.

import { chart, clear } from "./charts.js";
import { curveTable } from "./curve_table.js";
import { form, rest } from "./form.js";
import { facts, list } from "./numbers.js";
import { progressBar } from "./progress.js";
import { jobOf, profileOf } from "./recipe.js";
import { statement } from "./statement.js";
import { theoryList } from "./theory_list.js";
import { trouble } from "./trouble.js";
import { request } from "./wire.js";
import { loadText } from "./words.js";

const ALONG = { force: "force", pressure: "nominal_pressure", depth: "depth" };
// Quantities that are predictions of a theory times a constant.
const OVER_AREA = { interfacial_stiffness_per_area: "interfacial_stiffness", contact_fraction: "contact_area" };
const COLOURS = { unloading: "--second", reloading: "--third", retreat: "--second", jump: "--ink-soft", "pull-off force": "--mark" };
const DASHES = { jump: [3, 3], "pull-off force": [8, 4] };
const by = (id) => document.getElementById(id);

export function curveView({ recipe, forms, known, load, failed, ended, mapped }) {
  let running = null;
  let current = null; // { job, columns, points, end }
  let kept = null;
  let state = null; // the current load, and its numbers
  let shape = ""; // kind of the curve whose quantities are listed
  let own = { kind: null, parts: [] }; // the forms that this kind of curve has and a single load has not
  const [command, python] = [statement(by("curve_command")), statement(by("curve_python"))];
  const theories = theoryList(by("theories"), known, beside);
  const say = (text) => (by("curve_said").textContent = text);
  const search = progressBar(by("progress"), by("curve_said")); // for the search of loads; points of the curve have a separate count
  const sticks = (run) => run.job.job !== "curve";
  // The kind of load that is prescribed.
  const controlOf = ({ job }) => (Object.keys(job.loads || {})[0] || "forces").slice(0, -1);
  const along = (run) => (sticks(run) ? "depth" : ALONG[controlOf(run)]);

  // The job of the curve; theories are requested when its points are complete.
  function wanted() {
    const { theories: _, ...job } = jobOf(recipe.now.kind, recipe.now, forms);
    const { materials } = job.bodies;
    if (job.conduction && !Object.keys(job.conduction).length && materials && !materials.includes("rigid") && !profileOf(job)) {
      job.conduction = { resistivity: materials, conductivity: materials };
    }
    return job;
  }

  // Loads without a unit: the user must give it.
  function bare(job) {
    return own.parts.flatMap(({ part, fields }) => fields.flatMap(({ name, example }) => {
      const text = (job[part] || {})[name];
      const open = typeof text === "string" && /\d[a-z]/i.test(example) && /^[\d.,:\s-]+$/.test(text);
      return open ? [{ places: [`${part}.${name}`], message: `${text} has no unit: write it as in ${example}.` }] : [];
    }));
  }

  async function start() {
    const run = { points: [], job: wanted(), columns: [], end: null };
    const faults = bare(run.job);
    if (faults.length) return trouble("curve", { faults });
    forget();
    current = run;
    show();
    const sent = request("back", "curve", run.job, {}, (header, data) => run === current && heard(run, header, data));
    running = { sent, run };
    show();
    try {
      const end = await sent.ended;
      const field = run === current && trouble("curve", end);
      if (field) say("");
      else if (run === current && end.message) say(end.message);
      else if (run === current && end.how === "stopped") say("Stopped before the first point.");
    } catch (error) {
      failed(error);
    }
    if (running && running.run === run) running = null;
    if (run === current && run.end && !sticks(run)) await beside();
    show();
  }

  function heard(run, header, data) {
    if (header.type === "progress") return run.columns.length || search.heard(header);
    if (header.type === "map") mapped(header, data);
    else if (header.type === "stated") {
      command(header.command);
      python(header.python);
    } else if (header.type === "loads") {
      Object.assign(run, header);
      list(by("curve_notes"), header.notes);
      offer(run);
      show();
      say("");
    } else if (header.type === "point") {
      run.points.push(header);
      draw();
    } else if (header.type === "curve") {
      run.end = header;
      if (header.stopped) run.points.length = Math.min(run.points.length, header.count); // the last point may have been dropped
      facts(by("curve_facts"), header.facts);
      list(by("curve_notes"), [...run.notes, ...header.notes]);
      draw();
      ended();
    } else if (header.type === "theory") theories.heard(header);
    progress(run);
  }

  function progress(run) {
    const done = run.points.length;
    if (run.count) [by("progress").max, by("progress").value] = [run.count, done];
    else by("progress").removeAttribute("value");
    if (!done) return;
    const open = run.points.filter((each) => !each.resolved).length;
    const stopped = run.end && run.end.stopped ? "Stopped: " : "";
    say(run.count === 1 ? "" : `${stopped}${done}${run.count ? ` of ${run.count}` : ""} points${open ? `, ${open} of them not resolved by the grid (open circles)` : ""}.`);
  }

  // The quantities that can be shown. The default is the stiffness, for a loop the depth, for adhesive surfaces the force.
  function offer(run) {
    const looped = Boolean(run.job.plastic && run.job.plastic.loop);
    const usually = sticks(run) ? "force" : looped ? "depth" : "stiffness";
    const before = shape === `${run.job.job} ${looped}` && by("quantity").value;
    shape = `${run.job.job} ${looped}`;
    const some = run.columns.filter(({ name }) => !["nominal_pressure", "residual", along(run), ...(sticks(run) ? [] : ["force"])].includes(name));
    by("quantity").replaceChildren(...some.map(({ name, label }) => new Option(label, name)));
    by("quantity").value = some.some(({ name }) => name === before) ? before : usually;
    by("axes").value = sticks(run) || looped ? "linear" : "logarithmic";
    by("beside").hidden = sticks(run);
  }

  // Theories are requested when the points are complete.
  async function beside() {
    const run = current;
    if (!run || running || !job()) return;
    try {
      const { theories: _, ...plain } = job();
      const sent = request("back", "theories", plain, { theories: theories.chosen }, (header) => run === current && heard(run, header));
      const end = await sent.ended;
      if (end.message && run === current) say(end.message);
    } catch (error) {
      failed(error);
    }
    draw();
  }

  // The job of the computed part of the curve, with its theories.
  function job() {
    if (!current || !current.end || !current.end.again) return undefined;
    const theory = theories.chosen.join(",");
    return { ...current.job, ...current.end.part, ...(sticks(current) || !theory ? {} : { theories: { theory } }) };
  }

  // Consecutive points of one branch.
  function runs(points) {
    const found = [];
    for (const point of points) {
      const last = found[found.length - 1];
      if (last && last[0].branch === point.branch) last.push(point);
      else found.push([point]);
    }
    return found;
  }

  function lines(run, colour, name) {
    const quantity = by("quantity").value;
    const place = (points, more) => ({ x: points.map((each) => each[along(current)]), y: points.map((each) => each[quantity]), ...more });
    const series = [];
    const drawn = run.end && run.end.lines && quantity === "force" ? run.end.lines : null;
    for (const part of runs(run.points)) {
      const { branch } = part[0];
      const own = COLOURS[branch] || colour;
      const label = branch || name;
      if (branch && !drawn) series.push(place(part, { kind: "line", colour: own, label, silent: true }));
      for (const [resolved, kind, words] of [[true, "points", label], [false, "rings", branch ? "not resolved" : `${label}, not resolved`]]) {
        const some = part.filter((each) => each.resolved === resolved);
        if (some.length) series.push(place(some, { kind, colour: own, label: words }));
      }
    }
    for (const { label, x, y } of drawn || []) series.push({ x, y, label, kind: "line", colour: COLOURS[label] || colour, dash: DASHES[label], silent: true });
    return series;
  }

  function draw() {
    if (!current || !current.columns.length) return;
    const name = by("quantity").value;
    const log = by("axes").value === "logarithmic";
    const column = (wanted) => current.columns.find((each) => each.name === wanted);
    const [at, clickable] = [along(current), !sticks(current)];
    const series = lines(current, "--accent", kept ? "this surface" : "computed");
    if (kept && kept.curve.points.length && sticks(kept.curve) === sticks(current)) series.push(...lines(kept.curve, "--second", `kept: ${kept.name}`));
    const first = current.points.filter(({ branch }) => !branch || branch === "loading");
    const x = first.map((each) => each[at]);
    const { fit } = current.end || {};
    if (fit && name === "stiffness" && at === "force") {
      series.push({ x: fit.force, y: fit.stiffness, label: `power law, exponent ${fit.exponent.toFixed(3)}`, kind: "line", colour: "--ink-soft" });
    }
    for (const line of clickable ? theories.lines(OVER_AREA[name] || name) : []) {
      const scale = OVER_AREA[name] ? first[0][name] / first[0][OVER_AREA[name]] : 1;
      series.push({ ...line, x, y: line.y.map((value) => (value === null ? null : value * scale)), kind: "line" });
    }
    if (clickable && state && Number.isFinite(state[name]) && state[at] > 0) {
      series.push({ x: [state[at]], y: [state[name]], label: "the load shown", kind: "mark", colour: "--mark" });
    }
    chart(by("curve"), { x: { ...column(at), log }, y: { ...column(name), log }, count: current.points.length, series, clicked: clickable ? (place) => {
      const near = (each) => Math.abs(Math.log(each[at] / place));
      choose([...first].sort((a, b) => near(a) - near(b))[0]);
    } : null });
    curveTable(by("points"), current, clickable ? state : null, clickable ? choose : null);
  }

  function choose(point) {
    const control = controlOf(current);
    recipe.change((next) => (next.load = { [control]: loadText(point.load, load.unit(control), 6) }));
  }

  // A range of loads that suits the surface, in the form of the command line.
  function range(name) {
    const control = name.slice(0, -1);
    if (!load.usual(control)) return undefined;
    const [, high, start] = load.usual(control);
    return [start / 30, Math.min(30 * start, high)].map((end) => loadText(end, load.unit(control), 1)).join(":") + ":12";
  }

  function show() {
    const { kind } = recipe.now;
    if (own.kind !== kind) {
      const parts = Object.entries(forms.jobs[kind]).filter(([part]) => part !== "theories" && part !== "load").map(([part, all]) => [part, rest(all, forms.jobs.press[part])]);
      own = { kind, parts: parts.filter(([, { fields }]) => fields.length).map(([part, some]) => ({ part, ...some, ...form(recipe, part, some, { usual: kind === "curve" ? range : undefined, alone: true }) })) };
      by("curve_forms").replaceChildren(...own.parts.map(({ root }) => root));
      by("kind").value = kind;
    }
    const { after } = recipe.now.plastic || {};
    by("kind_said").textContent = forms.about[kind] + ("load" in forms.jobs[kind] ? " The load is the one above." : "") + (after && kind === "curve" ? " The curve starts with the fresh surface: After applies to the load above only. For unloading, check Loop." : "");
    for (const each of own.parts) each.show();
    const ready = Boolean(load.usual("force") && recipe.now.load);
    [by("start").disabled, by("stop").disabled] = [Boolean(running) || !ready, !running];
    by("progress").hidden = !running;
    by("of_curve").hidden = !current || !current.columns.length;
  }

  // A curve belongs to its surface and bodies: a change of these ends it.
  function forget() {
    if (running) running.sent.stop().catch(failed);
    running = current = null;
    theories.forget();
    clear(by("curve"));
    for (const id of ["curve_facts", "curve_notes", "points"]) by(id).replaceChildren();
    say("Press Start to compute the curve.");
  }

  for (const name of Object.keys(forms.jobs)) if (name !== "surface" && name !== "press") by("kind").add(new Option(name));
  by("kind").onchange = ({ target }) => recipe.change((next) => Object.assign(next, { kind: target.value, loads: {} }));
  by("start").onclick = start;
  by("stop").onclick = () => running && running.sent.stop().catch(failed);
  by("axes").onchange = draw;
  by("quantity").onchange = draw;

  return {
    show,
    forget,
    job,
    get facts() {
      return current && current.end ? current.end.facts : [];
    },
    get kept() {
      return current && current.points.length ? structuredClone(current) : { points: [], job: { job: "curve" }, columns: [] };
    },
    keep(other) {
      kept = other;
      draw();
    },
    // The current load, with its numbers.
    answered(record) {
      state = record;
      draw();
    },
  };
}
