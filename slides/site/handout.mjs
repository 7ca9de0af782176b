// Texts of the tree as HTML: Markdown by markdown-it, formulas by KaTeX. Nothing is copied: handouts, guides and
// decks stay the source.

import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

import { escaped } from "../tool/pictures.mjs";

/** markdown-it and KaTeX from build/slides, where ./carlo slides has its packages, too. */
export function typesetter(root) {
  const require = createRequire(path.join(root, "build/slides/package.json"));
  const katex = require("katex");
  const markdown = require("markdown-it")({ html: true });
  const set = (tex, display) => katex.renderToString(tex, { displayMode: display, throwOnError: true, strict: false });
  markdown.renderer.rules.code_block = (tokens, index) => formulaHtml(tokens[index].content, set);
  return { markdown, set, katexFolder: path.dirname(require.resolve("katex")) };
}

const functionNames = "exp|log1p|log|sin|cos|tan|arctan|arccos|min|max|sqrt";

/** The handouts' formulas, Unicode that reads well without a tool, as TeX; one line. */
export function texOf(line) {
  const inner = String.raw`\(((?:[^()]|\([^()]*\))*)\)`;
  return line
    .trim()
    .replace(/(\/?)([A-Za-z]{2,}(?:[ -](?!d[xyz]\b|and\b)[A-Za-z]{2,})*|d[ω])/g, (_, slash, words) => slash + wordsTex(words, slash))
    .replace(new RegExp(`√${inner}`, "g"), String.raw`\sqrt{$1}`)
    .replace(/√([A-Za-z]|[0-9]+)/g, String.raw`\sqrt{$1}`)
    .replace(new RegExp(`([_^])${inner}`, "g"), "$1{$2}")
    .replace(/ {2,}/g, String.raw`\quad `)
    .replace(/[′″]/g, (c) => (c === "′" ? "'" : "''"))
    .replace(/[−…·≈Σ]/g, (c) => ({ "−": "-", "…": "\\ldots ", "·": "\\cdot ", "≈": "\\approx ", Σ: "\\sum " })[c]);
}

function wordsTex(words, slash) {
  if (new RegExp(`^(${functionNames})$`).test(words)) return String.raw`\operatorname{${words}}`;
  if (/^d[A-Zxyzω]$/.test(words)) return String.raw`${slash ? "" : "\\,"}\mathrm{d}${words[1]}`;
  return /^w[io]$/.test(words) ? String.raw`\mathit{${words}}` : String.raw`\text{${words}}`;
}

/** An indented block: a formula a line; what is no formula, or none for KaTeX, stays as it is. */
function formulaHtml(text, set) {
  const lines = text.trimEnd().split("\n");
  try {
    if (!lines.every((line) => /[=≤≥≈∝]|→/.test(line) && !/(\|.*){3}/.test(line) && !line.includes("./"))) throw new Error("no formula");
    return `<div class="formula" tabindex="0">${lines.map((line) => set(texOf(line), true)).join("\n")}</div>\n`;
  } catch {
    return `<pre class="scroll" tabindex="0">${escaped(text)}</pre>\n`;
  }
}

const citation = /slides ([0-9]{2}):([a-z0-9-]+)/g;

/** An anchor for a heading or term: "Step a: camera rays" -> "text-step-a-camera-rays". */
const anchorOf = (heading) => `text-${heading.toLowerCase().replace(/<[^>]*>|&[a-z]+;/g, "").replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "")}`;

const titleOf = (page) => ({ "glossary.html": "the glossary", "instructors.html": "the instructors’ guide", "students.html": "the students’ sheet" })[page] ??
  page.replace(/lab0?([0-9]+)\.html/, "lab $1’s page");

/** Markdown as HTML; in the place of files of which the site has a page stand links to it. `pages`: as for textOf(). */
export const htmlOf = (text, { markdown }, pages) =>
  markdown
    .render(text)
    .replace(/<code>([A-Za-z0-9_./-]+\.md)<\/code>/g, (words, file) => (pages(file) ? `<a href="${pages(file)}">${titleOf(pages(file))}</a>` : words))
    .replaceAll("<table>", '<div class="scroll" tabindex="0"><table>')
    .replaceAll("</table>", "</table></div>");

/** The glossary: an anchor for each term, and links to the labs. */
export const glossaryOf = ({ title, html }, labs) => ({ title, headings: [], html: html
  .replace(/<li><strong>(.*?)<\/strong>/g, (words, term) => words.replace("<li>", `<li id="${anchorOf(term)}">`))
  .replace(/\((labs? [^)]*)\)/g, (_, words) => `(${words.replace(" ", "&nbsp;").replace(/([0-9])(\.[0-9])?/g, (name, number) =>
    `<a href="${labs.find((lab) => lab.number === Number(number)).page}">${name}</a>`)})`) });

/**
 * A Markdown file's title, body and headings [anchor, words]. `formulas`: those of formulasOf(), to which citations link; `pages`: a
 * function from a path in the tree to a page of the site, or undefined.
 */
export function textOf(root, file, tools, formulas, pages) {
  const headings = [];
  const [, title, rest] = /^# (.*)\n([\s\S]*)$/.exec(fs.readFileSync(path.join(root, file), "utf8"));
  const html = htmlOf(rest, tools, pages)
    .replace(citation, (words, number, name) => {
      const found = formulas.get(`${number}:${name}`);
      return found ? `<a href="${found.page}#${number}-${name}">${words}</a>` : words;
    })
    .replaceAll("<pre>", '<pre class="scroll" tabindex="0">')
    .replace(/<h2>(.*?)<\/h2>/g, (_, words) => {
      headings.push([anchorOf(words), words]);
      return `<h3 id="${anchorOf(words)}">${words}</h3>`;
    });
  return { title, html, headings };
}

/** The decks' labelled equations: Map("04:neyman" -> {number, name, slide, html, page}). */
export function formulasOf(book, { set }, pageOf) {
  const formulas = new Map();
  for (const deck of book.decks) {
    const page = pageOf(deck);
    if (!page) continue;
    for (const slide of deck.slides) {
      const found = slide.lines.join("\n").matchAll(/<!-- eq: ([a-z0-9-]+) -->\s*\$\$([\s\S]*?)\$\$/g);
      for (const [, name, tex] of found) {
        formulas.set(`${deck.number}:${name}`, { number: deck.number, name, slide: slide.title, page, html: set(tex, true) });
      }
    }
  }
  return formulas;
}
