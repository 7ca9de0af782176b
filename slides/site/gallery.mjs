// The gallery of the scenes: image, noise map, error against time, rendered by the reference renderer.

import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

import { escaped } from "../tool/pictures.mjs";
import { plotSvg } from "../tool/plot.mjs";
import { htmlOf } from "./handout.mjs";
import { page } from "./pages.mjs";

const samples = [4, 16, 64];

/** The reports of a scene's renders, one for each number of samples; kept until the renderer changes. */
function reports(root, renderer, scene, folder) {
  return samples.map((spp) => {
    const base = path.join(folder, `${scene}-160-${spp}`), report = `${base}.json`;
    if (!fs.existsSync(report) || fs.statSync(report).mtimeMs < fs.statSync(renderer).mtimeMs) {
      execFileSync(renderer, [`common/scenes/${scene}.xml`, "--size", "160x160", "--spp", spp, "--no-sums", "--quiet", "-o", base],
                   { cwd: root, stdio: "pipe" });
      fs.rmSync(`${base}.exr`);
    }
    return { ...JSON.parse(fs.readFileSync(report, "utf8")), base };
  });
}

/** The noise map's scale: the colours of pixel_maps.cpp from 0.1 % to 100 %, which are linear there, as a bar. */
function scaleHtml(root) {
  const code = fs.readFileSync(path.join(root, "common/course/render/pixel_maps.cpp"), "utf8");
  const anchors = [.../anchors = ([^;]*);/.exec(code)[1].matchAll(/\{([0-9.]+)f, ([0-9.]+)f, ([0-9.]+)f\}/g)].map(([, ...rgb]) => rgb.map(Number));
  const encoded = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  const colours = anchors.slice(1).flatMap((to, i) => [0, 0.25, 0.5, 0.75, ...(i === anchors.length - 2 ? [1] : [])].map((t) =>
    `rgb(${to.map((x, k) => encoded((1 - t) * anchors[i][k] + t * x)).join(" ")})`));
  return `<div class="scale"><i style="background: linear-gradient(90deg, ${colours.join(", ")})"></i>${
    ["0.1 %", "1 %", "10 %", "100 %"].map((words) => `<span>${words}</span>`).join("")}</div>`;
}

const three = (x) => String(Number(x.toPrecision(3)));

function sceneHtml({ root, out, book, scale }, renderer, scene, folder) {
  const found = reports(root, renderer, scene, folder), last = found.at(-1);
  fs.copyFileSync(`${last.base}.png`, path.join(out, `scenes/${scene}.png`));
  fs.copyFileSync(`${last.base}.error.png`, path.join(out, `scenes/${scene}.error.png`));
  const xml = fs.readFileSync(path.join(root, `common/scenes/${scene}.xml`), "utf8");
  const teaches = /Teaches: ([\s\S]*?)-->/.exec(xml)?.[1].replace(/\s+/g, " ").trim().replace(new RegExp(`^${scene.replaceAll("_", " ")}: `), "") ?? "";
  const points = found.filter((one) => one.relative_pixel_error > 0).map((one) => [one.seconds, one.relative_pixel_error]);
  const [at] = points;
  const plot = points.length < 2 ? "<p>No noise: every sample gives the exact value.</p>" : plotSvg(book.runs, {
    kind: "loglog", narrow: true, xlabel: "seconds", ylabel: "error", xunit: "seconds",
    guides: [{ slope: -0.5, at, to: points.at(-1)[0], label: "−1/2" }] },
    `Error against seconds, ${scene}`, [{ name: "", points }]);
  const img = (file, alt) => `<img src="scenes/${file}.png" alt="${escaped(alt)}" width="160" height="160">`;
  return `<figure id="${scene}"><figcaption>${scene}<span>${escaped(teaches)}</span></figcaption>
<div class="pair">${img(scene, `The scene ${scene}`)}<div>${img(`${scene}.error`, `Map of the relative noise of ${scene}`)}${scale}</div></div>
<p>${last.spp} samples a pixel in ${three(last.seconds)} s, ${three(last.paths / last.seconds / 1e6)} million paths a second; the
error, estimated from the render itself, is ${three(100 * last.relative_pixel_error)} %.</p>${plot}</figure>`;
}

export function gallery(context, programs, tools) {
  const renderer = path.join(programs, "carlo_render"), folder = path.join(context.root, "build/site/scenes");
  for (const one of [folder, path.join(context.out, "scenes")]) fs.mkdirSync(one, { recursive: true });
  const scenes = fs.readdirSync(path.join(context.root, "common/scenes")).filter((name) => name.endsWith(".xml")).map((name) => name.slice(0, -4));
  const figures = scenes.map((scene) => sceneHtml({ ...context, scale: scaleHtml(context.root) }, renderer, scene, folder));
  const readme = fs.readFileSync(path.join(context.root, "README.md"), "utf8");
  const from = readme.indexOf("    ./carlo bench render\n"), measured = readme.slice(from, readme.indexOf("    ./carlo test --hard", from));
  const processors = os.cpus(), threads = processors.length === 1 ? "one thread" : `${processors.length} threads`;
  context.write("gallery.html", page(context, {
    name: "gallery.html",
    title: "The scenes",
    lead: `Rendered at 160 × 160 pixels by <code>./carlo render</code> when this site was made. The picture on the right of each pair shows the
noise: a pixel’s colour is its standard error relative to its own brightness, on a logarithmic scale from dark blue (0.1 % or less) to yellow
(100 % or more). The error is the root mean square over the pixels of their standard errors, relative to the mean brightness: pixels at the
edge of a light count most. It falls faster than the −1/2 of random points: the renderer’s are Sobol’ points, and the shortest times include its start. All of it on
${threads} of ${processors[0].model.trim()}.`,
    body: `<div class="charts scenes">${figures.join("\n")}</div>
<section><h2>How fast, how accurate</h2><div class="text">${htmlOf(measured, tools, context.pages)}</div></section>`,
  }));
}
