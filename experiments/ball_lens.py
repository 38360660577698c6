#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a ball lens makes of the sun, against its closed form: by photons, and by how finely the ball is meshed.

    ball_lens.py [--kaustik build/release/bin/kaustik] [--out results/reconstructions/ball_lens_photons.csv] [--segments N...] [--photons N...]

A ball of glass (n = 1.5, R = 0.5 m, its middle 0.8 m above a plane) in parallel light, seen from straight above at 600×600; light that is
refracted twice and nothing else (`specular=interface`). A ray at the height b from the axis arrives where two refractions in a circle send it, with
which share of its light Fresnel's formulas say; from these, the irradiance in W/m² by the distance r from the axis, and its mean over 16×16
points of each pixel. relMSE over 0.02 m < r < 0.45 m with an epsilon of 1 % of the sun's irradiance, squared. Writes a row each of
photons and segments of the ball; `energy` is the sum of ours by the sum of the closed form's. No times are taken.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from pictures import read_image  # noqa: E402
from study import device_of  # noqa: E402

RADIUS, INDEX, HEIGHT, SUN, EYE, FIELD_OF_VIEW, SIDE = 0.5, 1.5, 0.8, 1000.0, 4.0, 14.25, 600
RING, RAYS, SAMPLES = 5e-6, 16_000_000, 16
NEAREST, FARTHEST = 0.02, 0.45
PIXEL = 2.0 * np.tan(0.5 * np.radians(FIELD_OF_VIEW)) * EYE / SIDE
SCENE = """name = "ball_lens"
[camera]
position = [0, 4, 0]
target = [0, 0, 0]
up = [0, 0, -1]
vertical_fov_degrees = 14.25
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "paper"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "paper"
shape = "plane"
material = "paper"
size = [4, 4]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.5
position = [0, 0.8, 0]
segments = {segments}
"""
COLUMNS = ["segments", "photons", "relMSE", "energy", "command", "version", "device", "seed", "date"]


def transmittance(cosine, before, after):
    sine = before / after * np.sqrt(np.maximum(1.0 - cosine**2, 0.0))
    beyond = np.sqrt(np.maximum(1.0 - sine**2, 0.0))
    s = (before * cosine - after * beyond) / (before * cosine + after * beyond)
    p = (after * cosine - before * beyond) / (after * cosine + before * beyond)
    return 1.0 - 0.5 * (s**2 + p**2)


def by_distance() -> np.ndarray:
    """The irradiance in rings of RING meters around the axis."""
    b = RADIUS * (np.arange(RAYS) + 0.5) / RAYS
    incident, refracted = np.arcsin(b / RADIUS), np.arcsin(b / (INDEX * RADIUS))
    turn, chord = incident - refracted, 2.0 * RADIUS * np.cos(refracted)
    x, y = b - chord * np.sin(turn), HEIGHT + RADIUS * np.cos(incident) - chord * np.cos(turn)
    ring = (np.abs(x - y * np.tan(2.0 * turn)) / RING).astype(np.int64)
    count = int(2.0 * PIXEL * SIDE / RING)
    arrives = (np.cos(2.0 * turn) > 0.01) & (ring < count)
    watts = SUN * 2.0 * np.pi * b * (RADIUS / RAYS) * transmittance(np.cos(incident), 1.0, INDEX) * transmittance(np.cos(refracted), INDEX, 1.0)
    inner = RING * np.arange(count)
    return np.bincount(ring[arrives], watts[arrives], count) / (np.pi * RING * (2.0 * inner + RING))


def closed_form() -> np.ndarray:
    rings = by_distance()
    picture = np.empty((SIDE, SIDE))
    at = PIXEL * (np.arange(SIDE * SAMPLES) + 0.5 - SIDE * SAMPLES / 2) / SAMPLES
    for row in range(SIDE):
        of_row = at[row * SAMPLES:(row + 1) * SAMPLES]
        ring = (np.hypot(of_row[:, None], at) / RING).astype(np.int64)
        picture[row] = rings[ring].reshape(SAMPLES, SIDE, SAMPLES).mean(axis=(0, 2))
    return picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/reconstructions/ball_lens_photons.csv")
    parser.add_argument("--segments", type=int, nargs="+", default=[192, 384, 768])
    parser.add_argument("--photons", type=int, nargs="+", default=[128, 256, 512])
    options = parser.parse_args()
    truth = closed_form()
    at = PIXEL * (np.arange(SIDE) + 0.5 - SIDE / 2)
    r = np.hypot(at[:, None], at)
    counts = (r > NEAREST) & (r < FARTHEST)
    rows = []
    for segments in options.segments:
        for photons in options.photons:
            with tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder) / "ball_lens.toml"
                scene.write_text(SCENE.format(segments=segments), encoding="utf-8")
                subprocess.run([options.kaustik, "run", scene, "--size", f"{SIDE}x{SIDE}", "--frames", "1", "--warmup", "0", "--precise",
                                "--set", f"emit.photons={photons}x{photons}", "--set", "specular=interface", "--out", folder],
                               check=True, capture_output=True)
                ours = read_image(pathlib.Path(folder) / "caustic.exr")[..., 1].astype(np.float64)
                report = json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8"))
            error = ((ours - truth)**2 / (truth**2 + 0.01 * SUN**2))[counts].mean()
            device = report["device"]
            rows.append({"segments": segments, "photons": f"{photons}²", "relMSE": f"{error:.3g}", "energy": f"{ours[counts].sum() / truth[counts].sum():.5f}",
                         "command": "experiments/ball_lens.py", "version": report["version"], "device": device_of(device | {"device": device["renderer"]}),
                         "seed": report["seed"], "date": report["timing"]["date"][:10]})
            print(f"{segments} segments, {photons}²: relMSE {error:.3g}", flush=True)
    with options.out.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
