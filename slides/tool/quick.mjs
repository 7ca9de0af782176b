// Runs every command in its quick form: it must succeed and produce what figures and numbers need.
// A quick run has fewer points, so rows and pictures are matched by their names only, without the
// numbers in these.

import { commandsOf, numberOf, plots, seriesOf } from "./figures.mjs";
import { descriptions } from "./pictures.mjs";
import { UserError } from "./problems.mjs";

export async function runCommands(book, numbers, problems) {
  const all = [...book.definitions.figures.values(), ...book.definitions.numbers.values()].filter((wanted) =>
    numbers.includes(wanted.number),
  );
  await book.runs.prepare(all.flatMap(commandsOf).map(quick));
  for (const wanted of all) {
    try {
      runOne(wanted, book.runs);
    } catch (error) {
      if (!(error instanceof UserError)) throw error;
      problems.add(wanted.file, 0, `"${wanted.id}": ${error.message}`);
    }
  }
}

function runOne(wanted, runs) {
  if (wanted.kind === "image") {
    wanted.images.forEach(({ command }) => runs.image(quick(command)));
  } else if (wanted.kind === "picture") {
    findPictures(wanted, runs.page(quick(wanted.command)));
  } else if (plots.includes(wanted.kind)) {
    const series = wanted.series?.map((one) => ({ ...one, where: names(one.where) }));
    seriesOf({ ...wanted, series, where: names(wanted.where) }, runs.tables(quick(wanted.command)));
  } else if (!wanted.kind) {
    const over = wanted.over && { ...wanted.over, where: names(wanted.over.where) };
    const any = { ...wanted, over, where: names(wanted.where), any: true };
    numberOf(any, runs.tables(quick(wanted.command)));
  }
}

function findPictures({ alt }, page) {
  const plain = (text) => text.replace(/[0-9][0-9 \u00a0\u202f]*/g, "#");
  const all = descriptions(page).map(plain);
  const missing = [alt].flat().find((start) => !all.some((text) => text.startsWith(plain(start))));
  if (missing)
    throw new UserError(`the lab's page has no picture whose description starts with "${missing}"`);
}

/** The conditions on text, without those on numbers. */
function names(where) {
  const isNumber = (value) => [value].flat().every((one) => typeof one === "number");
  return where && Object.fromEntries(Object.entries(where).filter(([, value]) => !isNumber(value)));
}

/** The same command, as cheap as possible. */
function quick(command) {
  if (command[0] === "lab")
    return [...without(command, ["--n"]), ...(command.includes("--quick") ? [] : ["--quick"])];
  return [...without(command, ["--size", "--spp", "--seconds"]), "--size", "16x16", "--spp", "1"];
}

/** The command without these options and their values. */
const without = (command, options) =>
  command.filter((word, index) => !options.includes(word) && !options.includes(command[index - 1]));
