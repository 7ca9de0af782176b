// Converts a deck's Markdown to Markdown that Marp knows: figures, snippets, numbers, labels and
// references become HTML.

import { numberText } from "./figures.mjs";
import { figureHtml } from "./pictures.mjs";
import { readSnippet } from "./snippets.mjs";
import { walk } from "./deck.mjs";

export const figureLine = /^!\[([^\]]*)\]\(figure:([^)]+)\)\s*$/;
export const reference = /\[([^\]]*)\]\(([0-9]{2}):([a-z0-9-]+)\)/g;
export const numberMark = /\{\{([^}]*)\}\}/g;
export const snippetFence = /^```([a-z+]*) snippet=(\S+)\s*$/;

/** `book`: {root, decks, labels, definitions, data, runs}. `paged`: for PDF, without links to other decks. */
export function marpMarkdown(deck, book, paged) {
  const { marp, theme, math, title } = deck.front;
  const head = [
    "---",
    ...Object.entries({ marp, theme, math, title: JSON.stringify(title) }).map(
      ([key, value]) => `${key}: ${value}`,
    ),
    "paginate: true",
    `footer: ${JSON.stringify(title)}`,
    "---",
    "",
  ];
  const slides = deck.slides.map((slide) => slideMarkdown(slide, deck, book, paged));
  return head.join("\n") + slides.join("\n---\n");
}

function slideMarkdown(slide, deck, book, paged) {
  const out = [];
  let equation = null;
  walk(slide.lines, (line, index, inFence) => {
    const snippet = snippetFence.exec(line);
    if (snippet) {
      out.push("```" + snippet[1], ...readSnippet(book.root, snippet[2]).lines);
    } else if (inFence) {
      out.push(line);
    } else if (/^<!-- (eq|label): /.test(line)) {
      equation = opened(line, slide, out);
    } else {
      out.push(inline(line, slide, deck, book, paged));
      if (equation && endsMath(line, equation)) {
        out.push("", `</div><span class="number">(${equation.equation})</span></div>`, "");
        equation = null;
      }
    }
  });
  const text = out
    .join("\n")
    .replace(/<!-- notes:([\s\S]*?)-->/, (_, notes) => `<!--\nNotes.\n\n${notes.trim()}\n-->`);
  return footer(slide, deck) + layout(slide) + text;
}

/** A label's anchor; for an equation, also the box around it. */
function opened(line, slide, out) {
  const [, kind, name] = /^<!-- (eq|label): ([a-z0-9-]+) -->/.exec(line);
  if (kind === "label") {
    out.push(`<span id="${name}"></span>`, "");
    return null;
  }
  out.push(`<div class="eq" id="eq-${name}"><div>`, "");
  return { ...slide.labels.find((label) => label.name === name), started: false };
}

/** Whether a line ends the $$ ... $$ of an equation. */
function endsMath(line, equation) {
  const marks = line.split("$$").length - 1;
  const open = equation.started;
  if (marks) equation.started = true;
  return open ? marks > 0 : marks > 1;
}

/** Hints cite "slides 04:variance-of-strata": the foot of that slide shows this label. */
function footer(slide, deck) {
  const labels = slide.labels.map((label) => `${deck.number}:${label.name}`);
  return labels.length
    ? `<!-- _footer: ${JSON.stringify([deck.front.title, ...labels].join(" \u00a0 "))} -->\n`
    : "";
}

/** Chooses a class for a slide that has none, by its content. */
function layout(slide) {
  return slide.classes.length ? "" : `<!-- _class: ${hasFigure(slide) ? "figured" : "plain"} -->\n`;
}

const hasFigure = (slide) => slide.lines.some((line) => figureLine.test(line));

function inline(line, slide, deck, book, paged) {
  const figure = figureLine.exec(line);
  if (figure) {
    const definition = {
      ...book.definitions.figures.get(figure[2]),
      narrow: slide.classes.includes("side"),
    };
    const data = book.data.get(definition.number)?.figures?.[figure[2]];
    return figureHtml(book.root, definition, figure[1], data, book.runs);
  }
  return line
    .replace(numberMark, (_, key) => {
      const wanted = book.definitions.numbers.get(key);
      return numberText(wanted, book.data.get(wanted.number).numbers[wanted.id].value);
    })
    .replace(reference, (_, text, number, name) =>
      link(text, book.labels.get(`${number}:${name}`), deck, paged),
    );
}

/** [eq](04:label) becomes the equation's number, other link texts stay as they are. */
function link(text, label, deck, paged) {
  const shown =
    text === "eq"
      ? label.equation
        ? `(${label.equation})`
        : `deck ${label.deck.id}, slide ${label.slide.place}`
      : text;
  if (label.deck === deck) return `<a href="#${label.slide.place}">${shown}</a>`;
  return paged
    ? `<span class="ref">${shown}</span>`
    : `<a href="${label.deck.name}.html#${label.slide.place}">${shown}</a>`;
}
