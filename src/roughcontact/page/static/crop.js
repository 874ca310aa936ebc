// The part of the map that a crop keeps, in the form of the command line: rows and columns, open ends left out.

// A part that was dragged over a map; its cells are counted from the earlier crop, and each may show several.
export function dragged(part, before, raw, cells) {
  const given = before ? before.split(",").map((ends) => ends.split(":")) : [["", ""], ["", ""]];
  return given.map(([from, to], axis) => {
    const [low, high] = [Number(from || 0), Math.min(Number(to || raw[axis]), raw[axis])];
    const step = Math.max(1, Math.round((high - low) / cells[axis]));
    const [a, b] = [part[2 * axis], part[2 * axis + 1]];
    return `${low + a * step}:${Math.min(low + b * step, high)}`;
  }).slice(-raw.length).join(",");
}
