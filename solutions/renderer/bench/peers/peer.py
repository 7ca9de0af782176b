"""Shared by the programs in this folder, each of which renders one of our scenes with another renderer,
for `./carlo bench peers`:

    python3 mitsuba_peer.py SCENE.json

peer_scene.cpp writes the JSON file. The image goes to the EXR file that it names, and one line
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
    """Prints the answer and ends the program at once: some renderers do not survive Python's own exit."""
    print("\ncarlo: " + json.dumps({"version": version, "seconds": seconds}), flush=True)
    os._exit(0)


def run_and_end(main, clean_up=lambda: None):
    """Runs the program and ends it at once, also after an error: Blender as a module may hang on its own
    threads when Python ends."""
    code = 3
    try:
        main()
        code = 0
    except Exception as error:
        print(f"Error: {error!r}", flush=True)
    clean_up()
    os._exit(code)


def processor_seconds(render):
    """The processor seconds of all threads of this process."""
    start = time.process_time()
    render()
    return time.process_time() - start
