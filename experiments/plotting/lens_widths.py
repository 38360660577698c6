#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How wide beams through the ball of `glass-sphere` are where they arrive, and how wide lenses say they are.

    lens_widths.py [--csv results/wyman2008/lens_widths.csv]

In the plane of the lamp and the ball's axis, on a screen across that axis; widths are of a beam of 1 mrad, in mm, across the beam, by where
it meets the ball (from the axis, in radii). Exact: `tangential` along that plane, by the difference of two rays; `sagittal` across it, where the
picture is one of rotation; `beam`, the root of their product, is what a round splat must be. `thin` and `thick` are the lenses of
specular.two_interfaces.lens (Wyman, Dachsbacher 2008, section 4.2). Two more say which of a lens's terms is missing: `oblique` is
the thick lens with each surface's power as a ray meets it at a slant, (n' cos θ' − n cos θ) / R in place of (n' − n) / R; `Coddington` has the squares of
the cosines along the plane too (Coddington's equations), and must be the exact one.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

LAMP, RADIUS, IOR, SCREEN = 3.0, 0.5, 1.5, 0.9  # m from the ball's middle, as experiments/scenes/glass-sphere.toml has them
PLACES = [0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99]
STEP = 1e-6  # rad
COLUMNS = ["of the radius", "status", "tangential", "sagittal", "beam", "thin", "thick", "oblique", "Coddington", "thin of beam", "thick of beam",
           "oblique of beam"]


def trace(angle: float) -> dict:
    """The ray that leaves the lamp at `angle`, rad, from the axis."""
    along, across = math.cos(angle), math.sin(angle)
    to_ball = LAMP * along - math.sqrt(RADIUS**2 - (LAMP * across)**2)
    x, y = to_ball * along - LAMP, to_ball * across
    cos_out = -(along * x + across * y) / RADIUS
    cos_in = math.sqrt(1.0 - (1.0 - cos_out**2) / IOR**2)
    way = 2.0 * RADIUS * cos_in
    # Bent twice by the same angle.
    bend = math.acos(cos_out) - math.acos(cos_in)
    within, beyond = angle - bend, angle - 2.0 * bend
    x, y = x + way * math.cos(within), y + way * math.sin(within)
    to_screen = (SCREEN - x) / math.cos(beyond)
    return {"height": y + to_screen * math.sin(beyond), "direction": beyond, "to ball": to_ball, "way": way, "to screen": to_screen,
            "outside": cos_out, "inside": cos_in}


def moved(width: float, growth: float, way: float) -> tuple[float, float]:
    return width + way * growth, growth


def through(ray: dict, power: float, outside: float = 1.0, inside: float = 1.0) -> float:
    """The width on the screen by two surfaces of that power, 1/m; with the cosines along the plane, otherwise across it."""
    width, growth = moved(0.0, 1.0, ray["to ball"])
    vergence = (outside**2 * growth / width - power) / (IOR * inside**2)
    width *= inside / outside
    width, growth = moved(width, vergence * width, ray["way"])
    vergence = (IOR * inside**2 * growth / width - power) / outside**2
    width *= outside / inside
    return moved(width, vergence * width, ray["to screen"])[0]


def thin(ray: dict) -> float:
    width, growth = moved(0.0, 1.0, ray["to ball"] + 0.5 * ray["way"])
    growth -= (IOR - 1.0) * 2.0 / RADIUS * width
    return moved(width, growth, 0.5 * ray["way"] + ray["to screen"])[0]


def row_at(place: float) -> list:
    angle = math.asin(place * RADIUS / LAMP)
    ray, more, less = trace(angle), trace(angle + STEP), trace(angle - STEP)
    tangential = abs((more["height"] - less["height"]) / (2.0 * STEP) * math.cos(ray["direction"]))
    sagittal = abs(ray["height"] / math.sin(angle))
    beam = math.sqrt(tangential * sagittal)
    outside, inside = ray["outside"], ray["inside"]
    slanted = (IOR * inside - outside) / RADIUS
    thick, oblique = abs(through(ray, (IOR - 1.0) / RADIUS)), abs(through(ray, slanted))
    coddington = math.sqrt(abs(through(ray, slanted, outside, inside)) * oblique)
    lens = abs(thin(ray))
    return [place, "done", tangential, sagittal, beam, lens, thick, oblique, coddington, lens / beam, thick / beam, oblique / beam]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--csv", type=Path, default=Path(__file__).resolve().parents[2] / "results/wyman2008/lens_widths.csv")
    arguments = parser.parse_args()
    with arguments.csv.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row_at(place)] for place in PLACES)
    return 0


if __name__ == "__main__":
    sys.exit(main())
