// Builds out/slides: HTML by Marp, PDF by Marp and Chromium, and the page that lists the decks.

import { spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

import { escaped } from "./pictures.mjs";
import { UserError } from "./problems.mjs";
import { marpMarkdown } from "./transform.mjs";

/** Writes `decks` as Markdown for Marp; returns the folder. */
export function writeMarkdown(decks, book, paged) {
  const folder = path.join(book.root, "build/slides", paged ? "paged" : "decks");
  fs.mkdirSync(folder, { recursive: true });
  const texts = new Map(decks.map((deck) => [`${deck.name}.md`, marpMarkdown(deck, book, paged)]));
  for (const old of fs.readdirSync(folder)) if (!texts.has(old)) fs.rmSync(path.join(folder, old));
  for (const [name, text] of texts) writeIfChanged(path.join(folder, name), text);
  return folder;
}

/** In watch mode Marp rebuilds what was written. */
function writeIfChanged(file, text) {
  if (!fs.existsSync(file) || fs.readFileSync(file, "utf8") !== text) fs.writeFileSync(file, text);
}

async function marp(book, folder, out, options) {
  const program = path.join(book.root, "build/slides/node_modules/@marp-team/marp-cli/marp-cli.js");
  const child = spawn(
    process.execPath,
    [
      program,
      "--config-file",
      path.join(book.root, "slides/tool/marp.config.mjs"),
      "--input-dir",
      folder,
      "--output",
      out,
      ...options,
    ],
    { cwd: book.root, stdio: ["ignore", "pipe", "pipe"] },
  );
  let words = "";
  for (const stream of [child.stdout, child.stderr]) {
    stream.setEncoding("utf8");
    stream.on("data", (text) => (words += text));
  }
  const status = await new Promise((resolve, reject) => child.on("error", reject).on("close", resolve));
  if (status !== 0 || /\[ +ERROR/.test(words)) throw new UserError(`Marp failed:\n${words}`);
}

/** Builds HTML of `decks` in out/slides. Invalid mathematics is an error. */
export async function buildHtml(decks, book, out) {
  await marp(book, writeMarkdown(decks, book, false), out, []);
  for (const deck of decks) checkHtml(deck, path.join(out, `${deck.name}.html`));
}

/** MathJax marks what it could not parse in red, or as an error. */
function checkHtml(deck, file) {
  const html = fs.readFileSync(file, "utf8");
  const error =
    /data-mjx-error="([^"]*)"/.exec(html)?.[1] ??
    (/data-mml-node="mtext" fill="red"/.test(html) ? "a command that MathJax does not know" : "");
  if (error) throw new UserError(`${deck.file}: an equation is wrong: ${error}`);
  const missing = deck.slides.length - (html.match(/<section [^>]*data-marpit-pagination=/g) ?? []).length;
  if (missing)
    throw new UserError(`${deck.file}: ${missing} of ${deck.slides.length} slides are missing in ${file}`);
}

export async function buildPdf(decks, book, out) {
  const browser = path.join(book.root, "slides/tool/chromium.sh");
  await marp(book, writeMarkdown(decks, book, true), out, [
    "--pdf",
    "--allow-local-files",
    "--browser",
    "chrome",
    "--browser-path",
    browser,
    "--browser-timeout",
    "180",
  ]);
}

/** Maps each label to its place: hints and handouts cite slides by it. */
function labelList(book) {
  const items = [...book.labels].map(
    ([key, label]) =>
      `<li><a href="${label.deck.name}.html#${label.slide.place}">${key}</a>${label.equation ? ` (${label.equation})` : ""}</li>`,
  );
  return `<details><summary>The labels that hints and handouts cite</summary><ul>${items.join("")}</ul></details>`;
}

/** The page that lists the decks, with links to existing files. */
export function writeIndex(book, out) {
  const rows = book.decks.map((deck) => {
    const link = (extension) =>
      fs.existsSync(path.join(out, `${deck.name}.${extension}`))
        ? `<a href="${deck.name}.${extension}">${extension === "html" ? escaped(deck.front.title) : "PDF"}</a>`
        : extension === "html"
          ? escaped(deck.front.title)
          : "";
    return (
      `<tr><td>${deck.id}</td><td>${link("html")}</td><td>${deck.slides.length}</td><td>${deck.front.minutes} min</td>` +
      `<td>${deck.front.lab ? `lab ${deck.front.lab}` : ""}</td><td>${link("pdf")}</td></tr>`
    );
  });
  const total = book.decks.reduce((sum, deck) => sum + Number(deck.front.minutes), 0);
  fs.writeFileSync(
    path.join(out, "index.html"),
    `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Carlo: slides</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font: 18px/1.6 system-ui, sans-serif; color: #1b1f24; max-width: 50rem; margin: 3rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; padding: .35rem .8rem .35rem 0; border-bottom: 1px solid #d9dee4; } a { color: #0072b2; }
p, details { color: #59636e; } ul { columns: 2; }
</style></head><body>
<h1>Carlo: slides</h1>
<table><tr><th></th><th>deck</th><th>slides</th><th>time</th><th></th><th></th></tr>
${rows.join("\n")}
</table>
${labelList(book)}
<p>${total} minutes in all. In a deck: arrow keys turn pages, <kbd>f</kbd> fills the screen, <kbd>p</kbd> opens the speaker's notes.</p>
</body></html>
`,
  );
}
