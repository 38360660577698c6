#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where the error of each technique comes from: noise, photons, pixels, and what stays.

    error_parts.py RESULTS --out DIR [--keep]

RESULTS is the folder of error_parts.toml, or of some of its scenes: with --keep the others stay as DIR has them. Writes DIR/parts.csv and DIR/parts.svg. The four parts add up to the relMSE of the caustic's
irradiance at the study's middle number of photons, net of the reference's own noise:

- noise: the variance, pixel by pixel, between runs with nearly as many photons whose cells lie elsewhere. Another start of the grid would
  give another picture; this is what the mean over many would lose.
- photons: of the rest, the bias, what infinitely many photons would take away: the biases of the three counts, extrapolated (Aitken:
  each step to four times as many changes by the same factor); where they do not fall that way, or to below 0, down to the most photons'
  alone (`extrapolated` is false).
- pixels: by how much the bias is less where the frame is rendered with twice the pixels a side, has lost that frame's own noise and is
  brought back to the size by its mean.
- stays: what is left: what the method leaves out or approximates.

A part may be negative: estimates are noisy, more pixels may be worse, and more photons and finer pixels may take away the same.
"""

import argparse
import csv
import json
import math
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

import drawings
from figures import COLORS, plt
from pictures import find_image, read_image
from sources import keys_noted
from study import device_of

FEWEST = 8  # runs: three counts of photons, two repeats of the middle one, the same three with finer pixels
PARTS = ("noise", "photons", "pixels", "stays")
IN_PART = "runs are there"  # how the status of a line ends of which more are missing
COLUMNS = ("scene", "technique", "status", "relMSE", *PARTS, "extrapolated", "version", "device", "sources", "date", "other_processors")


class Runs:
    """All runs of one technique on one scene, by size and photons."""

    def __init__(self, results: Path, rows: list[dict]):
        self.results = results
        self.rows = {(row["size"], self.photons(row)): row for row in rows if row["status"] == "done"}

    @staticmethod
    def photons(row: dict) -> int:
        return int(row["emit.photons"].split("x")[0])

    def image(self, size: str, photons: int, name: str) -> np.ndarray:
        return read_image(find_image(self.results / self.rows[size, photons]["folder"], name, (".exr", ".pfm")))

    def error(self, size: str, photons: int) -> dict:
        report = json.loads((self.results / self.rows[size, photons]["folder"] / "report.json").read_text())
        return report["error"]["caustic_irradiance"]


def halved(image: np.ndarray) -> np.ndarray:
    """The mean of two by two pixels."""
    height, width = image.shape[0] // 2, image.shape[1] // 2
    return image.reshape(height, 2, width, 2, -1).mean(axis=(1, 3))


def limit_of(few: float, middle: float, many: float) -> tuple[float, bool]:
    """What biases fall to with ever more photons, and whether that is extrapolated. A bias is a mean of squares: where the two steps
    are nearly the same, Aitken's limit may be anything, and one below 0 is none."""
    steps = few - middle, middle - many
    limit = many - steps[1] ** 2 / (steps[0] - steps[1]) if 0.0 < steps[1] < steps[0] else -math.inf
    rounding = 1e-5 * abs(few)  # of 32-bit pictures
    return (max(limit, 0.0), True) if limit >= -rounding else (many, False)


def parts_of(runs: Runs) -> dict:
    """Of relMSE, as `kaustik compare` defines it: the mean over channels and pixels of the squared difference by the squared reference
    and an epsilon."""
    sizes = sorted({size for size, _ in runs.rows}, key=lambda size: int(size.split("x")[0]))
    size, fine = sizes[0], sizes[-1]
    counts = sorted({photons for of, photons in runs.rows if of == size})
    few, middle, many = counts[0], counts[len(counts) // 2], counts[-1]
    repeats = counts[1:-1]

    truth = runs.image(size, middle, "reference")
    measured = runs.error(size, middle)
    epsilon = measured["formulas"]["rel_mse"]["epsilon"]
    weight = 1.0 / (truth.astype(np.float64) ** 2 + epsilon)

    def relative(square: np.ndarray) -> float:
        return float((square * weight).mean())

    # The mean over all pixels and that over those with a receiver differ by their share alone.
    def mse(photons: int, of: str = size) -> float:
        image = runs.image(of, photons, "caustic")
        return relative(((image if of == size else halved(image)) - truth) ** 2)

    share = measured["rel_mse"] / max(mse(middle), 1e-300)
    truths = (measured.get("truth_noise") or {}).get("rel_mse") or 0.0

    def variance(of: str) -> float:
        images = [runs.image(of, photons, "caustic").astype(np.float64) for photons in repeats]
        return share * relative(np.stack([image if of == size else halved(image) for image in images]).var(axis=0, ddof=1))

    noise = variance(size)

    def bias(photons: int) -> float:
        # Noise is known for the middle alone; its square falls as the photons rise.
        return share * mse(photons) - truths - noise * (middle / photons) ** 2

    limit, extrapolated = limit_of(bias(few), bias(middle), bias(many))
    pixels = bias(middle) - (share * mse(middle, fine) - truths - variance(fine))
    return {"relMSE": share * mse(middle) - truths, "noise": noise, "photons": bias(middle) - limit, "pixels": pixels,
            "stays": limit - pixels, "extrapolated": str(extrapolated).lower()}


def of_the_runs(group: list[dict], keys: dict[str, str]) -> dict:
    """What a line says of its runs: what all of them have, the last day, the most that other work took. Of several sources, or of one that is not known, none."""
    def shared(values: set[str]) -> str:
        return values.pop() if len(values) == 1 else ""

    return {"version": group[0].get("version", ""), "device": shared({device_of(row) for row in group}),
            "sources": shared({keys.get(row.get("folder", ""), "") for row in group}), "date": max(row.get("date") or "" for row in group),
            "other_processors": max((row.get("other_processors") or "" for row in group), key=lambda load: float(load or -1.0))}


def tabled(results: Path) -> list[dict]:
    keys = keys_noted(results)
    with (results / "runs.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    by = defaultdict(list)
    for row in rows:
        by[row.get("scene", ""), row.get("technique", "")].append(row)
    wanted = max(len(group) for group in by.values())
    table = []
    for (scene, technique), group in sorted(by.items()):
        line = {"scene": scene, "technique": technique, **of_the_runs(group, keys)}
        failed = next((row for row in group if row["status"] != "done"), None)
        if failed or len(group) < wanted:
            line["status"] = failed["message"].split(",")[0] if failed else f"{len(group)} of {wanted} {IN_PART}"
        elif wanted < FEWEST:
            line["status"] = f"{wanted} runs are too few to tell parts"
        else:
            runs = Runs(results, group)
            try:
                line |= {"status": "done", **parts_of(runs)}
            except TypeError:
                line["status"] = "its error has no number"
        table.append(line)
    return table


def with_those_of_before(table: list[dict], file: Path) -> list[dict]:
    """And the lines that were written before: all that there are not anew, or only in part."""
    if not file.is_file():
        return table
    with file.open(newline="", encoding="utf-8") as stream:
        before = {(line["scene"], line["technique"]): line for line in csv.DictReader(stream)}
    lines = {key: line | {part: float(line[part]) for part in ("relMSE", *PARTS) if line[part]} for key, line in before.items()}
    lines |= {(line["scene"], line["technique"]): line for line in table
              if not (line["status"].endswith(IN_PART) and (line["scene"], line["technique"]) in before)}
    return [line for _, line in sorted(lines.items())]


def draw(table: list[dict], file: Path) -> None:
    """A row of bars a scene, a bar a technique: its parts as shares of relMSE, which stands above it."""
    done = [line for line in table if line["status"] == "done"]
    scenes = sorted({line["scene"] for line in done})
    techniques = sorted({line["technique"] for line in done})
    figure, rows = plt.subplots(len(scenes), 1, figsize=(0.9 * len(techniques) + 2, 1.5 * len(scenes) + 1), sharex=True,
                                squeeze=False)
    for scene, axes in zip(scenes, rows[:, 0]):
        for line in (line for line in done if line["scene"] == scene):
            at, low = techniques.index(line["technique"]), 0.0
            whole = sum(max(line[part], 0.0) for part in PARTS) or 1.0
            for part, color in zip(PARTS, COLORS):
                height = max(line[part], 0.0) / whole
                axes.bar(at, height, bottom=low, color=color, label=part if at == 0 and scene == scenes[0] else None)
                low += height
            axes.text(at, 1.03, f"{line['relMSE']:.1e}", ha="center", fontsize=6)
        axes.set(ylim=(0, 1.25), yticks=[0, 1])
        axes.set_ylabel(scene, rotation=0, ha="right", va="center", fontsize=8)
    rows[-1, 0].set_xticks(range(len(techniques)), techniques, rotation=30, ha="right", fontsize=8)
    handles = [plt.Rectangle((0, 0), 1, 1, color=color) for color in COLORS[:len(PARTS)]]
    rows[0][0].legend(handles, PARTS, loc="lower center", bbox_to_anchor=(0.5, 1.15), ncols=len(PARTS), fontsize=8, frameon=False)
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata([file.with_name("parts.csv")]))
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    if not (arguments.results / "runs.csv").is_file():
        sys.exit(f"error_parts: there is no '{arguments.results / 'runs.csv'}'")
    table = tabled(arguments.results)
    arguments.out.mkdir(parents=True, exist_ok=True)
    if arguments.keep:
        table = with_those_of_before(table, arguments.out / "parts.csv")
    with (arguments.out / "parts.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n", restval="")
        writer.writeheader()
        writer.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in line.items()} for line in table)
    if any(line["status"] == "done" for line in table):
        draw(table, arguments.out / "parts.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
