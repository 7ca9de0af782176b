// Plots as SVG: a figure's definition and data, drawn by the program that draws like the labs'
// pages (plot.cpp).

import { numberText } from "./figures.mjs";

export const plotProgram = "carlo_slide_plot";

/** On a slide, which is 1280 wide, letters are twice as large as on a page. */
const sizeOf = ({ narrow, height }) =>
  narrow ? { width: 290, height: 268 } : { width: 576, height: (height ?? 410) / 1.91 };

const axisOf = (figure, which) => ({
  label: figure[`${which}label`] ?? "",
  log: scaleOf(figure, which) === "log",
  unit: figure[`${which}unit`] ?? "number",
  range: figure[`${which}range`] ?? [],
});

const scaleOf = (figure, which) => figure[`${which}scale`] ?? (figure.kind === "loglog" ? "log" : "linear");

function labelOf(figure, { name, slope }) {
  const text = (figure.names?.[name] ?? name).replaceAll("'", "’");
  return slope === undefined ? text : `${text} ${slope.toFixed(2).replace("-", "−")}`;
}

/** figure: the definition; series: [{name, points, slope}]. Returns the SVG. */
export function plotSvg(runs, figure, description, series) {
  const bars = figure.kind === "bars";
  const shown = bars ? [] : [...series.map((one) => seriesOf(figure, one)), ...guidesOf(figure)];
  return runs.answer(
    plotProgram,
    JSON.stringify({
      kind: figure.kind === "loglog" ? "lines" : figure.kind,
      description,
      ...sizeOf(figure),
      square: figure.square ?? false,
      x: axisOf(figure, "x"),
      y: axisOf(figure, "y"),
      series: shown,
      rows: bars ? rowsOf(figure, series) : [],
    }),
  );
}

function seriesOf(figure, one) {
  const isShown = (value, which) =>
    Number.isFinite(value) && (value > 0 || scaleOf(figure, which) !== "log");
  const points = one.points.filter(([x, y]) => isShown(x, "x") && isShown(y, "y"));
  return { name: labelOf(figure, one), x: points.map(([x]) => x), y: points.map(([, y]) => y), guide: false };
}

/** Straight lines of a given slope through a point, in a log-log plot. */
const guidesOf = ({ guides = [] }) =>
  guides.map(({ slope, at: [x, y], to = 10 * x, label = "" }) => ({
    name: label,
    x: [x, to],
    y: [y, y * (to / x) ** slope],
    guide: true,
  }));

/** A bar for each row, a colour for each series. */
function rowsOf(figure, series) {
  return series.flatMap((one, index) =>
    one.points.map(([name, value]) => ({
      name: [figure.names?.[name] ?? name, series.length > 1 ? labelOf(figure, one) : ""]
        .filter(Boolean)
        .join(", "),
      words: numberText(figure, value),
      value: Number.isFinite(value) ? value : "nan",
      series: index,
    })),
  );
}

/** A figure of kind "functions": curves of formulas in x. */
export function functionsSvg(runs, figure, description) {
  const [from, to] = figure.x;
  const steps = 400;
  const series = figure.functions.map(({ name, js }) => {
    const value = new Function("x", `"use strict"; return (${js});`);
    const points = Array.from({ length: steps + 1 }, (_, k) => from + ((to - from) * k) / steps).map((x) => [
      x,
      value(x),
    ]);
    return { name: name ?? "", points };
  });
  return plotSvg(runs, { xrange: figure.x, ...figure }, description, series);
}
