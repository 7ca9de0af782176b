"use strict";

const sampleSizes = [4, 16, 64, 256, 1024, 4096, 16384];
const ways = ["light", "lobe", "balance", "power"];

carlo.experiment("mis", {
  title: "Two densities, one integral",
  intro: "A plate reflects one light, on a line of directions. Either draw points of the light, or directions of the plate's lobe, or half of each with Veach and Guibas' weights (labs 6.6 and 6.7). The integral is known in closed form.",
  question: "a small light and a rough plate: which technique alone is better?",
  choices: ["points of the light", "directions of the lobe", "they are equal"],
  answer: "points of the light. A direction of a wide lobe seldom meets a small light. With a large light and a smooth plate it is the other way round. With weights the error stays far below that of the worse technique, and you need not know which one that is; power weights lose less than balance weights where one technique is nearly perfect.",
  asked: { half: 0.003, scale: 0.03, m: 0.54 },
  controls: {
    half: { label: "half width of the light", steps: [0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3], value: 0.003 },
    scale: { label: "roughness: scale of the lobe", steps: [0.0003, 0.001, 0.003, 0.01, 0.03, 0.1], value: 0.03 },
    m: { label: "mirror direction m", min: 0.3, max: 0.7, step: 0.01, value: 0.54 },
  },
  async run({ half, scale, m, seed }, view) {
    // What is worth seeing: the light, and the lobe around the mirror direction.
    const from = Math.max(0, Math.min(0.5 - 2 * half, m - 8 * scale)), to = Math.min(1, Math.max(0.5 + 2 * half, m + 8 * scale));
    const rows = carlo.call("6.curves", half, scale, m, 400, from, to);
    const edges = [Math.max(0, 0.5 - 2 * half), Math.min(1, 0.5 + 2 * half)], near = carlo.call("6.curves", half, scale, m, 400, ...edges);
    const column = (table, k) => Array.from({ length: 400 }, (_, i) => table[6 * i + k]);
    const x = column(rows, 0), f = column(rows, 1), nearX = column(near, 0), exact = carlo.call("6.errors", half, scale, m, 0, 1, 1, seed)[2];
    const curve = (name, y) => ({ name, x, y });
    view.plot("Integrand and densities", { kind: "functions", x: { label: "direction x", range: [from, to] }, y: { label: "per unit of x" },
      series: [curve("f / integral", f.map((v) => v / exact)), curve("light", column(rows, 2)), curve("lobe", column(rows, 3))] });
    view.plot("MIS weight of the light's samples", { kind: "functions", x: { label: "direction x, near the light", range: edges }, y: { label: "weight", range: [0, 1] },
      series: [["balance", 4], ["power", 5]].map(([name, k]) => ({ name, x: nearX, y: column(near, k) })) }, "the weight of the lobe’s samples is 1 minus this");
    const methods = ways.map((name, way) => ({ name, theory: -0.5, sizes: sampleSizes,
      error: (n, runs) => carlo.call("6.errors", half, scale, m, way, n, runs, seed)[0] }));
    const fits = await view.ladder({ methods, xlabel: "samples N", ylabel: "relative RMS error",
                                     runs: (n) => Math.max(8, Math.min(400, Math.round(2e5 / n))) });
    view.slopes(methods, fits);
    const errors = ways.map((_, way) => carlo.call("6.errors", half, scale, m, way, 64, 400, seed)[0]);
    view.say(`With 64 samples the relative error is ${ways.map((name, i) => `${carlo.digits(errors[i])} (${name})`).join(", ")}. ` +
      `A slope other than −1/2 is a sign of an infinite or barely finite variance, unless there is no error but rounding.`);
  },
});

carlo.experiment("plates", {
  title: "Veach's plates on a line",
  intro: "Four plates from nearly mirror-like (top) to nearly matt, four lights of equal power from a point (left) to a panel. Every pixel is its own estimate, as in lab 6.7.",
  question: "where are points of the lights noisier than directions of the lobe?",
  choices: ["small light, rough plate", "large light, smooth plate", "everywhere alike"],
  answer: "large light, smooth plate. Few points of a large light lie where a smooth plate reflects.",
  asked: { size: 1, rough: 1 },
  controls: {
    n: { label: "samples a pixel", steps: [2, 4, 8, 16, 32, 64], value: 4 },
    size: { label: "size of the lights", steps: [0.25, 0.5, 1, 2], value: 1, text: (x) => `× ${x}` },
    rough: { label: "roughness of the plates", steps: [0.25, 0.5, 1, 2, 4], value: 1, text: (x) => `× ${x}` },
  },
  async run({ n, size, rough, seed }, view) {
    const columns = 240, rows = 14, gap = 3, sums = [0, 0, 0], truth = [];
    const names = ["Points of the lights", "Directions of the lobe", "Both, power heuristic", "Exact"];
    const seconds = [];
    for (const way of [3, 0, 1, 2]) {
      const picture = [];
      for (let plate = 0; plate < 4; ++plate) {
        const [pixels, time] = view.timed(() => carlo.call("6.plate", way, n, seed, plate, columns, rows, size, rough));
        seconds[way] = (seconds[way] ?? 0) + time;
        pixels.forEach((value, i) => {
          if (way === 3) truth.push(value);
          else sums[way] += (value - truth[plate * rows * columns + i]) ** 2;
        });
        // A photograph's curve shows five stops of brightness side by side.
        picture.push(...pixels.map((v) => (v / (v + 4)) ** 2.2), ...Array(plate < 3 ? gap * columns : 0).fill(0));
        await view.pause();
      }
      const error = Math.sqrt(sums[way] / (4 * rows * columns));
      view.image(names[way], picture, columns, { grey: true,
        note: way === 3 ? "closed form" : `RMS error ${carlo.digits(error)}, ${carlo.digits(1000 * seconds[way])} ms in this browser` });
    }
    const errors = sums.map((sum) => Math.sqrt(sum / (4 * rows * columns)));
    const methods = names.slice(0, 3).map((_, way) => ({ name: ["lights", "lobe", "both"][way], theory: -0.5, sizes: [2, 4, 8, 16, 32, 64],
      error: (samples) => Math.sqrt([0, 1, 2, 3].reduce((sum, plate) => {
        const pixels = carlo.call("6.plate", way, samples, seed, plate, columns, rows, size, rough);
        return pixels.reduce((total, value, i) => total + (value - truth[plate * rows * columns + i]) ** 2, sum);
      }, 0) / (4 * rows * columns)) }));
    view.slopes(methods, await view.ladder({ methods, runs: () => 1, xlabel: "samples a pixel", ylabel: "RMS error of a pixel" }));
    view.say(`RMS errors with ${n} samples a pixel: lights ${carlo.digits(errors[0])}, lobe ${carlo.digits(errors[1])}, both ${carlo.digits(errors[2])}.`);
  },
});

carlo.experiment("tails", {
  title: "A tail that error bars miss",
  intro: "The integral of 5 x⁴ over [0, 1] from points of density (n + 1) xⁿ. At n = 4 the density is the integrand; beyond it, points near 0 become rare while their contributions grow without bound. From n = 9 on the variance is infinite.",
  question: "at n = 8.5 the variance is finite. Do the measured errors lie on its line σ/√N?",
  choices: ["yes", "they lie above", "they lie below, until a rare point comes"],
  answer: "they lie below, until a rare point comes. Most of the variance comes from points near 0 that few runs have drawn.",
  asked: { n: 8.5 },
  controls: {
    n: { label: "exponent n of the density", min: 0, max: 12, step: 0.5, value: 8.5 },
    runs: { label: "runs", steps: [30, 100, 300, 1000], value: 100 },
  },
  async run({ n, runs, seed }, view) {
    const sizes = [16, 64, 256, 1024, 4096, 16384], held = [];
    const [, , , variance, index] = carlo.call("6.tails", n, 16, 1, seed);
    if (!variance) {
      view.box.replaceChildren();
      return view.say("The density is the integrand’s: every contribution is 1, and there is no error but rounding.");
    }
    const method = { name: "measured", sizes, theory: variance < Infinity ? -0.5 : undefined,
      error: (size, count) => {
        const found = carlo.call("6.tails", n, size, count, seed);
        held[sizes.indexOf(size)] = 100 * found[1];
        return found[0];
      },
      exactName: "σ/√N", exact: (size) => Math.sqrt(variance / size) };
    const fits = await view.ladder({ methods: [method], runs: () => runs, xlabel: "points N" });
    view.plot("Intervals that contain the integral", { x: { label: "points N", log: true, unit: "count" }, y: { label: "% of runs", range: [0, 100] },
      series: [{ name: "measured", x: sizes, y: held }, { name: "promised", guide: true, x: sizes, y: sizes.map(() => 95) }] });
    view.slopes([method], fits);
    view.say(`σ² of one contribution: ${carlo.digits(variance)}${variance < Infinity ? " (25/((n + 1)(9 − n)) − 1)" : ""}. Contributions have a tail P(Y > y) ~ y<sup>−a</sup> with ` +
      `a = ${carlo.digits(index)}; where a is close to 2 a sample's variance is mostly in points that it has not drawn.`);
  },
});
