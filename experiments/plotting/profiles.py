#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where the time of a technique goes on each scene, and how much of its light is chaotic.

    profiles.py RESULTS --out FILE [--technique NAME...] [--photons 256x256] [--keep]

RESULTS is a folder of `kaustik experiment run`, of all_techniques.toml; with --keep the file keeps its rows of what has no run there. Writes a row a technique and scene: the time of the passes of the caustic
(as in table.py, without what a medium scatters), in ms, and what of it goes into

- surfaces: what is made of the scene's geometry before any photon, depth layers and hierarchies of triangles;
- emission: what lights see, and photons from it;
- tracing: through specular surfaces and to where they land;
- spreading: beams, triangles and splats of them over pixels;
- gathering: of all that into the eye's pixels.

`chaotic` is the share of the flux that is spread by beams of cells of their own: those whose photons have no neighbour that took the same path to the same surface near
by, so that nothing is known of the light between them. Empty where a technique joins no photons.
"""

import argparse
import csv
import sys
from pathlib import Path

from maker import rows_in, write_whole
from sources import keys_noted
from study import device_of
from table import CAUSTIC, OF_THE_RUN, number, rounded, sum_of_passes, timed

PARTS = {"surfaces": ("geometry.", "layers."), "emission": ("driver.", "emit.", "refine.", "generator.", "light."), "tracing": ("specular.", "trace.", "around."),
         "spreading": ("reconstruct.", "filter.", "temporal."), "gathering": ("gather.",)}
COLUMNS = ("technique", "scene", "status", "ms", *PARTS, "chaotic", *OF_THE_RUN)
MEDIUM = "media."
PRIMITIVES = "energy.primitives."


def chaotic_of(row: dict) -> float | None:
    shares = {kind: number(row, PRIMITIVES + kind) or 0.0 for kind in ("beams", "triangles", "splats")}
    return shares["beams"] / sum(shares.values()) if shares["beams"] + shares["triangles"] > 0.0 else None


def profiled(row: dict) -> dict:
    """COLUMNS of a run that is done, but its status and what it is."""
    times = {part: sum_of_passes(row, passes) or 0.0 for part, passes in PARTS.items()}
    whole = timed(row, sum(times.values()))
    return {"ms": whole or None, **{part: time / whole if whole else None for part, time in times.items()}, "chaotic": chaotic_of(row)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--technique", nargs="+", default=["exact_rays", "screen_space_photons"])
    parser.add_argument("--photons", default="256x256")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    table = arguments.results / "runs.csv"
    if not table.is_file():
        print(f"profiles: '{table}' is not there; is '{arguments.results}' the results of 'kaustik experiment run'?", file=sys.stderr)
        return 1
    with table.open(newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    keys = keys_noted(arguments.results)
    chosen = [row for row in rows if row["technique"] in arguments.technique and row.get("emit.photons", arguments.photons) == arguments.photons and row.get("as_published") != "true" and row["status"] == "done"]
    made = {(row["technique"], row["scene"]): row for row in (rows_in(arguments.out) if arguments.keep else [])}
    for row in chosen:
        of_the_run = {key: row.get(key, "") for key in OF_THE_RUN} | {"device": device_of(row), "sources": keys.get(row["folder"], "")}
        values = {key: "" if value is None else rounded(str(value)) for key, value in profiled(row).items()}
        made[row["technique"], row["scene"]] = {"technique": row["technique"], "scene": row["scene"], "status": "done", **values, **of_the_run}
    write_whole(arguments.out, list(COLUMNS), [made[of] for of in sorted(made)])
    return 0


assert sorted(start for starts in PARTS.values() for start in starts) == sorted(start for start in CAUSTIC if start != MEDIUM), "each pass of the caustic is in one part"

if __name__ == "__main__":
    sys.exit(main())
