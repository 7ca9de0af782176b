// Watch mode: transforms changed decks again; Marp builds the HTML and makes the browser reload it.

import { spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

import { writeTheme } from "./theme.mjs";

const period = 400; // milliseconds; polling works on every file system

/** `transform()` writes the decks' Markdown into `folder`. Never returns. */
export async function watch(root, folder, out, transform) {
  let last = newest(path.join(root, "slides"));
  writeTheme(root);
  transform();
  const program = path.join(root, "build/slides/node_modules/@marp-team/marp-cli/marp-cli.js");
  const marp = spawn(
    process.execPath,
    [
      program,
      "--config-file",
      path.join(root, "slides/tool/marp.config.mjs"),
      "--watch",
      "--input-dir",
      folder,
      "--output",
      out,
    ],
    { cwd: root, stdio: ["ignore", "inherit", "inherit"] },
  );
  marp.on("exit", (code) => process.exit(code ?? 1));
  for (;;) {
    await new Promise((resolve) => setTimeout(resolve, period));
    const now = newest(path.join(root, "slides"));
    if (now === last) continue;
    last = now;
    transform();
  }
}

/** The time of the newest file in a folder. */
function newest(folder) {
  let time = 0;
  for (const entry of fs.readdirSync(folder, { withFileTypes: true })) {
    const name = path.join(folder, entry.name);
    // An editor may remove a file between the two calls.
    const stat = fs.statSync(name, { throwIfNoEntry: false });
    time = Math.max(time, entry.isDirectory() ? newest(name) : (stat?.mtimeMs ?? 0));
  }
  return time;
}
