#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Soft and colored caustics next to the sharp ones that they come from, at equal time.

    soft_and_colored.py FILE

FILE: what table.py --csv keeps of soft_and_colored.toml. Prints Markdown: a row for each scene whose lamp has a size, by points and widened, or
whose glass disperses, and the scene that it comes from; relMSE within a time of the caustic's passes, between a scene's runs in the logarithms
of both. "–" where the run with the fewest photons takes longer; ≤ where the one with the most takes less, whose error it is.
"""

import argparse
import csv
import pathlib
from collections import defaultdict

from speed_error import least
from table import number

SHARP = {"bulb_ball": "glass-sphere", "panel_ball": "glass-sphere", "sky_ball": "", "sun_pool": "pool", "wide_sun_pool": "pool", "sun_ring": "ring",
         "flint_ball": "sharp_ball", "prism": "sharp_prism"}
TIMES_MS = [50, 100, 200, 500, 1000]


def curves(file: pathlib.Path) -> dict[tuple[str, str], list[tuple[float, float]]]:
    """Time and error of each run, by scene and by how its light is widened."""
    found = defaultdict(list)
    with file.open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            time, error = number(row, "ms"), number(row, "relMSE")
            if time and error:
                scene = pathlib.PurePath(row["scene"]).stem
                found[scene, row.get("reconstruct.triangles.light_size") or "points"].append((time, error))
    return found


def at(points: list[tuple[float, float]], time: float) -> str:
    error = least(points, time)
    if error is None:
        return "–"
    beyond = time > max(first for first, _ in points)
    return ("≤ " if beyond else "") + (f"{error:.1e}" if error < 1e-3 else f"{error:.2g}")


def table(file: pathlib.Path) -> str:
    found = curves(file)
    lines = ["| scene | light | sharp scene | " + " | ".join(f"{time} ms: sharp; this" for time in TIMES_MS) + " |",
             "|" + " --- |" * (3 + len(TIMES_MS))]
    for (scene, light), points in sorted(found.items()):
        if scene not in SHARP:
            continue
        sharp = found.get((SHARP[scene], "points"), [])
        cells = [f"{at(sharp, time) if sharp else '–'}; {at(points, time)}" for time in TIMES_MS]
        light = "colored" if SHARP[scene].startswith("sharp") else light
        lines.append(f"| `{scene}` | {light} | {f'`{SHARP[scene]}`' if sharp else '–'} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    print(table(parser.parse_args().file))


if __name__ == "__main__":
    main()
