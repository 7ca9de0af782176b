// Parses decks: front matter, slides, titles, labels, notes. Does not interpret citations.

import fs from "node:fs";
import path from "node:path";

const deckFile = /^([0-9]{2})([a-z]?)_[a-z0-9_]+\.md$/;
const label = /^<!-- (eq|label): ([a-z0-9-]+) -->\s*$/;

/**
 * All decks of `folder`, in order. A deck split in two (08a, 08b) has one number and one set of labels.
 * @returns {Array<{file, name, id, number, front, slides}>}
 */
export function readDecks(root, problems) {
  const folder = path.join(root, "slides");
  const decks = [];
  for (const entry of fs.readdirSync(folder).sort()) {
    const match = deckFile.exec(entry);
    if (match) {
      decks.push(readDeck(path.join(folder, entry), `slides/${entry}`, match[1], match[2], problems));
    } else if (/^[0-9]/.test(entry)) {
      problems.add(`slides/${entry}`, 0, "a deck is named like 04_stratification.md");
    }
  }
  numberEquations(decks, problems);
  return decks;
}

function readDeck(absolute, file, number, part, problems) {
  const lines = fs.readFileSync(absolute, "utf8").split("\n");
  const { front, end } = frontMatter(lines, file, problems);
  const deck = { file, name: path.basename(file, ".md"), id: number + part, number, front, slides: [] };
  for (const slide of split(lines, end)) {
    deck.slides.push(readSlide(slide, deck, problems));
  }
  const titles = new Set();
  for (const slide of deck.slides) {
    if (!slide.title) problems.add(file, slide.line, "a slide needs a title: a line '# ...'");
    if (titles.has(slide.title)) problems.add(file, slide.line, `two slides are called "${slide.title}"`);
    titles.add(slide.title);
  }
  return deck;
}

function frontMatter(lines, file, problems) {
  const front = {};
  const end = lines.indexOf("---", 1);
  if (lines[0] !== "---" || end < 0) {
    problems.add(file, 1, "a deck starts with front matter between two lines '---'");
    return { front, end: 0 };
  }
  for (const line of lines.slice(1, end)) {
    const match = /^([a-z]+): (.+)$/.exec(line);
    if (match) front[match[1]] = match[2].replace(/^"(.*)"$/, "$1");
  }
  const expected = { marp: "true", theme: "carlo", math: "mathjax" };
  for (const [key, value] of Object.entries(expected)) {
    if (front[key] !== value) problems.add(file, 1, `front matter needs '${key}: ${value}'`);
  }
  if (!front.title) problems.add(file, 1, "front matter needs 'title: ...'");
  if (!/^[1-9][0-9]?$/.test(front.minutes ?? "")) {
    problems.add(file, 1, "front matter needs 'minutes: N', the time that the deck takes");
  }
  return { front, end: end + 1 };
}

/** Calls `visit(line, index, inFence)`; the lines that open and close a fence count as inside. */
export function walk(lines, visit) {
  let fence = "";
  lines.forEach((line, index) => {
    const mark = /^(```+|~~~+)/.exec(line)?.[1];
    if (!fence && mark) {
      fence = mark;
      visit(line, index, true);
    } else {
      visit(line, index, fence !== "");
      if (fence && line.trim() === fence) fence = "";
    }
  });
}

/** Splits at lines '---'; each piece has the number of its first line. */
function split(lines, start) {
  const slides = [{ line: start + 1, lines: [] }];
  walk(lines.slice(start), (line, index, inFence) => {
    if (line === "---" && !inFence) {
      slides.push({ line: start + index + 2, lines: [] });
    } else {
      slides.at(-1).lines.push(line);
    }
  });
  return slides;
}

function readSlide({ line, lines }, deck, problems) {
  const slide = { line, lines, title: "", classes: [], labels: [], notes: "" };
  const at = (index) => line + index;
  walk(lines, (text, index, inFence) => {
    if (inFence) return;
    if (!slide.title && /^# \S/.test(text)) slide.title = text.slice(2).trim();
    const classes = /^<!-- _class: ([a-z ]+) -->/.exec(text);
    if (classes) slide.classes = classes[1].split(" ");
    const found = label.exec(text);
    if (found) {
      slide.labels.push({ kind: found[1], name: found[2], line: at(index) });
      if (found[1] === "eq" && !lines[index + 1]?.startsWith("$$")) {
        problems.add(deck.file, at(index), "the line after '<!-- eq: ... -->' must start with $$");
      }
    } else if (/<!-- *(eq|label)\b/.test(text)) {
      problems.add(
        deck.file,
        at(index),
        `a label is written '<!-- eq: words-in-lower-case -->', got '${text}'`,
      );
    }
  });
  slide.notes = /<!-- notes:([\s\S]*?)-->/.exec(lines.join("\n"))?.[1].trim() ?? "";
  if (!slide.notes && !slide.classes.includes("title")) {
    problems.add(deck.file, line, `"${slide.title}" has no speaker notes: '<!-- notes: ... -->'`);
  }
  return slide;
}

/** Numbers each labelled equation, (4.1), (4.2), ..., and each slide. */
function numberEquations(decks, problems) {
  const last = {};
  const seen = new Map();
  for (const deck of decks) {
    deck.slides.forEach((slide, index) => {
      slide.place = index + 1;
      for (const label of slide.labels) {
        if (label.kind === "eq") {
          last[deck.number] = (last[deck.number] ?? 0) + 1;
          label.equation = `${Number(deck.number)}.${last[deck.number]}`;
        }
        label.deck = deck;
        label.slide = slide;
        const key = `${deck.number}:${label.name}`;
        if (seen.has(key))
          problems.add(deck.file, label.line, `the label ${key} stands also in ${seen.get(key)}`);
        seen.set(key, `${deck.file}:${label.line}`);
      }
    });
  }
}

/** Resolves "04:variance-of-strata" to its label. */
export function allLabels(decks) {
  const labels = new Map();
  for (const deck of decks) {
    for (const slide of deck.slides) {
      for (const label of slide.labels) labels.set(`${deck.number}:${label.name}`, label);
    }
  }
  return labels;
}
