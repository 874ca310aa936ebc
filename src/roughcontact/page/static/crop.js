// The part of the map that is kept, as the command line writes it: rows and columns, an open end left out.

// A part that was dragged over a map, whose cells count from the crop before it and may stand for several.
export function dragged(part, before, raw, cells) {
  const given = before ? before.split(",").map((ends) => ends.split(":")) : [["", ""], ["", ""]];
  return given.map(([from, to], axis) => {
    const [low, high] = [Number(from || 0), Math.min(Number(to || raw[axis]), raw[axis])];
    const step = Math.max(1, Math.round((high - low) / cells[axis]));
    const [a, b] = [part[2 * axis], part[2 * axis + 1]];
    return `${low + a * step}:${Math.min(low + b * step, high)}`;
  }).slice(-raw.length).join(",");
}
