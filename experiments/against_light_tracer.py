#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The default and an exact light tracer in turn on one machine: how much sooner one has the other's error.

    against_light_tracer.py --out FILE [--kaustik build/release/bin/kaustik] [--scenes NAME...] [--technique exact_rays] [--rounds 3]
                            [--size 400x300] [--reference-photons 16777216] [--threads 0] [-- options of kaustik run...]

For each scene (those that are shipped and the room of water, or those that are named), in each round: `kaustik run`, and `kaustik reference` (every photon straight into its pixel) with few photons and with many, out
of an empty cache. The time of ours is of all passes of the caustic, as in table.py; the light tracer's a photon is the difference of its two
runs, and its error falls as one over its photons, from the run with many. Both errors are against the same reference and net of its noise. SMAPE
falls as its two runs say. Writes a row a scene: medians over the rounds, and the least and the largest factor. A row that is in FILE already is
not run again; rows of another processor are not mixed with these. Times need an idle machine; what other processes took meanwhile is said in other_processors, the most of any run.
"""

import argparse
import csv
import json
import math
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "plotting"))
import light_tracer  # noqa: E402
from light_tracer import ROOT, kaustik  # noqa: E402
from study import device_of  # noqa: E402
from table import CAUSTIC  # noqa: E402

FEW, MANY = 1048576, 4194304
ROOM = "experiments/room_of_water/room_of_water.toml"
COLUMNS = ["scene", "technique", "status", "rounds", "ms", "relMSE, net", "SMAPE", "us a photon", "light tracer's photons", "light tracer's ms", "factor",
           "low", "high", "by SMAPE", "message", "device", "version", "date", "other_processors"]


def of_caustic(report: dict) -> float:
    return sum(each["gpu_ms"]["median"] for each in report["passes"]
               if each.get("ran") and each["name"].startswith(CAUSTIC) and not each["name"].startswith("media."))


def run(options, scene: str, folder: pathlib.Path) -> dict:
    kaustik(options.kaustik, "run", scene, "--technique", options.technique, "--size", options.size, "--frames", 3, "--warmup", 1, "--precise",
            "--reference", "auto", "--reference-photons", options.reference_photons, *options.more, "--out", folder)
    report = json.loads((folder / "report.json").read_text())
    error = report["error"]["caustic_irradiance"]
    return {"ms": of_caustic(report), "relMSE, net": error["rel_mse"] - error["truth_noise"]["rel_mse"], "SMAPE": error["smape"], "report": report}


def light(options, scene: str, photons: int, folder: pathlib.Path) -> dict:
    row = light_tracer.measure(options, scene, "light", photons, folder)
    return {"photons": row["photons"], "ms": 1e3 * row["seconds"], "relMSE, net": row["relMSE"] - row["relMSE, reference's own"],
            "SMAPE": row["SMAPE"]}


def factors(ours: dict, few: dict, many: dict) -> dict:
    """Of one round: what the light tracer needs for our errors, and by how much we are sooner."""
    a_photon = (many["ms"] - few["ms"]) / (many["photons"] - few["photons"])
    photons = many["relMSE, net"] * many["photons"] / ours["relMSE, net"]
    slope = math.log(many["SMAPE"] / few["SMAPE"]) / math.log(many["photons"] / few["photons"])
    by_smape = many["photons"] * (ours["SMAPE"] / many["SMAPE"]) ** (1.0 / slope)
    return {"us a photon": 1e3 * a_photon, "light tracer's photons": photons, "light tracer's ms": photons * a_photon,
            "factor": photons * a_photon / ours["ms"], "by SMAPE": by_smape * a_photon / ours["ms"]}


def measure(options, scene: str) -> dict:
    rounds, others = [], []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            ours = run(options, scene, pathlib.Path(folder))
            report = ours.pop("report")
            if not ours["relMSE, net"] > 0.0:
                return {"status": "failed", "message": "below the reference's noise"}
            rounds.append(ours | factors(ours, *(light(options, scene, photons, pathlib.Path(folder)) for photons in (FEW, MANY))))
            others.append(report["timing"]["other_processors"])
    row = {key: statistics.median(each[key] for each in rounds) for key in rounds[0]}
    row |= {"low": min(each["factor"] for each in rounds), "high": max(each["factor"] for each in rounds)}
    device = report["device"]
    return {key: f"{value:.5g}" for key, value in row.items()} | {
        "status": "done", "rounds": options.rounds, "device": device_of(device | {"device": device["renderer"]}), "version": report["version"],
        "date": report["timing"]["date"], "other_processors": f"{max(others):.2g}"}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--technique", default="exact_rays")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--reference-photons", type=int, default=16777216)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("more", nargs="*", help="options of kaustik run")
    options = parser.parse_args()
    scenes = options.scenes or [*(line.split()[0] for line in kaustik(options.kaustik, "list", "scenes").splitlines()), ROOM]
    done = set()
    if options.out.exists():
        with options.out.open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        done = {(row["scene"], row["technique"]) for row in rows}
        here = light_tracer.processor(options.threads)
        if others := {row["device"] for row in rows if row["device"] and not row["device"].endswith(here)}:
            sys.exit(f"against_light_tracer: '{options.out}' has rows of {' and '.join(sorted(others))}, and this is {here}; write another file")
    options.out.parent.mkdir(parents=True, exist_ok=True)
    with options.out.open("a", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n", restval="")
        if not done:
            writer.writeheader()
        for scene in scenes:
            name = pathlib.PurePath(scene).stem
            if (name, options.technique) in done:
                continue
            try:
                row = measure(options, scene)
            except (KeyError, TypeError):  # no caustic, and so no error
                row = {"status": "failed", "message": "no caustic"}
            writer.writerow(row | {"scene": name, "technique": options.technique})
            stream.flush()
            print(f"{name}: {row.get('message') or row['factor']}", flush=True)


if __name__ == "__main__":
    main()
