"use strict";

carlo.experiment("density", {
  title: "Bias and noise of a disc of photons",
  intro: "A point light at height 1 emits photons; those within a radius of its foot estimate the irradiance there, which is 1 (lab 9.5). A large disc averages over darker floor: bias. A small one holds few photons: noise. Both are known in closed form.",
  question: "what happens to the best radius if 16 times as many photons are emitted?",
  choices: ["it stays", "it shrinks", "it grows"],
  answer: "it shrinks. With less noise, less bias pays. Set 512 photons, then 8192, and compare the lowest point of both curves.",
  controls: {
    photons: { label: "photons emitted", steps: [512, 2048, 8192, 16384], value: 8192 },
    maps: { label: "photon maps", steps: [16, 64, 128], value: 64 },
    alpha: { label: "α of shrinking discs", min: 0.5, max: 0.9, step: 0.1, value: 0.7 },
  },
  async run({ photons, maps, alpha, seed }, view) {
    const radii = Array.from({ length: 11 }, (_, i) => 0.04 * 2 ** (i / 2)), rows = [];
    for (const radius of radii) {
      rows.push(carlo.call("9.density", radius, photons, maps, seed));
      await view.pause();
      const at = radii.slice(0, rows.length), column = (k) => rows.map((row) => Math.sqrt(Math.max(0, row[k])));
      view.plot("Error against the radius", { x: { label: "radius", log: true }, y: { label: "relative error", log: true }, series: [
        { name: "noise", x: at, y: column(1) }, { name: "bias", x: at, y: column(0).map((bias, i) => (rows[i][0] > 4 * rows[i][1] / maps ? bias : NaN)) },
        { name: "both", x: at, y: rows.map((row) => Math.sqrt(Math.max(0, row[0] + row[1]))) },
        { guide: true, colour: 0, x: at, y: column(3) }, { guide: true, colour: 1, x: at, y: column(2) }] }, "dashed: closed form; bias is shown where it stands out of the noise");
    }
    const totals = rows.map((row) => row[2] + row[3]), best = totals.indexOf(Math.min(...totals));
    const methods = [["shrinks", alpha], ["stays", 0]].map(([name, a]) => ({ name, sizes: [1, 4, 16, 64], theory: a ? -Math.min(1 - alpha, alpha / 2) : 0,
      error: (n, runs) => {
        const [bias2, variance] = carlo.call("9.progressive", 0.4, a, n, 1024, runs, seed);
        return Math.sqrt(Math.max(1e-12, bias2 + variance));
      } }));
    const fits = await view.ladder({ methods, runs: () => 16, xlabel: "passes N", ylabel: "relative error" });
    view.slopes(methods, fits);
    view.say(`By the closed forms, of these radii ${carlo.digits(radii[best])} is the best: bias ${carlo.digits(100 * Math.sqrt(rows[best][2]))} %, noise ${carlo.digits(100 * Math.sqrt(rows[best][3]))} %. ` +
      "Passes with a radius that stays end at its bias; where it shrinks by α, both parts vanish (lab 9.6).");
  },
});

const photonScenes = ["cornell_lambert", "caustics", "room with balls"];
// The scenes' rooms differ in size: radii are shares of this.
const photonRoom = { "cornell_lambert": 550, "caustics": 2, "room with balls": 2 };
const addedScenes = new Map();
function sceneNumber(name) {
  if (!addedScenes.has(name)) addedScenes.set(name, carlo.call("scene.add", ...carloScenes[name])[0]);
  return addedScenes.get(name);
}

carlo.experiment("photons", {
  title: "Photons in a box",
  intro: "Each pass traces its own photons and looks up one ray a pixel (lab 9.5), at 64 × 64 pixels. On the left the radius stays, in the middle it shrinks from pass to pass (lab 9.6), on the right is lab 8's path tracer. All three get the same time, in turns.",
  question: "with time, which image is free of bias?",
  choices: ["the radius that stays", "the radius that shrinks", "paths", "the last two"],
  answer: "the last two. A shrinking radius loses its bias, though slowly; the one that stays keeps it.",
  controls: {
    scene: { label: "scene", options: photonScenes, value: 1 },
    photons: { label: "photons a pass", steps: [1000, 4000, 16000], value: 4000 },
    radius: { label: "first radius", steps: [0.01, 0.02, 0.04, 0.08, 0.16], value: 0.08, unit: "of the room" },
    seconds: { label: "time for each", steps: [1, 2, 5, 10, 30], value: 5, unit: "s" },
  },
  async run({ scene, photons, radius, seconds, seed }, view) {
    const size = 64, name = photonScenes[scene], number = sceneNumber(name), first = radius * photonRoom[name];
    const ways = ["Radius stays", "Radius shrinks", "Paths (8.8)"].map((title, id) => ({ title, id, time: 0, passes: 0, next: 0.3, radius: first, log: [] }));
    carlo.call("9.start", number, size, seed, photons, first, 0, 0);
    carlo.call("9.start", number, size, seed, photons, first, 2 / 3, 1);
    carlo.call("8.start", number, 3, size, seed, 0, 0);
    let row = 0, white = 0;
    const image = (way) => (way.id < 2 ? carlo.call("9.pixels", way.id) : carlo.call("8.image", 0));
    const show = (way) => {
      const pixels = image(way);
      white ||= 2.5 * pixels.reduce((a, b) => a + b) / pixels.length || 0;
      view.image(way.title, pixels, size, { white: white || 1, note: way.id < 2
        ? `${way.passes} passes, radius now ${carlo.digits(way.radius / photonRoom[name], 2)} of the room` : `${way.passes} samples a pixel` });
    };
    ways.forEach(show);
    while (ways.some((way) => way.time < seconds)) {
      const way = ways.reduce((least, one) => (one.time < least.time ? one : least));
      if (way.id < 2) {
        way.time += view.clocked(() => { way.radius = carlo.call("9.pass", way.id)[0]; });
        ++way.passes;
      } else {
        way.time += view.clocked(() => carlo.call("8.rows", 0, row, 16));
        row = (row + 16) % size;
        if (!row) ++way.passes;
      }
      if (way.time > way.next) show(way), way.next = way.time * 1.4, way.log.push([way.time, way.passes, image(way)]);
      await view.pause();
    }
    ways.forEach(show);
    const reference = image(ways[2]), mean = reference.reduce((a, b) => a + b) / reference.length;
    const difference = (pixels) => Math.sqrt(pixels.reduce((sum, x, i) => sum + (x - reference[i]) ** 2, 0) / pixels.length) / mean;
    const series = (x) => ways.slice(0, 2).map((way) => ({ name: ["stays", "shrinks"][way.id], x: way.log.map((one) => one[x]), y: way.log.map((one) => difference(one[2])) }));
    const y = { label: "relative difference", log: true };
    view.plot("Difference to the paths' image", { x: { label: "seconds in this browser", log: true, unit: "seconds" }, y, series: series(0) });
    view.plot("The same against passes", { x: { label: "passes N", log: true, unit: "count" }, y, series: series(1) });
    const [level, noise] = carlo.call("8.deviation", 0);
    view.say(`${ways.map((way) => `${way.title}: ${way.passes} ${way.id < 2 ? "passes" : "samples a pixel"}`).join(", ")}. ` +
      `The difference to the image by paths holds the paths' own noise too, ${carlo.digits(100 * noise / level)} % of the mean luminance.`);
  },
});

carlo.experiment("records", {
  title: "Irradiance records, one by one",
  intro: "Indirect irradiance in the Cornell box, pixel by pixel: where no record serves, a new one is made from strata × strata directions (lab 9.7). Orange: where a record was placed.",
  question: "where do records crowd?",
  choices: ["in the middle of walls", "in corners and along edges", "evenly"],
  answer: "in corners and along edges. Near surfaces change the irradiance within a short way.",
  controls: {
    most: { label: "largest error of a record", steps: [0.05, 0.1, 0.2, 0.4, 0.8], value: 0.2 },
    strata: { label: "strata a side", steps: [4, 8, 16], value: 8 },
  },
  async run({ most, strata, seed }, view) {
    const size = 96, scene = sceneNumber("cornell_lambert"), places = [];
    carlo.call("9.cache_start", scene, size, most, strata, seed, 0);
    let records = 0, seconds = 0, shown = 0;
    const draw = () => {
      const pixels = carlo.call("9.cache_image", 0), white = 2.2 * pixels.reduce((a, b) => a + b) / pixels.length || 1;
      view.image("Irradiance", pixels, size, { grey: true, white, note: `indirect light alone, ${records} records` });
      view.canvas("Where records are", { note: `${records} of ${size * size} pixels` }, (g, width) => {
        const cell = width / size;
        g.fillStyle = carlo.colour("--grid");
        g.fillRect(0, 0, width, width);
        g.fillStyle = carlo.colour("--series-2");
        for (const i of places) g.fillRect(i % size * cell, Math.floor(i / size) * cell, Math.max(2, cell), Math.max(2, cell));
      });
    };
    for (let first = 0; first < size * size; first += size) {
      let found;
      seconds += view.clocked(() => { found = carlo.call("9.cache_pixels", 0, first, size); });
      records = found[0];
      places.push(...found.subarray(1));
      if (performance.now() - shown > 150) draw(), shown = performance.now();
      await view.pause();
    }
    draw();
    // The cache against many directions, at pixels spread over the image.
    const all = carlo.call("9.cache_image", 0), errors = { cache: [] }, probes = [];
    for (let i = 0; i < 40; ++i) probes.push(Math.floor((i + 0.5) / 40 * size) * size + (i * 37) % size);
    const truth = [];
    for (const at of probes) {
      truth.push(carlo.call("9.cache_exact", 0, at, 24)[0]);
      await view.pause();
    }
    const seen = truth.map((value) => value > 0), mean = truth.reduce((a, b) => a + b) / seen.filter(Boolean).length;
    const rms = (values) => Math.sqrt(values.reduce((sum, x, i) => sum + (seen[i] ? (x - truth[i]) ** 2 : 0), 0) / seen.filter(Boolean).length) / mean;
    errors.cache = rms(probes.map((at) => all[at]));
    const sides = [1, 2, 4, 8, 16], without = [], times = [];
    for (const side of sides) {
      const start = performance.now();
      without.push(rms(probes.map((at) => carlo.call("9.cache_exact", 0, at, side)[0])));
      times.push((performance.now() - start) / 1000 * size * size / probes.length);
      await view.pause();
    }
    const y = { label: "relative error", log: true }, counts = sides.map((side) => side * side);
    view.plot("Error against directions a pixel", { x: { label: "directions N", log: true, unit: "count" }, y, series: [
      { name: "no cache", x: counts, y: without }, { name: "cache", x: [records * strata * strata / size / size], y: [errors.cache] }] }, "the cache: its records' directions over all pixels");
    view.plot("Error against seconds", { x: { label: "seconds for the image, in this browser", log: true, unit: "seconds" }, y, series: [
      { name: "no cache", x: times, y: without }, { name: "cache", x: [seconds], y: [errors.cache] }] });
    view.say(`${records} records serve ${size * size} pixels in ${carlo.digits(seconds)} s; their relative error is ${carlo.digits(100 * errors.cache)} % at ${probes.length} pixels, ` +
      "against 576 directions each. Part of it is bias: more seconds with the same setting do not remove it.");
  },
});
