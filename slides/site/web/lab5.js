"use strict";

const binCount = 24;
// The weights that the reader draws; the controls set them to a shape.
const shapes = [
  { name: "a hill", f: (x) => Math.exp(-8 * (x - 0.4) ** 2) },
  { name: "a line", f: (x) => x },
  { name: "two lights", f: (x) => (Math.abs(x - 0.2) < 0.05 ? 1 : Math.abs(x - 0.75) < 0.1 ? 0.4 : 0.02) },
  { name: "one bright bin", f: (x) => (Math.abs(x - 0.48) < 0.02 ? 1 : 0.01) },
  { name: "constant", f: () => 0.6 },
];
const shapeOf = (which) => Array.from({ length: binCount }, (_, i) => shapes[which].f((i + 0.5) / binCount));
let drawn, drawnFrom;

/** Bars of weights to draw with the pointer; with the keys: left and right choose a bin, up and down change it. */
function drawWeights(view, weights, counts, changed) {
  let chosen = 0;
  const most = Math.max(...weights), sum = weights.reduce((a, b) => a + b), total = counts ? counts.reduce((a, b) => a + b) : 1;
  const draw = () => {
    const canvas = view.canvas("Draw a density", { shape: 0.6, label: "Bars of the density. Left and right choose one, up and down change it.",
      note: "drag over the bars, or use the arrow keys; dots: the share of samples in each bin" }, (g, width, height) => {
      for (let i = 0; i < binCount; ++i) {
        const bar = weights[i] / Math.max(most, 1e-9) * (height - 14);
        g.fillStyle = carlo.colour(i === chosen ? "--series-5" : "--series-6");
        g.fillRect(i / binCount * width + 1, height - bar, width / binCount - 2, bar);
        if (!counts) continue;
        g.fillStyle = carlo.colour("--series-2");
        const dot = counts[i] / total * sum / Math.max(most, 1e-9) * (height - 14);
        g.fillRect((i + 0.5) / binCount * width - 3, Math.max(0, height - dot - 3), 6, 6);
      }
    });
    return canvas;
  };
  const canvas = draw();
  canvas.tabIndex = 0;
  canvas.className = "draw";
  const set = (bin, weight) => {
    chosen = Math.min(binCount - 1, Math.max(0, bin));
    weights[chosen] = Math.min(1, Math.max(0.002, weight));
    changed();
  };
  const from = (e) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    set(Math.floor((e.clientX - left) / width * binCount), (1 - (e.clientY - top) / height) * Math.max(most, 0.2));
  };
  canvas.onpointerdown = (e) => { canvas.setPointerCapture(e.pointerId); from(e); };
  canvas.onpointermove = (e) => { if (canvas.hasPointerCapture(e.pointerId)) from(e); };
  canvas.onkeydown = (e) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] }[e.key];
    if (!step) return;
    e.preventDefault();
    if (step[0]) chosen = (chosen + step[0] + binCount) % binCount, draw();
    else set(chosen, weights[chosen] + step[1]);
  };
}

carlo.experiment("drawn", {
  title: "A density drawn by hand",
  intro: "A table of 24 bins, sampled by inversion of its sums (lab 5.5), by rejection of darts below its highest bar (lab 5.7), and by Vose's alias table. All three give the same density; the cost differs.",
  question: "which shape makes rejection expensive?",
  choices: ["a constant", "a line", "one bright bin"],
  answer: "one bright bin. Darts fall evenly below its height, and most of them beside it.",
  asked: { shape: 3 },
  controls: {
    shape: { label: "start from", options: shapes.map(({ name }) => name), value: 0 },
    n: { label: "samples N", steps: [100, 1000, 10000, 100000], value: 10000 },
  },
  async run({ shape, n, seed }, view) {
    if (drawnFrom !== shape) drawn = shapeOf(shape), drawnFrom = shape;
    const ways = ["inversion", "rejection", "alias table"], rows = [], all = [];
    for (const [way, name] of ways.entries()) {
      const [found, seconds] = view.timed(() => carlo.call("5.histogram", way, n, seed, ...drawn));
      all.push(found);
      rows.push([name, way === 1 ? carlo.digits(found[binCount] / n) : "none", `${carlo.digits(1e9 * seconds / n)} ns`]);
      await view.pause();
    }
    let waiting;
    drawWeights(view, drawn, Array.from(all[0].subarray(0, binCount)), () => {
      clearTimeout(waiting);
      waiting = setTimeout(() => document.querySelector("#drawn form").requestSubmit(), 120);
    });
    const accepted = carlo.call("5.accepted", ...drawn)[0];
    view.table("The cost of a sample", ["", "darts", "time here"], rows, `closed form for rejection: ${carlo.digits(1 / accepted)} darts a sample; times vary with what else runs`);
    const sum = drawn.reduce((a, b) => a + b), sizes = [64, 256, 1024, 4096, 16384, 65536];
    const deviation = Math.sqrt(drawn.reduce((total, weight) => total + weight / sum * (1 - weight / sum), 0) / binCount);
    const methods = ways.map((name, way) => ({ name, sizes,
      error: (size) => {
        const found = carlo.call("5.histogram", way, size, seed, ...drawn);
        return Math.hypot(...drawn.map((weight, i) => found[i] / size - weight / sum)) / Math.sqrt(binCount);
      },
      ...(way === 0 ? { exact: (size) => deviation / Math.sqrt(size) } : {}) }));
    await view.ladder({ methods, runs: () => 1, xlabel: "samples N", ylabel: "RMS error of a bin's share" });
    view.say(`Rejection accepts ${carlo.digits(100 * accepted)} % of its darts, the area below the density over that of its box.`);
  },
});

carlo.experiment("power", {
  title: "Inversion against rejection",
  intro: "The density (n + 1) xⁿ on [0, 1] (lab 5.3): inversion takes one power a sample, rejection throws darts at the unit square until one falls below xⁿ.",
  question: "n = 63: how many darts a sample?",
  choices: ["2", "8", "64", "4096"],
  answer: "64. The area below xⁿ is 1/(n + 1) of the square.",
  asked: { e: 63 },
  controls: {
    e: { label: "exponent n", steps: [0, 1, 3, 7, 15, 31, 63, 127, 255], value: 15 },
    n: { label: "samples N", steps: [1000, 10000, 100000], value: 10000 },
  },
  async run({ e, n, seed }, view) {
    const exponents = [0, 1, 3, 7, 15, 31, 63, 127, 255], cost = [[], []], darts = [];
    for (const one of exponents) {
      for (const way of [0, 1]) {
        const size = Math.max(50, Math.round(n / (one + 1)));
        const [found, seconds] = view.timed(() => carlo.call("5.power", way, one, size, 1, seed));
        cost[way].push(seconds / size);
        if (way) darts.push(found[1]);
      }
      await view.pause();
    }
    const x = exponents.map((one) => one + 1);
    view.plot("Time of a sample", { x: { label: "n + 1", log: true, unit: "count" }, y: { label: "seconds in this browser", log: true, unit: "seconds" },
      series: [{ name: "inversion", x, y: cost[0] }, { name: "rejection", x, y: cost[1] }] });
    view.plot("Darts of a sample", { x: { label: "n + 1", log: true, unit: "count" }, y: { label: "darts", log: true, unit: "count" },
      series: [{ name: "measured", x, y: darts }, { name: "n + 1", guide: true, x: [1, 256], y: [1, 256] }] });
    const sigma = Math.sqrt((e + 1) / (e + 3) - ((e + 1) / (e + 2)) ** 2);
    const methods = ["inversion", "rejection"].map((name, way) => ({ name, sizes: [16, 64, 256, 1024, 4096], theory: -0.5,
      error: (size, runs) => carlo.call("5.power", way, e, size, runs, seed)[0], exact: (size) => sigma / Math.sqrt(size) }));
    const fits = await view.ladder({ methods, runs: () => Math.max(8, Math.min(32, Math.round(1024 / (e + 1)))), xlabel: "samples N" });
    view.slopes(methods, fits);
    view.say(`At n = ${e} rejection throws ${carlo.digits(e + 1)} darts a sample (closed form) and takes ${carlo.digits(cost[1][exponents.indexOf(e)] / cost[0][exponents.indexOf(e)])} ` +
      "times as long as inversion here. Against N both have the same error: only seconds tell them apart.");
  },
});

carlo.experiment("disc", {
  title: "Points of a disc",
  intro: "Darts at the square around the disc, or inversion of radius and angle (lab 5.8).",
  question: "does it matter for the error of an average over the disc?",
  choices: ["no: both are uniform", "yes: strata survive inversion, and the error falls faster"],
  answer: "yes. Rejection throws away numbers of some strata and keeps others; inversion maps every stratum to a piece of the disc.",
  controls: { side: { label: "points N", steps: [4, 8, 16, 32], value: 16, text: (side) => String(side * side) } },
  async run({ side, seed }, view) {
    const names = ["Rejection", "Inversion", "Inversion, strata"];
    for (const [way, name] of names.entries()) {
      const xy = carlo.call("5.disc", way, side, seed), darts = xy.at(-1);
      view.canvas(name, { note: `${side * side} points, ${darts} darts` }, (g, width) => {
        const at = (x) => (1 + x) / 2 * width;
        g.strokeStyle = carlo.colour("--soft");
        g.beginPath();
        g.arc(at(0), at(0), width / 2 - 1, 0, 7);
        g.stroke();
        g.fillStyle = carlo.colour("--series-1");
        for (let i = 0; i + 1 < xy.length; i += 2) g.fillRect(at(xy[i]) - 1.5, at(-xy[i + 1]) - 1.5, 3, 3);
      });
    }
    // The variance of x^2 over the disc: 1/8 - 1/16.
    const methods = ["rejection", "inversion", "strata"].map((name, way) => ({ name, sizes: [16, 64, 256, 1024, 4096], theory: [-0.5, -0.5, -1][way],
      error: (n, runs) => carlo.call("5.disc_error", way, Math.sqrt(n), runs, seed)[0],
      ...(way === 0 ? { exact: (n) => Math.sqrt(1 / 16 / n), exactName: "σ/√N" } : {}) }));
    const fits = await view.ladder({ methods, runs: () => 32 });
    view.slopes(methods, fits);
    view.say(`The mean of x² over the disc is 1/4: its error falls as N<sup>${carlo.digits(fits[0][0])}</sup> by rejection, N<sup>${carlo.digits(fits[2][0])}</sup> by inversion of stratified numbers. ` +
      "Rejection throws 4/π = 1.27 darts a point.");
  },
});
