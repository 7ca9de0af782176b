#!/usr/bin/env bash
# three.js 0.170.0, OBJLoader: an object with faces and one line element ("l") or point ("p").
# Expected: a mesh, and lines or points beside it.
# Seen: the whole object becomes LineSegments (or Points): the corners of its triangles are now ends of
# lines, and nothing is filled. In separate objects ("o") both are right.
# Do: put l and p elements into objects of their own, or remove them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
npm install --prefix "$tmp" --silent three@0.170.0 > npm.log

cat > lines.mjs <<'JS'
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
const corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
const kinds = (text) => new OBJLoader().parse(corners + text).children.map((c) => c.type).join(" ");
let changed = false;
for (const [text, expected] of [["f 1 2 3 4\n", "Mesh"], ["f 1 2 3 4\nl 1 3\n", "LineSegments"],
    ["f 1 2 3 4\np 1\n", "Points"], ["o a\nf 1 2 3 4\no b\nl 1 3\n", "Mesh LineSegments"]]) {
  const seen = kinds(text);
  console.log(JSON.stringify(text), "loads as", seen);
  if (seen !== expected && !changed) {
    console.error(`changed: ${JSON.stringify(text)} loads as ${seen}, not ${expected}`);
    changed = true;
  }
}
process.exit(changed ? 1 : 0);
JS
node lines.mjs
