#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What `kaustik tune` picks next to the best of the whole study, all_techniques.toml.

    tuned.py [--kaustik build/release/bin/kaustik] [--scenes NAME...] [--rounds 5] [--out results/runs/tuned] [--csv results/all_techniques/tuned.csv]

The error that is asked for is 1.5 times what the default has with 256x256 photons, net of the reference's noise, by the study's rows
(results/all_techniques/runs.csv). The best of the study is the technique whose curve, by default and as published, is at that error first, with the photons
that a line between its runs in the logarithms of photons and error gives. Both are then rendered in turn, and their ratio of times is the mean of the rounds',
with its interval at 95 of 100. A row a scene; rows of other scenes are left as they are. `sources`: the key of the tuned runs and of the best's (plotting/sources.py).
On an idle machine.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import defaultdict

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "experiments/plotting"), str(ROOT / "experiments")]
from maker import Maker  # noqa: E402
from speed_error import DEFAULT, net, number, rows_of  # noqa: E402
from table import CAUSTIC  # noqa: E402
from two_builds import interval, rows_of_others, write_rows  # noqa: E402

SCENES = ["cornell-bunny", "glass-sphere", "glass-teapot", "pool"]
SIZE, REFERENCE_PHOTONS = "400x300", "16777216"  # as the study has them
COLUMNS = ["scene", "relMSE asked", "tuned", "tuned, photons", "tuned, relMSE", "tuned, ms", "best of the study", "best, photons", "best, relMSE", "best, ms",
           "ratio", "low", "high", "rounds", "minutes to tune", "device", "version", "date", "other_processors", "sources"]


def side_of(row: dict) -> int | None:
    """Photons along a side of the grid; None where the number is not one to choose."""
    grid = row["emit.photons"].split("x")
    return int(grid[0]) if row["technique"] not in ("adaptive_caustic_map", "vertex_caustics") and len(set(grid)) == 1 else None


def best_of_study(rows: list[dict], error: float) -> dict:
    """Technique, whether as published, and photons a side of what has the error first."""
    curves = defaultdict(list)
    for row in rows:
        if row["status"] == "done" and side_of(row) and number(row, "ms") and (net(row) or 0.0) > 0.0:
            curves[row["technique"], row["as_published"] == "true"].append((side_of(row), net(row), number(row, "ms")))
    found = []
    for (technique, published), points in curves.items():
        points.sort()
        found += [(ms, technique, published, side) for side, at, ms in points if at <= error]
        for (side0, error0, ms0), (side1, error1, ms1) in zip(points, points[1:]):
            if error1 < error < error0:
                part = math.log(error / error0) / math.log(error1 / error0)
                found.append((ms0 * (ms1 / ms0) ** part, technique, published, math.ceil(side0 * (side1 / side0) ** part)))
    _, technique, published, side = min(found)
    return {"technique": technique, "as_published": published, "emit.photons": f"{side}x{side}"}


def named(settings: dict) -> str:
    rest = [f"{key}={value}" for key, value in settings.items() if key not in ("technique", "as_published", "emit.photons")]
    return ", ".join([settings["technique"] + (", as published" if settings.get("as_published") else ""), *rest])


def render(options, scene: str, settings: dict, folder: str) -> dict:
    command = [options.kaustik, "run", scene, "--size", SIZE, "--technique", settings["technique"], "--frames", "3", "--warmup", "1", "--precise",
               "--reference", "auto", "--reference-photons", REFERENCE_PHOTONS, "--out", folder]
    command += ["--as-published"] if settings.get("as_published") else []
    for key, value in settings.items():
        if key not in ("technique", "as_published"):
            command += ["--set", f"{key}={value}"]
    subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
    report = json.loads(pathlib.Path(folder, "report.json").read_text(encoding="utf-8"))
    error = report["error"]["caustic_irradiance"]
    passes = [one for one in report["passes"] if one["ran"] and one["name"].startswith(CAUSTIC)]
    return {"ms": sum(one["gpu_ms"]["median"] for one in passes), "error": error["rel_mse"] - error["truth_noise"]["rel_mse"], "report": report}


def row_of(options, scene: str, maker: Maker) -> dict:
    study = [row for row in rows_of(ROOT / "results/all_techniques/runs.csv") if row["scene"] == scene]
    default = next(row for row in study if row["technique"] == DEFAULT and row["emit.photons"] == "256x256")
    error, begin = 1.5 * net(default), time.monotonic()
    subprocess.run([options.kaustik, "tune", scene, "--error", f"{error:.4g}", "--size", SIZE, "--reference-photons", REFERENCE_PHOTONS,
                    "--out", options.out / scene], check=True, capture_output=True, cwd=ROOT)
    minutes = (time.monotonic() - begin) / 60.0
    picks = {"tuned": tomllib.loads((options.out / scene / "tuned.toml").read_text(encoding="utf-8")), "best": best_of_study(study, error)}
    runs = defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        for settings in picks.values():  # programs are compiled and kept
            render(options, scene, settings, folder)
        for _ in range(options.rounds):
            for name, settings in picks.items():
                runs[name].append(render(options, scene, settings, folder))
    ratio, low, high = interval([tuned["ms"] / best["ms"] for tuned, best in zip(runs["tuned"], runs["best"])])
    report = runs["best"][-1]["report"]
    device, row = report["device"], {"scene": scene, "relMSE asked": f"{error:.3g}", "best of the study": named(picks["best"]), "tuned": named(picks["tuned"])}
    for name, settings in picks.items():
        row |= {f"{name}, photons": settings["emit.photons"], f"{name}, relMSE": f"{runs[name][0]['error']:.3g}",
                f"{name}, ms": f"{statistics.median(run['ms'] for run in runs[name]):.1f}"}
    keys = dict.fromkeys(maker.sources(maker.tree.key_of(of[-1]["report"])) for of in runs.values())
    load = max(run["report"]["timing"].get("other_processors", 0.0) for of in runs.values() for run in of)
    return row | {"ratio": f"{ratio:.3f}", "low": f"{low:.3f}", "high": f"{high:.3f}", "rounds": options.rounds, "minutes to tune": f"{minutes:.1f}",
                  "device": f"{device['renderer']}, {device['cpu']}, {device['threads']} threads", "version": report["version"],
                  "date": report["timing"]["date"], "other_processors": f"{load:.2f}", "sources": " ".join(filter(None, keys))}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--rounds", type=int, default=5, choices=(5, 10, 15, 20))
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/runs/tuned")
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "results/all_techniques/tuned.csv")
    options = parser.parse_args()
    rows, maker = rows_of_others(options.csv, options.scenes), Maker(options.kaustik)
    for scene in options.scenes:
        rows.append(row_of(options, scene, maker))
        print(scene, rows[-1]["ratio"], flush=True)
        write_rows(options.csv, COLUMNS, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
