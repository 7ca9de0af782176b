// Definitions of figures and numbers (slides/figures/NN.json) and their data (slides/data/NN.json).

import crypto from "node:crypto";
import fs from "node:fs";
import path from "node:path";

import { UserError } from "./problems.mjs";
import { programOf, spoken } from "./runs.mjs";

export const plots = ["loglog", "lines", "points", "bars"];
const kinds = [...plots, "image", "picture", "drawing", "functions"];
const scales = ["log", "linear"];
const units = ["number", "count", "seconds", "degrees"];
const axes = { xscale: scales, yscale: scales, xunit: units, yunit: units };
const digits = 4; // of every kept point,
const numberDigits = 6; // and of every number, which texts round again

/** {figures: Map(id -> definition), numbers: Map("04.slope.jittered" -> definition), handouts: [{says}]}. */
export function readDefinitions(root, problems) {
  const figures = new Map();
  const numbers = new Map();
  const handouts = [];
  for (const [number, file, content] of jsonFiles(root, "figures", problems)) {
    const command = (words) => (typeof words === "string" ? content.commands?.[words] : words);
    for (const [id, given] of Object.entries(content.figures ?? {})) {
      const figure = { ...given, id, number, file, command: command(given.command) };
      figure.images = given.images?.map((image) => ({ ...image, command: command(image.command) }));
      checkFigure(root, figure, problems);
      figures.set(id, figure);
    }
    for (const [id, given] of Object.entries(content.numbers ?? {})) {
      const wanted = { ...given, id, number, file, command: command(given.command) };
      checkNumber(wanted, problems);
      numbers.set(`${number}.${id}`, wanted);
    }
    for (const says of content.handout ?? []) handouts.push({ number, file, says: String(says) });
  }
  return { figures, numbers, handouts };
}

function* jsonFiles(root, folder, problems) {
  const absolute = path.join(root, "slides", folder);
  if (!fs.existsSync(absolute)) return;
  for (const entry of fs.readdirSync(absolute).sort()) {
    const number = /^([0-9]{2})\.json$/.exec(entry)?.[1];
    if (!number) continue;
    const file = `slides/${folder}/${entry}`;
    try {
      yield [number, file, JSON.parse(fs.readFileSync(path.join(absolute, entry), "utf8"))];
    } catch (error) {
      problems.add(file, 0, `is no JSON: ${error.message}`);
    }
  }
}

function checkFigure(root, figure, problems) {
  const wrong = (text) => problems.add(figure.file, 0, `figure "${figure.id}": ${text}`);
  if (!figure.id.startsWith(`${figure.number}-`)) wrong(`its name must start with ${figure.number}-`);
  if (!kinds.includes(figure.kind))
    return wrong(`kind must be one of ${kinds.join(", ")}, got '${figure.kind}'`);
  if (plots.includes(figure.kind) && !figure.series) {
    for (const key of ["table", "x", "y"]) if (!figure[key]) wrong(`needs "${key}"`);
  }
  for (const [key, known] of Object.entries(axes)) {
    if (figure[key] && !known.includes(figure[key]))
      wrong(`${key} must be one of ${known.join(", ")}, got '${figure[key]}'`);
  }
  if (figure.kind === "picture" && !figure.alt) wrong('needs "alt": how the picture\'s description starts');
  if (figure.kind === "functions" && !(figure.functions?.length && figure.x?.length === 2)) {
    wrong('needs "x": [from, to] and "functions": [{"name", "js"}]');
  }
  if (
    figure.kind === "drawing" &&
    !fs.existsSync(path.join(root, "slides/figures", figure.drawing ?? ""))
  ) {
    wrong(`"drawing" must name an SVG file of slides/figures, got '${figure.drawing}'`);
  }
  if (figure.kind === "image" && !figure.images?.length) wrong('needs "images": [{"command", "caption"}]');
  for (const command of commandsOf(figure)) {
    if (!programOf(command)) wrong(badCommand(command));
  }
  if ([...plots, "picture"].includes(figure.kind) && figure.command === undefined) wrong('needs "command"');
}

function checkNumber(wanted, problems) {
  const wrong = (text) => problems.add(wanted.file, 0, `number "${wanted.id}": ${text}`);
  if (!/^[a-z0-9.-]+$/.test(wanted.id)) wrong("its name has letters a to z, digits, dots and dashes only");
  for (const key of ["table", "column"]) if (!wanted[key]) wrong(`needs "${key}"`);
  if (wanted.format && !formats[wanted.format])
    wrong(`format must be one of ${Object.keys(formats).join(", ")}, got '${wanted.format}'`);
  if (!programOf(wanted.command)) wrong(badCommand(wanted.command));
}

const badCommand = (command) =>
  `a command is ["lab", "4", "--solutions", ...] or ["render", ...], or the name of one under "commands", ` +
  `got ${JSON.stringify(command)}`;

/** Returns the commands that a figure or number needs. */
export const commandsOf = (wanted) =>
  wanted.images
    ? wanted.images.map((image) => image.command)
    : wanted.command !== undefined
      ? [wanted.command]
      : [];

/** The kept data depends on these fields; how it is drawn does not matter. */
export function recipe(wanted) {
  const { command, table, x, y, by, where, series, slopes, column, over } = wanted;
  const text = JSON.stringify({ command, table, x, y, by, where, series, slopes, column, over });
  return crypto.createHash("sha256").update(text).digest("hex").slice(0, 8);
}

const rounded = (value, kept = digits) =>
  typeof value === "number" ? Number(value.toPrecision(kept)) : value;

/** Rounds numbers to six digits: a float of a lab is 0.00100000005. */
const same = (one, other) =>
  one === other ||
  (typeof one === "number" && typeof other === "number" && one.toPrecision(6) === other.toPrecision(6));

function rowsOf(tables, { table, where }) {
  if (!tables[table]) {
    throw new UserError(`the run has no table "${table}"; it has ${Object.keys(tables).join(", ")}`);
  }
  const wanted = Object.entries(where ?? {});
  const rows = tables[table].filter((row) =>
    wanted.every(([key, value]) => [value].flat().some((one) => same(one, row[key]))),
  );
  if (rows.length === 0) throw new UserError(`table "${table}" has no row where ${JSON.stringify(where)}`);
  return rows;
}

function valueOf(row, column, table) {
  if (!(column in row)) {
    throw new UserError(
      `table "${table}" has no column "${column}"; it has ${Object.keys(row).join(", ")}`,
    );
  }
  return row[column];
}

/** Extracts a plot's points from a run's tables: [{name, points: [[x, y], ...], slope}]. Throws UserError. */
export function seriesOf(figure, tables) {
  if (figure.series) {
    return figure.series.flatMap((one) =>
      seriesOf({ ...figure, ...one, series: undefined }, tables).map((found) => ({
        ...found,
        name: one.name ?? found.name,
      })),
    );
  }
  const found = new Map();
  for (const row of rowsOf(tables, figure)) {
    const name = figure.by ? String(valueOf(row, figure.by, figure.table)) : "";
    if (!found.has(name)) found.set(name, []);
    found.get(name).push([figure.x, figure.y].map((key) => rounded(valueOf(row, key, figure.table))));
  }
  return [...found].map(([name, points]) => {
    if (!points.some(([, y]) => Number.isFinite(y)))
      throw new UserError(`"${figure.y}" of "${name}" is never a number`);
    return { name, points, ...slopeOf(figure, name, tables) };
  });
}

function slopeOf({ slopes, by, where }, name, tables) {
  if (!slopes) return {};
  const row = rowsOf(tables, { table: slopes.table, where: by ? { [slopes.key ?? by]: name } : where })[0];
  return { slope: rounded(valueOf(row, slopes.column, slopes.table)) };
}

/**
 * Extracts a number from a run's tables, divided by that of `wanted.over` if present. With
 * `wanted.any`, from the first of several rows, number or not. Throws UserError.
 */
export function numberOf(wanted, tables) {
  if (!wanted.over) return rounded(cellOf(wanted, tables), numberDigits);
  const { over, ...above } = wanted;
  const value = cellOf(above, tables) / cellOf({ ...above, ...over }, tables);
  if (!Number.isFinite(value) && !wanted.any)
    throw new UserError(`the quotient is ${value}, expected a number`);
  return rounded(value, numberDigits);
}

function cellOf(wanted, tables) {
  const rows = rowsOf(tables, wanted);
  if (rows.length !== 1 && !wanted.any) {
    throw new UserError(
      `table "${wanted.table}" has ${rows.length} rows where ${JSON.stringify(wanted.where)}, expected one`,
    );
  }
  const value = valueOf(rows[0], wanted.column, wanted.table);
  if (!Number.isFinite(value) && !wanted.any)
    throw new UserError(`column "${wanted.column}" is ${JSON.stringify(value)}, expected a number`);
  return value;
}

const formats = { percent: [100, " %"], ns: [1e9, ""] }; // factor, unit

/** Formats a slide's number: three digits unless "digits" says otherwise, in the unit of "format". */
export function numberText(wanted, value) {
  const [factor, unit] = formats[wanted.format] ?? [1, ""];
  const scaled = factor * value;
  let text = scaled.toPrecision(wanted.digits ?? 3);
  if (text.includes("e")) {
    const size = Math.abs(scaled);
    if (size >= 1e-3 && size < 1e15) text = String(Number(text));
  }
  const thousands = /^-?[0-9]{5,}$/.test(text) ? text.replace(/\B(?=([0-9]{3})+$)/g, "\u202f") : text;
  return thousands.replace("-", "−") + unit;
}

/** Returns {figures: {id: {recipe, series}}, numbers: {id: {recipe, value}}} of all decks, by deck number. */
export function readData(root, problems) {
  const data = new Map();
  for (const [number, file, content] of jsonFiles(root, "data", problems))
    data.set(number, { file, ...content });
  return data;
}

/** Reruns the commands of these decks' numbers and writes slides/data/NN.json. */
export function remake(root, definitions, runs, numbers, say) {
  const wantedBy = new Map();
  const add = (wanted, group) => {
    if (!numbers.includes(wanted.number)) return;
    if (!wantedBy.has(wanted.number)) wantedBy.set(wanted.number, { figures: [], numbers: [] });
    wantedBy.get(wanted.number)[group].push(wanted);
  };
  for (const figure of definitions.figures.values())
    if (plots.includes(figure.kind)) add(figure, "figures");
  for (const wanted of definitions.numbers.values()) add(wanted, "numbers");
  const done = new Set();
  const tables = (wanted) => {
    const fresh = !done.has(spoken(wanted.command));
    if (fresh) say(spoken(wanted.command));
    done.add(spoken(wanted.command));
    return runs.tables(wanted.command, { fresh });
  };
  for (const [number, wanted] of wantedBy) {
    const data = { figures: {}, numbers: {} };
    for (const figure of wanted.figures) {
      data.figures[figure.id] = {
        recipe: recipe(figure),
        series: extracted(figure, () => seriesOf(figure, tables(figure))),
      };
    }
    for (const one of wanted.numbers) {
      data.numbers[one.id] = {
        recipe: recipe(one),
        value: extracted(one, () => numberOf(one, tables(one))),
      };
    }
    fs.mkdirSync(path.join(root, "slides/data"), { recursive: true });
    fs.writeFileSync(path.join(root, `slides/data/${number}.json`), pretty(data));
  }
}

/** Runs work(), adding the figure's or number's name to its errors. */
function extracted(wanted, work) {
  try {
    return work();
  } catch (error) {
    if (error instanceof UserError) error.message = `${wanted.file}: "${wanted.id}": ${error.message}`;
    throw error;
  }
}

/** Writes JSON with a line for each series and number, so that a diff shows which has changed. */
function pretty(data) {
  const object = (entries, indent) =>
    entries.length === 0
      ? "{}"
      : `{\n${entries.map(([key, text]) => `${indent}  ${JSON.stringify(key)}: ${text}`).join(",\n")}\n${indent}}`;
  const figures = Object.entries(data.figures).map(([id, { recipe, series }]) => [
    id,
    `{\n      "recipe": "${recipe}",\n      "series": [\n        ` +
      `${series.map((one) => JSON.stringify(one)).join(",\n        ")}\n      ]\n    }`,
  ]);
  const numbers = Object.entries(data.numbers).map(([id, one]) => [id, JSON.stringify(one)]);
  return (
    object(
      [
        ["figures", object(figures, "  ")],
        ["numbers", object(numbers, "  ")],
      ],
      "",
    ) + "\n"
  );
}
