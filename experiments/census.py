#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What light each shipped scene has by class of paths, and what every technique forms, cannot form and loses of it.

    census.py [--kaustik build/release/bin/kaustik] [--out results/census] [--runs results/runs/census] [--photons N] [SCENE...]

Runs `kaustik census` of each scene into RUNS/SCENE, where what is there already stays, and writes OUT/classes.csv and OUT/techniques.csv of all
that are there; rows of other scenes stay as they are. Each row says when it was made and of which sources (plotting/sources.py: the framework, all techniques, the
scene), as far as this program made it. With --anew scenes of other sources are made again. No times are taken, so that the machine need not be idle.
"""

import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from maker import Maker, made, rows_in, write_whole  # noqa: E402
from sources import Tree  # noqa: E402


def scenes(kaustik: str) -> list[str]:
    printed = subprocess.run([kaustik, "list", "scenes", "--json"], check=True, capture_output=True, text=True).stdout
    return [scene["name"] for scene in json.loads(printed)]


# In each scene's own file; in the joined one of all techniques they only take room.
LEFT_OUT = {"emitted", "device"}


MADE = "made.json"  # in a scene's folder


def key_of(tree: Tree, scene: str) -> str:
    return tree.key_without_technique(scene, "techniques", "shaders")


def joined(files: list[pathlib.Path], target: pathlib.Path) -> None:
    """All rows under one head; of scenes that no file is of those that the target has, in its order."""
    heads, of_scenes = set(), {}
    for row in rows_in(target):
        of_scenes.setdefault(row["scene"], []).append(row)
    for file in files:
        with file.open(newline="") as stream:
            reader = csv.DictReader(stream)
            rows = [row | made(file.with_name(MADE)) for row in reader]
        heads.add(tuple(name for name in reader.fieldnames if name not in LEFT_OUT))
        of_scenes |= {row["scene"]: [] for row in rows}
        for row in rows:
            of_scenes[row["scene"]].append({name: cell for name, cell in row.items() if name not in LEFT_OUT})
    columns = [*heads.pop(), "date", "sources"]
    rows = [row for of in of_scenes.values() for row in of]
    if heads or any(set(row) - set(columns) for row in rows):
        sys.exit(f"census: {', '.join(map(str, files))} and '{target}' are of different versions; make those of the older one anew")
    write_whole(target, columns, rows)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", default=str(ROOT / "build/release/bin/kaustik"))
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/census")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "results/runs/census")
    parser.add_argument("--photons", type=int, default=1 << 22)
    parser.add_argument("--anew", action="store_true")
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    failed = []
    done = []
    maker = Maker(arguments.kaustik)
    if arguments.anew:
        maker.require()
    for scene in arguments.scenes or scenes(arguments.kaustik):
        folder = arguments.runs / scene
        key = key_of(maker.tree, scene)
        if arguments.anew and folder.is_dir() and made(folder / MADE)["sources"] != key:
            shutil.rmtree(folder)
        if not (folder / "census.json").is_file():
            command = [arguments.kaustik, "census", scene, "--photons", str(arguments.photons), "--out", str(folder)]
            if subprocess.run(command, stdout=subprocess.DEVNULL).returncode:
                failed.append(scene)
                continue
            maker.note(folder / MADE, key)
        done.append(folder)
        print(f"{scene} is done", flush=True)
    if done:
        for name in ("classes.csv", "techniques.csv"):
            joined([folder / name for folder in done], arguments.out / name)
    if failed:
        print(f"census: no census of {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
