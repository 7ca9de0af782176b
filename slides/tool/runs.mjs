// Runs the commands behind figures and numbers, and keeps their output in build/slides/runs.

import { execFile, spawnSync } from "node:child_process";
import crypto from "node:crypto";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

import { UserError } from "./problems.mjs";

/** ["lab", "4", "--quick"] -> the program that ./carlo would start, or null if there is none. */
export function programOf(command) {
  if (!Array.isArray(command) || !command.every((word) => typeof word === "string")) return null;
  if (command[0] === "render") return "carlo_render";
  if (command[0] === "lab" && /^[1-9][0-9]?$/.test(command[1] ?? "") && command[2] === "--solutions") {
    return `lab${command[1].padStart(2, "0")}_solution`;
  }
  return null;
}

/** The command as a person would type it. */
export const spoken = (command) => `./carlo ${command.join(" ")}`;

export class Runs {
  constructor(root, programs) {
    this.root = root;
    this.programs = programs; // the folder of the built programs
    this.folder = path.join(root, "build/slides/runs");
  }

  /** The lab's tables. `fresh` reruns it even if there is a kept answer. */
  tables(command, options = {}) {
    return JSON.parse(fs.readFileSync(this.#kept(command, "json", options), "utf8")).tables;
  }

  /** The lab's page, as HTML. */
  page(command, options = {}) {
    return fs.readFileSync(this.#kept(command, "html", options), "utf8");
  }

  /** The rendered PNG. */
  image(command, options = {}) {
    return fs.readFileSync(this.#kept(command, "png", options));
  }

  /** A program's stdout for a text on its stdin. */
  answer(name, text) {
    const program = this.#built(name);
    const { status, signal, stdout, stderr, error } = spawnSync(program, { ...this.#options, input: text, stdio: "pipe" });
    if (error) throw new UserError(`${name}: ${error.message}`);
    if (status !== 0) throw new UserError(`${name} failed (${signal ?? `exit code ${status}`}): ${stderr.trim()}`);
    return stdout;
  }

  #built(name) {
    const program = path.join(this.programs, name);
    if (!fs.existsSync(program)) throw new UserError(`${program} is not built`);
    return program;
  }

  /** Runs those commands that have no answer yet, one per processor at a time. A failure is reported when
   * its answer is requested. */
  async prepare(commands) {
    const waiting = [...new Map(commands.map((command) => [JSON.stringify(command), command])).values()];
    const worker = async () => {
      for (let command = waiting.shift(); command; command = waiting.shift()) {
        const job = this.#job(command, command[0] === "render" ? "png" : "html");
        if (!fs.existsSync(job.program) || job.isAnswered()) continue;
        fs.mkdirSync(this.folder, { recursive: true });
        await new Promise((done) =>
          execFile(job.program, job.words, this.#options, (error) => {
            if (error) job.forget();
            done();
          }),
        );
      }
    };
    await Promise.all(Array.from({ length: os.cpus().length }, worker));
  }

  get #options() {
    return { cwd: this.root, encoding: "utf8", maxBuffer: 1 << 26, stdio: ["ignore", "pipe", "pipe"] };
  }

  /** Returns the program of a command, and the file of its answer of this kind. */
  #job(command, extension) {
    const program = path.join(this.programs, programOf(command));
    const key = crypto.createHash("sha256").update(JSON.stringify(command)).digest("hex").slice(0, 16);
    const base = path.join(this.folder, key);
    const file = `${base}.${extension}`;
    const words =
      command[0] === "render"
        ? [...command.slice(1), "--quiet", "-o", base]
        : [...command.slice(3), "--json", `${base}.json`, "--page", `${base}.html`];
    const isAnswered = () => fs.existsSync(file) && fs.statSync(file).mtimeMs > fs.statSync(program).mtimeMs;
    // A program may fail after writing an answer.
    const forget = () => ["json", "html", "png"].forEach((kind) => fs.rmSync(`${base}.${kind}`, { force: true }));
    return { program, words, file, isAnswered, forget };
  }

  /** Runs the command unless its answer is newer than its program; returns the answer's file. */
  #kept(command, extension, { fresh = false }) {
    const { program, words, file, isAnswered, forget } = this.#job(command, extension);
    this.#built(programOf(command));
    if (!fresh && isAnswered()) return file;
    fs.mkdirSync(this.folder, { recursive: true });
    const { status, signal, stdout, stderr, error } = spawnSync(program, words, this.#options);
    if (error) throw new UserError(`${spoken(command)}: ${error.message}`);
    if (status !== 0) {
      forget();
      const said = (stderr.trim() || stdout.trim()).split("\n").at(-1);
      throw new UserError(`${spoken(command)} failed (${signal ?? `exit code ${status}`}): ${said}`);
    }
    if (!fs.existsSync(file)) throw new UserError(`${spoken(command)} wrote no ${extension} file`);
    return file;
  }
}
