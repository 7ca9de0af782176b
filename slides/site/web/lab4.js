"use strict";

const setNames = ["random", "jittered", "Latin", "Halton", "Sobol'"];
const integrandNames = ["exp(−x² − y²), smooth", "4 in the quarter disc: an edge", "a narrow peak"];
// Theory for many points; jittered points need square numbers, Halton's and Sobol's have factors of log N.
const setSlopes = [[-0.5, -0.5], [-1, -0.75], [-0.5, -0.5], [-0.92, -0.75], [-1.42, -0.75]];
const squares = [16, 64, 256, 1024, 4096, 16384];

/** The integrand in grey, and on it what `draw(g, width)` adds; y points up. */
function overIntegrand(view, title, f, note, draw) {
  const side = 96, values = carlo.call("4.values", f, side);
  const most = Math.max(...values);
  view.canvas(title, { note, label: `${title}: ${note}` }, (g, width) => {
    const cell = width / side;
    g.fillStyle = carlo.colour("--soft");
    values.forEach((value, i) => {
      g.globalAlpha = 0.45 * value / most;
      const [left, top] = [i % side, Math.floor(i / side)].map((k) => Math.floor(k * cell));
      g.fillRect(left, top, Math.floor((i % side + 1) * cell) - left, Math.floor((Math.floor(i / side) + 1) * cell) - top);
    });
    g.globalAlpha = 1;
    draw(g, width);
    g.strokeStyle = carlo.colour("--soft");
    g.strokeRect(0.5, 0.5, width - 1, width - 1);
  });
}

carlo.experiment("strata", {
  title: "Strata over an integrand",
  intro: "The same number of points, placed in five ways: independent, one in each cell of a grid (lab 4.3), one in each row and column (lab 4.4), Halton's and Sobol's points (randomised). Each point is uniform by itself, so each average is unbiased.",
  question: "four times as many jittered points on the smooth integrand: how many times smaller is the error?",
  choices: ["2", "4", "8"],
  answer: "4. The error of jittered points in two dimensions falls as 1/N where the integrand is smooth, and as N to the −3/4 across an edge.",
  controls: {
    set: { label: "points", options: setNames, value: 1 },
    f: { label: "integrand, on the unit square", options: integrandNames, value: 0 },
    n: { label: "points in the picture", steps: [16, 64, 256, 1024], value: 64 },
  },
  async run({ set, f, n, seed }, view) {
    const xy = carlo.call("4.points", set, n, seed), cells = Math.sqrt(n);
    overIntegrand(view, "The points", f, `${n} points: ${setNames[set]}; darker: larger values of the integrand`, (g, width) => {
      g.strokeStyle = carlo.colour("--soft");
      for (let i = 1; set === 1 && i < cells; ++i) {
        g.fillRect(i / cells * width, 0, 0.5, width);
        g.fillRect(0, i / cells * width, width, 0.5);
      }
      g.fillStyle = carlo.colour("--series-2");
      for (let i = 0; i < xy.length; i += 2) {
        g.beginPath();
        g.arc(xy[i] * width, (1 - xy[i + 1]) * width, n > 300 ? 1.5 : 2.5, 0, 7);
        g.fill();
      }
    });
    const methods = setNames.map((name, which) => ({ name, sizes: squares, theory: setSlopes[which][f === 1 ? 1 : 0],
      error: (size, runs) => carlo.call("4.set", which, f, size, runs, seed)[0] }));
    const fits = await view.ladder({ methods, runs: (size) => Math.max(16, Math.min(100, Math.round(2e5 / size))) });
    view.slopes(methods, fits);
    const errors = setNames.map((_, which) => carlo.call("4.set", which, f, 1024, 64, seed)[0]);
    view.say(`With 1024 points the RMS error is ${setNames.map((name, i) => `${carlo.digits(errors[i])} (${name})`).join(", ")}.`);
  },
});

carlo.experiment("recursive", {
  title: "Strata that split where it pays",
  intro: "Recursive stratification (lab 4.6) halves a box along the axis along which it varies more, gives more points to the half that varies more, and goes on until few points are left.",
  question: "on the narrow peak, N = 4096: how does its error compare with that of independent points?",
  choices: ["as large", "about half", "a tenth or less"],
  answer: "a tenth or less. Where strata are small the integrand hardly varies within one.",
  asked: { f: 2, n: 4096 },
  controls: {
    f: { label: "integrand, on the unit square", options: integrandNames, value: 2 },
    n: { label: "points N", steps: [16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384], value: 1024 },
  },
  async run({ f, n, seed }, view) {
    for (let size = 16; size <= n; size *= 2) {
      const [value, error, exact, ...boxes] = carlo.call("4.boxes", f, size, seed);
      overIntegrand(view, "The boxes", f, `${carlo.digits(size)} points, ${boxes.length / 5} boxes: ${carlo.digits(value, 4)} ± ${carlo.digits(error, 2)}, exactly ${carlo.digits(exact, 4)}`, (g, width) => {
        g.strokeStyle = carlo.colour("--series-2");
        for (let i = 0; i < boxes.length; i += 5) {
          const [left, bottom, right, top] = boxes.slice(i, i + 4).map((x) => x * width);
          g.strokeRect(left, width - top, right - left, top - bottom);
        }
      });
      await view.pause();
    }
    const methods = [["random", 0], ["jittered", 1], ["recursive", 2]].map(([name, which]) => ({ name, sizes: squares,
      theory: which === 2 ? undefined : setSlopes[which][f === 1 ? 1 : 0],
      error: (size, runs) => (which === 2 ? carlo.call("4.recursive", f, size, runs, seed)
                                          : carlo.call("4.set", which, f, size, runs, seed))[0] }));
    const fits = await view.ladder({ methods, runs: (size) => Math.max(16, Math.min(64, Math.round(2e5 / size))) });
    view.slopes(methods, fits);
    const plain = carlo.call("4.set", 0, f, n >= 1024 ? n : 1024, 64, seed)[0], split = carlo.call("4.recursive", f, n >= 1024 ? n : 1024, 64, seed)[0];
    view.say(`With ${carlo.digits(Math.max(n, 1024))} points its RMS error is ${carlo.digits(split)}: ${carlo.digits(100 * split / plain)} % of that of independent points, ${carlo.digits(plain)}.`);
  },
});
