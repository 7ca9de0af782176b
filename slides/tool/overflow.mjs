// Measures in Chromium whether everything stays inside its slide, and whether figures are legible.

import { createRequire } from "node:module";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const smallest = 14; // of a figure's letters, in slide pixels

/** Adds a problem for each slide of out/slides/DECK.html with overflow or with tiny letters. */
export async function checkOverflow(decks, book, out, problems) {
  const require = createRequire(path.join(book.root, "build/slides/package.json"));
  const puppeteer = require("puppeteer-core");
  const browser = await puppeteer.launch({
    executablePath: path.join(book.root, "slides/tool/chromium.sh"),
    timeout: 180000,
    protocolTimeout: 600000,
  });
  try {
    const page = await browser.newPage();
    await page.setViewport({ width: 1280, height: 720 });
    for (const deck of decks) {
      await page.goto(pathToFileURL(path.join(out, `${deck.name}.html`)).href, {
        waitUntil: "load",
        timeout: 180000,
      });
      const found = await page.evaluate(measure);
      if (found.length !== deck.slides.length) {
        problems.add(
          deck.file,
          0,
          `${found.length} slides could be measured, expected ${deck.slides.length}`,
        );
      }
      found.forEach(({ over, what, letters }, index) => {
        const slide = deck.slides[index];
        const wrong = (text) =>
          problems.add(deck.file, slide.line, `slide ${slide.place}, "${slide.title}": ${text}`);
        if (what) wrong(`${what} sticks out by ${over} px`);
        if (letters < smallest) wrong(`letters of ${letters.toFixed(1)} px in a figure, less than ${smallest}`);
      });
    }
  } finally {
    await browser.close();
  }
}

/**
 * Runs in the page. Returns by how many slide pixels which child exceeds the space inside the
 * padding, and the size of the smallest letters in its figures.
 */
function measure() {
  const sections = [...document.querySelectorAll("section[data-marpit-pagination]")];
  // Only the current slide is laid out; makes the others measurable like it.
  const style = document.createElement("style");
  style.textContent =
    "svg[data-marpit-svg]{visibility:visible!important;display:block!important;content-visibility:visible!important}";
  document.head.append(style);
  return sections.map((section) => {
    const box = section.getBoundingClientRect();
    const scale = box.width / section.offsetWidth;
    const css = getComputedStyle(section);
    const inside = {
      left: box.left + parseFloat(css.paddingLeft) * scale,
      right: box.right - parseFloat(css.paddingRight) * scale,
      top: box.top + parseFloat(css.paddingTop) * scale,
      bottom: box.bottom - parseFloat(css.paddingBottom) * scale,
    };
    let worst = { over: 0, what: "" };
    const note = (over, what) => {
      if (over > worst.over) worst = { over: Math.round(over), what };
    };
    // A nested picture states the size of its letters (pictures.mjs).
    const sizes = [...section.querySelectorAll("figure svg text, figure svg image[data-letters]")].map(
      (element) => {
        const { a, b } = element.getScreenCTM();
        const own = element.dataset.letters ?? getComputedStyle(element).fontSize;
        return (parseFloat(own) * Math.hypot(a, b)) / scale;
      },
    );
    const letters = Math.min(Infinity, ...sizes);
    note(section.scrollHeight - section.clientHeight, "something");
    note(section.scrollWidth - section.clientWidth, "something");
    for (const element of section.querySelectorAll("*")) {
      if (element.closest("footer, mjx-assistive-mml") || element.matches("mjx-container")) continue;
      const frame = section.contains(element.ownerSVGElement) && element.closest("figure svg");
      // In a drawing only clipped text counts.
      if (section.contains(element.ownerSVGElement) && !(frame && element.tagName === "text")) continue;
      const place = element.getBoundingClientRect();
      if (!place.width || !place.height) continue;
      const room = frame ? frame.getBoundingClientRect() : inside;
      const over =
        Math.max(
          room.left - place.left,
          place.right - room.right,
          room.top - place.top,
          place.bottom - room.bottom,
        ) / scale;
      if (over > 3)
        note(over, `<${element.tagName.toLowerCase()}> "${element.textContent.trim().slice(0, 40)}"`);
      if (
        element.scrollWidth > element.clientWidth + 2 &&
        element.clientWidth &&
        getComputedStyle(element).overflowX !== "visible"
      ) {
        note(
          element.scrollWidth - element.clientWidth,
          `<${element.tagName.toLowerCase()}> "${element.textContent.trim().slice(0, 40)}"`,
        );
      }
    }
    return { ...worst, letters: Number.isFinite(letters) ? letters : 1000 };
  });
}
