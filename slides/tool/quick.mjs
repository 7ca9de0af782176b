// Runs every command in its quick form: it must end well and give what figures and numbers take.

import { numberOf, plots, seriesOf } from "./figures.mjs";
import { pictureOf } from "./pictures.mjs";
import { UserError } from "./problems.mjs";

export function runCommands(book, numbers, problems) {
  for (const wanted of [...book.definitions.figures.values(), ...book.definitions.numbers.values()]) {
    if (!numbers.includes(wanted.number)) continue;
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
    const page = runs.page(quick(wanted.command));
    const missing = [wanted.alt].flat().find((alt) => !pictureOf(page, alt));
    if (missing) throw new UserError(`the lab's page has no picture whose description starts with "${missing}"`);
  } else if (plots.includes(wanted.kind)) {
    seriesOf(wanted, runs.tables(quick(wanted.command)));
  } else if (!wanted.kind) {
    numberOf(wanted, runs.tables(quick(wanted.command)));
  }
}

/** The same command, as cheap as it gets. */
function quick(command) {
  if (command[0] === "lab") return command.includes("--quick") ? command : [...command, "--quick"];
  const priced = ["--size", "--spp", "--seconds"];
  const kept = command.filter((word, index) => !priced.includes(word) && !priced.includes(command[index - 1]));
  return [...kept, "--size", "16x16", "--spp", "1"];
}
