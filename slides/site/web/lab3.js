"use strict";

/** Known generators, x -> (a x + b) mod c. */
const knownLcgs = [
  { name: "RANDU", a: 65539, b: 0, c: 2 ** 31, lattice: 2 ** 30 },
  { name: "the lecture's LCG", a: 1664525, b: 1013904223, c: 2 ** 32 },
  { name: "MINSTD", a: 16807, b: 0, c: 2147483647 },
  { name: "MINSTD, 48271", a: 48271, b: 0, c: 2147483647 },
  { name: "a = 69069", a: 69069, b: 1, c: 2 ** 32 },
  { name: "ANSI C's example, whole state", a: 1103515245, b: 12345, c: 2 ** 31 },
  { name: "own a, b, c" },
];
const lcgControls = {
  which: { label: "generator", options: knownLcgs.map((one) => one.name), value: 0 },
  a: { label: "own a", typed: true, min: 1, max: 2 ** 32 - 1, value: 137 },
  b: { label: "own b", typed: true, min: 0, max: 2 ** 32 - 1, value: 187 },
  c: { label: "own c", typed: true, min: 256, max: 2 ** 32, value: 4096 },
};

/** x_0, odd as RANDU and MINSTD want it. */
const firstOf = ({ seed }) => 2 * (seed % 2 ** 31) + 1;

/** The generator that the controls choose; 0 < a < c. */
function lcgOf({ which, a, b, c }) {
  const known = knownLcgs[which];
  if (known.a) return { lattice: known.c, ...known };
  const kept = { a: a % c || 1, b: b % c, c };
  return { name: `${kept.a} x + ${kept.b} mod ${c}`, lattice: c, ...kept };
}

carlo.experiment("planes", {
  title: "The planes of a generator",
  intro: "Three successive numbers of x → (a x + b) mod c, divided by c, are a point of the cube. All such points lie on parallel planes; the spectral test (lab 3.8, and its search in more dimensions) finds the greatest distance 1/ν between neighbouring ones. Below, two integrals are computed from the same numbers: the mean of x, and the volume of a ball in the cube; dashed are the errors that independent numbers would have. Even RANDU does well in both: a lattice is no fault for every integrand.",
  question: "on how many planes do all triples of RANDU lie?",
  choices: ["15", "about 150", "about 1600", "they fill the cube"],
  answer: "15. RANDU's numbers satisfy xₙ₊₂ = 6 xₙ₊₁ − 9 xₙ modulo 2³¹.",
  asked: { which: 0 },
  controls: { ...lcgControls, n: { label: "triples", steps: [1000, 2000, 4000, 8000, 16000], value: 4000 } },
  async run(values, view) {
    const lcg = lcgOf(values), { a, b, c, lattice } = lcg;
    const points = carlo.call("3.triples", a, b, c, firstOf(values), values.n);
    const [nu, planes, ...normal] = carlo.call("3.spectral", a, b, c, 3);
    const wires = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].flatMap((corner, k) => [0, 1, 2].flatMap((axis) => {
      if (k && corner[axis]) return [];
      const end = corner.map((x, i) => (i === axis ? 1 : x));
      const ends = [[corner, end]];
      return k ? [...ends, [end, [1, 1, 1]]] : ends;
    }));
    const turntable = view.turntable("Triples in the cube", { points, lines: wires,
      note: "drag to turn, or use the arrow keys; the button below looks along the planes",
      axes: [["xₙ", [1.06, 0, 0]], ["xₙ₊₁", [0, 1.06, 0]], ["xₙ₊₂", [0, 0, 1.06]]] });
    addButton(view, "Look along the planes", () => turntable.along(alongOf(normal)));
    // The search in four dimensions takes seconds for more.
    const four = lattice <= 2 ** 31 ? carlo.call("3.spectral", a, b, lattice, 4) : null;
    const plane = carlo.call("3.spectral_plane", a, lattice)[0];
    const ideal = [1.0746, 1.1225, 1.1892].map((gamma, i) => gamma * lattice ** (1 / (i + 2)));
    view.table("Spectral figures", ["d", "ν", "at best", "the vector s across the planes"], [
      ["2", carlo.digits(plane, 5), carlo.digits(ideal[0]), ""],
      ["3", carlo.digits(nu, 5), carlo.digits(ideal[1]), normal.join(", ")],
      ["4", four ? carlo.digits(four[0], 5) : "–", carlo.digits(ideal[2]), four ? four.slice(2).join(", ") : ""],
    ], "ν: one over the distance of neighbouring lines, planes, hyperplanes; “at best” is Hermite’s bound; –: takes too long here for this modulus");
    await integrals(view, lcg, firstOf(values));
    view.say(`${carlo.escaped(lcg.name)}: all triples lie on at most ${carlo.digits(planes)} planes, ${carlo.digits(1 / nu)} apart ` +
      `(a perfect lattice of as many points: ${carlo.digits(1 / ideal[1])}).`);
  },
});

/** Two integrals from the generator's numbers; dashed: independent numbers would have these errors. */
const integrals = (view, { a, b, c }, x) => view.ladder({ xlabel: "points N", runs: () => 32,
  methods: [["mean of x", 12 ** -0.5], ["ball", Math.sqrt(Math.PI / 6 * (1 - Math.PI / 6))]].map(([name, sigma], which) => ({
    name, sizes: [16, 64, 256, 1024, 4096, 16384, 65536],
    error: (n, runs) => carlo.call("3.integral", a, b, c, x, n, runs)[which],
    exact: (n) => sigma / Math.sqrt(n) })) });

/** Rows of a rotation whose first axis is across the planes. */
function alongOf(normal) {
  const unit = (v) => v.map((x) => x / Math.hypot(...v));
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const x = unit(normal), z = unit(cross(x, Math.abs(x[1]) < 0.8 ? [0, 1, 0] : [1, 0, 0]));
  return [x, cross(z, x), z];
}

function addButton(view, text, action) {
  const place = view.figure("Triples in the cube").parentNode;
  place.querySelector("button")?.remove();
  const button = document.createElement("button");
  Object.assign(button, { type: "button", textContent: text, onclick: action });
  place.append(button);
}

const testNames = ["χ², top 10 bits", "χ², low 8 bits", "lag-1 correlation", "serial 2D, 256²", "serial 3D, 64³",
  "lagged 3D, 16³", "gaps, p = 1/16", "runs up", "collisions, 2 × 15 bits", "birthday spacings, 2 × 20 bits",
  "birthday spacings, 32 bits", "matrix rank, lowest bit", "matrix rank, 32 bits", "linear complexity"];

carlo.experiment("battery", {
  title: "Which tests catch it",
  intro: "The lab's battery of statistical tests on growing numbers of words. A test catches a generator where its p-value is below 10⁻⁹; a good generator gives p-values uniform on [0, 1]. At the end, errors of the mean of x and of a ball's volume from the same numbers; dashed: of independent ones.",
  question: "RANDU's triples lie on few planes. Which test sees it?",
  choices: ["the frequencies of single numbers", "pairs as points of a square", "triples as points of a cube"],
  answer: "triples. Frequencies of numbers and of pairs look right, as long as their leading bits are taken; that low bits fail is another fault, their short period. (Birthday spacings see pairs as points of a fine lattice, and are far sharper than counts.)",
  asked: { which: 0, k: 16 },
  controls: { ...lcgControls, k: { label: "words, at most", steps: [12, 14, 16, 18, 20], value: 16, text: (k) => carlo.digits(2 ** k, 7) } },
  async run(values, view) {
    const { a, b, c, name } = lcgOf(values), x = firstOf(values);
    const found = testNames.map(() => []), sizes = [];
    for (let k = 10; k <= values.k; k += 2) {
      sizes.push(2 ** k);
      for (let t = 0; t < testNames.length; ++t) {
        found[t].push(carlo.call("3.test", a, b, c, x, t, k)[0]);
        await view.pause();
        drawBattery(view, found, sizes);
      }
    }
    const caught = testNames.filter((_, t) => found[t].some((p) => p >= 0 && p < 1e-9));
    view.say(`${carlo.escaped(name)}: ${caught.length ? `caught by ${caught.join("; ")}` : "no test catches it"} within 2<sup>${values.k}</sup> words.`);
    await integrals(view, { a, b, c }, x);
  },
});

function drawBattery(view, found, sizes) {
  const verdict = (p) => (p === undefined ? "" : p < 0 ? "–" : p < 1e-9 ? `<strong class="caught">${carlo.digits(p, 1)}</strong>` : carlo.digits(p, 2));
  view.table("p-values", ["test", ...sizes.map((n) => `2<sup>${Math.log2(n)}</sup>`)],
    testNames.map((test, t) => [test, ...sizes.map((_, i) => verdict(found[t][i]))]),
    "underlined: caught; –: the test’s approximation does not hold for this number of words, or for so few bits");
}
