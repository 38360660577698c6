#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What finer photons where paths part gain over a plain grid of photons.

    refined.py FILE

FILE: what table.py --csv keeps of refined.toml. Prints Markdown: a row for each scene and number of photons along a side of the grid; relMSE net of the
reference's noise by the plain grid, and for each driver.dense.refine that error, how many times as many photons a plain grid emits for it, and how many
times as long that takes; both between the scene's runs without refinement, in the logarithms. > and < where even most of these have a larger error, or
the fewest a smaller one; – where the error is below the reference's noise.
"""

import argparse
import csv
import math
import pathlib
from collections import defaultdict

from table import number


def net(row: dict) -> float | None:
    error, own = number(row, "relMSE"), number(row, "relMSE, reference's own")
    if error is None:
        return None
    return error - (own or 0.0) if error > 1.2 * (own or 0.0) else None


def needed(points: list[tuple[float, float]], error: float) -> tuple[str, float]:
    """The first of points (cost, error) at an error, and whether it is a bound."""
    points = sorted(points)
    if points[0][1] <= error:
        return "<", points[0][0]
    for (x0, e0), (x1, e1) in zip(points, points[1:]):
        if e1 <= error:
            return "", x0 * (x1 / x0) ** (math.log(e0 / error) / math.log(e0 / e1))
    return ">", points[-1][0]


def table(file: pathlib.Path) -> str:
    scenes: dict = defaultdict(dict)
    with file.open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            scenes[row["scene"]][row["emit.photons"], int(row["driver.dense.refine"])] = row
    refinements = sorted({refine for rows in scenes.values() for _, refine in rows if refine > 1})
    lines = ["| scene | photons | plain: relMSE; ms | " + " | ".join(f"{refine}: relMSE; fewer photons; sooner" for refine in refinements) + " |",
             "|" + " --- |" * (3 + len(refinements))]
    for scene, rows in sorted(scenes.items()):
        plain = [row for (_, refine), row in rows.items() if refine == 1 and net(row)]
        by_photons = [(number(row, "emitted"), net(row)) for row in plain]
        by_time = [(number(row, "ms"), net(row)) for row in plain]
        for photons in sorted({photons for photons, refine in rows if refine > 1}, key=lambda name: int(name.split("x")[0])):
            first = rows[photons, 1]
            cells = [f"{net(first):.2g}; {number(first, 'ms'):.0f}" if net(first) else f"–; {number(first, 'ms'):.0f}"]
            for refine in refinements:
                row = rows.get((photons, refine))
                error = net(row) if row else None
                if error is None or not plain:
                    cells.append("–")
                    continue
                fewer, count = needed(by_photons, error)
                faster, time = needed(by_time, error)
                cells.append(f"{error:.2g}; {fewer}{count / number(row, 'emitted'):.2g}; {faster}{time / number(row, 'ms'):.2g}")
            lines.append(f"| `{scene}` | {photons.replace('x', '×')} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    print(table(parser.parse_args().file))


if __name__ == "__main__":
    main()
