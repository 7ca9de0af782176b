"use strict";

const dartSizes = (most) => Array.from({ length: 12 }, (_, i) => 16 * 4 ** i).filter((n) => n <= most);

carlo.experiment("darts", {
  title: "Darts at a circle",
  intro: "Darts fall uniformly on the unit square; four times the share inside the quarter disc estimates π. Two other integrands with the same integral compete: the circle's height 4 √(1 − x²) and the arctangent's derivative 4/(1 + x²).",
  question: "compared with samples of 4/(1 + x²), how many darts does the same error take?",
  choices: ["as many", "twice as many", "about six times", "a hundred times"],
  answer: "about six times, the ratio of the two variances.",
  controls: {
    n: { label: "darts N, at most", steps: dartSizes(2 ** 22), value: 65536 },
  },
  async run({ n: most, seed }, view) {
    const shown = Math.min(most, 4096), xy = carlo.call("2.places", seed, shown);
    view.canvas(`The first ${shown} darts`, { label: "Darts on the unit square", note: "orange: missed the quarter disc" },
      (g, width) => {
        for (let i = 0; i < shown; ++i) {
          const [x, y] = [xy[2 * i], xy[2 * i + 1]];
          g.fillStyle = carlo.colour(x * x + y * y < 1 ? "--series-1" : "--series-2");
          g.fillRect(x * width - 1, (1 - y) * width - 1, 2, 2);
        }
        g.strokeStyle = carlo.colour("--ink");
        g.beginPath();
        g.arc(0, width, width, -Math.PI / 2, 0);
        g.stroke();
      });
    const deviations = carlo.call("2.deviations");
    const methods = ["darts", "circle", "arctangent"].map((name, which) => ({ name, theory: -0.5, sizes: dartSizes(most),
      error: (n, runs) => carlo.call("2.estimates", which, n, runs, seed)[0],
      exact: (n) => deviations[which] / Math.sqrt(n) }));
    const fits = await view.ladder({ methods, xlabel: "samples N", runs: (n) => Math.max(16, Math.min(128, Math.round(3e5 / n))) });
    view.slopes(methods, fits);
    const [, value, error] = carlo.call("2.estimates", 0, most, 1, seed);
    view.say(`${carlo.digits(most)} darts: ${carlo.digits(value, 6)} ± ${carlo.digits(error, 2)} (one standard error). For the same error it takes ` +
      `${carlo.digits((deviations[0] / deviations[2]) ** 2)} times as many darts as samples of 4/(1 + x²): the ratio of their variances. Dashed: σ/√N, known in closed form.`);
  },
});

carlo.experiment("intervals", {
  title: "A thousand intervals at once",
  intro: "Each run throws N darts and gives two intervals for π: estimate ± z standard errors (lab 2.1), and Wilson's score interval (lab 2.2).",
  question: "with N = 16 and z = 1.96, which of the two keeps the promise of 95 % better?",
  choices: ["estimate ± 1.96 standard errors", "Wilson's", "both keep it"],
  answer: "Wilson's. The simple interval has no width where all darts or none are inside, and is too narrow near that.",
  asked: { n: 16, z: 1.96 },
  controls: {
    n: { label: "darts N a run", steps: [4, 8, 16, 32, 64, 128, 256, 1024, 4096], value: 16 },
    z: { label: "z", steps: [1, 1.645, 1.96, 2.576], value: 1.96, unit: "standard deviations" },
  },
  async run({ n, z, seed }, view) {
    const runs = 1000, found = carlo.call("2.intervals", n, z, runs, seed), exact = carlo.call("2.coverage", n, z);
    view.say(`Of ${runs}, ${Math.round(1000 * found[0])} simple and ${Math.round(1000 * found[1])} score intervals contain π; by the binomial ` +
      `distribution it should be ${carlo.digits(1000 * exact[0])} and ${carlo.digits(1000 * exact[1])}.`);
    ["estimate ± z standard errors", "Wilson's score interval"].forEach((title, kind) =>
      drawThousand(view, title, found.subarray(2), kind));
    const sizes = [4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256, 512, 1024];
    const rows = sizes.map((size) => carlo.call("2.coverage", size, z));
    const promised = 100 * normalShare(z);
    view.plot("Intervals that contain π", { x: { label: "darts N a run", log: true, unit: "count" }, y: { label: "% of runs", range: [40, 100] },
      series: [{ name: "simple", x: sizes, y: rows.map(([simple]) => 100 * simple) }, { name: "score", x: sizes, y: rows.map(([, score]) => 100 * score) },
        { name: "promised", guide: true, x: sizes, y: sizes.map(() => promised) }] }, "exact, by the binomial distribution");
    await view.ladder({ methods: [{ name: "darts", sizes: dartSizes(65536), theory: -0.5,
      error: (size, count) => carlo.call("2.estimates", 0, size, count, seed)[0] }], runs: () => 64, xlabel: "darts N" });
  },
});

/** The share of the normal distribution within z standard deviations, for the z of the menu. */
function normalShare(z) {
  return { 1: 0.6827, 1.645: 0.9, 1.96: 0.95, 2.576: 0.99 }[z];
}

/** All intervals as a fan of lines in the order of their runs; those that miss π in the second colour. */
function drawThousand(view, title, bounds, kind) {
  const runs = bounds.length / 4;
  view.canvas(title, { shape: 0.7, label: `${runs} intervals`, note: "one column a run; orange: does not contain π" }, (g, width, height) => {
    const y = (value) => height * (1 - Math.min(4.2, Math.max(0, value)) / 4.2);
    for (let i = 0; i < runs; ++i) {
      const [lower, upper] = [bounds[4 * i + 2 * kind], bounds[4 * i + 2 * kind + 1]];
      g.fillStyle = carlo.colour(lower <= Math.PI && Math.PI <= upper ? "--series-6" : "--series-2");
      g.fillRect(i / runs * width, y(upper), Math.max(0.5, width / runs), Math.max(1, y(lower) - y(upper)));
    }
    g.fillStyle = carlo.colour("--ink");
    g.fillRect(0, y(Math.PI), width, 1);
    for (const tick of [0, 1, 2, 3, 4]) g.fillText(String(tick), 2, Math.min(height - 2, y(tick) - 2));
  });
}
