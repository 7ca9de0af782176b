// Code on slides comes from the tree, between lines '// slide: NAME' and '// end slide'.

import fs from "node:fs";
import path from "node:path";

const longest = 22; // lines that fit on a slide
const begin = /^\s*(?:\/\/|#) slide: ([a-z0-9-]+)\s*$/;
const end = /^\s*(?:\/\/|#) end slide\s*$/;

/** "common/random/pcg.h#next" -> its lines without common indentation, or an error's text. */
export function readSnippet(root, reference) {
  const [file, name] = reference.split("#");
  if (!name) return { error: `a snippet is named like common/random/pcg.h#next, got '${reference}'` };
  if (!/^(common|labs)\//.test(file) || file.includes("..")) {
    return { error: `snippets come from common/ or labs/ (solutions are no slides), got '${file}'` };
  }
  const absolute = path.join(root, file);
  if (!fs.existsSync(absolute)) return { error: `there is no file ${file}` };
  const lines = fs.readFileSync(absolute, "utf8").split("\n");
  const starts = lines.flatMap((line, index) => (begin.exec(line)?.[1] === name ? [index] : []));
  if (starts.length !== 1) {
    return { error: `expected one line '// slide: ${name}' in ${file}, found ${starts.length}` };
  }
  const rest = lines.slice(starts[0] + 1);
  const length = rest.findIndex((line) => end.test(line));
  if (length < 0) return { error: `'// slide: ${name}' of ${file} has no '// end slide'` };
  if (length === 0 || length > longest) {
    return { error: `${reference} has ${length} lines; a slide holds 1 to ${longest}` };
  }
  return { lines: unindented(rest.slice(0, length)) };
}

function unindented(lines) {
  const depths = lines.filter((line) => line.trim()).map((line) => /^ */.exec(line)[0].length);
  const depth = Math.min(...depths);
  return lines.map((line) => line.slice(depth));
}

/** Lists all markers in the tree's sources: [{reference, file, line}]. */
export function markers(root) {
  const found = [];
  for (const file of sources(root)) {
    fs.readFileSync(path.join(root, file), "utf8")
      .split("\n")
      .forEach((line, index) => {
        const name = begin.exec(line)?.[1];
        if (name) found.push({ reference: `${file}#${name}`, file, line: index + 1 });
      });
  }
  return found;
}

/** Lists the files of common/ and labs/ that hold code or prose. */
export function sources(root) {
  const found = [];
  const visit = (folder) => {
    for (const entry of fs.readdirSync(path.join(root, folder), { withFileTypes: true })) {
      const name = `${folder}/${entry.name}`;
      if (entry.isDirectory()) visit(name);
      else if (/\.(h|cpp|md|json|cmake|txt)$/.test(entry.name)) found.push(name);
    }
  };
  for (const folder of ["common", "labs"]) visit(folder);
  return found;
}
