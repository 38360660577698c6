#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What triangles bring against sprites on every scene, from the study reconstructions.toml or its CSV, in Markdown.

    reconstructions.py RESULTS
"""

import sys
from collections import defaultdict
from pathlib import Path

from runs import head, line, ms_of, passes_of, print_table, runs_of, scene_of


def scenes(rows: list[dict]) -> None:
    print(head(["scene", "relMSE, sprites", "relMSE, triangles", "less by", "reconstruct, ms", "emission to reconstruction, ms", "frame, ms"]))
    found: dict = defaultdict(dict)
    for row in rows:
        found[scene_of(row)][row["reconstruct"]] = row["report"]
    for scene, by in sorted(found.items()):
        ways = [by["sprites"], by["triangles"]]
        # What `beams` and `triangles` share of the flux's map is passes of the stage too.
        if not any(name.startswith("trace.") for name in passes_of(ways[0])):
            print(line([f"`{scene}`", *("–" for _ in range(6))]))
            continue
        errors = [report["error"]["caustic_irradiance"]["rel_mse"] for report in ways]
        times = [[ms_of(report, starts) for report in ways] for starts in (("reconstruct.",), ("emit.", "specular.", "trace.", "reconstruct."))]
        frames = [f"{report['frame_ms']['median']:.0f} ± {report['frame_ms']['stdev']:.0f}" for report in ways]
        print(line([f"`{scene}`", *(f"{error:.4g}" for error in errors), f"{errors[0] / errors[1]:.1f}",
                    *(f"{before:.0f} → {after:.0f}" for before, after in times), " → ".join(frames)]))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    sys.exit(print_table(scenes, runs_of(Path(sys.argv[1]))))
