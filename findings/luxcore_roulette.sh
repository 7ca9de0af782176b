#!/usr/bin/env bash
# LuxCore 2.11.2: Russian roulette in its path tracer, PATHCPU, with default settings.
# Expected: roulette changes the noise, not the mean. A closed cube whose walls emit 1 and reflect half
# of what they get has the radiance 1 + 1/2 + 1/4 + ... = 2 everywhere.
# Seen: 2.05. With four segments it is 1.90 instead of 1.875, with two or three it is right: what is
# wrong begins at path.russianroulette.depth, 3 by default.
# Do: set path.russianroulette.depth above path.pathdepth.total; then the means are right.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with pyluxcore==2.11.2 numpy==1.26.4

cat > furnace.py <<'PY'
import os, time
from hold import hold
import numpy as np, pyluxcore
pyluxcore.Init(lambda message: None)

def properties(values):
    result = pyluxcore.Properties()
    for key, value in values.items():
        result.Set(pyluxcore.Property(key, value))
    return result

corners = [(x, y, z) for x in (-1., 1.) for y in (-1., 1.) for z in (-1., 1.)]
walls = [(0, 2, 6, 4), (1, 5, 7, 3), (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6)]
triangles = [t for a, b, c, d in walls for t in ((a, b, c), (a, c, d))]

def mean(reflectance, depth, more={}):
    scene = pyluxcore.Scene()
    scene.Parse(properties({
        "scene.camera.type": "perspective", "scene.camera.lookat.orig": [0., 0., 0.],
        "scene.camera.lookat.target": [1., 0.2, 0.1], "scene.camera.up": [0., 0., 1.],
        "scene.camera.fieldofview": 60., "scene.materials.wall.type": "matte",
        "scene.materials.wall.kd": [reflectance] * 3, "scene.materials.wall.emission": [1.] * 3}))
    # Emission is on the side of the normal, which must point inwards.
    inside = lambda t: np.dot(np.cross(np.subtract(corners[t[1]], corners[t[0]]),
                                       np.subtract(corners[t[2]], corners[t[0]])), corners[t[0]]) < 0
    scene.DefineMesh("cube", corners, [t if inside(t) else t[::-1] for t in triangles], None, None, None, None)
    scene.Parse(properties({"scene.objects.cube.shape": "cube", "scene.objects.cube.material": "wall"}))
    config = pyluxcore.RenderConfig(properties({
        "film.width": 16, "film.height": 16, "film.filter.type": "BOX", "film.outputs.0.type": "RGB",
        "film.outputs.0.filename": "unused.exr", "film.imagepipelines.0.0.type": "NOP",
        "renderengine.type": "PATHCPU", "renderengine.seed": 1, "sampler.type": "SOBOL",
        "native.threads.count": 1, "batch.haltspp": [64, 0], "path.pathdepth.total": depth,
        "path.pathdepth.diffuse": depth, **more}), scene)
    session = pyluxcore.RenderSession(config)
    session.Start()
    while not session.HasDone():
        time.sleep(.01)
        session.UpdateStats()
    session.Stop()
    film = np.zeros(16 * 16 * 3, np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, film, 0, True)
    return float(film.mean(dtype=float))

never = {"path.russianroulette.depth": 1000}
for reflectance, depth, more, expected in ((.5, 3, {}, 1.75), (.5, 4, {}, 1.899), (.5, 4, never, 1.875),
                                           (.5, 24, {}, 2.048), (.5, 24, never, 2)):
    seen = mean(reflectance, depth, more)
    hold(abs(seen / expected - 1) < .006,
         f"reflectance {reflectance}, {depth} segments, {more}: {seen}, not {expected}")
    print(f"reflectance {reflectance}, {depth} segments{', no roulette' if more else ''}: {seen:.3f}", flush=True)
os._exit(0)  # this module may not survive Python's own exit
PY
venv/bin/python furnace.py
