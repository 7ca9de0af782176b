// Draws plots as SVG. Colours come from the theme's classes: c1, c2, ...

import { numberText } from "./figures.mjs";

const frame = { left: 92, top: 14, bottom: 58 };
const letter = 11; // width of a letter of a series' name, on average

export const escaped = (text) =>
  String(text)
    .replaceAll("&", "&amp;")
    .replaceAll("<", "&lt;")
    .replaceAll(">", "&gt;")
    .replaceAll('"', "&quot;");

/** A plot as wide as the slide; `figure.narrow`: for half of it; `figure.height`: where there is less room. */
const sizeOf = ({ narrow, height }) =>
  narrow ? { width: 640, height: 600 } : { width: 1100, height: height ?? 410 };
const square = ({ height }, box) => ({
  height,
  width: height - box.top - box.bottom + box.left + box.right,
});

/** figure: the definition; series: [{name, points, slope}]. */
export function plotSvg(figure, series) {
  const shown = series.map((one) => ({ ...one, label: labelOf(figure, one) }));
  if (figure.kind === "bars") return barsSvg(figure, shown);
  const log = { x: scaleOf(figure, "x") === "log", y: scaleOf(figure, "y") === "log" };
  for (const one of shown) {
    one.points = one.points.filter(
      ([x, y]) => Number.isFinite(x) && Number.isFinite(y) && (!log.x || x > 0) && (!log.y || y > 0),
    );
  }
  const all = shown.flatMap((one) => one.points);
  const longest = Math.max(...shown.map((one) => one.label.length));
  const box = { ...frame, right: 24 + letter * longest };
  const size = figure.square ? square(sizeOf(figure), box) : sizeOf(figure);
  const { width, height } = size;
  const x = axis(
    figure.xrange ?? range(all.map((point) => point[0])),
    log.x,
    box.left,
    width - box.right,
    figure.xrange,
  );
  const y = axis(
    figure.yrange ?? range(all.map((point) => point[1])),
    log.y,
    height - box.bottom,
    box.top,
    figure.yrange,
  );
  const parts = [gridX(x, box, size), gridY(y, box, size), titles(figure, box, size)];
  for (const guide of figure.guides ?? []) parts.push(guideSvg(guide, x, y));
  // What leaves a given range is cut off; marks at the range's ends are not.
  const clip = `inset-${figure.id}`;
  parts.push(
    `<clipPath id="${clip}"><rect x="${box.left - 8}" y="${box.top - 8}" width="${width - box.left - box.right + 16}" ` +
      `height="${height - box.top - box.bottom + 16}"/></clipPath><g clip-path="url(#${clip})">`,
  );
  const crowded = figure.kind === "points" && all.length > 300;
  shown.forEach((one, index) => parts.push(seriesSvg({ ...figure, crowded }, one, index, x, y)));
  parts.push("</g>");
  if (longest) parts.push(endLabels(shown, y, width - box.right + 10, height));
  return svg(size, parts);
}

const svg = ({ width, height }, parts) =>
  `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img">${parts.join("")}</svg>`;

const scaleOf = (figure, which) => figure[`${which}scale`] ?? (figure.kind === "loglog" ? "log" : "linear");

function labelOf(figure, { name, slope }) {
  const text = (figure.names?.[name] ?? name).replaceAll("'", "’");
  return slope === undefined ? text : `${text} ${slope.toFixed(2).replace("-", "−")}`;
}

function range(values) {
  return [Math.min(...values), Math.max(...values)];
}

/** Maps values to pixels and has the ticks; `exact` ranges are not widened. */
function axis([low, high], log, from, to, exact) {
  const forward = log ? Math.log10 : (value) => value;
  let a = forward(low),
    b = forward(high);
  if (a === b) [a, b] = [a - 0.5, b + 0.5];
  if (!exact) {
    const margin = 0.03 * (b - a);
    [a, b] = [a - margin, b + margin];
  }
  const at = (value) => from + ((forward(value) - a) / (b - a)) * (to - from);
  return {
    at,
    ticks: (log ? logTicks(a, b) : linearTicks(a, b)).map((value) => ({ value, at: at(value) })),
    log,
  };
}

function logTicks(a, b) {
  const decades = Math.floor(b + 1e-9) - Math.ceil(a - 1e-9) + 1;
  const step = Math.max(1, Math.ceil(decades / 7));
  const ticks = [];
  for (let k = Math.ceil(a - 1e-9); k <= b + 1e-9; k += step) ticks.push(10 ** k);
  if (ticks.length >= 2) return ticks;
  return [1, 2, 5]
    .flatMap((m) => [Math.floor(a), Math.ceil(a)].map((k) => m * 10 ** k))
    .filter((value) => Math.log10(value) >= a && Math.log10(value) <= b)
    .sort((p, q) => p - q);
}

function linearTicks(a, b) {
  const raw = (b - a) / 5;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * unit).find((value) => value >= raw * 0.999);
  const ticks = [];
  for (let k = Math.ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k)
    ticks.push(Number((k * step).toPrecision(12)));
  return ticks;
}

function tickText(value, log) {
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
  if (log && (exponent < -2 || exponent > 3)) {
    const digit = Math.round(value / 10 ** exponent);
    const power = `10<tspan dy="-8" font-size="15">${String(exponent).replace("-", "−")}</tspan>`;
    return digit === 1 ? power : `${digit}·${power}`;
  }
  return String(Number(value.toPrecision(6))).replace("-", "−");
}

const text = (x, y, anchor, content, extra = "") =>
  `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}"${extra}>${content}</text>`;

const line = (x1, y1, x2, y2, kind) =>
  `<line class="${kind}" x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}"/>`;

const gridX = (x, box, { height }) =>
  x.ticks
    .map(
      ({ value, at }) =>
        line(at, box.top, at, height - box.bottom, "grid") +
        text(at, height - box.bottom + 24, "middle", tickText(value, x.log)),
    )
    .join("");

const gridY = (y, box, { width }) =>
  y.ticks
    .map(
      ({ value, at }) =>
        line(box.left, at, width - box.right, at, "grid") +
        text(box.left - 10, at + 6, "end", tickText(value, y.log)),
    )
    .join("");

function titles(figure, box, { width, height }) {
  const [x, y] = [figure.xlabel ?? "", figure.ylabel ?? ""];
  const middle = (box.top + height - box.bottom) / 2;
  return (
    text((box.left + width - box.right) / 2, height - 8, "middle", escaped(x), ' class="axis"') +
    text(0, 0, "middle", escaped(y), ` class="axis" transform="translate(20 ${middle}) rotate(-90)"`)
  );
}

/** A straight line of a given slope through a point, in a log-log plot. */
function guideSvg({ slope, at, to, label }, x, y) {
  const end = to ?? at[0] * 10;
  const yEnd = at[1] * (end / at[0]) ** slope;
  return (
    line(x.at(at[0]), y.at(at[1]), x.at(end), y.at(yEnd), "guide") +
    (label ? text(x.at(end) + 8, y.at(yEnd) + 6, "start", escaped(label), ' class="soft"') : "")
  );
}

function seriesSvg(figure, { points }, index, x, y) {
  const places = points.map(([px, py]) => [x.at(px).toFixed(1), y.at(py).toFixed(1)]);
  const marks = figure.marks ?? !["functions"].includes(figure.kind);
  const radius = figure.crowded ? 2.4 : figure.kind === "points" ? 4 : 5;
  const dots = marks
    ? places.map(([px, py]) => `<circle cx="${px}" cy="${py}" r="${radius}"/>`).join("")
    : "";
  const path =
    figure.kind === "points"
      ? ""
      : `<polyline points="${places.map((place) => place.join(",")).join(" ")}"/>`;
  return `<g class="c${(index % 8) + 1}">${path}${dots}</g>`;
}

/** Names at the right, beside each series' last point, pushed apart where they would overlap. */
function endLabels(shown, y, left, height) {
  const gap = 27;
  const labels = shown.map((one, index) => ({
    index,
    text: one.label,
    at: one.points.length ? y.at(one.points.at(-1)[1]) : frame.top,
  }));
  labels.sort((a, b) => a.at - b.at);
  labels.forEach((one, k) => {
    if (k) one.at = Math.max(one.at, labels[k - 1].at + gap);
  });
  const bottom = height - frame.bottom;
  for (let k = labels.length - 1; k >= 0; --k) {
    const limit = k === labels.length - 1 ? bottom : labels[k + 1].at - gap;
    labels[k].at = Math.min(labels[k].at, limit);
  }
  return labels
    .map(
      (one) =>
        `<g class="c${(one.index % 8) + 1}">${text(left, one.at + 6, "start", escaped(one.text), ' class="name"')}</g>`,
    )
    .join("");
}

/** One bar for each row, with its value at the end; a series for each colour. */
function barsSvg(figure, shown) {
  const { width, height } = sizeOf(figure);
  const rows = shown.flatMap((one, index) => one.points.map(([name, value]) => ({ name, value, index })));
  const left = figure.narrow ? 250 : 360,
    right = width - 120,
    step = Math.min(64, (height - 20) / rows.length);
  const log = scaleOf(figure, "y") === "log";
  const values = rows
    .map((row) => row.value)
    .filter((value) => Number.isFinite(value) && (!log || value > 0));
  const scale = axis(
    log ? [Math.min(...values) / 2, Math.max(...values)] : [Math.min(0, ...values), Math.max(...values)],
    log,
    left,
    right,
    true,
  );
  const base = log ? left : scale.at(0);
  return svg(
    { width, height },
    rows.map((row, k) => {
      const top = 10 + k * step;
      const end = Number.isFinite(row.value) && (!log || row.value > 0) ? scale.at(row.value) : base;
      const name = [figure.names?.[row.name] ?? row.name, shown.length > 1 ? shown[row.index].label : ""]
        .filter(Boolean)
        .join(", ");
      return (
        text(left - 14, top + step / 2 + 6, "end", escaped(name)) +
        `<g class="c${(row.index % 8) + 1}"><rect x="${Math.min(base, end).toFixed(1)}" y="${(top + step * 0.15).toFixed(1)}" ` +
        `width="${Math.abs(end - base).toFixed(1)}" height="${(step * 0.7).toFixed(1)}"/></g>` +
        text(Math.max(base, end) + 10, top + step / 2 + 6, "start", numberText(figure, row.value))
      );
    }),
  );
}

/** A figure of kind "functions": curves of formulas in x. */
export function functionsSvg(figure) {
  const [from, to] = figure.x;
  const steps = 400;
  const series = figure.functions.map(({ name, js }) => {
    const value = new Function("x", `"use strict"; return (${js});`);
    const points = Array.from({ length: steps + 1 }, (_, k) => from + ((to - from) * k) / steps)
      .map((x) => [x, value(x)])
      .filter(([, y]) => Number.isFinite(y));
    return { name: name ?? "", points };
  });
  return plotSvg({ xrange: figure.x, ...figure }, series);
}
