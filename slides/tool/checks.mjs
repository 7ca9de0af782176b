// All checks that neither run nor install anything: labels, citations both ways, snippets, figures,
// numbers, the lecture's headings.

import fs from "node:fs";
import path from "node:path";

import { plots, recipe } from "./figures.mjs";
import { checkHandouts } from "./handouts.mjs";
import { markers, readSnippet, sources } from "./snippets.mjs";
import { figureLine, numberMark, reference, snippetFence } from "./transform.mjs";
import { walk } from "./deck.mjs";

export function checkBook(book, problems) {
  checkSlides(book, book.decks, problems);
  checkPhrases(book, problems);
  checkUse(book, problems);
  checkCitations(book, problems);
  checkDurations(book, problems);
  checkLecture(book, problems);
}

/** Everything that a slide refers to must exist. */
export function checkSlides(book, decks, problems) {
  for (const deck of decks) {
    for (const slide of deck.slides) {
      walk(slide.lines, (line, index, inFence) => {
        const wrong = (text) => problems.add(deck.file, slide.line + index, text);
        const snippet = snippetFence.exec(line);
        if (snippet) checkSnippet(book, snippet[2], slide.lines[index + 1], wrong);
        else if (/^```.*snippet/.test(line))
          wrong("a snippet's fence is written '```cpp snippet=common/file.h#name'");
        if (!inFence) checkLine(book, line, wrong);
      });
      checkNow(book, deck, slide, problems);
    }
  }
}

function checkSnippet(book, name, next, wrong) {
  const { error } = readSnippet(book.root, name);
  if (error) wrong(error);
  if (next !== "```") wrong("a snippet's fence is empty: the tool fills it");
  book.used.snippets.add(name);
}

/** Numbers of phrases in handouts must exist, and the handouts must contain the phrases. */
function checkPhrases(book, problems) {
  for (const { file, says } of book.definitions.handouts)
    checkNumbers(book, says, (text) => problems.add(file, 0, text));
  checkHandouts(book, problems);
}

function checkLine(book, line, wrong) {
  const figure = figureLine.exec(line);
  if (figure) checkFigure(book, figure[2], wrong);
  else if (line.includes("](figure:"))
    wrong("a figure stands on a line of its own: ![what one sees](figure:04-slopes)");
  else if (/!\[[^\]]*\]\(/.test(line))
    wrong("pictures are figures made by a command: ![...](figure:04-slopes)");
  checkNumbers(book, line, wrong);
  for (const [, , number, name] of line.matchAll(reference)) {
    if (!book.labels.has(`${number}:${name}`)) wrong(`no deck ${number} has the label '${name}'`);
  }
}

function checkNumbers(book, line, wrong) {
  for (const [, key] of line.matchAll(numberMark)) {
    const wanted = book.definitions.numbers.get(key);
    book.used.numbers.add(key);
    if (!wanted) {
      wrong(`there is no number {{${key}}} in slides/figures/${key.slice(0, 2)}.json`);
    } else {
      checkKept(wanted, book.data.get(wanted.number)?.numbers?.[wanted.id], "number", wrong);
    }
  }
}

function checkFigure(book, id, wrong) {
  book.used.figures.add(id);
  const definition = book.definitions.figures.get(id);
  if (!definition) {
    wrong(`there is no figure "${id}" in slides/figures/${id.slice(0, 2)}.json`);
  } else if (plots.includes(definition.kind)) {
    checkKept(definition, book.data.get(definition.number)?.figures?.[id], "figure", wrong);
  }
}

function checkKept(wanted, kept, what, wrong) {
  const again = `./carlo slides --remake ${wanted.number}`;
  if (!kept) wrong(`${what} "${wanted.id}" has no data yet: ${again}`);
  else if (kept.recipe !== recipe(wanted))
    wrong(`${what} "${wanted.id}" was made by another command: ${again}`);
}

/** "Now do Lab 4.2": the exercise must exist. */
function checkNow(book, deck, slide, problems) {
  if (!slide.classes.includes("now")) return;
  const tags = [...slide.title.matchAll(/\b([1-9][0-9]?\.[0-9]+)\b/g)].map((match) => `Lab ${match[1]}`);
  if (!/^Now do Lab [0-9]/.test(slide.title) || !tags.length) {
    problems.add(deck.file, slide.line, `a 'now' slide is called '# Now do Lab N.M', got "${slide.title}"`);
  }
  for (const tag of tags) {
    if (!book.exercises.some((exercise) => exercise.tag === tag))
      problems.add(deck.file, slide.line, `there is no exercise ${tag}`);
  }
}

/** Definitions must be used: figures, numbers, the markers in sources. */
function checkUse(book, problems) {
  for (const [id, { file }] of book.definitions.figures) {
    if (!book.used.figures.has(id)) problems.add(file, 0, `figure "${id}" is on no slide`);
  }
  for (const [key, { file }] of book.definitions.numbers) {
    if (!book.used.numbers.has(key)) problems.add(file, 0, `number "${key}" is on no slide and in no handout`);
  }
  for (const { reference, file, line } of markers(book.root)) {
    if (!book.used.snippets.has(reference))
      problems.add(file, line, `the snippet ${reference} is on no slide`);
  }
}

/** Labs must cite existing labels; each label must be cited by its lab; each exercise must cite one. */
function checkCitations(book, problems) {
  const cited = new Set();
  const byExercise = new Set();
  for (const file of sources(book.root)) {
    const text = fs.readFileSync(path.join(book.root, file), "utf8");
    for (const { paragraph, line } of paragraphs(text)) {
      for (const match of paragraph.matchAll(/\bslides\s+(?:[/*#]*\s*)?([0-9]{2}):([a-z0-9-]*[a-z0-9])/g)) {
        const key = `${match[1]}:${match[2]}`;
        const at = line + paragraph.slice(0, match.index).split("\n").length - 1;
        if (!book.labels.has(key)) problems.add(file, at, `cites slides ${key}, a label that no deck has`);
        cited.add(`${/^labs\/([0-9]{2})/.exec(file)?.[1]} ${key}`);
        // A lab.json is one paragraph; its hints are checked one by one below.
        if (file.endsWith(".json")) continue;
        for (const [tag] of paragraph.matchAll(/Lab [0-9]+\.[0-9]+/g)) byExercise.add(tag);
      }
    }
  }
  for (const [key, label] of book.labels) {
    const lab = label.deck.front.lab;
    if (lab && !cited.has(`${lab.padStart(2, "0")} ${key}`)) {
      problems.add(
        label.deck.file,
        label.line,
        `nothing in labs/${lab.padStart(2, "0")}_* cites slides ${key}`,
      );
    }
  }
  const covered = new Set(
    book.decks
      .map((deck) => deck.front.lab)
      .filter(Boolean)
      .map(Number),
  );
  for (const { tag, file, hints, lab } of book.exercises) {
    const own = hints.some((hint) => /\bslides [0-9]{2}:[a-z0-9-]+/.test(hint));
    if (covered.has(lab) && !own && !byExercise.has(tag)) {
      problems.add(
        file,
        0,
        `${tag} cites no slide: 'slides ${String(lab).padStart(2, "0")}:LABEL' in a hint, ` +
          "or in a paragraph of the handout or the sources that names it",
      );
    }
  }
}

/** Splits text into runs of lines without a blank line. */
function paragraphs(text) {
  const found = [];
  let start = 0;
  const lines = text.split("\n");
  for (let i = 0; i <= lines.length; ++i) {
    if (i < lines.length && lines[i].trim()) continue;
    if (i > start) found.push({ paragraph: lines.slice(start, i).join("\n"), line: start + 1 });
    start = i + 1;
  }
  return found;
}

/** Each slide takes one to four minutes. */
function checkDurations(book, problems) {
  for (const deck of book.decks) {
    const each = Number(deck.front.minutes) / deck.slides.length;
    if (each < 1 || each > 4) {
      problems.add(
        deck.file,
        0,
        `${deck.front.minutes} minutes for ${deck.slides.length} slides; a slide takes 1 to 4`,
      );
    }
  }
}

/** slides/lecture.md: slides in its rows '| heading | deck | slide |' must exist. */
function checkLecture(book, problems) {
  const file = "slides/lecture.md";
  const absolute = path.join(book.root, file);
  if (!fs.existsSync(absolute))
    return problems.add(file, 0, "is missing: which slide covers which heading of the lecture");
  fs.readFileSync(absolute, "utf8")
    .split("\n")
    .forEach((line, index) => {
      const row = /^\| (.+?) \| ([0-9]{2}) \| (.+?) \|$/.exec(line);
      if (!row) {
        if (/^\|/.test(line) && !/^\| ?(-|Heading)/.test(line))
          problems.add(file, index + 1, "a row is written '| heading | 04 | slide |'");
        return;
      }
      const decks = book.decks.filter((deck) => deck.number === row[2]);
      if (!decks.length) problems.add(file, index + 1, `there is no deck ${row[2]}`);
      for (const title of row[3].split("; ")) {
        if (decks.length && !decks.some((deck) => deck.slides.some((slide) => slide.title === title))) {
          problems.add(file, index + 1, `deck ${row[2]} has no slide "${title}"`);
        }
      }
    });
}

/** Lists all exercises of the labs: [{tag, file, hints, lab}]. */
export function readExercises(root) {
  const labs = fs
    .readdirSync(path.join(root, "labs"))
    .sort()
    .map((name) => `labs/${name}/lab.json`);
  return labs
    .filter((file) => fs.existsSync(path.join(root, file)))
    .flatMap((file) => {
      const { lab, exercises } = JSON.parse(fs.readFileSync(path.join(root, file), "utf8"));
      return exercises.map(({ tag, hints }) => ({ tag, file, hints, lab }));
    });
}
