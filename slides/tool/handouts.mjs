// Numbers in the labs' handouts: "handout" in slides/figures/NN.json lists phrases of
// labs/NN_*/README.md with names in place of numbers. With the commands' results filled in, each
// phrase must be in the handout.

import fs from "node:fs";
import path from "node:path";

import { numberText } from "./figures.mjs";
import { numberMark } from "./transform.mjs";

/** Collapses whitespace. */
const plain = (text) => text.replace(/[\s\u00a0\u202f]+/g, " ");

function handoutOf(root, number) {
  const folder = fs.readdirSync(path.join(root, "labs")).find((name) => name.startsWith(`${number}_`));
  const file = folder && `labs/${folder}/README.md`;
  return file && fs.existsSync(path.join(root, file)) ? file : null;
}

/** Checks that each phrase of each handout has the kept numbers; adds others to `problems`. */
export function checkHandouts(book, problems) {
  for (const { number, file, says } of book.definitions.handouts) {
    const handout = handoutOf(book.root, number);
    if (!handout) {
      problems.add(file, 0, `"handout": lab ${number} has no README.md`);
      continue;
    }
    const text = plain(fs.readFileSync(path.join(book.root, handout), "utf8"));
    if (!says.match(numberMark)) problems.add(file, 0, `"handout": no number {{...}} in "${says}"`);
    const filled = filledIn(book, says);
    if (filled && !text.includes(plain(filled)))
      problems.add(handout, 0, `does not say "${filled}", as the commands of ${file} do ("${says}")`);
  }
}

/** Returns the phrase with its numbers; null if one is missing, which checkPhrases reports. */
function filledIn(book, says) {
  let complete = true;
  const text = says.replace(numberMark, (_, key) => {
    const wanted = book.definitions.numbers.get(key);
    const kept = wanted && book.data.get(wanted.number)?.numbers?.[wanted.id];
    if (!kept) complete = false;
    return kept ? numberText(wanted, kept.value) : "";
  });
  return complete ? text : null;
}
