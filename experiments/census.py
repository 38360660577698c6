#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What light each shipped scene has by class of paths, and what every technique forms, cannot form and loses of it.

    census.py [--kaustik build/release/bin/kaustik] [--out results/census] [--runs results/runs/census] [--photons N] [SCENE...]

Runs `kaustik census` of each scene into RUNS/SCENE, where what is there already stays, and writes OUT/classes.csv and OUT/techniques.csv of all
that are there. No times are taken, so that the machine need not be idle.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def scenes(kaustik: str) -> list[str]:
    printed = subprocess.run([kaustik, "list", "scenes", "--json"], check=True, capture_output=True, text=True).stdout
    return [scene["name"] for scene in json.loads(printed)]


# In each scene's own file; in the joined one of all techniques they only take room.
LEFT_OUT = {"emitted", "device"}


def joined(files: list[pathlib.Path], target: pathlib.Path) -> None:
    """All rows under one head, whole or not at all."""
    heads, rows = set(), []
    for file in files:
        with file.open(newline="") as stream:
            head, *body = csv.reader(stream)
        kept = [i for i, name in enumerate(head) if name not in LEFT_OUT]
        heads.add(tuple(head[i] for i in kept))
        rows += [[row[i] for i in kept] for row in body]
    if len(heads) != 1:
        sys.exit(f"census: {', '.join(map(str, files))} are of different versions; delete those of the older one")
    target.parent.mkdir(parents=True, exist_ok=True)
    with (part := target.with_suffix(".part")).open("w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([heads.pop(), *rows])
    part.replace(target)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", default=str(ROOT / "build/release/bin/kaustik"))
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/census")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "results/runs/census")
    parser.add_argument("--photons", type=int, default=1 << 22)
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    failed = []
    done = []
    for scene in arguments.scenes or scenes(arguments.kaustik):
        folder = arguments.runs / scene
        if not (folder / "census.json").is_file():
            command = [arguments.kaustik, "census", scene, "--photons", str(arguments.photons), "--out", str(folder)]
            if subprocess.run(command, stdout=subprocess.DEVNULL).returncode:
                failed.append(scene)
                continue
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
