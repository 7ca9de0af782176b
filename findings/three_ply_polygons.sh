#!/usr/bin/env bash
# three.js 0.187.0, PLYLoader: a PLY file with faces of five and more corners.
# Expected: they are triangulated, as OBJLoader does, or the loader complains.
# Seen: they vanish. Only triangles and quadrilaterals are taken: a pentagon between two of them leaves
# a hole, without a message. In a file of pentagons only there are no indices at all, so the
# vertices are taken for triangles, three by three, in the order of the file.
# Do: triangulate before three.js gets the file.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
npm install --prefix "$tmp" --silent three@0.187.0 > npm.log

cat > ply.mjs <<'JS'
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
const corners = ["0 0 0", "4 0 0", "5 3 0", "2 5 0", "-1 3 0", "2 -3 0", "6 -3 0"];
const pentagon = [0, 1, 2, 3, 4], triangle = [0, 5, 1], quad = [1, 5, 6, 2];
const ply = (faces) => new PLYLoader().parse(
  `ply\nformat ascii 1.0\nelement vertex ${corners.length}\n` +
  ["x", "y", "z"].map((a) => `property float ${a}\n`).join("") +
  `element face ${faces.length}\nproperty list uchar int vertex_indices\nend_header\n` +
  corners.join("\n") + "\n" + faces.map((f) => `${f.length} ${f.join(" ")}\n`).join(""));
const obj = (faces) => new OBJLoader().parse(
  corners.map((c) => `v ${c}\n`).join("") + faces.map((f) => `f ${f.map((i) => i + 1).join(" ")}\n`).join(""));
const hold = (ok, text) => { if (!ok) { console.error("changed: " + text); process.exit(1); } };

const mixed = ply([triangle, pentagon, quad]).index.count / 3, alone = ply([pentagon]).index;
const objs = obj([triangle, pentagon, quad]).children[0].geometry.attributes.position.count / 3;
console.log(`triangle, pentagon and quadrilateral: ${mixed} triangles from PLY, ${objs} from OBJ`);
hold(objs === 6, `OBJLoader gives ${objs} triangles`);
hold(mixed === 3, `PLYLoader gives ${mixed} triangles`);
hold(alone === null, "PLYLoader makes indices for a pentagon alone");
JS
node ply.mjs
