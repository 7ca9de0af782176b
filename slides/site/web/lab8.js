"use strict";

const tracers = ["TracePath as in the lecture (8.4)", "TracePath, corrected (8.4)", "lights sampled (8.7)", "MIS and roulette (8.8)"];
const sceneNames = ["cornell_lambert", "cornell_phong", "soft_shadows", "indirect", "room with balls", "caustics", "plates"];
const added = new Map();

/** The number of a scene in the module. */
function sceneNumber(name) {
  if (!added.has(name)) added.set(name, carlo.call("scene.add", ...carloScenes[name])[0]);
  return added.get(name);
}
/** Scenes with mirrors or glass, which 8.4 does not know. */
const isSpecular = (scene) => ["room with balls", "caustics"].includes(sceneNames[scene]);

carlo.experiment("tracer", {
  title: "The path tracer",
  intro: "Two of lab 8's tracers side by side, at 128 × 128 pixels on one thread. They take turns and get the same time. The error is the root mean square over the pixels of their standard errors, each relative to the brightness around it (√relMSE). It measures noise alone: light that is lost to a limit on the length of paths does not show in it. Touch or hover over a pixel, or move with the arrow keys, to see its own error.",
  question: "with the same time for the Cornell box, how large is the error of the tracer that samples lights, compared with TracePath's?",
  choices: ["the same", "about half", "about a fifth", "about a hundredth"],
  answer: "about a fifth, though it traces fewer paths in that time. TracePath finds the light only by chance.",
  asked: { scene: 0, left: 1, right: 2, depth: 0 },
  controls: {
    scene: { label: "scene", options: sceneNames, value: 0 },
    left: { label: "left", options: tracers, value: 1 },
    right: { label: "right", options: tracers, value: 2 },
    depth: { label: "longest path (8.8 only)", steps: [0, 1, 2, 3, 4, 6, 10], value: 0, text: (d) => (d ? `${d} segments` : "any length") },
    seconds: { label: "time for each", steps: [1, 2, 5, 10, 30, 120], value: 5, unit: "s" },
  },
  async run({ scene, left, right, depth, seconds, seed }, view) {
    const size = 128, band = 8, number = sceneNumber(sceneNames[scene]);
    // Mirrors and glass come with Lab 8.7.
    const sides = [left, right].map((tracer, i) => ({ tracer: isSpecular(scene) ? Math.max(2, tracer) : tracer, id: i, row: 0, samples: 0,
      time: 0, times: [], errors: [], groups: [], next: 0.25 }));
    const start = ({ tracer, id }) => carlo.call("8.start", number, tracer, size, seed, depth, id);
    // What errors are relative to.
    const reference = 2;
    start({ tracer: 3, id: reference });
    for (let pass = 0; pass < 4; ++pass) carlo.call("8.rows", reference, 0, size), await view.pause();
    for (const side of sides) {
      // A browser translates code again once it has run for a while; until then it is slow.
      start(side);
      for (let time = 0; time < 0.3;) time += view.clocked(() => carlo.call("8.rows", side.id, 60, band)), await view.pause();
      start(side);
    }
    let white = 0;
    sides.forEach((side) => drawSide(view, side, size, 1));
    while (sides.some((side) => side.time < seconds)) {
      const side = sides[0].time <= sides[1].time ? sides[0] : sides[1];
      side.time += view.clocked(() => carlo.call("8.rows", side.id, side.row, band));
      side.row = (side.row + band) % size;
      if (!side.row && ++side.samples && side.time > side.next) {
        side.next = side.time * 1.3;
        const [mean, error, ...groups] = carlo.call("8.noise", side.id, reference);
        white ||= 2.5 * mean;
        if (side.samples > 1) side.times.push(side.time), side.errors.push(error), side.groups.push(groups);
        drawSide(view, side, size, white);
        drawErrors(view, sides);
      }
      await view.pause();
    }
    sides.forEach((side) => drawSide(view, side, size, white || 1));
    drawErrors(view, sides);
    const slopes = sides.map(({ times, groups }) => (times.length > 2
      ? carlo.call("group_slope", times.length, ...times, ...groups[0].flatMap((_, g) => groups.map((row) => row[g]))) : null));
    view.say(sides.map((side, i) => `${side.id ? "Right" : "Left"}: ${side.samples} samples a pixel, ` +
      `${carlo.digits(side.samples * size * size / side.time / 1e6)} million paths a second, error ${carlo.digits(100 * (side.errors.at(-1) ?? NaN))} %` +
      `${slopes[i] ? `, slope ${carlo.digits(slopes[i][0])} ± ${carlo.digits(slopes[i][1], 2)} against seconds` : ""}.`).join(" ") +
      (isSpecular(scene) && Math.min(left, right) < 2 ? " TracePath of 8.4 knows no mirrors or glass: 8.7 stands in for it." : ""));
  },
});

function drawSide(view, side, size, white) {
  const title = side.id ? "Right" : "Left", name = tracers[side.tracer];
  const canvas = view.image(title, carlo.call("8.image", side.id), size,
    { white, note: `${name}, ${side.samples} samples a pixel<br><span class="pixel">&nbsp;</span>` });
  canvas.tabIndex = 0;
  const show = (x, y) => {
    side.at = [Math.min(size - 1, Math.max(0, x)), Math.min(size - 1, Math.max(0, y))];
    const [n, mean, error] = carlo.call("8.pixel", side.id, ...side.at);
    canvas.closest("figure").querySelector(".pixel").textContent =
      `Pixel (${side.at}): ${n} samples, ${carlo.digits(mean)} ± ${carlo.digits(1.96 * error, 2)}`;
  };
  if (side.at) show(...side.at);
  canvas.onpointermove = (e) => {
    const { left, top, width } = canvas.getBoundingClientRect();
    show(Math.floor((e.clientX - left) / width * size), Math.floor((e.clientY - top) / width * size));
  };
  canvas.onkeydown = (e) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    if (!step) return;
    e.preventDefault();
    const [x, y] = side.at ?? [64, 64];
    show(x + step[0], y + step[1]);
  };
}

function drawErrors(view, sides) {
  const shown = sides.filter((side) => side.times.length);
  if (!shown.length) return;
  const samples = (side) => side.times.map((t) => t / side.time * side.samples);
  const guide = { name: "−1/2", guide: true, x: [shown[0].times[0], shown[0].times.at(-1)],
    y: [shown[0].errors[0], shown[0].errors[0] * Math.sqrt(shown[0].times[0] / shown[0].times.at(-1))] };
  const series = (x) => shown.map((side) => ({ name: side.id ? "right" : "left", x: x(side), y: side.errors }));
  view.plot("Error against seconds", { x: { label: "seconds in this browser", log: true, unit: "seconds" },
    y: { label: "relative error of a pixel", log: true }, series: [...series((side) => side.times), guide] });
  view.plot("Error against samples", { x: { label: "samples a pixel", log: true, unit: "count" },
    y: { label: "relative error of a pixel", log: true }, series: series(samples) });
}

carlo.experiment("furnace", {
  title: "TracePath's error bars in a furnace",
  intro: "A closed sphere emits 1 and reflects the share ρ: the radiance is 1/(1 − ρ) everywhere. The lecture's TracePath chooses emission with probability .9; the corrected one always adds it (lab 8.4).",
  question: "at ρ = .5, how often do the lecture's 95 % error bars contain the truth?",
  choices: ["in 95 % of all runs", "in about half of them", "hardly ever"],
  answer: "in about half of them. Its contributions have an infinite variance: most runs have not met the rare large ones.",
  asked: { rho: 0.5 },
  controls: {
    rho: { label: "albedo ρ", min: 0.05, max: 0.9, step: 0.05, value: 0.5 },
    n: { label: "paths N, at most", steps: [1024, 4096, 16384, 65536], value: 16384 },
  },
  async run({ rho, n: most, seed }, view) {
    const exact = 1 / (1 - rho), names = ["lecture", "corrected"], deviations = carlo.call("8.furnace_deviations", rho);
    const sizes = [16, 64, 256, 1024, 4096, 16384, 65536].filter((n) => n <= most), held = [[], []];
    const methods = names.map((name, rule) => ({ name, sizes, theory: deviations[rule] < Infinity ? -0.5 : undefined,
      error: (n, runs) => {
        const [error, share] = carlo.call("8.furnace", rho, rule, n, runs, seed);
        held[rule][sizes.indexOf(n)] = 100 * share;
        return error;
      },
      exact: (n) => deviations[rule] / Math.sqrt(n) }));
    const fits = await view.ladder({ methods, runs: (n) => Math.max(50, Math.min(200, Math.round(2e5 / n))), xlabel: "paths N" });
    view.plot("Error bars that contain the truth", { x: { label: "paths N", log: true, unit: "count" }, y: { label: "% of runs", range: [0, 100] },
      series: [...names.map((name, i) => ({ name, x: sizes, y: held[i] })), { name: "promised", guide: true, x: sizes, y: sizes.map(() => 95) }] });
    const last = [];
    for (const rule of [0, 1]) {
      const rows = carlo.call("8.furnace", rho, rule, most, 1, seed).subarray(2);
      const column = (k) => Array.from({ length: rows.length / 3 }, (_, i) => rows[3 * i + k]);
      const [x, mean, error] = [0, 1, 2].map(column);
      last.push([mean.at(-1), error.at(-1)]);
      view.plot(`One run: ${names[rule]}`, { kind: "functions", x: { label: "paths N", log: true, unit: "count" }, y: { label: "radiance" },
        series: [{ name: "mean", x, y: mean }, { name: "+1.96 se", x, y: mean.map((v, i) => v + 1.96 * error[i]) },
          { name: "−1.96 se", x, y: mean.map((v, i) => v - 1.96 * error[i]) }, { name: "exact", guide: true, x: [x[0], x.at(-1)], y: [exact, exact] }] });
      await view.pause();
    }
    view.slopes(methods, fits);
    view.say(`Exact: ${carlo.digits(exact)}. One run of ${carlo.digits(most)} paths: lecture ${last.map(([mean, error]) =>
      `${carlo.digits(mean)} ± ${carlo.digits(1.96 * error, 2)}`).join(", corrected ")}. The standard deviation of one path is ` +
      `${carlo.digits(deviations[0])} by the lecture's rule, ${carlo.digits(deviations[1])} by the corrected one.`);
  },
});

carlo.experiment("recap", {
  title: "A slip in the Recap",
  intro: "A ball of light at the centre of a spherical room. TracePath as printed in the lecture's Recap multiplies by p_light, one over the light's solid angle, where its density demands a division; the corrected form divides.",
  question: "a ball of three tenths of the room's radius: what does the printed form give?",
  choices: ["the right radiance, with more noise", "a third of it", "three times as much", "no value at all"],
  answer: "three times as much, whatever the number of paths: a wrong weight is bias.",
  asked: { ball: 0.3, albedo: 0.5 },
  controls: {
    albedo: { label: "albedo of the wall", min: 0.1, max: 0.9, step: 0.1, value: 0.5 },
    ball: { label: "ball's radius over the room's", steps: [0.05, 0.1, 0.2, 0.3, 0.5, 0.7], value: 0.3 },
    n: { label: "paths N, at most", steps: [300, 1000, 3000, 10000], value: 3000 },
  },
  async run({ albedo, ball, n, seed }, view) {
    const names = ["Recap as printed", "Recap, corrected", "random direction as printed"], rows = [];
    const methods = names.map((name, form) => ({ name: ["printed", "corrected", "random"][form], form, points: [], seconds: [] }));
    const sizes = [100, 300, 1000, 3000, 10000].filter((size) => size <= n);
    for (const size of sizes) {
      for (const method of methods) {
        const [found, time] = view.timed(() => carlo.call("8.recap", albedo, ball, method.form, size, seed));
        method.points.push(found), method.seconds.push(time);
        await view.pause();
      }
    }
    const exact = methods[0].points[0][2];
    methods.forEach(({ points, form }) => {
      const [mean, error, , printed, random] = points.at(-1);
      rows.push([names[form], `${carlo.digits(mean)} ± ${carlo.digits(1.96 * error, 2)}`, carlo.digits([printed, exact, random][form])]);
    });
    view.table("Radiance of the wall", ["", "measured", "closed form"], rows, `the truth: ${carlo.digits(exact)}`);
    const errors = methods.map(({ points }) => points.map(([mean]) => Math.abs(mean / exact - 1)));
    view.plot("Error against N", { x: { label: "paths N", log: true, unit: "count" }, y: { label: "relative error, one run", log: true },
      series: methods.map(({ name }, i) => ({ name, x: sizes, y: errors[i] })) });
    view.plot("Error against seconds", { x: { label: "seconds in this browser", log: true, unit: "seconds" }, y: { label: "relative error, one run", log: true },
      series: methods.map(({ name, seconds }, i) => ({ name, x: seconds, y: errors[i] })) });
    const [, , , printed, random] = methods[0].points[0];
    const times = (mean) => (mean < Infinity ? `gives ${carlo.digits(mean / exact)} times the right radiance on average` : "has no finite mean: each bounce brings more than the one before");
    view.say(`The Recap as printed ${times(printed)}; a random direction, not divided by its density, ${times(random)}. No number of paths makes up for a wrong weight.`);
  },
});
