// What the user has asked for, as plain values: the page sends all of it with every request. Undo and redo go through it.

const START = {
  source: null,
  preparation: {
    crop: null, despike: null, level: "plane", form: null, fill: false,
    short_cutoff: null, long_cutoff: null, downsample: null,
  },
  bodies: { materials: ["steel", "aluminium"] },
  load: null,
};

export const EXAMPLES = [
  { name: "Fractal patch", about: "H = 0.8, 256 × 256 cells, free", hurst: "0.8", rms: "1um", size: "1mm", points: 256 },
  { name: "Joint face", about: "periodic, roll-off, 512 × 512", hurst: "0.8", rms: "0.5um", size: "1mm", points: 512,
    rolloff: "150um", periodic: true },
  { name: "Rugged patch", about: "H = 0.4, 512 × 512 cells", hurst: "0.4", rms: "0.2um", size: "1mm", points: 512, seed: 3 },
  { name: "Large map", about: "H = 0.7, 1024 × 1024 cells", hurst: "0.7", rms: "1um", size: "2mm", points: 1024, seed: 2 },
];

export function history(changed) {
  let now = structuredClone(START);
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
    // Change it; while something is dragged, `kept` is false until it is let go of.
    change(edit, kept = true) {
      const next = structuredClone(now);
      edit(next);
      if (JSON.stringify(next) === JSON.stringify(now)) return;
      if (kept) {
        past.push(now);
        future.length = 0;
      }
      set(next, now);
    },
    // Remember a state from before something was dragged.
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

// How the user calls a source: a file by its name, an example by its own.
export function titleOf(source, names) {
  if (!source) return "";
  if (source.kind === "file") return names[source.file] || "";
  const same = (each) => ["hurst", "rms", "size", "points"].every((key) => each[key] === source[key]);
  return (EXAMPLES.find(same) || { name: "Made surface" }).name;
}

// Stands for a surface in questions that are about none.
export const BLANK = { kind: "made", hurst: "0.8", rms: "1um", size: "1mm", points: 2 };

export const example = ({ name, about, ...made }) => ({ kind: "made", seed: 1, ...made });

export const fresh = () => structuredClone(START.preparation);
