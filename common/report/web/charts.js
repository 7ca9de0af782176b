"use strict";
// Draws the charts that the page describes in its "charts" JSON block, each into its figure.

(() => {
  const shapes = [
    ["circle", "●"], ["rect", "■"], ["triangle", "▲"], ["rectRot", "◆"],
    ["cross", "✚"], ["crossRot", "✖"], ["star", "✱"], ["circle", "●"],
  ];
  const superscript = (n) =>
    String(n).replace(/[-0-9]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[+c]));
  const units = [[1, "s"], [1e-3, "ms"], [1e-6, "µs"], [1e-9, "ns"]];

  // Numbers for people ------------------------------------------------------------------------

  const significant = (value, digits) => {
    const size = Math.abs(value);
    if (value === 0 || (size >= 1e-3 && size < 1e6)) return String(+value.toPrecision(digits));
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${+mantissa}·10${superscript(+exponent)}`;
  };

  const seconds = (value, digits) => {
    const [size, name] = units.find(([s]) => Math.abs(value) >= s * 0.9999) || units[3];
    return `${significant(value / size, digits)} ${name}`;
  };

  // With gaps from five digits on, as tables have them.
  const grouped = (whole) =>
    /\d{5}/.test(whole) ? whole.replace(/\B(?=(\d{3})+$)/g, "\u2009") : whole;

  const count = (value) =>
    Math.abs(value - Math.round(value)) > 1e-6 ? significant(value, 4)
      : grouped(String(Math.round(value)));

  const spoken = (axis, value) =>
    axis.unit === "seconds" ? seconds(value, 3)
      : axis.unit === "count" ? count(value) : significant(value, 4);

  const tick = (axis, value) => {
    if (axis.unit === "seconds") return seconds(value, 2);
    const power = Math.log10(value);
    if (axis.scale === "log" && (value >= 1e4 || value < 0.05)) {
      const whole = Math.round(power);
      if (Math.abs(power - whole) < 1e-9) return `10${superscript(whole)}`;
    }
    return significant(value, 3);
  };

  // Axes --------------------------------------------------------------------------------------

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // Decades only, thinned to what fits; 2 and 5 as well where there are hardly two decades.
  const decades = (scale) => {
    const low = Math.log10(scale.min), high = Math.log10(scale.max);
    const steps = high - low < 2 ? [1, 2, 5] : [1];
    const stride = Math.max(1, Math.ceil((high - low) / 8));
    const ticks = [];
    for (let e = Math.floor(low); e <= Math.ceil(high); ++e) {
      if (steps.length === 1 && e % stride !== 0) continue;
      for (const s of steps) {
        const value = s * 10 ** e;
        if (value >= scale.min * 0.999 && value <= scale.max * 1.001) ticks.push({ value });
      }
    }
    scale.ticks = ticks;
  };

  const range = (values, log) => {
    const shown = values.filter((v) => Number.isFinite(v) && (!log || v > 0));
    if (shown.length === 0) return {};
    const low = Math.min(...shown), high = Math.max(...shown);
    if (log) {
      const margin = Math.max((high / low) ** 0.05, 1.3);
      return { min: low / margin, max: high * margin };
    }
    const margin = (high - low) * 0.05 || Math.abs(high) * 0.05 || 1;
    return { min: low - margin, max: high + margin };
  };

  const makeAxis = (axis, values) => {
    const log = axis.scale === "log";
    return {
      type: log ? "logarithmic" : "linear",
      ...range(values, log),
      title: { display: true, text: axis.label, color: colour("--soft") },
      grid: { color: colour("--grid"), borderColor: colour("--rule") },
      ticks: {
        color: colour("--soft"), maxRotation: 0, autoSkipPadding: 12,
        callback: (value) => tick(axis, value),
      },
      afterBuildTicks: log ? decades : undefined,
    };
  };

  // Series ------------------------------------------------------------------------------------

  const plottable = (chart) => ([x, y]) =>
    Number.isFinite(x) && Number.isFinite(y) &&
    (chart.x.scale !== "log" || x > 0) && (chart.y.scale !== "log" || y > 0);

  const toPoint = ([x, y]) => ({ x, y });

  // The points of a series, its fitted line, and the two edges of the line's confidence band.
  const makeDatasets = (chart, series, index) => {
    const hue = colour(`--series-${(index % 8) + 1}`);
    const keep = plottable(chart);
    const bare = { pointRadius: 0, pointHitRadius: 0, showLine: true, borderWidth: 0, fill: false };
    const sets = [{
      data: series.points.filter(keep).map(toPoint),
      series: index, points: true, showLine: series.joined && !series.fit,
      borderColor: hue, backgroundColor: hue, borderWidth: 1.5,
      pointStyle: shapes[index % 8][0], pointRadius: 4, pointHoverRadius: 7, pointHitRadius: 10,
      pointBorderWidth: 2,
    }];
    if (series.fit) {
      const edge = (factor) =>
        series.fit.map(([x, y, band]) => [x, y * band ** factor]).filter(keep).map(toPoint);
      sets.push(
        { ...bare, data: edge(0), series: index, borderColor: hue, borderWidth: 1.75,
          borderDash: [6, 4] },
        { ...bare, data: edge(1), series: index, fill: "+1", backgroundColor: hue + "2e" },
        { ...bare, data: edge(-1), series: index });
    }
    return sets;
  };

  const describe = (chart, dataset, index) => {
    const point = dataset.data[index];
    return `${chart.series[dataset.series].name}: ${chart.x.label} ${spoken(chart.x, point.x)}, ` +
           `${chart.y.label} ${spoken(chart.y, point.y)}`;
  };

  // One figure --------------------------------------------------------------------------------

  const draw = (figure, chart, hidden) => {
    const values = (axis) =>
      chart.series.flatMap((s) => s.points.filter(plottable(chart)).map((p) => p[axis]));
    const datasets = chart.series.flatMap((s, i) => makeDatasets(chart, s, i));
    datasets.forEach((d) => { d.hidden = hidden.has(d.series); });
    return new Chart(figure.querySelector("canvas"), {
      type: "scatter",
      data: { datasets },
      options: {
        animation: false,
        responsive: true,
        maintainAspectRatio: false,
        interaction: { mode: "nearest", intersect: true },
        scales: { x: makeAxis(chart.x, values(0)), y: makeAxis(chart.y, values(1)) },
        plugins: {
          legend: { display: false },
          tooltip: {
            displayColors: false,
            backgroundColor: colour("--ink"), bodyColor: colour("--paper"),
            titleColor: colour("--paper"), padding: 10,
            filter: (item) => item.dataset.points === true,
            callbacks: {
              title: (items) => items.length ? chart.series[items[0].dataset.series].name : "",
              label: (item) => [
                `${chart.x.label}: ${spoken(chart.x, item.parsed.x)}`,
                `${chart.y.label}: ${spoken(chart.y, item.parsed.y)}`,
              ],
            },
          },
        },
      },
    });
  };

  const makeLegend = (figure, chart, toggle) => {
    const legend = figure.querySelector(".legend");
    chart.series.forEach((series, index) => {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("aria-pressed", "true");
      button.title = "Show or hide";
      const mark = document.createElement("i");
      mark.textContent = shapes[index % 8][1];
      mark.style.color = `var(--series-${(index % 8) + 1})`;
      mark.setAttribute("aria-hidden", "true");
      button.append(mark, series.name);
      if (series.slope) {
        const slope = document.createElement("small");
        slope.textContent = ` slope ${series.slope.replace(/-/g, "−")}`;
        button.append(slope);
      }
      button.addEventListener("click", () => {
        button.setAttribute("aria-pressed", String(toggle(index)));
      });
      legend.append(button);
    });
  };

  // Arrow keys walk along a series (left, right) and from one to the next (up, down).
  const makeKeyboard = (figure, chart, current) => {
    const canvas = figure.querySelector("canvas");
    const live = figure.querySelector(".sr-only");
    let series = 0, index = -1;
    const show = (elements) => {
      const plot = current();
      plot.setActiveElements(elements);
      plot.tooltip.setActiveElements(elements, { x: 0, y: 0 });
      plot.update("none");
    };
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
      if (event.key === "Escape") { show([]); return; }
      if (!(event.key in step)) return;
      event.preventDefault();
      const [up, along] = step[event.key];
      const sets = current().data.datasets;
      const shown = sets.map((d, i) => i).filter((i) => sets[i].points && !sets[i].hidden);
      if (shown.length === 0) return;
      series = Math.min(Math.max(series + up, 0), shown.length - 1);
      const dataset = shown[series];
      index = Math.min(Math.max(index + along, 0), sets[dataset].data.length - 1);
      if (index < 0) return;
      show([{ datasetIndex: dataset, index }]);
      live.textContent = describe(chart, sets[dataset], index);
    });
    canvas.addEventListener("blur", () => show([]));
  };

  // The page ----------------------------------------------------------------------------------

  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  const redraws = [];
  JSON.parse(document.getElementById("charts").textContent).forEach((chart) => {
    const figure = document.getElementById(chart.id);
    const hidden = new Set();
    let plot = draw(figure, chart, hidden);
    makeLegend(figure, chart, (index) => {
      if (!hidden.delete(index)) hidden.add(index);
      plot.data.datasets.forEach((d) => { d.hidden = hidden.has(d.series); });
      plot.update("none");
      return !hidden.has(index);
    });
    makeKeyboard(figure, chart, () => plot);
    redraws.push(() => { plot.destroy(); plot = draw(figure, chart, hidden); });
  });
  window.matchMedia("(prefers-color-scheme: dark)")
    .addEventListener("change", () => redraws.forEach((redraw) => redraw()));
})();
