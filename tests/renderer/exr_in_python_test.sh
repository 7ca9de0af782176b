#!/usr/bin/env bash
# exr_in_python_test.sh RENDER SOURCE: the Python in solutions/renderer/BESIDE.md reads from fresh renders what their
# reports and channels say. If OpenEXR for Python is not installed, a stand-in reads them. Exit code 77: no NumPy.
set -euo pipefail
render=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# python_with MODULES: prints a Python that has them.
python_with() {
  local python
  for python in python3 /usr/bin/python3 "$source/build/peers/bin/python"; do
    if "$python" -c "import $1" 2>/dev/null; then printf '%s' "$python" && return; fi
  done
  return 1
}
if ! python=$(python_with numpy,OpenEXR); then
  python=$(python_with numpy) || { echo 'skipped: needs NumPy' && exit 77; }
  # As much of OpenEXR as the page uses, for one part packed by ZIP in blocks of 16 lines.
  cat >"$scratch/OpenEXR.py" <<'EOF'
import struct
import types
import zlib

import numpy


def unpacked(block):
    differences = numpy.frombuffer(zlib.decompress(block), numpy.uint8)
    halves = (numpy.cumsum(differences, dtype=numpy.uint8) - 128 * numpy.arange(len(differences))).astype(numpy.uint8)
    middle = (len(halves) + 1) // 2
    block = numpy.empty_like(halves)
    block[0::2], block[1::2] = halves[:middle], halves[middle:]
    return block.tobytes()


class File:
    def __init__(self, path, separate_channels):
        with open(path, "rb") as file:
            self.bytes = file.read()
        at, self.attributes = 8, {}
        while self.bytes[at]:
            name, kind = self.bytes[at:].split(b"\0", 2)[:2]
            at += len(name) + len(kind) + 2
            size = struct.unpack_from("<i", self.bytes, at)[0]
            self.attributes[name.decode()] = self.bytes[at + 4:at + 4 + size]
            at += 4 + size
        self.offsets = at + 1
        assert separate_channels and self.attributes["compression"] == b"\3"

    def header(self):
        return {name: value.decode() for name, value in self.attributes.items() if name.startswith("carlo:")}

    def channels(self):
        left, top, right, bottom = struct.unpack("<4i", self.attributes["dataWindow"])
        width, height = right - left + 1, bottom - top + 1
        kinds, rest = {}, self.attributes["channels"]
        while rest[0]:
            name, rest = rest.split(b"\0", 1)
            kinds[name.decode()] = {0: "<u4", 2: "<f4"}[rest[0]]
            rest = rest[16:]
        rows = []
        for offset in struct.unpack_from(f"<{-(-height // 16)}Q", self.bytes, self.offsets):
            size = struct.unpack_from("<i", self.bytes, offset + 4)[0]
            lines = min(16, height - len(rows))
            block = self.bytes[offset + 8:offset + 8 + size]
            words = unpacked(block) if size < 4 * lines * len(kinds) * width else block
            rows += list(numpy.frombuffer(words, "<u4").reshape(lines, len(kinds), width))
        return {name: types.SimpleNamespace(pixels=numpy.stack([row[i].view(kind) for row in rows]))
                for i, (name, kind) in enumerate(kinds.items())}
EOF
fi

# The page's lines, and after them what must hold.
awk '/^```python/ { inside = 1; next } /^```/ { inside = 0 } inside' "$source/solutions/renderer/BESIDE.md" >"$scratch/sums.py"
sed '/^def exact/,$d' "$scratch/sums.py" >"$scratch/image.py"
cat >>"$scratch/sums.py" <<'EOF'
import json
import pathlib

report = json.loads(pathlib.Path(sys.argv[1]).with_suffix(".json").read_text())
assert numpy.array_equal(mean.astype(numpy.float32), image), "the sums are not the image"
assert numpy.array_equal(standard_error.astype(numpy.float32), error), "the sums are not the standard errors"
assert numpy.allclose(mean.mean(axis=(0, 1)), report["mean"], rtol=1e-13, atol=0), report
assert numpy.all(samples == report["spp"]) and samples.sum() == report["samples"], report
assert not numpy.allclose(image, image[::-1], atol=.1) and not numpy.allclose(image, image[:, ::-1], atol=.1)
if "light_paths" not in report:
    whole = numpy.sqrt((standard_error**2).sum(axis=(0, 1))) / pixels
    assert numpy.allclose(whole, report["standard_error"], rtol=1e-9, atol=0), report
EOF
cat >>"$scratch/image.py" <<'EOF'
import json
import pathlib

# Whole numbers are not what they are in all programs of the page's table.
assert {c.pixels.dtype for c in channels.values()} == {numpy.dtype("f4")}, "not all channels are floats"
report = json.loads(pathlib.Path(sys.argv[1]).with_suffix(".json").read_text())
samples = channels["samples"].pixels
assert abs(samples.mean(dtype=float) - report["spp"]) < 1e-9 and samples.max() == report["target"]["spp_max"], report
EOF

# check PROGRAM OPTIONS...: renders, and runs the program on the image.
check() {
  "$render" "$source/common/scenes/caustics.xml" --size 37x43 --quiet -o "$scratch/render" "${@:2}"
  "$python" -W error "$scratch/$1.py" "$scratch/render.exr" || { echo "FAILED: $*" && exit 1; }
}
check sums --spp 64 --technique path --sampler independent
check sums --spp 128 --technique bidirectional
check image --target-error .3 --spp 512 --no-sums
