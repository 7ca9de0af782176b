// The viewer of a render's page, driven as a reader does. The page shows halves.xml, each of whose
// pixels is known: a light, (0.25, 0.5, 1) in the render and 0.5 in the reference, and beside it
// surroundings of 0.1 in both.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const url = pathToFileURL(process.env.CARLO_PAGE).href;
const width = 32, height = 16;

// The sRGB transfer function in 8 bits.
const byte = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x
  : 1.055 * Math.min(x, 1) ** (1 / 2.4) - 0.055));

let browser;
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CARLO_CHROMIUM,
                                    args: ["--no-sandbox", "--disable-gpu"] });
});
after(() => browser?.close());

const open = async (t, { wide = true, dark = false, reducedMotion = "no-preference" } = {}) => {
  const context = await browser.newContext({
    viewport: wide ? { width: 1280, height: 900 } : { width: 360, height: 740 },
    colorScheme: dark ? "dark" : "light", reducedMotion, hasTouch: !wide });
  t.after(() => context.close());
  const page = await context.newPage(), problems = [], requests = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(message.text());
  });
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(url);
  await page.locator(".viewer[data-ready]").waitFor();
  return { page, problems, requests, canvas: page.locator(".viewer canvas") };
};

// The colour at a place of the canvas, given as shares of its width and height.
const colourAt = (page, x, y) => page.evaluate(([u, v]) => {
  const canvas = document.querySelector(".viewer canvas");
  const at = [Math.floor(u * canvas.width), Math.floor(v * canvas.height)];
  return [...canvas.getContext("2d").getImageData(...at, 1, 1).data].slice(0, 3);
}, [x, y]);

const near = (actual, expected, tolerance = 1) => {
  assert.equal(actual.length, expected.length);
  expected.forEach((value, i) => assert.ok(Math.abs(actual[i] - value) <= tolerance,
                                           `${actual} is not ${expected}`));
};

const readout = async (page) => ({
  words: await page.locator(".viewer-readout p").textContent(),
  rows: await page.locator(".viewer-readout tbody tr").evaluateAll(
    (rows) => Object.fromEntries(rows.map((row) => {
      const [name, ...cells] = [...row.children].map((cell) => cell.textContent);
      return [name, cells.map((text) => Number(text.replace("−", "-")))];
    }))),
});

// Moves the pointer over the middle of a pixel.
const point = async (page, canvas, x, y) => {
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + (x + 0.5) / width * box.width,
                        box.y + (y + 0.5) / height * box.height);
};

// A pixel of the light, one of the surroundings, and the middles of both halves of the canvas.
const light = { pixel: [3, 5], place: [0.1, 0.3] }, sky = { place: [0.85, 0.3] };

const slider = (page, name) => page.getByRole("slider", { name });
const told = (page, name) => slider(page, name).getAttribute("aria-valuetext");
const slide = async (page, name, value) => {
  await slider(page, name).evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, String(value));
};

for (const wide of [true, false]) {
  for (const dark of [false, true]) {
    describe(`${wide ? 1280 : 360} px, ${dark ? "dark" : "light"}`, () => {
      test("the page needs nothing else, fits the screen and follows the scheme", async (t) => {
        const { page, problems, requests } = await open(t, { wide, dark });
        assert.deepEqual(problems, []);
        assert.deepEqual(requests.filter((r) => !/^(file|data|blob):/.test(r)), []);
        const [needed, given] =
          await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(needed <= given, `${needed} px are wider than the screen's ${given}`);
        const [r, g, b] = await page.evaluate(() =>
          getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
        assert.equal(r + g + b < 384, dark);
      });

      test("the split shows the render on its left and the reference on its right", async (t) => {
        const { page } = await open(t, { wide, dark });
        await slide(page, "Split", 100);
        near(await colourAt(page, ...light.place), [byte(0.25), byte(0.5), 255]);
        await slide(page, "Split", 0);
        near(await colourAt(page, ...light.place), [byte(0.5), byte(0.5), byte(0.5)]);
        near(await colourAt(page, ...sky.place), [byte(0.1), byte(0.1), byte(0.1)]);
      });

      test("exposure brightens by stops", async (t) => {
        const { page } = await open(t, { wide, dark });
        await slide(page, "Split", 100);
        await slider(page, "Exposure").focus();
        for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft");
        near(await colourAt(page, ...light.place), [byte(0.125), byte(0.25), byte(0.5)]);
        assert.equal(await told(page, "Exposure"), "−1 stops");
      });

      test("each map has the numbers that it should have", async (t) => {
        const { page, canvas } = await open(t, { wide, dark });
        await slide(page, "Split", 100);
        await canvas.scrollIntoViewIfNeeded();
        await point(page, canvas, ...light.pixel);
        const { words, rows } = await readout(page);
        near(rows.Render, [0.25, 0.5, 1], 2e-5);
        near(rows.Reference, [0.5, 0.5, 0.5], 2e-5);
        near(rows.difference, [-0.25, 0, 0.5], 2e-5);
        // ((1/4)^2 + (1/2)^2) / 0.26 / 3
        const relMse = Number(words.match(/relMSE ([\d.]+)/)[1]);
        assert.ok(Math.abs(relMse - 0.3125 / 0.26 / 3) <= 1e-3, words);
        assert.match(words, /x 3, y 5: /);
        for (const mode of ["Difference", "relMSE", "FLIP", "Noise"]) {
          await page.locator(".viewer-modes label", { hasText: mode }).click();
          assert.ok(await page.locator(".viewer-legend").isVisible(), `${mode} has no legend`);
          const ticks = await page.locator(".viewer-ticks span").allTextContents();
          assert.ok(ticks.length >= 4 && ticks.every((tick) => /\d/.test(tick)), String(ticks));
          assert.ok((await canvas.getAttribute("aria-label")).includes(`Render: ${mode}`));
        }
      });

      test("the difference is blue where the render is too dark and orange where too bright",
           async (t) => {
        const { page } = await open(t, { wide, dark });
        await slide(page, "Split", 100);
        await page.locator(".viewer-modes label", { hasText: "Difference" }).click();
        const [r, , b] = await colourAt(page, ...light.place);  // + 0.25 / 3 on the mean
        assert.ok(r > b + 50, `${r}, ${b} is not orange`);
        const grey = await colourAt(page, ...sky.place);
        assert.ok(Math.max(...grey) - Math.min(...grey) <= 4, `${grey} is not grey`);
      });
    });
  }
}

test("everything works by keyboard alone", async (t) => {
  const { page, canvas } = await open(t);
  const focused = () => page.evaluate(() => document.activeElement.tagName);
  for (let i = 0; i < 12 && await focused() !== "CANVAS"; ++i) await page.keyboard.press("Tab");
  assert.equal(await focused(), "CANVAS", "Tab does not reach the image");
  await page.keyboard.press("ArrowLeft");
  assert.match((await readout(page)).words, /^x 16, y 8/);
  await page.keyboard.press("Shift+ArrowLeft");
  await page.keyboard.press("ArrowUp");
  const { words, rows } = await readout(page);
  assert.match(words, /^x 6, y 7/);
  near(rows.Render, [0.25, 0.5, 1], 2e-5);
  assert.ok((await page.locator(".viewer-spoken").textContent()).includes("x 6, y 7"));
  await page.keyboard.press("m");
  assert.ok((await canvas.getAttribute("aria-label")).includes("Render: Difference"));
  for (let i = 0; i < 10; ++i) await page.keyboard.press("[");
  assert.equal(await told(page, "Split"), "0 %");
  await page.keyboard.press(".");
  assert.equal(await told(page, "Exposure"), "+0.5 stops");
  await page.keyboard.press("Escape");
  assert.match((await readout(page)).words, /^Point at a pixel/);
  for (let i = 0; i < 20 && await focused() !== "SUMMARY"; ++i) await page.keyboard.press("Tab");
  assert.equal(await focused(), "SUMMARY", "Tab does not reach the list of keys");
});

test("zooming keeps the pixel under the pointer, and the whole image comes back", async (t) => {
  const { page, canvas } = await open(t);
  const zoom = async () =>
    Number((await page.locator(".viewer-zoom").textContent()).match(/[\d.]+/)[0]);
  const fit = await zoom();
  await canvas.click({ position: { x: 20, y: 20 } });
  const before = (await readout(page)).words;
  await page.mouse.wheel(0, -480);
  await page.waitForFunction((old) =>
    parseFloat(document.querySelector(".viewer-zoom").textContent) > 2 * old, fit);
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + 20.4, box.y + 20.4);
  assert.equal((await readout(page)).words, before);
  await page.keyboard.press("0");
  assert.equal(await zoom(), fit);
  await page.getByRole("button", { name: "Zoom in" }).click();
  assert.ok(Math.abs(await zoom() / fit - 1.5) <= 0.02);
  // Dragging moves the image with the pointer, away from the split.
  const x = box.x + 0.8 * box.width, y = box.y + 0.53 * box.height;
  await page.mouse.move(x, y);
  const dragged = (await readout(page)).words;
  await page.mouse.down();
  await page.mouse.move(x - 40, y - 15, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(x - 40, y - 14.6);
  assert.equal((await readout(page)).words, dragged);
  await page.getByRole("button", { name: "Reset all" }).click();
  assert.equal(await zoom(), fit);
});

test("the split can be dragged on the image", async (t) => {
  const { page, canvas } = await open(t);
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 30);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 4, box.y + 30, { steps: 3 });
  await page.mouse.up();
  assert.equal(await told(page, "Split"), "25 %");
});

test("every control has a name, and nothing moves by itself", async (t) => {
  const { page } = await open(t, { reducedMotion: "reduce" });
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, canvas, summary")].filter((element) =>
      !(element.getAttribute("aria-label") || element.textContent.trim() ||
        element.labels?.[0]?.textContent.trim())).length);
  assert.equal(nameless, 0);
  assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
  assert.equal(await page.evaluate(() =>
    getComputedStyle(document.documentElement).scrollBehavior), "auto");
});

test("two images that are the same are not split", async (t) => {
  const { page } = await open(t);
  await page.getByRole("combobox", { name: "Right" }).selectOption("0");
  assert.ok(!await slider(page, "Split").isVisible());
  // Where the split's line would be.
  near(await colourAt(page, 0.4985, 0.5), await colourAt(page, ...light.place), 0);
});
