// The part of the map that is kept: by numbers of rows and columns, or dragged over the map.

import { trouble } from "./trouble.js";
import { put } from "./typing.js";
import { written } from "./words.js";

const ENDS = ["crop_top", "crop_bottom", "crop_left", "crop_right"];
const by = (id) => document.getElementById(id);

export function cropFields(recipe) {
  let raw = null; // the surface before its preparation

  const whole = () => [0, raw.shape[0], 0, raw.shape[1]];
  const now = () => recipe.now.preparation.crop || whole();

  function change(crop) {
    const all = whole();
    const same = crop.every((end, k) => end === all[k]);
    recipe.change((next) => (next.preparation.crop = same ? null : crop));
  }

  function typed() {
    const [top, bottom, left, right] = ENDS.map((id) => Math.round(Number(by(id).value)));
    const all = whole();
    const wrong = (field, message) => trouble("crop", { field, message });
    if (!(top >= 0 && top < bottom)) return wrong("crop_top", `No row is left: the first lies below the end, from 0 to ${all[1] - 1}.`);
    if (!(left >= 0 && left < right)) return wrong("crop_left", `No column is left: the first lies below the end, from 0 to ${all[3] - 1}.`);
    trouble("crop", {});
    return change([top, Math.min(bottom, all[1]), left, Math.min(right, all[3])]);
  }

  for (const id of ENDS) by(id).onchange = typed;
  by("uncrop").onclick = () => {
    recipe.change((next) => (next.preparation.crop = null));
    by("crop_top").focus();
  };

  function show() {
    by("crop_fields").hidden = !raw;
    if (!raw) return;
    const crop = now();
    ENDS.forEach((id, k) => {
      put(by(id), crop[k]);
      by(id).max = raw.shape[k < 2 ? 0 : 1];
    });
    trouble("crop", {});
    const cells = [crop[1] - crop[0], crop[3] - crop[2]];
    const [length, width] = cells.map((count, k) => written((count / raw.shape[k]) * raw.lengths[k], "m", 3));
    by("crop_size").textContent = `${cells[0]} × ${cells[1]} cells, ${length} × ${width}`;
    by("uncrop").hidden = !recipe.now.preparation.crop;
  }

  return {
    show,
    // What the file holds, as soon as it is read; null for another file.
    of(found) {
      raw = found;
      show();
    },
    // A part that was dragged over the map, whose cells count from the crop and may stand for several.
    dragged(part) {
      const [top, , left] = now();
      const step = recipe.now.preparation.downsample || 1;
      const [a, b, c, d] = part.map((end) => end * step);
      change([top + a, Math.min(top + b, raw.shape[0]), left + c, Math.min(left + d, raw.shape[1])]);
    },
    // A crop as the command line writes it, an open end left out: "1:60,:".
    written(text) {
      const parts = text.split(",").map((part) => part.split(":"));
      const all = whole();
      change(parts.flatMap(([from, to], k) => [from ? Number(from) : all[2 * k], to ? Number(to) : all[2 * k + 1]]));
    },
  };
}
