// The program behind ./carlo slides.

import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { buildHtml, buildPdf, writeIndex, writeMarkdown } from "./build.mjs";
import { checkBook, checkSlides, readExercises } from "./checks.mjs";
import { allLabels, readDecks } from "./deck.mjs";
import { commandsOf, readData, readDefinitions, remake } from "./figures.mjs";
import { checkPictures, commandOf, labsWithPictures, writePicture } from "./lab_pictures.mjs";
import { checkOverflow } from "./overflow.mjs";
import { plotProgram } from "./plot.mjs";
import { Problems, UserError } from "./problems.mjs";
import { runCommands } from "./quick.mjs";
import { Runs, programOf } from "./runs.mjs";
import { writeTheme } from "./theme.mjs";
import { watch } from "./watch.mjs";

const root = path.resolve(fileURLToPath(new URL("../..", import.meta.url)));
const out = path.join(root, "out/slides");
const say = (text) => console.log(`carlo: ${text}`);

function readBook(programs) {
  const problems = new Problems();
  const decks = readDecks(root, problems);
  return {
    root,
    decks,
    problems,
    labels: allLabels(decks),
    definitions: readDefinitions(root, problems),
    data: readData(root, problems),
    exercises: readExercises(root),
    runs: new Runs(root, programs),
    used: { figures: new Set(), numbers: new Set(), snippets: new Set() },
  };
}

/** The requested decks, such as 4 or 08a; all if none were requested. */
function chosen(book, wanted) {
  const ids = wanted.map((word) => word.replace(/^[0-9](?![0-9])/, "0$&"));
  const has = (deck, id) => deck.id === id || deck.number === id;
  for (const id of ids) {
    if (!book.decks.some((deck) => has(deck, id))) {
      throw new UserError(
        `there is no deck ${id}; there are: ${book.decks.map((deck) => deck.id).join(" ")}`,
      );
    }
  }
  return book.decks.filter((deck) => !ids.length || ids.some((id) => has(deck, id)));
}

const numbersOf = (decks) => [...new Set(decks.map((deck) => deck.number))];

/** The labs of these decks: 08a and 08b share one. */
const picturesOf = (decks) => labsWithPictures(root, numbersOf(decks).map(Number));

function refuse(problems) {
  if (!problems.count) return;
  problems.print();
  throw new UserError(
    problems.count === 1
      ? "one thing is wrong with the slides"
      : `${problems.count} things are wrong with the slides`,
  );
}

/** Checks what must be right before these decks can be built. */
function refuseToBuild(book, decks) {
  checkSlides(book, decks, book.problems);
  const files = numbersOf(decks).flatMap((number) => [
    `slides/figures/${number}.json`,
    `slides/data/${number}.json`,
  ]);
  refuse(book.problems.of([...decks.map((deck) => deck.file), ...files]));
}

const isPicture = (one) => ["image", "picture"].includes(one.kind);

/** Prepares a build: the folder, the theme, and the pictures shown. */
async function prepare(book, decks) {
  fs.mkdirSync(out, { recursive: true });
  writeTheme(root);
  const numbers = numbersOf(decks);
  const seen = [...book.definitions.figures.values()].filter(
    (one) => numbers.includes(one.number) && isPicture(one),
  );
  await book.runs.prepare(seen.flatMap(commandsOf));
}

const modes = {
  /** Prints the programs that a mode starts, for ./carlo to build. */
  programs(book, decks, mode) {
    const numbers = numbersOf(decks);
    if (mode === "pictures") {
      console.log(picturesOf(decks).map((lab) => programOf(commandOf(lab))).join(" "));
      return;
    }
    const taken = {
      html: isPicture,
      pdf: isPicture,
      watch: isPicture,
      remake: (one) => !isPicture(one),
      run: () => true,
    }[mode];
    if (!taken) return;
    const wanted = [...book.definitions.figures.values(), ...book.definitions.numbers.values()];
    const drawing = ["html", "pdf", "watch"].includes(mode) ? [plotProgram] : [];
    const programs = wanted
      .filter((one) => numbers.includes(one.number) && taken(one))
      .flatMap(commandsOf)
      .map(programOf);
    console.log([...new Set([...drawing, ...programs])].filter(Boolean).join(" "));
  },

  check(book) {
    checkBook(book, book.problems);
    checkPictures(root, book.problems);
    refuse(book.problems);
    const minutes = book.decks.reduce((sum, deck) => sum + Number(deck.front.minutes), 0);
    say(
      `${book.decks.length} decks (${minutes} minutes), ${book.labels.size} labels, ` +
        `${book.definitions.figures.size} figures and ${book.definitions.numbers.size} numbers are right`,
    );
  },

  async run(book, decks) {
    checkBook(book, book.problems);
    await runCommands(book, numbersOf(decks), book.problems);
    refuse(book.problems);
    say("every command behind figures and numbers gives them");
  },

  remake(book, decks) {
    refuse(book.problems.of([...book.definitions.figures.values()].map((figure) => figure.file)));
    remake(root, book.definitions, book.runs, numbersOf(decks), (text) => say(`running ${text} ...`));
    say("made slides/data anew; git diff shows what has changed");
  },

  pictures(book, decks) {
    for (const lab of picturesOf(decks)) {
      say(`running ./carlo ${commandOf(lab).join(" ")} ...`);
      const file = writePicture(root, lab, book.runs.page(commandOf(lab)));
      say(`wrote ${path.relative(process.cwd(), file)}`);
    }
  },

  async html(book, decks) {
    refuseToBuild(book, decks);
    await prepare(book, decks);
    await buildHtml(decks, book, out);
    writeIndex(book, out);
    say(`wrote ${path.relative(process.cwd(), path.join(out, "index.html"))}`);
  },

  async pdf(book, decks) {
    refuseToBuild(book, decks);
    await prepare(book, decks);
    const problems = new Problems();
    const pages = async () => {
      await buildHtml(decks, book, out);
      await checkOverflow(decks, book, out, problems);
    };
    // In parallel, each to its end: one that is left running would write on.
    const ends = await Promise.allSettled([pages(), buildPdf(decks, book, out)]);
    for (const end of ends) if (end.status === "rejected") throw end.reason;
    writeIndex(book, out);
    refuse(problems);
    say(
      `wrote ${path.relative(process.cwd(), path.join(out, "index.html"))} and the decks beside it, HTML and PDF`,
    );
  },

  watch(first, decks, ids, programs) {
    const folder = path.join(root, "build/slides/decks");
    return watch(root, folder, out, () => {
      try {
        const book = readBook(programs);
        const decks = chosen(book, ids);
        refuseToBuild(book, decks);
        writeMarkdown(decks, book, false);
      } catch (error) {
        if (!(error instanceof UserError)) throw error;
        console.error(`carlo: ${error.message}`);
      }
    });
  },
};

/** slides.mjs MODE FOLDER_OF_PROGRAMS [DECK ...]; "programs" is followed by the mode. */
async function main([mode, programs, ...words]) {
  const book = readBook(programs);
  if (!book.decks.length) throw new UserError("there are no decks in slides/");
  const modeAsked = mode === "programs" ? words.shift() : "";
  const decks = chosen(book, words);
  await modes[mode](book, decks, modeAsked || words, programs);
}

main(process.argv.slice(2)).catch((error) => {
  if (!(error instanceof UserError)) throw error;
  console.error(`carlo: ${error.message}`);
  process.exitCode = 1;
});
