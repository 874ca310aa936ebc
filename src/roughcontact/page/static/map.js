// The map: a canvas with heights, contact, pressure or gap; for crops and cuts by pointer or keys.

import { COLOURS } from "./colours.js";
import { written } from "./words.js";

const CONTACT = [0, 0xd5, 0x5e, 0x00]; // vermilion, distinct from grey also for the colour-blind
const MOST = 0.995; // share of the cells with pressure that lie below the end of the scale
const STEPS = [1, 2, 5];
const RING = "#ff4fa3"; // in neither colour map; the colour of #ringed

export function mapView(canvas, bar, heard) {
  const state = { fields: {}, which: "heights", colours: "viridis", mode: "cut", axis: "row", place: null, mark: null, drag: null, spikes: [] };
  const picture = document.createElement("canvas");
  const context = canvas.getContext("2d");

  const fieldOf = (which) => state.fields[which === "contact" ? "pressure" : which];
  // The chosen map if it is computed; otherwise the heights.
  const kind = () => (fieldOf(state.which) ? state.which : "heights");
  const shown = () => fieldOf(kind());

  function css(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  // The rectangle of the picture on the canvas, in points.
  function frame() {
    const field = shown();
    const [height, width] = field.lengths;
    const scale = Math.min(canvas.width / width, canvas.height / height);
    const [w, h] = [width * scale, height * scale];
    return { x: (canvas.width - w) / 2, y: (canvas.height - h) / 2, w, h };
  }

  // The ends of the colours: those of both maps in a comparison.
  function ends(field) {
    const own = ownEnds(field);
    const other = state.beside && state.beside.ends(kind());
    if (!other) return own;
    return { low: Math.min(own.low, other.low), high: Math.max(own.high, other.high), below: own.below || other.below, beyond: own.beyond || other.beyond };
  }

  function ownEnds(field) {
    const [low, most] = field.colours;
    const beyond = most < field.ends[1];
    if (["heights", "flattened", "traction"].includes(kind())) return { low, high: most, below: low > field.ends[0], beyond };
    if (kind() === "gap") return { low: 0, high: Math.max(most, 1e-300), beyond };
    const some = [];
    const stride = Math.max(1, Math.floor(field.values.length / 250000));
    for (let k = 0; k < field.values.length; k += stride) if (field.values[k] > 0) some.push(field.values[k]);
    some.sort((a, b) => a - b);
    const high = some.length ? some[Math.min(some.length - 1, Math.floor(MOST * some.length))] : 1;
    return { low: 0, high, beyond: high < field.ends[1] };
  }

  function paint() {
    const field = shown();
    if (!field) return;
    const [rows, columns] = field.shape;
    [picture.width, picture.height] = [columns, rows];
    const image = new ImageData(columns, rows);
    const out = new Uint32Array(image.data.buffer);
    const { low, high, below, beyond } = ends(field);
    const table = COLOURS[state.colours];
    const scale = high > low ? 255 / (high - low) : 0;
    const none = packed(css("--map-none"));
    if (kind() === "contact") paintContact(out, field);
    else {
      for (let k = 0; k < out.length; k++) {
        const value = field.values[k];
        if (Number.isNaN(value)) continue; // missing points show the background
        if (kind() === "pressure" && value === 0) out[k] = none;
        else out[k] = table[Math.min(255, Math.max(0, (value - low) * scale)) | 0];
      }
    }
    picture.getContext("2d").putImageData(image, 0, 0);
    paintBar(low, high, below, beyond, field.unit);
    draw();
  }

  // The cells in contact, over the heights in grey.
  function paintContact(out, field) {
    const heights = state.fields.heights;
    const alike = heights && heights.shape[0] === field.shape[0] && heights.shape[1] === field.shape[1];
    const touch = (255 << 24) | (CONTACT[3] << 16) | (CONTACT[2] << 8) | CONTACT[1];
    const [dark, light] = css("--map-greys").split(" ").map(Number);
    for (let k = 0; k < out.length; k++) {
      if (field.values[k] > 0) {
        out[k] = touch;
        continue;
      }
      const value = alike ? heights.values[k] : 0;
      if (Number.isNaN(value)) continue;
      const part = alike ? (value - heights.colours[0]) / (heights.colours[1] - heights.colours[0] || 1) : 0.5;
      const grey = dark + (light - dark) * Math.min(Math.max(part, 0), 1);
      out[k] = (255 << 24) | (grey << 16) | (grey << 8) | grey;
    }
  }

  function showRinged() {
    if (bar.ringed) bar.ringed.hidden = kind() !== "heights" || !state.spikes.length;
  }

  // The colour scale is clipped if few values lie outside; the labels at its ends show this.
  function paintBar(low, high, below, beyond, unit) {
    const contact = kind() === "contact";
    bar.root.classList.toggle("keyed", contact);
    bar.low.textContent = contact ? "" : (below ? "≤ " : "") + written(low, unit, 3);
    showRinged();
    bar.high.textContent = contact ? "" : (beyond ? "≥ " : "") + written(high, unit, 3);
    const scale = bar.canvas.getContext("2d");
    const strip = new ImageData(256, 1);
    new Uint32Array(strip.data.buffer).set(COLOURS[state.colours]);
    scale.putImageData(strip, 0, 0);
  }

  function draw() {
    const field = shown();
    context.clearRect(0, 0, canvas.width, canvas.height);
    if (!field) return;
    const at = frame();
    context.imageSmoothingEnabled = field.shape[1] > at.w;
    context.drawImage(picture, at.x, at.y, at.w, at.h);
    if (kind() === "heights") for (const [row, column] of state.spikes) ring(at, field, { row, column }, RING);
    drawRuler(at, field);
    if (state.drag) drawDrag();
    else if (state.place !== null && state.mode === "cut") drawCut(at, field);
  }

  function drawRuler(at, field) {
    const unit = devicePixelRatio;
    const wanted = 0.22 * field.lengths[1];
    const power = 10 ** Math.floor(Math.log10(wanted));
    const length = power * STEPS.filter((step) => step * power <= wanted).pop();
    const width = (length / field.lengths[1]) * at.w;
    const [x, y] = [at.x + 14 * unit, at.y + at.h - 16 * unit];
    const label = written(length, "m", 3);
    context.font = `600 ${12 * unit}px system-ui, sans-serif`;
    const room = Math.max(width, context.measureText(label).width) + 16 * unit;
    context.fillStyle = "rgba(10, 14, 20, 0.62)";
    context.beginPath();
    context.roundRect(x - 8 * unit, y - 22 * unit, room, 32 * unit, 6 * unit);
    context.fill();
    context.fillStyle = "#fff";
    context.fillRect(x, y, width, 3 * unit);
    context.fillText(label, x, y - 7 * unit);
  }

  function drawCut(at, field) {
    if (state.mark) ring(at, field, state.mark, "#fff");
    const row = state.axis === "row";
    const count = field.cells[row ? 0 : 1];
    if (count === 1) return; // the cut is the whole profile
    const along = ((state.place + 0.5) / count) * (row ? at.h : at.w);
    for (const [width, colour] of [[4, "rgba(0,0,0,.55)"], [2, "#fff"]]) {
      context.beginPath();
      context.lineWidth = width * devicePixelRatio;
      context.strokeStyle = colour;
      context.setLineDash([8 * devicePixelRatio, 5 * devicePixelRatio]);
      if (row) {
        context.moveTo(at.x, at.y + along);
        context.lineTo(at.x + at.w, at.y + along);
      } else {
        context.moveTo(at.x + along, at.y);
        context.lineTo(at.x + along, at.y + at.h);
      }
      context.stroke();
    }
    context.setLineDash([]);
  }

  function ring(at, field, { row, column }, colour) {
    const x = at.x + ((column + 0.5) / field.cells[1]) * at.w;
    const y = at.y + ((row + 0.5) / field.cells[0]) * at.h;
    for (const [width, ink] of [[5, "rgba(0,0,0,.6)"], [2.5, colour]]) {
      context.beginPath();
      context.lineWidth = width * devicePixelRatio;
      context.strokeStyle = ink;
      context.arc(x, y, 7 * devicePixelRatio, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  function drawDrag() {
    const { from, to } = state.drag;
    const [x, y] = [Math.min(from.x, to.x), Math.min(from.y, to.y)];
    const [w, h] = [Math.abs(to.x - from.x), Math.abs(to.y - from.y)];
    context.fillStyle = "rgba(255,255,255,.22)";
    context.fillRect(x, y, w, h);
    context.strokeStyle = "#fff";
    context.lineWidth = 2 * devicePixelRatio;
    context.strokeRect(x, y, w, h);
  }

  // The cell under a point of the screen; null outside the map.
  function cellAt(event, clamped = false) {
    const field = shown();
    if (!field) return null;
    const box = canvas.getBoundingClientRect();
    const at = frame();
    let x = ((event.clientX - box.left) * (canvas.width / box.width) - at.x) / at.w;
    let y = ((event.clientY - box.top) * (canvas.height / box.height) - at.y) / at.h;
    if (clamped) [x, y] = [x, y].map((part) => Math.min(Math.max(part, 0), 1 - 1e-9));
    if (x < 0 || y < 0 || x >= 1 || y >= 1) return null;
    const point = { x: at.x + x * at.w, y: at.y + y * at.h };
    return { row: Math.floor(y * field.cells[0]), column: Math.floor(x * field.cells[1]), x, y, point };
  }

  function valuesAt(cell) {
    const words = [];
    const field = shown();
    words.push(`x ${written(cell.x * field.lengths[1], "m", 3)}, y ${written(cell.y * field.lengths[0], "m", 3)}`);
    for (const [name, label] of [["heights", "height"], ["pressure", "pressure"], ["gap", "gap"]]) {
      const each = state.fields[name];
      if (!each || each.cells[0] !== field.cells[0] || each.cells[1] !== field.cells[1]) continue;
      const at = Math.floor(cell.row / each.factor) * each.shape[1] + Math.floor(cell.column / each.factor);
      const value = each.values[at];
      words.push(`${label} ${Number.isNaN(value) ? "missing" : written(Math.abs(value) < 1e-13 && name === "gap" ? 0 : value, each.unit, 3)}`);
    }
    return words.join("   ");
  }

  canvas.addEventListener("pointerdown", (event) => {
    const cell = cellAt(event);
    if (!cell || event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    state.drag = state.mode === "crop" ? { from: cell.point, to: cell.point, first: cell, last: cell } : null;
    if (state.mode === "cut") setPlace(state.axis === "row" ? cell.row : cell.column);
  });
  canvas.addEventListener("pointermove", (event) => {
    const cell = cellAt(event, canvas.hasPointerCapture(event.pointerId));
    heard.over(cell ? valuesAt(cell) : "", cell);
    if (!cell || !canvas.hasPointerCapture(event.pointerId)) return;
    if (state.drag) {
      Object.assign(state.drag, { to: cell.point, last: cell });
      draw();
    } else if (state.mode === "cut") setPlace(state.axis === "row" ? cell.row : cell.column);
  });
  canvas.addEventListener("pointerup", () => {
    const drag = state.drag;
    state.drag = null;
    draw();
    if (!drag) return;
    const rows = [drag.first.row, drag.last.row].sort((a, b) => a - b);
    const columns = [drag.first.column, drag.last.column].sort((a, b) => a - b);
    if ((rows[1] - rows[0] >= 3 || shown().cells[0] === 1) && columns[1] - columns[0] >= 3) {
      heard.crop([rows[0], rows[1] + 1, columns[0], columns[1] + 1]);
    } else heard.small();
  });
  canvas.addEventListener("pointerleave", () => heard.over("", null));
  canvas.addEventListener("keydown", (event) => {
    const field = shown();
    if (!field) return;
    if (state.mode === "none") return;
    const step = (event.shiftKey ? 10 : 1) * { ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const axis = event.key === "ArrowUp" || event.key === "ArrowDown" ? "row" : "column";
    if (axis !== state.axis) [state.axis, state.place] = [axis, null];
    const count = field.cells[state.axis === "row" ? 0 : 1];
    const from = state.place === null || state.place >= count ? Math.floor(count / 2) : state.place;
    setPlace(Math.min(Math.max(from + step, 0), count - 1));
  });

  function setPlace(place) {
    state.place = place;
    draw();
    heard.cut(state.axis, place);
  }

  function fit() {
    const field = shown();
    const box = canvas.parentElement.getBoundingClientRect();
    const width = Math.max(box.width, 100);
    const aspect = field ? field.lengths[0] / field.lengths[1] : 1;
    const most = Math.max(260, Math.min(innerHeight * 0.68, 1500));
    const height = Math.min(width * aspect, most);
    canvas.style.height = `${height}px`;
    const ratio = devicePixelRatio;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    }
    draw();
  }
  new ResizeObserver(fit).observe(canvas.parentElement);

  return {
    state,
    paint,
    draw,
    fit,
    // The number of cells per side that can be shown.
    pixels: () => Math.min(2048, Math.max(256, Math.round(Math.max(canvas.width, canvas.height) / 64) * 64)),
    set(name, header, buffer) {
      state.fields[name] = { ...header, values: new Float32Array(buffer) };
      canvas.dataset.fields = Object.keys(state.fields).join(" ");
      fit();
      if (state.fields[name] === shown()) paint();
    },
    // The position of the cut.
    place(axis, place) {
      Object.assign(state, { axis, place });
      draw();
    },
    // Spikes: cells far from all their neighbours.
    spikes(places) {
      state.spikes = places;
      showRinged();
      draw();
    },
    mark(cell) {
      state.mark = cell;
      draw();
    },
    middle() {
      const field = shown();
      return { row: Math.floor(field.cells[0] / 2), column: Math.floor(field.cells[1] / 2) };
    },
    ends: (which) => (kind() === which && shown() ? ownEnds(shown()) : null),
    clear(...names) {
      for (const name of names) delete state.fields[name];
      canvas.dataset.fields = Object.keys(state.fields).join(" ");
      if (!shown()) draw();
    },
    has: (name) => name in state.fields,
  };
}

function packed(colour) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return (255 << 24) | (b << 16) | (g << 8) | r;
}
