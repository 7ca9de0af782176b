// similarity.mjs PACKAGES WORK: compares what a class handed in, lab by lab, with Dolos (https://dolos.ugent.be).
// PACKAGES holds node_modules. WORK/task.json names labs, submissions and the code that everybody was given,
// WORK/of_NAME.json holds a submission's files; the result is WORK/result.json. The texts come from strangers:
// they are only parsed, within limits.
import { createRequire } from "node:module";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { tokensOf } from "./tokens.mjs";

const [packages, work] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(packages), "package.json"));
const load = (name) => import(pathToFileURL(require.resolve(name)));
const { FingerprintIndex, Region, TokenizedFile, File } = await load("@dodona/dolos-core");
const { Parser, Language } = await load("web-tree-sitter");
await Parser.init();
const cpp = await Language.load(require.resolve("tree-sitter-cpp/tree-sitter-cpp.wasm"));

const gram = 16, window = 6; // a match of gram + window - 1 tokens is always found
const limits = { characters: 200_000, tokens: 20_000, milliseconds: 5000, own: 30, repeats: 50_000,
  fragments: 12, lines: 60 };

const spent = () => process.cpuUsage().user / 1000;

/// Returns a text's syntax tree; throws a sentence.
function parsed(text) {
  if (text.length > limits.characters) throw `has more than ${limits.characters} characters`;
  if (text.includes("\0")) throw "is not text";
  // Of processor time, so that a busy machine gives the same result.
  const end = spent() + limits.milliseconds, parser = new Parser();
  try {
    parser.setLanguage(cpp);
    const tree = parser.parse(text, null, { progressCallback: () => spent() > end });
    if (!tree) throw "takes too long to parse";
    return tree;
  } finally {
    parser.delete();
  }
}

/// Returns a lab's files of one submission as one file for Dolos, whose rows count through all of them.
function tokenized(name, files) {
  const tokens = [], mapping = [], rows = [];
  let characters = 0, senseless = 0;
  for (const [file, text] of Object.entries(files)) {
    let found, tree;
    try {
      tree = parsed(text);
      found = tokensOf(tree.rootNode, limits.tokens);
    } catch (error) {
      throw `${file} ${typeof error === "string" ? error : "cannot be parsed"}`;
    } finally {
      tree?.delete();
    }
    tokens.push(...found.tokens);
    if (tokens.length > limits.tokens) throw `has more than ${limits.tokens} tokens`;
    for (const { row, column } of found.places)
      mapping.push(new Region(rows.length + row, column, rows.length + row, column));
    text.split("\n").forEach((line, i) => rows.push({ file, row: i + 1, text: line }));
    [characters, senseless] = [characters + text.length, senseless + found.senseless];
  }
  if (senseless > characters / 2) throw "is no C++ for the most part";
  return Object.assign(new TokenizedFile(new File(name, ""), tokens, mapping), { rows });
}

/// Returns how often a file has each of these fingerprints, each count to some power, summed up.
const sumOf = (fingerprints, file, power) =>
  [...fingerprints].reduce((sum, one) => sum + one.occurrencesOf(file).length ** power, 0);
const percent = (share) => `${Math.round(100 * share)} %`;

const by_name = (a, b) => (a < b ? -1 : a > b ? 1 : 0);

/// Returns a text's beginning without the signs that would turn its direction; never half a character.
const shown = (text) => Array.from(text.slice(0, 400)).slice(0, 160).join("").replace(/[\u202a-\u202e\u2066-\u2069]/g, "?");

/// Returns the largest matching fragments that add something, as lines side by side.
function fragmentsOf(pair) {
  const lines = ({ rows }, { startRow, endRow }) => rows.slice(startRow, endRow + 1);
  const seen = [new Set(), new Set()];
  // Equally large ones in the order of the files.
  const order = (a, b) => b.pairs.length - a.pairs.length || a.leftSelection.startRow - b.leftSelection.startRow ||
    a.rightSelection.startRow - b.rightSelection.startRow;
  const all = pair.buildFragments().sort(order).map((fragment) =>
    [lines(pair.leftFile, fragment.leftSelection), lines(pair.rightFile, fragment.rightSelection)]);
  const list = all.filter((sides) => {
    const fresh = sides.map((side, i) => side.filter((line) => !seen[i].has(line)));
    fresh.forEach((side, i) => side.forEach((line) => seen[i].add(line)));
    return fresh.every((side) => side.length > 1);
  });
  const cut = (side) => side.slice(0, limits.lines).map((line) => ({ ...line, text: shown(line.text) }));
  return list.slice(0, limits.fragments).map(([left, right]) => ({ left: cut(left), right: cut(right),
    more: Math.max(left.length, right.length, limits.lines) - limits.lines }));
}

function compare(lab, submissions) {
  const index = new FingerprintIndex(gram, window);
  const left_out = [], files = [];
  for (const name of submissions) {
    try {
      const file = path.join(work, `of_${name}.json`);
      if (!fs.existsSync(file)) throw "could not be read";
      const { files: texts, refused } = JSON.parse(fs.readFileSync(file, "utf8"))[lab.folder];
      if (refused) throw "was refused: its report says why";
      if (Object.keys(texts).length === 0) throw "was not handed in";
      files.push(tokenized(name, texts));
    } catch (error) {
      left_out.push({ name, why: typeof error === "string" ? error : "could not be read" });
    }
  }
  index.addFiles(files);
  // Afterwards, because Dolos marks only what is in the index already. The stub first, so that what is marked
  // then is its code, and what is added later is in the solution alone.
  const entries_of_all = index.entries(), stubs = new Map();
  lab.given.forEach((texts, i) => {
    index.addIgnoredFile(tokenized(`given ${i}`, texts));
    if (i === 0) entries_of_all.forEach((entry) => stubs.set(entry.file, sumOf(entry.ignored, entry.file, 1)));
  });
  const own = new Map();
  for (const entry of index.entries()) {
    const all = entry.kgrams.length, given = sumOf(entry.ignored, entry.file, 1), name = entry.file.path;
    if (sumOf(entry.shared, entry.file, 2) > limits.repeats) left_out.push({ name, why: "repeats itself too often" });
    else if (all - given >= limits.own) own.set(entry.file, all - given);
    else left_out.push({ name, why: all === 0 ? "holds too little code" :
      `has too little of its own: ${percent(stubs.get(entry.file) / all)} is the stub's code, ` +
      `${percent((given - stubs.get(entry.file)) / all)} the solution's` });
  }
  left_out.sort((a, b) => by_name(a.name, b.name));
  const pairs = [], entries = [...own.keys()];
  entries.forEach((first, i) => entries.slice(i + 1).forEach((second) => {
    const pair = index.getPair(first, second);
    pairs.push({ first: first.path, second: second.path, overlap: pair.overlap, longest: pair.longest,
      similarity: pair.overlap / (own.get(first) + own.get(second)), files: [first, second] });
  }));
  pairs.sort((a, b) => b.similarity - a.similarity || b.longest - a.longest || b.overlap - a.overlap ||
    by_name(a.first, b.first) || by_name(a.second, b.second));
  return { folder: lab.folder, compared: entries.map((file) => file.path), left_out,
    pairs: pairs.map(({ files: two, ...row }, i) =>
      i < most_pairs ? { ...row, fragments: fragmentsOf(index.getPair(...two)) } : row) };
}

const { labs, submissions, most_pairs } = JSON.parse(fs.readFileSync(path.join(work, "task.json"), "utf8"));
const result = { gram, window, labs: labs.map((lab) => compare(lab, submissions)) };
fs.writeFileSync(path.join(work, "result.json"), JSON.stringify(result));
