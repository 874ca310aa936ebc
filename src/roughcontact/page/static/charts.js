// Curves on uPlot: distributions, spectra, cuts, loading curves.

import { digits, scaleFor } from "./words.js";

/* global uPlot */

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Series: { label, x, y, kind: "line" | "points" | "rings" | "area", colour, dash }. Axes: { label, unit, log }.
export function chart(root, { x, y, series, zero = false, height = 210, clicked = null, label = "" }) {
  const scaleX = scaleFor(series.flatMap((each) => [...each.x]), x.unit);
  const scaleY = scaleFor(series.flatMap((each) => [...each.y]), y.unit);
  const { xs, columns } = together(series, scaleX.factor, scaleY.factor, x.log, y.log);
  if (root.plot) root.plot.destroy();
  root.replaceChildren();
  if (!xs.length) return;
  const ratio = { font: "12px system-ui, sans-serif", ink: css("--ink-soft"), grid: css("--line-soft") };
  const axis = (of, scale) => ({
    label: of.label + (scale.unit ? ` [${scale.unit}]` : ""),
    labelFont: ratio.font,
    font: ratio.font,
    stroke: ratio.ink,
    labelSize: 22,
    grid: { stroke: ratio.grid, width: 1 },
    ticks: { stroke: ratio.grid, width: 1, size: 4 },
    values: (_, ticks) => ticks.map((tick) => (tick === null ? "" : digits(tick, 3))),
  });
  const log = (on) => (on ? { distr: 3 } : {});
  const options = {
    width: Math.max(root.clientWidth, 200),
    height,
    padding: [10, 12, 0, 0],
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, points: { size: 7 } },
    scales: {
      x: { time: false, ...log(x.log) },
      y: { ...log(y.log), ...(zero ? { range: (_, low, high) => [Math.min(0, low), high * 1.05 || 1] } : {}) },
    },
    axes: [axis(x, scaleX), { ...axis(y, scaleY), size: 58 }],
    series: [{}, ...series.map((each) => drawn(each))],
  };
  root.plot = new uPlot(options, [xs, ...columns], root);
  root.setAttribute("role", "img");
  root.setAttribute("aria-label", `${label || y.label}: ${y.label} against ${x.label}, ${xs.length} points`);
  if (clicked) {
    root.plot.over.addEventListener("click", () => {
      if (root.plot.cursor.idx !== null) clicked(xs[root.plot.cursor.idx] / scaleX.factor);
    });
  }
}

function drawn(each) {
  const stroke = each.colour.startsWith("--") ? css(each.colour) : each.colour;
  const points = { show: each.kind === "points" || each.kind === "rings", size: 7, width: 1.5, stroke };
  points.fill = each.kind === "rings" ? css("--card") : stroke;
  const line = each.kind === "line" || each.kind === "area";
  return {
    label: each.label,
    stroke,
    width: line ? 2 : 0,
    dash: each.dash,
    spanGaps: line && !each.gaps,
    fill: each.kind === "area" ? `${stroke}33` : undefined,
    points,
    paths: line ? undefined : () => null,
  };
}

// All series on one axis, as uPlot wants them; what a logarithm cannot show is left out.
function together(series, factorX, factorY, logX, logY) {
  const places = new Set();
  for (const each of series) for (const value of each.x) if (!logX || value > 0) places.add(value);
  const sorted = [...places].sort((a, b) => a - b);
  const index = new Map(sorted.map((value, k) => [value, k]));
  const columns = series.map((each) => {
    const column = new Array(sorted.length).fill(undefined);
    each.x.forEach((value, k) => {
      const height = each.y[k];
      const there = height !== null && Number.isFinite(height) && (!logY || height > 0);
      const at = index.get(value);
      if (at !== undefined) column[at] = there ? height * factorY : null;
    });
    return column;
  });
  return { xs: sorted.map((value) => value * factorX), columns };
}

// Redrawn when the room or the colours change.
export function redrawn(root, draw) {
  let width = 0;
  new ResizeObserver(() => {
    if (Math.abs(root.clientWidth - width) < 2) return;
    width = root.clientWidth;
    draw();
  }).observe(root);
}
