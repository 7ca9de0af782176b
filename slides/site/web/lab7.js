"use strict";

const samplerNames = ["uniform, by rejection (7.2)", "uniform (7.3)", "cosine-weighted (7.4)", "lobe about the mirror direction (7.6)"];
const exponents = [0, 1, 3, 10, 30, 100, 1000, 1e4, 1e5, 1e6, 1e7];

/** The dome's circles, for the turntable; the normal is drawn upwards. */
const domeLines = () => {
  const circle = (f) => Array.from({ length: 49 }, (_, i) => f(i / 48 * 2 * Math.PI));
  return [0, 30, 60].map((up) => Math.PI / 180 * up).map((up) => circle((a) =>
    [Math.cos(up) * Math.cos(a), Math.sin(up), -Math.cos(up) * Math.sin(a)]));
};

carlo.experiment("dome", {
  title: "Directions on a dome",
  intro: "Each point is a direction drawn by one of the lab's samplers. The lobe's density is proportional to cosⁿ of the angle with the mirror direction of wo; at a grazing angle part of it lies below the horizon.",
  question: "n = 10⁷: how wide is the lobe, by the mean angle with its axis?",
  choices: ["about 1°", "about .02°", "0: floats cannot hold it"],
  answer: "about .02°. The mean angle is about √(π/2n) radians.",
  asked: { which: 3, n: 1e7, theta: 45 },
  controls: {
    which: { label: "sampler", options: samplerNames, value: 2 },
    n: { label: "exponent n of the lobe", steps: exponents, value: 30 },
    theta: { label: "angle of wo with the normal", min: 0, max: 89, step: 1, value: 45, unit: "°" },
    side: { label: "directions", steps: [16, 32, 64], value: 32, text: (side) => carlo.digits(side * side) },
    jittered: { label: "numbers", options: ["independent", "one in each stratum"], value: 0 },
  },
  async run({ which, n, theta, side, jittered, seed }, view) {
    const found = carlo.call("7.dome", which, n, theta, side, jittered, seed), count = side * side;
    const points = [];
    // The normal is up on the screen.
    for (let i = 0; i + 2 < found.length; i += 3) points.push(found[i], found[i + 2], -found[i + 1]);
    const turn = theta / 180 * Math.PI, wo = [-Math.sin(turn), Math.cos(turn), 0], mirror = [Math.sin(turn), Math.cos(turn), 0];
    view.turntable("The directions", { points, centre: [0, 0.4, 0], size: 2.4, shape: 0.75,
      lines: [...domeLines(), [[0, 0, 0], [0, 1.15, 0]], ...(which === 3 ? [[[0, 0, 0], wo], [[0, 0, 0], mirror]] : [])],
      note: `${carlo.digits(count)} directions from ${carlo.digits(found.at(-1))} draws; drag to turn, or use the arrow keys`,
      axes: [["n", [0, 1.2, 0]], ...(which === 3 ? [["wo", wo], ["mirror", mirror]] : [])] });
    const z = [], buckets = 20;
    for (let i = 2; i < 3 * count; i += 3) z.push(found[i]);
    const share = Array.from({ length: buckets }, (_, k) =>
      z.filter((c) => c >= k / buckets && (c < (k + 1) / buckets || (k === buckets - 1 && c <= 1.001))).length / count * buckets);
    const at = share.map((_, k) => (k + 0.5) / buckets);
    const theory = which < 2 ? () => 1 : which === 2 ? (c) => 2 * c : null;
    view.plot("Density of cos θ", { x: { label: "cos θ", range: [0, 1] }, y: { label: "per unit of cos θ" },
      series: [{ name: "measured", x: at, y: share }, ...(theory ? [{ name: "exact", guide: true, x: [0.001, 1], y: [theory(0), theory(1)] }] : [])] });
    const rows = [theta, 0, 60, 85].map((angle) => [`${angle}°`, ...carlo.call("7.lobe", n, angle, 10000, seed)]);
    view.table("The lobe", ["wo", "below the horizon", "mean angle"], rows.map(([angle, below, mean]) =>
      [angle, `${carlo.digits(100 * below)} %`, `${carlo.digits(mean)}°`]), `n = ${carlo.digits(n)}, 10 000 directions each`);
    const methods = samplerNames.slice(0, 3).map((_, technique) => ({ name: ["rejection", "uniform", "cosine"][technique], theory: -0.5, sizes: [16, 64, 256, 1024, 4096],
      error: (size, runs) => carlo.call("7.floor", technique, 0.6, 0.4, size, runs, seed)[0] }));
    await view.ladder({ methods, runs: () => 64, xlabel: "directions N", ylabel: "relative error of irradiance" });
    view.say(which === 3 ? `Mean angle with the mirror direction: ${carlo.digits(rows[0][2])}°; ${carlo.digits(100 * rows[0][1])} % of the directions lie below the horizon and carry nothing.`
      : which ? "By inversion every pair of numbers gives a direction." : `Rejection throws ${carlo.digits(found.at(-1) / count)} darts a direction; by the volumes of cube and ball it should be 6/π = 1.91.`);
  },
});

carlo.experiment("floor", {
  title: "Irradiance that is known exactly",
  intro: "A point of a floor under a round light of radiance 1 at height 1 (lab 7.7). The irradiance is known in closed form; the error is that of N directions. The lobe points at the light and falls to 1/e at its rim.",
  question: "a light of radius .1: which directions have the least error for their time?",
  choices: ["uniform", "cosine-weighted", "the lobe towards the light"],
  answer: "the lobe towards the light. Most other directions miss a small light.",
  asked: { radius: 0.1 },
  controls: {
    radius: { label: "radius of the light", steps: [0.05, 0.1, 0.2, 0.4, 0.8, 1.6], value: 0.1, unit: "heights" },
    x: { label: "distance of the point from its foot", min: 0, max: 3, step: 0.2, value: 0.4, unit: "heights" },
  },
  async run({ radius, x, seed }, view) {
    const names = ["rejection", "uniform", "cosine", "lobe"];
    const methods = names.map((name, technique) => ({ name, theory: -0.5, sizes: [64, 256, 1024, 4096, 16384],
      error: (n, runs) => carlo.call("7.floor", technique, radius, x, n, runs, seed)[0] }));
    const fits = await view.ladder({ methods, runs: (n) => Math.max(16, Math.min(200, Math.round(2e5 / n))), xlabel: "directions N", ylabel: "relative RMS error" });
    view.slopes(methods, fits);
    const found = names.map((_, technique) => view.timed(() => carlo.call("7.floor", technique, radius, x, 1024, 64, seed)));
    const price = found.map(([[error], seconds]) => error ** 2 * seconds), least = Math.min(...price);
    view.table("N = 1024", ["", "relative error", "μs", "error² × time"], found.map(([[error], seconds], i) =>
      [names[i], carlo.digits(error), carlo.digits(1e6 * seconds / 64), carlo.digits(price[i] / least)]), "the last column relative to the best");
    view.say(`Exact: ${carlo.digits(found[0][0][1], 5)}. Here “${names[price.indexOf(least)]}” has the least error² × time.`);
  },
});
