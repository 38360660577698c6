#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long scenes take by two builds of the program, in turn: before, after, before, after.

    two_builds.py BEFORE AFTER --csv FILE [--pairs 10] [--errors PHOTONS] [--scenes NAME...] [--before-set KEY=VALUE]... [-- options of kaustik run...]

BEFORE and AFTER are folders of builds, each next to its own shaders and meshes (build/release of a checkout); or the same one twice, of which the first
is told what --before-set says. Each pair gives a ratio of the two
medians of a frame; the interval is that of the mean of the ratios' logarithms, at 95 of 100 (Student's t). A scene that either build refuses has a
row with its message. With --errors the relMSE by each of the caustic, and of what the eye sees through specular surfaces, against a reference of so many photons, is in the row. FILE's rows of other scenes are left as they are. Writes a row a scene: ms before and after (medians of the pairs), ratio, low, high. On an idle machine, or the figures are noise:
what other processes took of it meanwhile is said in other_processors, the most of any run.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENES = ["blocker", "concave-glass", "cornell-bunny", "flat-water", "glass-bunny", "glass-dragon", "glass-dragon-low", "glass-sphere", "glass-teapot",
          "glossy-table", "god-rays", "pool", "pool-reflections", "ring", "tree", "water-from-below"]
COLUMNS = ["scene", "pairs", "before, ms", "after, ms", "ratio", "low", "high", "relMSE before", "relMSE after", "view relMSE before",
           "view relMSE after", "message", "before", "device", "version", "date", "other_processors"]
# Of Student's t, two-sided, 95 of 100, by degrees of freedom.
T95 = {4: 2.776, 9: 2.262, 14: 2.145, 19: 2.093, 39: 2.023, 59: 2.001, 99: 1.984}


class Refused(Exception):
    """What a build says of a scene."""


def run(build: pathlib.Path, scene: str, options: list[str], folder: str) -> dict:
    environment = {**os.environ, "KAUSTIK_ROOT": str(build.resolve().parents[1])}
    done = subprocess.run([build / "bin/kaustik", "run", scene, "--out", folder, *options], capture_output=True, text=True, env=environment)
    if done.returncode:
        raise Refused((done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1])
    return json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8"))


def interval(ratios: list[float]) -> tuple[float, float, float]:
    """Their geometric mean, and what it may be, at 95 of 100."""
    logarithms = [math.log(ratio) for ratio in ratios]
    middle = statistics.fmean(logarithms)
    reach = T95[len(ratios) - 1] * statistics.stdev(logarithms) / math.sqrt(len(ratios))
    return math.exp(middle), math.exp(middle - reach), math.exp(middle + reach)


def errors_of(report: dict, name: str) -> dict[str, str]:
    errors = report.get("error", {})
    found = {f"relMSE {name}": errors.get("caustic_irradiance"), f"view relMSE {name}": errors.get("view", {}).get("radiance")}
    return {column: f"{error['rel_mse']:.4g}" for column, error in found.items() if error and error.get("rel_mse") is not None}


def row_of(scene: str, before: pathlib.Path, after: pathlib.Path, pairs: int, judged: list[str], told: list[str], options: list[str]) -> dict:
    builds = [("before", before, [*told, *options]), ("after", after, options)]
    times: dict[str, list[float]] = {"before": [], "after": []}
    errors = {}
    load = 0.0
    with tempfile.TemporaryDirectory() as folder:
        try:
            for name, build, own in builds:  # programs are compiled and kept
                errors |= errors_of(run(build, scene, [*own, *judged], folder), name)
            for _ in range(pairs):
                for name, build, own in builds:
                    report = run(build, scene, own, folder)
                    times[name].append(report["frame_ms"]["median"])
                    load = max(load, report["timing"].get("other_processors", 0.0))
        except Refused as refused:
            return {"scene": scene, "message": str(refused)}
    ratio, low, high = interval([b / a for a, b in zip(times["before"], times["after"])])
    device = report["device"]
    return {"scene": scene, "pairs": pairs, "before, ms": f"{statistics.median(times['before']):.1f}", "after, ms": f"{statistics.median(times['after']):.1f}",
            "ratio": f"{ratio:.3f}", "low": f"{low:.3f}", "high": f"{high:.3f}", **errors, "version": report["version"], "date": report["timing"]["date"],
            "device": f"{device['renderer']}, {device['cpu']}, {device['threads']} threads", "other_processors": f"{load:.2f}"}


def rows_of_others(file: pathlib.Path, scenes: list[str]) -> list[dict]:
    """What a file of a row a scene has of other scenes."""
    if not file.exists():
        return []
    with file.open(newline="", encoding="utf-8") as stream:
        return [row for row in csv.DictReader(stream) if row["scene"] not in scenes]


def write_rows(file: pathlib.Path, columns: list[str], rows: list[dict]) -> None:
    """By scene."""
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: row["scene"]))


def commit_of(build: pathlib.Path) -> str:
    done = subprocess.run(["git", "-C", build, "log", "-1", "--format=%h of %cs"], capture_output=True, text=True)
    return done.stdout.strip()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path, required=True)
    parser.add_argument("--pairs", type=int, default=10, choices=[count + 1 for count in T95])
    parser.add_argument("--errors", type=int, metavar="PHOTONS")
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--before-set", action="append", default=[], metavar="KEY=VALUE")
    arguments, options = parser.parse_known_args([one for one in sys.argv[1:] if one != "--"])
    judged = ["--reference", "auto", "--reference-photons", str(arguments.errors)] if arguments.errors else []
    told = [word for setting in arguments.before_set for word in ("--set", setting)]
    rows = rows_of_others(arguments.csv, arguments.scenes)
    arguments.csv.parent.mkdir(parents=True, exist_ok=True)
    for scene in arguments.scenes:
        rows.append(row_of(scene, arguments.before, arguments.after, arguments.pairs, judged, told, options) |
                    {"before": commit_of(arguments.before)})
        print(scene, rows[-1].get("ratio") or rows[-1].get("message"), flush=True)
        write_rows(arguments.csv, COLUMNS, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
