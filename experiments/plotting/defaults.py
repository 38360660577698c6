#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What following both branches of light brings and costs, from the study defaults.toml: for each scene the
photons that are traced, all lists together, the errors of the caustic against all paths, and what of the
light is not followed.

    defaults.py RESULTS

Prints a table in Markdown. Errors of a picture that has no caustic are left empty.
"""

import argparse
import csv
import sys
from collections import defaultdict
from pathlib import Path


def name_of(row: dict) -> str:
    """What a run's rule is called in the table."""
    levels = row.get("specular.split.levels")
    return f"{row['specular']}, {levels}" if levels and row["specular"] == "split" else row["specular"]


def number(row: dict, key: str, form: str) -> str:
    """A cell of the table; empty where the run has no such number."""
    text = row.get(key) or ""
    return format(float(text), form) if text else ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    arguments = parser.parse_args()
    table = arguments.results / "runs.csv"
    if not table.is_file():
        print(f"defaults: '{table}' is not there; is '{arguments.results}' the results of "
              "'kaustik experiment run'?", file=sys.stderr)
        return 1
    with table.open(newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if row.get("status") == "done"]
    scenes = defaultdict(list)
    for row in rows:
        scenes[row["scene"]].append(row)
    print("| scene | `specular` | traced | relMSE | SMAPE | HDR FLIP | energy ratio | not followed |")
    print("| --- " * 8 + "|")
    for scene, runs in sorted(scenes.items()):
        for row in sorted(runs, key=name_of):
            emitted = float(row.get("energy.emitted_w") or 0.0)
            untraced = float(row.get("energy.lost_w.untraced_branch") or 0.0)
            share = f"{100.0 * untraced / emitted:.2f} %" if emitted > 0.0 else ""
            error = "error.caustic_irradiance."
            print(f"| `{scene}` | `{name_of(row)}` | {number(row, 'photons.traced', ',.0f')} | "
                  f"{number(row, error + 'rel_mse', '.2g')} | "
                  f"{number(row, error + 'smape', '.3f')} | {number(row, error + 'flip_hdr', '.3f')} | "
                  f"{number(row, error + 'energy_ratio', '.3f')} | {share} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
