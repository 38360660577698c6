#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Certified intervals against references of many photons: no reference may leave an interval by more than its own noise.

    /usr/bin/python3 experiments/certified.py [--out results] [--work results/runs/certified] [--cases flat-water ...]
                                              [--photons 1073741824] [--threads 0]

For each case runs `kaustik certify` and `kaustik reference` of the same paths, compares them value by value and writes OUT/certified.csv.
Two cores take an hour or two, nearly all of it for references.
What is in WORK already is not made again, and rows of cases that are not asked for stay. `beyond`: values (pixels times channels) that
are outside of their interval by more than z standard errors, where z is what one of that many independent normal values exceeds with a
probability of 5 %; `largest z`: of all values. A row says when its files were made, and of which sources (plotting/sources.py: the framework,
what certifies, the scene), as far as this program made them; with --anew what is of other sources is made again. A certificate that takes more than --seconds is left as "time is up"; the next call goes on
with it. `seconds`: what the certificate took, in all calls.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys

import numpy as np
import OpenImageIO

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from maker import Maker, made, rows_in, write_whole  # noqa: E402

KAUSTIK = ROOT / "build/release/bin/kaustik"
SIZE = "200x150"
# Name: scene, interactions, band in pixels.
CASES = {
    "flat-water": ("flat-water", 1, 0.002),
    "smooth-wave": ("experiments/certified/smooth_wave.toml", 1, 0.01),
    "ring": ("ring", 1, 0.005),
    "ring, two": ("ring", 2, 0.01),
    "pool-reflections": ("pool-reflections", 1, 0.02),
    "glass-sphere": ("glass-sphere", 2, 0.02),
}
COLUMNS = ["scene", "interactions", "band", "status", "lit", "median width", "p95 width", "undecided", "total width", "emitted", "deposited",
           "reference deposited", "undecided watts", "cells", "seconds", "photons", "largest z", "outside", "beyond", "version", "date", "sources"]


def picture(file: pathlib.Path) -> np.ndarray:
    return OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT).astype(float)


def departures(lower: np.ndarray, upper: np.ndarray, reference: np.ndarray, error: np.ndarray) -> np.ndarray:
    """By how many standard errors each value is outside; 0 inside. A pixel that few photons have hit has a standard error as much too small as
    its value: below an interval the error is the one that as many photons as its lower bound asks for would have (a photon's share of light
    is the variance over the mean). Where no photon has been there is no error to tell."""
    away = np.where(reference < lower, lower - reference, np.where(reference > upper, reference - upper, 0.0))
    known = np.isfinite(error) & (error > 0.0)
    scale = np.sqrt(np.divide(np.maximum(lower, reference), reference, out=np.ones_like(away), where=known & (reference > 0.0)))
    return np.divide(away, error * scale, out=np.zeros_like(away), where=known)


def note_of(picture: pathlib.Path) -> pathlib.Path:
    """When it was made, and of which sources."""
    return picture.with_suffix(".made.json")


def row_of(name: str, certificate: pathlib.Path, reference: pathlib.Path) -> dict:
    scene, interactions, band = CASES[name]
    found = json.loads(certificate.with_suffix(".json").read_text())
    truth = json.loads(reference.with_suffix(".json").read_text())
    z = departures(picture(certificate.with_suffix(".lower.exr")), picture(certificate.with_suffix(".upper.exr")), picture(reference),
                   picture(reference.with_suffix(".stderr.exr")))
    limit = statistics.NormalDist().inv_cdf(1.0 - 0.05 / z.size)
    pixels, energy = found["pixels"], found["energy"]
    return {"scene": name.split(",")[0], "interactions": interactions, "band": found["request"]["band_px"], "status": "done", "lit": pixels["lit"],
            "median width": pixels["median_width"], "p95 width": pixels["p95_width"], "undecided": pixels["undecided"] / max(pixels["lit"], 1),
            "total width": found["deposited_width"], "emitted": sum(energy["emitted_w"]) / 2, "deposited": sum(energy["deposited_w"]) / 2,
            "reference deposited": truth["energy"]["deposited_w"], "undecided watts": energy["undecided_w"], "cells": found["cells"], "seconds": found["seconds"],
            "photons": truth["photons"], "largest z": z.max(), "outside": int((z > 0).sum()), "beyond": int((z > limit).sum()),
            "version": found["version"], **made(note_of(certificate), note_of(reference))}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "results/runs/certified")
    parser.add_argument("--cases", nargs="*", default=list(CASES), choices=list(CASES))
    parser.add_argument("--photons", type=int, default=1 << 30)
    parser.add_argument("--seconds", type=float, default=1800.0)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--anew", action="store_true")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    file = options.out / "certified.csv"
    rows = {(row["scene"], row["interactions"]): row for row in rows_in(file)}
    maker = Maker(KAUSTIK)
    if options.anew:
        maker.require()
    for name in options.cases:
        scene, interactions, band = CASES[name]
        stem = f"{name.split(',')[0]}-{interactions}"
        certificate = options.work / f"{stem}.exr"
        reference = options.work / f"{stem}.reference.exr"
        common = [scene, "--interactions", str(interactions), "--size", SIZE, "--threads", str(options.threads)]
        key = maker.tree.key_without_technique(scene, "framework/certify")
        for made_before in (certificate, reference) if options.anew else ():
            if made(note_of(made_before))["sources"] != key:
                made_before.with_suffix(".json").unlink(missing_ok=True)
        if not reference.with_suffix(".json").exists():
            subprocess.run([KAUSTIK, "reference", *common, "--photons", str(options.photons), "--out", reference], cwd=ROOT, check=True)
            maker.note(note_of(reference), key)
        if not certificate.with_suffix(".json").exists():
            process = subprocess.Popen([KAUSTIK, "certify", *common, "--band", str(band), "--out", certificate], cwd=ROOT)
            try:
                process.wait(options.seconds)
            except subprocess.TimeoutExpired:
                process.terminate()
                process.wait()
            if certificate.with_suffix(".json").exists():
                maker.note(note_of(certificate), key)
        if certificate.with_suffix(".json").exists():
            row = row_of(name, certificate, reference)
        else:
            row = {"scene": name.split(",")[0], "interactions": interactions, "band": band, "status": "time is up"}
        rows[(row["scene"], str(interactions))] = row
        write_whole(file, COLUMNS, [{column: f"{value:.7g}" if isinstance(value, float) else value for column, value in rows[of].items()} for of in sorted(rows)])


if __name__ == "__main__":
    main()
