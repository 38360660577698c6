#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What an error costs, from a study of photons and reconstructions (equal_error.toml): the time from
emission to reconstruction at which each reaches the error of another, interpolated between its own
runs in the logarithms of both, with the error bars that one standard deviation of the times gives.

    equal_error.py RESULTS|CSV [--base sprites] [--photons 256x256] [--against reconstruct]

Prints a table in Markdown. A curve that does not come down to the error, or is below it with its
fewest photons already, is said to be beyond its range: its end is a bound, not a figure.
"""

import argparse
import math
import sys
from collections import defaultdict
from pathlib import Path

from runs import runs_of

STAGES = ("emit.", "specular.", "trace.", "reconstruct.")
ERROR = "caustic_irradiance"


class Run:
    """One run's cost, ms, and error."""

    def __init__(self, report: dict):
        times = [p["gpu_ms"] for p in report["passes"]
                 if p.get("ran") and "gpu_ms" in p and p["name"].startswith(STAGES)]
        self.milliseconds = sum(time["median"] for time in times)
        if all("stdev" in time for time in times):
            self.spread = math.sqrt(sum(time["stdev"] ** 2 for time in times))
        else:  # a runs.csv has the whole frame's
            self.spread = self.milliseconds * report["frame_ms"]["stdev"] / report["frame_ms"]["mean"]
        self.error = report["error"][ERROR]["rel_mse"]


def time_at(runs: list[Run], error: float, shift: float) -> tuple[float, str]:
    """The time of a curve at an error, and "" or how the curve ends before it: "<" where it costs
    less than this, ">" where it costs more. `shift`: by how many standard deviations it is slower."""
    curve = sorted((run.milliseconds + shift * run.spread, run.error) for run in runs)
    curve = [(max(time, 1e-6), max(err, 1e-12)) for time, err in curve]
    if curve[0][1] <= error:
        return curve[0][0], "<"
    for (t0, e0), (t1, e1) in zip(curve, curve[1:]):
        if e1 <= error:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** share, ""
    return curve[-1][0], ">"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--base", default="sprites", help="whose error is to be reached")
    parser.add_argument("--photons", default="256x256", help="at how many photons of its")
    parser.add_argument("--against", default="reconstruct,reconstruct.beams.shape",
                        help="the settings that are compared, between commas")
    arguments = parser.parse_args()
    rows = runs_of(arguments.results)
    curves: dict = defaultdict(lambda: defaultdict(list))
    at_base = {}
    for row in rows:
        scene = row["scene"]
        choices = [row.get(key) for key in arguments.against.split(",")]
        which = ", ".join(choice for choice in choices if choice)
        run = Run(row["report"])
        curves[scene][which].append(run)
        if which == arguments.base and row["emit.photons"] == arguments.photons:
            at_base[scene] = run
    others = sorted({which for curve in curves.values() for which in curve} - {arguments.base})
    print("| scene | relMSE | " + f"`{arguments.base}`, ms | "
          + " | ".join(f"`{other}`, ms | times faster" for other in others) + " |")
    print("| --- " * (3 + 2 * len(others)) + "|")
    for scene, curve in curves.items():
        base = at_base.get(scene)
        if base is None:
            continue
        cells = [f"`{scene}`", f"{base.error:.3g}", f"{base.milliseconds:.0f}"]
        for other in others:
            time, end = time_at(curve[other], base.error, 0.0)
            fast, _ = time_at(curve[other], base.error, -1.0)
            slow, _ = time_at(curve[other], base.error, 1.0)
            bound = {"<": "≥ ", ">": "≤ ", "": ""}[end]
            low = (base.milliseconds - base.spread) / slow
            high = (base.milliseconds + base.spread) / max(fast, 1e-6)
            cells.append({"<": "≤ ", ">": "≥ ", "": ""}[end] + f"{time:.0f}")
            cells.append(f"{bound}{base.milliseconds / time:.1f} ({low:.1f} to {high:.1f})")
        print("| " + " | ".join(cells) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
