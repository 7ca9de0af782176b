"use strict";

// Powers of two or four up to a budget.
const ladderOf = (first, last, factor) => {
  const sizes = [];
  for (let n = first; n <= last; n *= factor) sizes.push(n);
  return sizes;
};

/** The points of a rule with n cells a side in d dimensions. */
const rulePoints = [(n, d) => n ** d, (n, d) => (n + 1) ** d, (n, d) => (2 * n + 1) ** d];
const ruleOrder = [2, 2, 4];

carlo.experiment("curse", {
  title: "The curse of dimensions",
  intro: "A rule of lab 1.4, nested in d dimensions, against Monte Carlo on the unit cube. Errors are relative to the integral; Monte Carlo's are the root mean square of many runs.",
  question: "for the smooth integrand: from which dimension on does Monte Carlo's error fall faster than the midpoint rule's?",
  choices: ["2", "3", "5", "9", "never"],
  answer: "5. (Its slope, not yet its error: with few points the rule may be ahead.) The rule's slope −2/d is flatter than −1/2 from there on; at d = 4 the two are equal.",
  asked: { d: 6, f: 0, rule: 0 },
  controls: {
    d: { label: "dimensions d", min: 1, max: 10, step: 1, value: 6 },
    f: { label: "integrand", options: ["exp(x₁ + … + x_d)", "1 in the unit ball, else 0"], value: 0 },
    rule: { label: "rule", options: ["midpoint", "trapezoid", "Simpson"], value: 0 },
    n: { label: "points N, at most", steps: ladderOf(256, 2 ** 20, 4), value: 65536 },
  },
  async run({ d, f, rule, n: most, seed }, view) {
    const sides = new Map();
    for (let n = 1, last = 0; rulePoints[rule](n, d) <= most; ++n) {
      const points = rulePoints[rule](n, d);
      if (points < 2 * last) continue;
      sides.set(points, n);
      last = points;
    }
    const smooth = f === 0;
    const methods = [
      { name: "Monte Carlo", sizes: ladderOf(16, most, 4), theory: -0.5,
        error: (n, runs) => carlo.call("1.monte_carlo", d, f, n, runs, seed)[0] },
      { name: ["midpoint", "trapezoid", "Simpson"][rule], sizes: [...sides.keys()],
        theory: smooth ? -ruleOrder[rule] / d : undefined, runs: () => 1,
        error: (n) => carlo.call("1.rule", d, f, rule, sides.get(n))[0] },
    ];
    const fits = await view.ladder({ methods, ylabel: "relative error",
                                     runs: (n) => Math.max(16, Math.min(64, Math.round(2e5 / n))) });
    view.slopes(methods, fits);
    view.say(fits[1] ? `In ${d} dimension${d > 1 ? "s" : ""} the rule's error falls as N<sup>${carlo.digits(fits[1][0])}</sup>` +
      `${smooth ? ` (theory for many points: ${carlo.digits(-ruleOrder[rule] / d)})` : ""}, Monte Carlo's as N<sup>${carlo.digits(fits[0][0])}</sup>.`
      : `The budget allows ${sides.size} size${sides.size === 1 ? "" : "s"} of the rule in ${d} dimensions, too few for a slope; Monte Carlo's is ${carlo.digits(fits[0][0])}.`);
  },
});

carlo.experiment("spike", {
  title: "Error bars that miss",
  intro: "The integrand is 1 everywhere on [0, 1] and 1 + 1/w on a spike of width w: its integral is 2, and half of that lies where a uniform point falls with probability w, like a small bright light. A thousand runs, each with its 95 % interval by lab 1.3.",
  question: "of 1000 intervals with N = 1/w points each, how many contain the integral?",
  choices: ["about 950", "about 800", "about 600", "hardly any"],
  answer: "about 600. In a share (1 − w)ᴺ of the runs, some 37 %, no point meets the spike, and the interval has no width.",
  asked: { w: 0.001, n: 1000 },
  controls: {
    w: { label: "width w of the spike", steps: [0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001], value: 0.001 },
    n: { label: "points N a run", steps: [10, 30, 100, 300, 1000, 3000, 10000, 30000], value: 1000 },
  },
  async run({ w, n, seed }, view) {
    const shown = 60, runs = 1000;
    const found = carlo.call("1.spike", w, n, runs, seed, shown);
    view.say(`${Math.round(1000 * found[0])} of 1000 intervals contain the integral. In a share (1 − w)ᴺ = ${carlo.digits(100 * found[2])} % of all runs ` +
      "no point meets the spike: the estimate is then exactly 1, its error bar 0, and nothing in the run says so.");
    drawIntervals(view, found.subarray(3));
    const sizes = [10, 30, 100, 300, 1000, 3000, 10000, 30000];
    const share = [], error = [], seconds = [];
    for (const size of sizes) {
      const [[held, rms], time] = view.timed(() => carlo.call("1.spike", w, size, runs, seed, 0));
      share.push(100 * held), error.push(rms), seconds.push(time / runs);
      await view.pause();
      const at = sizes.slice(0, share.length);
      view.plot("Intervals that contain the integral", { x: { label: "points N", log: true, unit: "count" },
        y: { label: "% of 1000 runs", range: [0, 100] }, series: [{ name: "measured", x: at, y: share },
          { name: "promised", guide: true, x: sizes, y: sizes.map(() => 95) }] });
      const theory = at.map((x) => Math.sqrt((1 / w - 1) / x));
      view.plot("Error against N", { x: { label: "points N", log: true, unit: "count" }, y: { label: "RMS error", log: true },
        series: [{ name: "measured", x: at, y: error }, { name: "σ/√N", guide: true, x: at, y: theory }] });
      view.plot("Error against seconds", { x: { label: "seconds in this browser", log: true, unit: "seconds" },
        y: { label: "RMS error", log: true }, series: [{ name: "", x: seconds, y: error }] });
    }
  },
});

/** Intervals one below the other, those that miss 2 in the second colour. */
function drawIntervals(view, pairs) {
  const count = pairs.length / 2;
  const most = Math.max(3, ...Array.from({ length: count }, (_, i) => pairs[2 * i] + 2 * pairs[2 * i + 1]));
  view.canvas("The first 60 runs", { shape: 0.62, note: "mean and 95 % interval; orange: does not contain 2, the vertical line",
    label: `Means and intervals of ${count} runs` }, (g, width, height) => {
    const x = (value) => (0.04 + 0.92 * value / most) * width;
    g.fillStyle = carlo.colour("--soft");
    g.fillRect(x(2), 0, 1, height - 16);
    for (let tick = 0; tick <= most; ++tick) g.fillText(String(tick), x(tick) - 3, height - 3);
    for (let i = 0; i < count; ++i) {
      const mean = pairs[2 * i], half = 1.96 * pairs[2 * i + 1];
      const y = (i + 0.5) / count * (height - 18);
      g.fillStyle = carlo.colour(Math.abs(mean - 2) <= half ? "--series-1" : "--series-2");
      g.fillRect(x(mean - half), y, Math.max(1, x(mean + half) - x(mean - half)), 1);
      g.fillRect(x(mean) - 2, y - 1.5, 4, 4);
    }
  });
}
