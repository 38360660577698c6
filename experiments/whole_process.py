#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long one picture takes, from the command to its end.

    whole_process.py [--kaustik build/release/bin/kaustik] [--out results/costs/whole_process.csv] [--rounds 5] [SCENE...]

`kaustik run SCENE --size 600x600 --frames 1 --warmup 0` with 128² photons a light, as a whole process: with empty caches (what is compiled of
shaders is kept nowhere yet), and then with what that has kept. Writes a row a scene: medians of the seconds by the clock, the least and the
most, and of the later runs the frame's own ms. Cold and warm in turn, each round with a cache folder of its own. Times need an idle machine.
"""

import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from study import device_of  # noqa: E402

COLUMNS = ["scene", "cold, s", "cold, least", "cold, most", "warm, s", "warm, least", "warm, most", "frame, ms", "rounds", "command", "version", "device",
           "date", "other_processors"]


def run(options, scene: str, cache: pathlib.Path, folder: pathlib.Path) -> tuple[float, dict]:
    begin = time.monotonic()
    subprocess.run([options.kaustik, "run", scene, "--size", "600x600", "--set", "emit.photons=128x128", "--frames", "1", "--warmup", "0", "--out", folder],
                   check=True, capture_output=True, env=os.environ | {"XDG_CACHE_HOME": str(cache)})
    return time.monotonic() - begin, json.loads((folder / "report.json").read_text(encoding="utf-8"))


def measure(options, scene: str) -> dict:
    cold, warm, frames, loads = [], [], [], []
    for _ in range(options.rounds):
        with tempfile.TemporaryDirectory() as folder:
            out, cache = pathlib.Path(folder) / "out", pathlib.Path(folder) / "cache"
            cache.mkdir()
            cold.append(run(options, scene, cache, out)[0])
            seconds, report = run(options, scene, cache, out)
            warm.append(seconds)
            frames.append(report["frame_ms"]["median"])
            loads.append(report["timing"].get("other_processors", 0.0))
    device = report["device"]
    return {"scene": scene, "rounds": options.rounds, "frame, ms": f"{statistics.median(frames):.4g}", "command": "experiments/whole_process.py",
            "version": report["version"], "device": device_of(device | {"device": device["renderer"]}), "date": report["timing"]["date"],
            "other_processors": f"{max(loads):.2f}"} | {
        f"{name}, {what}": f"{of(values):.3g}" for name, values in (("cold", cold), ("warm", warm))
        for what, of in (("s", statistics.median), ("least", min), ("most", max))}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/costs/whole_process.csv")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    options = parser.parse_args()
    rows = [measure(options, scene) for scene in options.scenes or ["glass-sphere", "pool", "glass-bunny"]]
    with options.out.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
