// The site as a reader uses it: every page from a folder, every control by keyboard, nothing asked of another
// host. All calls of the WebAssembly module are made again by the native program, and compared.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const site = process.env.CARLO_SITE, native = process.env.CARLO_SITE_NATIVE;
const pages = fs.readdirSync(site).filter((name) => name.endsWith(".html"));
const axe = createRequire(import.meta.url).resolve("axe-core");

let browser;
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CARLO_CHROMIUM, args: ["--no-sandbox", "--disable-gpu"] });
});
after(() => browser?.close());

async function open(t, name, { width = 1280, dark = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme: dark ? "dark" : "light" });
  t.after(() => context.close());
  const page = await context.newPage(), problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(message.text());
  });
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) problems.push(`asks for ${request.url()}`);
  });
  await page.addInitScript(() => { window.carloLog = []; });
  await page.goto(pathToFileURL(path.join(site, name.split("#")[0])).href + (name.includes("#") ? `#${name.split("#")[1]}` : ""));
  return { page, problems };
}

/** What axe-core finds against contrast, names of controls, reach by keyboard. */
async function barriers(page) {
  await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ["wcag2a", "wcag2aa"], preload: false }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 200))}`);
}

const finished = (page, id) =>
  page.waitForFunction((name) => document.getElementById(name).dataset.state === "done", id, { timeout: 120_000 });

// Bits are promised where only whole numbers, + - * / and square roots are computed; the rest calls the mathematics
// library, which is musl's here and glibc's there. Where a last digit decides a path, or the split of a stratum,
// otherwise, what follows differs altogether: of these the mean is compared.
const bits = /^(2\.(places|deviations)|3\.(triples|spectral|spectral_plane|integral)|8\.(start|rows)|scene\.add)$/;
const statistical = /^4\.(recursive|boxes)$|^8\.(image|noise|deviation|furnace|recap)$|^9\./;

function differences(log) {
  const lines = log.map(({ name, numbers }) => `${name} ${numbers.join(" ")}`).join("\n");
  const answers = execFileSync(native, { input: `${lines}\n`, maxBuffer: 1 << 30, encoding: "utf8" }).split("\n");
  const wrong = [], mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
  log.forEach(({ name, numbers, values }, i) => {
    const expected = answers[i].split(" ").filter(Boolean).map((x) => Number(x.replace("inf", "Infinity"))).slice(0, values.length);
    const near = (a, b, most) => Object.is(a, b) || Math.abs(a - b) <= most * Math.max(1e-12, Math.abs(b)) || (Number.isNaN(a) && Number.isNaN(b));
    const right = bits.test(name) ? values.every((x, k) => Object.is(x, expected[k]))
      : statistical.test(name) ? near(mean(values), mean(expected), 5e-2)
        : values.every((x, k) => near(x, expected[k], 1e-6));
    if (!right || expected.length !== values.length) wrong.push(`${name}(${numbers.slice(0, 8)}): ${values.slice(0, 4)}, native ${expected.slice(0, 4)}`);
  });
  return wrong;
}

describe("every page", () => {
  for (const name of pages) {
    test(name, async (t) => {
      for (const [width, dark] of [[390, true], [1280, false], [1920, true]]) {
        const { page, problems } = await open(t, name, { width, dark });
        const { scrollWidth, innerWidth } = await page.evaluate(() => ({ scrollWidth: document.documentElement.scrollWidth, innerWidth }));
        assert.ok(scrollWidth <= innerWidth, `${width} pixels wide: ${scrollWidth}`);
        if (width !== 1920) assert.deepEqual(await barriers(page), []);
        assert.deepEqual(problems, []);
        await page.close();
      }
    });
  }
  test("fewer than 15 MB", () => {
    const files = fs.readdirSync(site, { recursive: true }).map((name) => fs.statSync(path.join(site, name)));
    assert.ok(files.reduce((sum, file) => sum + (file.isFile() ? file.size : 0), 0) < 15e6);
  });
  // As the reader has them: with what scripts add, and with the lecture's decks where they are built.
  test("links lead to files of the site, and to places in them", async (t) => {
    const linked = fs.readdirSync(site, { recursive: true }).filter((name) => name.endsWith(".html")), found = new Map();
    for (const name of linked) {
      const { page } = await open(t, name);
      found.set(path.join(site, name), await page.evaluate(() => ({
        ids: [...document.querySelectorAll("[id]")].map((one) => one.id),
        links: [...document.querySelectorAll("[href], [src]")].map((one) => one.href?.baseVal ?? one.href ?? one.src) })));
      await page.close();
    }
    for (const [from, { ids, links }] of found) {
      if (path.dirname(from) === site) assert.deepEqual(ids.filter((id, i) => ids.indexOf(id) < i), [], `${from} has an anchor twice`);
      for (const link of links.filter((one) => one.startsWith("file:"))) {
        const url = new URL(link), [file, place] = [fileURLToPath(url), decodeURIComponent(url.hash.slice(1).split("?")[0])];
        assert.ok(fs.existsSync(file), `${from} links to ${file}`);
        // A deck's own script goes to the slide of a number.
        if (place && path.dirname(file) === site) assert.ok(found.get(file).ids.includes(place), `${from} links to ${file}#${place}`);
      }
    }
  });
  test("a link into a page ends at its place", async (t) => {
    for (const place of ["lab08.html#handout", "lab08.html#tracer", "lab08.html#text-step-h-the-path-tracer", "lab01.html#01-welford", "glossary.html#text-mis"]) {
      const { page } = await open(t, place, { width: 390 });
      const top = () => page.evaluate(() => document.getElementById(location.hash.slice(1)).getBoundingClientRect().top);
      let at = await top();
      for (let before = NaN; at !== before; at = await top()) before = at, await page.waitForTimeout(400);
      assert.ok(at >= 0 && at < 40, `${place} is ${at} pixels below the top`);
      await page.close();
    }
  });
});

describe("experiments", () => {
  const named = pages.flatMap((name) => [...fs.readFileSync(path.join(site, name), "utf8")
    .matchAll(/<article class="live" id="([a-z]+)">/g)].map(([, id]) => ({ name, id })));
  for (const { name, id } of named) {
    test(`${name}: ${id}`, async (t) => {
      // The address alone starts it; renders are told to be short.
      const { page, problems } = await open(t, `${name}#${id}?seconds=1&seed=7`);
      await finished(page, id);
      const article = page.locator(`#${id}`);
      assert.ok(await article.locator("figure").count() > 0, "it shows nothing");
      assert.deepEqual(await barriers(page), []);
      const controls = await article.locator("[data-id]").all();
      for (const control of controls) {
        if (["seconds"].includes(await control.getAttribute("data-id"))) continue;
        await control.focus();
        const before = await control.inputValue();
        await page.keyboard.press("ArrowUp");
        if (await control.inputValue() === before) await page.keyboard.press("ArrowDown");
        assert.notEqual(await control.inputValue(), before, "a control does not listen to the keyboard");
        await page.waitForTimeout(300);
        await finished(page, id);
      }
      await article.locator("[data-next]").click();
      await finished(page, id);
      assert.match(page.url(), new RegExp(`#${id}\\?.*seed=`));
      assert.ok((await article.locator(".status").textContent()).length > 20);
      for (const canvas of await article.locator("canvas[tabindex]").all()) {
        await canvas.focus();
        await page.keyboard.press("ArrowLeft");
      }
      const text = await article.locator("svg.plot text").allTextContents();
      assert.ok(text.some((words) => words.includes("seconds")), "no plot has seconds on its axis");
      assert.deepEqual(problems, []);
      assert.deepEqual(differences(await page.evaluate(() => window.carloLog)), []);
    });
  }
});
