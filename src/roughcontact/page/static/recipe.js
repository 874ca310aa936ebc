// The recipe of the user: the parts of a job, as texts, with undo and redo.

const BEGIN = { source: null, preparation: {}, bodies: { materials: "steel,aluminium" }, load: null, kind: "curve" };

const fractal = (name, about, hurst, rms, size, points, more = {}) => ({
  name, about, source: { kind: "self-affine", hurst, rms, size, points, seed: "1", ...more },
});
const PATCHES = [
  fractal("Fractal patch", "H = 0.8, 256 × 256 cells, free", "0.8", "1um", "1mm", "256"),
  fractal("Joint face", "periodic, roll-off, 512 × 512", "0.8", "0.5um", "1mm", "512", { rolloff: "150um", periodic: true }),
  fractal("Rugged patch", "H = 0.4, 512 × 512 cells", "0.4", "0.2um", "1mm", "512", { seed: "3" }),
  fractal("Large map", "H = 0.7, 1024 × 1024 cells", "0.7", "1um", "2mm", "1024", { seed: "2" }),
];
const SPECIFIED = { name: "Specified joint", about: "rms height 1.2 µm, mean slope 0.12, 256 × 256 cells", source: { kind: "specified", sigma: "1.2um", slope: "0.12", hurst: "0.8", rolloff: "64um", size: "512um", points: "256", seed: "1", periodic: true } };
const BALL = { name: "Ball", about: "a sphere, 256 × 256 cells", source: { kind: "shape", shape: "sphere", radius: "5mm", size: "0.2mm", points: "256" } };

// Examples to begin with, including the maps of the package.
export const examplesOf = ({ sources }) => [
  ...PATCHES, SPECIFIED, BALL,
  ...sources.example.fields[0].choices.map((example) => ({ name: `Example ${example}`, about: "a map that comes with the package", source: { kind: "example", example } })),
];

export function history(changed) {
  let now = structuredClone(BEGIN);
  const past = [];
  const future = [];

  function set(next, before) {
    now = next;
    changed(now, before);
  }

  return {
    get now() {
      return now;
    },
    get can() {
      return { undo: past.length > 0, redo: future.length > 0 };
    },
    // Change the recipe; during a drag, `kept` is false until the pointer is released.
    // Undo ends at the first surface.
    change(edit, kept = true) {
      const next = structuredClone(now);
      edit(next);
      if (JSON.stringify(next) === JSON.stringify(now)) return;
      if (kept && now.source) {
        past.push(now);
        future.length = 0;
      }
      set(next, now);
    },
    // Store the state before a drag.
    remember(before) {
      if (JSON.stringify(before) === JSON.stringify(now)) return;
      past.push(before);
      future.length = 0;
      changed(now, now);
    },
    undo() {
      if (!past.length) return;
      future.push(now);
      set(past.pop(), future[future.length - 1]);
    },
    redo() {
      if (!future.length) return;
      past.push(now);
      set(future.pop(), past[past.length - 1]);
    },
  };
}

// A job for the server: each part with only its own fields.
export function jobOf(name, state, { jobs }) {
  const job = { job: name, source: state.source };
  for (const [part, { fields }] of Object.entries(jobs[name])) {
    const given = Object.entries(state[part] || {}).filter(([field]) => fields.some((each) => each.name === field));
    job[part] = Object.fromEntries(given);
  }
  job.preparation.level ??= "none"; // the page shows the heights that it presses
  return job;
}

// The model of a profile; empty for a map.
export const profileOf = ({ contact }) => (contact || {}).profile;

// The parts of a state on which an answer of a kind depends.
export const partsOf = (name, { jobs }) => ["source", ...Object.keys(jobs[name])];

// The user's name of a source: that of the file or the example.
export function titleOf(source, names, examples) {
  if (!source) return "";
  if (source.kind === "file") return names[source.file] || "";
  const same = examples.find((each) => JSON.stringify(each.source) === JSON.stringify(source));
  return same ? same.name : "Made surface";
}

// Preparation of a new source: heights are levelled, shapes are unchanged.
export const fresh = ({ kind }) => (kind === "shape" ? {} : { level: "plane" });
