#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a user would pick instead: exact light tracing and progressive photon mapping, their error and time.

    light_tracer.py --out FILE [--kaustik build/release/bin/kaustik] [--scenes NAME...] [--size 400x300]
                    [--reference-photons 16777216] [--photons 524288 1048576 4194304] [--threads 0]

For each scene `kaustik reference` is run with few photons and a seed of its own, by both estimators (every photon
straight into its pixel; photons gathered where the eye's rays end, `sppm`), and compared with the reference that
all_techniques.toml uses. Writes a CSV: scene, estimator, photons, seconds (tracing alone, on `threads`
processors), relMSE, what of it is the reference's own noise, SMAPE, HDR FLIP, energy, version. A row that is
in FILE already is not run again: it can be interrupted. Times need an idle machine.
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SEED = 7  # not that of the references, whose photons would be the same
COLUMNS = ["scene", "estimator", "size", "photons", "seconds", "relMSE", "relMSE, reference's own", "SMAPE", "HDR FLIP",
           "energy", "version"]


def kaustik(program: pathlib.Path, *arguments, cache: pathlib.Path | None = None) -> str:
    environment = dict(os.environ, **({"KAUSTIK_CACHE": str(cache)} if cache else {}))
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=environment)
    if done.returncode:
        sys.exit(f"light_tracer: 'kaustik {' '.join(map(str, arguments))}' ended with {done.returncode}: {done.stderr}")
    return done.stdout


def measure(options, scene: str, estimator: str, photons: int, folder: pathlib.Path) -> dict:
    reference, image = folder / f"{scene}.exr", folder / "image.exr"
    if not reference.exists():
        kaustik(options.kaustik, "reference", scene, "--size", options.size, "--photons", options.reference_photons,
                "--out", reference)
    # Out of an empty cache: what is there already is not traced, and so has no time.
    with tempfile.TemporaryDirectory() as cache:
        kaustik(options.kaustik, "reference", scene, "--size", options.size, "--photons", photons, "--seed", SEED,
                "--estimator", estimator, "--threads", options.threads, "--out", image, cache=pathlib.Path(cache))
    traced = json.loads(image.with_suffix(".json").read_text())
    error = json.loads(kaustik(options.kaustik, "compare", "--json", "--stderr",
                               reference.with_suffix(".stderr.exr"), image, reference))["error"]
    return {"scene": scene, "estimator": estimator, "size": options.size, "photons": traced["photons"],
            "seconds": traced["compute_s"], "relMSE": error["rel_mse"],
            "relMSE, reference's own": error["truth_noise"]["rel_mse"], "SMAPE": error["smape"],
            "HDR FLIP": error["flip_hdr"], "energy": error["energy_ratio"], "version": traced["version"]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--reference-photons", type=int, default=16777216)
    parser.add_argument("--photons", type=int, nargs="+", default=[524288, 1048576, 4194304])
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    scenes = options.scenes or [line.split()[0] for line in kaustik(options.kaustik, "list", "scenes").splitlines()]

    done = set()
    if options.out.exists():
        with options.out.open(newline="") as stream:
            done = {(row["scene"], row["estimator"], row["asked"]) for row in csv.DictReader(stream)}
    options.out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, options.out.open("a", newline="") as stream:
        writer = csv.DictWriter(stream, [*COLUMNS, "asked"], lineterminator="\n")
        if not done:
            writer.writeheader()
        for scene in scenes:
            for estimator in ("light", "sppm"):
                for photons in options.photons:
                    if (scene, estimator, str(photons)) not in done:
                        row = measure(options, scene, estimator, photons, pathlib.Path(folder))
                        writer.writerow(row | {"asked": photons})
                        stream.flush()
                        said = "no caustic" if row["relMSE"] is None else f"relMSE {row['relMSE']:.3g}"
                        print(f"{scene}, {estimator}, {row['photons']} photons: {row['seconds']:.2f} s, {said}",
                              flush=True)


if __name__ == "__main__":
    main()
