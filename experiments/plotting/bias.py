#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where techniques are wrong by more than the reference's noise: a sheet a scene of the study bias.toml, with a picture a technique.

    bias.py RESULTS --out DIR

RESULTS is the folder of `kaustik experiment run experiments/bias.toml`. Writes DIR/SCENE.jpg from each run's bias.png: the z-test of every pixel against the paths that
the technique models (framework/measure/bias.h), orange where it is too bright, blue where it is too dark; above it the shares of pixels that are so. By chance it
would be one in a thousand.
"""

import argparse
import csv
import sys
from pathlib import Path

from PIL import Image

from figures import plt

COLUMNS = 4


def sheet(scene: str, rows: list[dict], results: Path, file: Path) -> None:
    lines = -(-len(rows) // COLUMNS)
    figure, cells = plt.subplots(lines, COLUMNS, squeeze=False, layout="constrained", figsize=(3.0 * COLUMNS, 2.6 * lines))
    for axes in cells.flat:
        axes.axis("off")
    for row, axes in zip(rows, cells.flat):
        with Image.open(results / row["folder"] / "bias.png") as picture:
            axes.imshow(picture.convert("RGB"), interpolation="antialiased")
        bright, dark = (100.0 * float(row[f"error.bias.{name}"]) for name in ("too_bright", "too_dark"))
        axes.set_title(f"{row['technique']}: {bright:.1f} % too bright, {dark:.1f} % too dark", fontsize=7)
    figure.suptitle(scene, fontsize=10)
    figure.savefig(file, dpi=130, pil_kwargs={"quality": 85})
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    table = arguments.results / "runs.csv"
    if not table.is_file():
        sys.exit(f"bias: there is no '{table}'")
    with table.open(newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["status"] == "done"]
    if missing := [row["technique"] for row in rows if not (arguments.results / row["folder"] / "bias.png").is_file()]:
        sys.exit(f"bias: the run of {missing[0]} has no bias.png; it needs a reference")
    arguments.out.mkdir(parents=True, exist_ok=True)
    for scene in sorted({row["scene"] for row in rows}):
        sheet(scene, [row for row in rows if row["scene"] == scene], arguments.results, arguments.out / f"{scene}.jpg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
