"""What the programs beside this one share: each renders one of our scenes with another renderer, for
`./carlo bench peers`:

    python3 mitsuba_peer.py SCENE.json

The JSON file is what peer_scene.cpp writes. The image goes to the EXR file it names, and one line
"carlo: {...}" with the processor seconds and the renderer's version to stdout.
"""

import json
import os
import sys
import time


def read_scene():
    with open(sys.argv[-1], encoding="utf-8") as file:
        return json.load(file)


def answer(version, seconds):
    """The last thing that a program does: some renderers do not survive Python's end."""
    print("\ncarlo: " + json.dumps({"version": version, "seconds": seconds}), flush=True)
    os._exit(0)


def processor_seconds(render):
    """All of this process's threads."""
    start = time.process_time()
    render()
    return time.process_time() - start
