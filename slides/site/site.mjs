// The program behind ./carlo site: node site.mjs FOLDER_OF_PROGRAMS OUT. Builds the WebAssembly module and writes the
// pages.

import { execFileSync, spawnSync } from "node:child_process";
import crypto from "node:crypto";
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { allLabels, readDecks } from "../tool/deck.mjs";
import { readData, readDefinitions } from "../tool/figures.mjs";
import { Problems, UserError } from "../tool/problems.mjs";
import { Runs } from "../tool/runs.mjs";
import { gallery } from "./gallery.mjs";
import { formulasOf, glossaryOf, textOf, typesetter } from "./handout.mjs";
import { frontPage, labPage, textPage } from "./pages.mjs";

const root = path.resolve(fileURLToPath(new URL("../..", import.meta.url)));
const here = path.join(root, "slides/site");
const say = (text) => console.log(`carlo: ${text}`);

function run(program, words, options = {}) {
  const { status, stdout, stderr, error } = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 26, ...options });
  if (error) throw new UserError(`${program}: ${error.message}`);
  if (status !== 0) throw new UserError(`${program} failed:\n${stdout}${stderr}`);
  return stdout;
}

/** Builds build/site/carlo.js, the module. */
function buildModule() {
  const folder = path.join(root, "build/site");
  // Debian's Emscripten looks for its optimiser's packages where Debian's node does.
  const env = { ...process.env, NODE_PATH: "/usr/share/nodejs" };
  // What was compiled before, in any tree.
  if (spawnSync("ccache", ["--version"]).status === 0) Object.assign(env, { EM_COMPILER_WRAPPER: "ccache", CCACHE_BASEDIR: root });
  fs.mkdirSync(folder, { recursive: true });
  say("building the WebAssembly module ...");
  if (!fs.existsSync(path.join(folder, "build.ninja"))) run("emcmake", ["cmake", "-G", "Ninja", "-S", here, "-B", folder], { env });
  run("ninja", ["-C", folder], { env });
  return path.join(folder, "carlo.js");
}

/** Copies the labs' decks that are built, without links to those that are not; large data goes into files that all share. */
function copyDecks(book, labs, out) {
  const from = path.join(root, "out/slides"), to = path.join(out, "slides");
  const names = book.decks
    .filter((deck) => labs.some((lab) => lab.digits === deck.number))
    .map((deck) => `${deck.name}.html`)
    .filter((name) => fs.existsSync(path.join(from, name)));
  if (names.length) fs.mkdirSync(path.join(to, "data"), { recursive: true });
  for (const name of names) {
    const html = fs.readFileSync(path.join(from, name), "utf8")
      .replace(/data:(?:image|font)\/([a-z0-9]+);base64,([A-Za-z0-9+/=]{3000,})/g, (_, kind, text) => {
        const bytes = Buffer.from(text, "base64");
        const file = `data/${crypto.createHash("sha256").update(bytes).digest("hex").slice(0, 16)}.${kind}`;
        fs.writeFileSync(path.join(to, file), bytes);
        return file;
      })
      .replace(/<a href="([^"#:]+\.html)#[^"]*">(.*?)<\/a>/g, (link, deck, words) => (names.includes(deck) ? link : words));
    fs.writeFileSync(path.join(to, name), html);
  }
  return new Set(names);
}

/** KaTeX's style sheet and its fonts, those for browsers of today. */
function copyKatex(folder, out) {
  fs.mkdirSync(path.join(out, "fonts"), { recursive: true });
  for (const name of fs.readdirSync(path.join(folder, "fonts")))
    if (name.endsWith(".woff2")) fs.copyFileSync(path.join(folder, "fonts", name), path.join(out, "fonts", name));
  return fs.readFileSync(path.join(folder, "katex.min.css"), "utf8");
}

function readBook(programs) {
  const problems = new Problems();
  const decks = readDecks(root, problems);
  const book = { root, decks, labels: allLabels(decks), definitions: readDefinitions(root, problems),
                 data: readData(root, problems), runs: new Runs(root, programs) };
  if (problems.count) problems.print();
  if (problems.count) throw new UserError("the slides have problems: ./carlo slides --check");
  return book;
}

function labsOf() {
  const folders = fs.readdirSync(path.join(root, "labs")).filter((name) => fs.existsSync(path.join(root, "labs", name, "lab.json")));
  return folders.sort().map((folder) => {
    const json = JSON.parse(fs.readFileSync(path.join(root, "labs", folder, "lab.json"), "utf8"));
    const picture = ["picture.png", "picture.jpg"].find((name) => fs.existsSync(path.join(root, "labs", folder, name)));
    const live = fs.existsSync(path.join(here, `web/lab${json.lab}.js`));
    return { folder, number: json.lab, digits: folder.slice(0, 2), title: json.title, picture, alt: json.picture?.alt ?? "",
             page: `lab${folder.slice(0, 2)}.html`, live };
  });
}

function size(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).reduce((sum, entry) =>
    sum + (entry.isDirectory() ? size(path.join(folder, entry.name)) : fs.statSync(path.join(folder, entry.name)).size), 0);
}

/** Where the repository is, if git or GitHub says so, and which commit this is. */
function sourceOf() {
  const git = (...words) => spawnSync("git", ["-C", root, ...words], { encoding: "utf8" }).stdout?.trim() ?? "";
  const { GITHUB_SERVER_URL: server, GITHUB_REPOSITORY: name } = process.env;
  const address = server && name ? `${server}/${name}` : git("remote", "get-url", "origin").replace(/\.git$/, "");
  return { address: /^https:\/\/[^@]+$/.test(address) ? address : "", commit: git("log", "-1", "--format=%h of %cs") +
    (git("status", "--porcelain") && ", with changes") };
}

function main([programs, out]) {
  const start = Date.now();
  const module = buildModule();
  // Only what an earlier run has written is removed.
  if (fs.existsSync(out) && fs.readdirSync(out).length && !fs.existsSync(path.join(out, "carlo.js")))
    throw new UserError(`${out} holds other files than a site: give another folder, or empty it`);
  fs.rmSync(out, { recursive: true, force: true });
  fs.mkdirSync(out, { recursive: true });
  const book = readBook(programs), labs = labsOf(), tools = typesetter(root);
  const pageOf = (deck) => labs.find((lab) => lab.digits === deck.number)?.page;
  const formulas = formulasOf(book, tools, pageOf);
  const pages = (file) => labs.find((lab) => file === `labs/${lab.folder}/README.md`)?.page ??
    { "tests/INSTRUCTORS.md": "instructors.html", "labs/README.md": "students.html", "labs/glossary.md": "glossary.html" }[file];
  const write = (name, text) => fs.writeFileSync(path.join(out, name), text);

  say("writing the pages ...");
  const styles = ["common/course/report/web/page.css", "slides/site/web/site.css"].map((file) => fs.readFileSync(path.join(root, file), "utf8"));
  write("site.css", [copyKatex(tools.katexFolder, out), ...styles].join("\n"));
  write("carlo.js", fs.readFileSync(module, "utf8") +
    `\nconst carloScenes = ${execFileSync(path.join(programs, "carlo_site_native"), ["scenes"], { encoding: "utf8" })};\n` +
    fs.readFileSync(path.join(here, "web/live.js"), "utf8").replace('"use strict";', ""));
  const decks = copyDecks(book, labs, out);
  const context = { root, book, labs, formulas, decks, pages, write, out, source: sourceOf() };
  for (const lab of labs) {
    const text = textOf(root, `labs/${lab.folder}/README.md`, tools, formulas, pages);
    if (lab.live) fs.copyFileSync(path.join(here, `web/lab${lab.number}.js`), path.join(out, `lab${lab.number}.js`));
    if (lab.picture) fs.copyFileSync(path.join(root, "labs", lab.folder, lab.picture), path.join(out, `lab${lab.digits}-${lab.picture}`));
    write(lab.page, labPage(context, lab, text));
  }
  write("instructors.html", textPage(context, "instructors.html", textOf(root, "tests/INSTRUCTORS.md", tools, formulas, pages),
                                     "The files named here are in the repository; <code>tests/INSTRUCTORS.md</code> is this page."));
  write("students.html", textPage(context, "students.html", textOf(root, "labs/README.md", tools, formulas, pages)));
  write("glossary.html", textPage(context, "glossary.html", glossaryOf(textOf(root, "labs/glossary.md", tools, formulas, pages), labs)));
  fs.copyFileSync(path.join(root, "common/scenes/cornell_phong.jpg"), path.join(out, "cornell_phong.jpg"));
  write("index.html", frontPage(context, fs.readFileSync(path.join(root, "README.md"), "utf8"), tools));
  say("rendering the scenes ...");
  gallery(context, programs, tools);
  const megabytes = (size(out) / 1e6).toFixed(1);
  say(`wrote ${path.relative(process.cwd(), path.join(out, "index.html"))} (${megabytes} MB, ${Math.round((Date.now() - start) / 1000)} s)`);
}

try {
  main(process.argv.slice(2));
} catch (error) {
  if (!(error instanceof UserError)) throw error;
  console.error(`carlo: ${error.message}`);
  process.exitCode = 1;
}
