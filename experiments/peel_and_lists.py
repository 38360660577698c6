#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long the layers of a view take by peeling and by lists of fragments, in turn: peel, lists, peel, lists.

    peel_and_lists.py [--csv results/layers/peel_and_lists.csv] [--scenes NAME...]

Writes a row a scene: at two sizes the depth complexity, ms of the passes layers.* without the pyramid by both (two rounds), triangles of eight layers
over pixels, and what layers=auto takes by that; × where the other one is faster. Rows of other scenes stay as they are. On an idle machine.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

from two_builds import SCENES, rows_of_others, write_rows

ROOT = pathlib.Path(__file__).resolve().parents[1]
SIZES = {"400×300": ("400x300", 3), "1600×1200": ("1600x1200", 2)}
ALLOWED = 8  # layers
OPTIONS = ["--technique", "screen_space_photons", "--warmup", "1", "--precise", "--set", "emit.photons=16x16", "--set", "view=interface"]
COMMAND = "experiments/peel_and_lists.py: kaustik run SCENE --size SIZE --frames F --set layers=NODE " + " ".join(OPTIONS)
COLUMNS = ["scene", "triangles", "400×300: deep", "peel", "lists", "share", "1600×1200: deep", "peel (2)", "lists (2)", "share (2)", "command", "version",
           "device", "seed", "date"]


def report_of(scene: str, node: str, size: str, frames: int, folder: str) -> dict:
    done = subprocess.run([ROOT / "build/release/bin/kaustik", "run", scene, "--size", size, "--frames", str(frames), "--set", f"layers={node}",
                           "--out", folder, *OPTIONS], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"peel_and_lists: {scene}: {done.stderr.strip()}")
    return json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8"))


def passes_of(report: dict) -> dict[str, dict]:
    return {one["name"]: one for one in report["passes"] if one["name"].startswith("layers.") and one["name"] != "layers.pyramid"}


def milliseconds(report: dict) -> float:
    return sum(one["gpu_ms"]["median"] for one in passes_of(report).values() if one["ran"])


def row_of(scene: str) -> dict:
    row: dict[str, object] = {"scene": scene, "command": COMMAND, "seed": 1}
    with tempfile.TemporaryDirectory() as folder:
        for mark, (shown, (size, frames)) in zip(("", " (2)"), SIZES.items()):
            times: dict[str, list[float]] = {"peel": [], "lists": []}
            for _ in range(2):
                for node, found in times.items():
                    report = report_of(scene, node, size, frames, folder)
                    found.append(milliseconds(report))
            triangles = report["scene"]["triangles"]
            width, height = (int(side) for side in size.split("x"))
            share = f"{ALLOWED * triangles / (width * height):.3g}"
            device = report["device"]
            row |= {"triangles": f"{triangles:,}", "version": report["version"], "date": report["timing"]["date"][:10],
                    "device": f"{device['renderer']}, {device['cpu']}, {device['threads']} threads", f"{shown}: deep": report["layers"]["complexity"]}
            if report["layers"]["complexity"] == 0:
                row |= {f"peel{mark}": "–", f"lists{mark}": "–", f"share{mark}": "–"}
                continue
            automatic = passes_of(report_of(scene, "auto", size, 1, folder))
            taken = "lists" if automatic.get("layers.lists", {}).get("ran") else "peel"
            faster = min(times, key=lambda node: statistics.fmean(times[node]))
            row |= {f"{node}{mark}": ", ".join(f"{one:.0f}" for one in found) for node, found in times.items()}
            row[f"share{mark}"] = f"{share}, {taken}{'' if taken == faster else ' ×'}"
    return row


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "results/layers/peel_and_lists.csv")
    parser.add_argument("--scenes", nargs="+", default=SCENES, metavar="NAME")
    arguments = parser.parse_args()
    rows = rows_of_others(arguments.csv, arguments.scenes)
    for scene in arguments.scenes:
        rows.append(row_of(scene))
        print(scene, *(rows[-1][name] for name in ("peel", "lists", "share", "peel (2)", "lists (2)", "share (2)")), flush=True)
        write_rows(arguments.csv, COLUMNS, rows)


if __name__ == "__main__":
    main()
