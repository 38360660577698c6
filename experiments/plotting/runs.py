# SPDX-License-Identifier: MIT
"""The runs of a study with what their reports say, for programs that print tables of it: out of a folder of `kaustik experiment run`, or of
its runs.csv alone, as results/ keeps them. And how such tables are written."""

import csv
import json
import statistics
import sys
from pathlib import Path

from study import require_one_device

# What a runs.csv has of a report; all other columns are settings, which a report has among its parameters.
OF_A_REPORT = ("frame_ms", "photons", "layers", "hits", "error", "energy", "memory", "map", "cells", "timing", "scene")
STAGES = ("geometry.", "emit.", "specular.", "light.", "trace.", "reconstruct.", "filter.", "gather.",
          "temporal.", "layers.")


def as_value(text: str):
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def report_of(row: dict) -> dict:
    """As much of a run's report as its row of runs.csv has."""
    report: dict = {"passes": [], "parameters": {}, "technique": row.get("technique"),
                    "as_published": row.get("as_published") == "true"}
    for key, text in row.items():
        first, *rest = key.split(".")
        if text == "":
            continue
        if key.startswith("pass:"):
            report["passes"].append({"name": key.removeprefix("pass:"), "ran": True, "gpu_ms": {"median": float(text)}})
        elif first in OF_A_REPORT and rest:
            *way, last = rest
            at = report.setdefault(first, {})
            for part in way:
                at = at.setdefault(part, {})
            at[last] = as_value(text)
        else:
            report["parameters"][key] = as_value(text)
    return report


def runs_of(results: Path) -> list[dict]:
    """The rows that are done, each with its report, of a study's folder or of the CSV that is left of it. Ends the program where neither is there."""
    file = results / "runs.csv" if results.is_dir() else results
    if not file.is_file():
        sys.exit(f"{Path(sys.argv[0]).stem}: there is no '{file}'; is it of 'kaustik experiment run'?")
    with file.open(newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if row.get("status", "done") == "done"]
    if not rows:
        sys.exit(f"{Path(sys.argv[0]).stem}: no run of '{file}' is done")
    require_one_device(rows, results)
    for row in rows:
        report = file.parent / row.get("folder", ".") / "report.json"
        row["report"] = json.loads(report.read_text()) if report.is_file() else report_of(row)
    return rows


def passes_of(report: dict) -> dict[str, float]:
    """The median ms of each pass that ran, by its name."""
    return {one["name"]: one["gpu_ms"]["median"] for one in report["passes"] if one.get("ran") and "gpu_ms" in one}


def ms_of(report: dict, starts: tuple | str = STAGES) -> float:
    """Of all passes whose names start so; by default those that the caustic takes."""
    return sum(time for name, time in passes_of(report).items() if name.startswith(starts))


def maps_of(row: dict) -> tuple[int, int, int]:
    """How many maps the light is stored in, texels along the first one's side, and texels of all; 0, 0, 0 where there is none."""
    if "map" not in row["report"] and "schema" not in row["report"]:
        raise KeyError("map.count")  # a CSV of before it had this column
    found = row["report"].get("map") or {}
    if maps := found.get("maps"):
        return len(maps), maps[0]["size"][0], sum(m["size"][0] * m["size"][1] * m["views"] for m in maps)
    return found.get("count", 0), found.get("side", 0), found.get("texels", 0)


def scene_of(row: dict) -> str:
    return Path(row["scene"]).stem


def value(row: dict, key: str):
    return row["report"]["parameters"][key]


def error_of(row: dict) -> dict:
    """Against the paths that the photons model, where they do not model all."""
    judged = row["report"]["error"]
    return judged.get("modelled_paths", judged)["caustic_irradiance"]


def causes_of(rows: list[dict], causes: list[str]) -> list[str]:
    """Those that some run has lost light to."""
    return [cause for cause in causes if any(row["report"]["energy"].get("lost_w", {}).get(cause) for row in rows)]


def print_table(table, rows: list[dict], *arguments) -> int:
    """Of `rows`, which may be of a CSV that has less than reports have."""
    try:
        table(rows, *arguments)
    except KeyError as missing:
        print(f"{Path(sys.argv[0]).stem}: no run says {missing}, which '{table.__name__}' shows; a CSV has not all of a report: give the study's "
              "folder, or make it anew", file=sys.stderr)
        return 1
    return 0


def line(cells: list) -> str:
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def head(cells: list) -> str:
    return line(cells) + "\n" + line(["---"] * len(cells))


def spread(values: list[float]) -> str:
    return f"{statistics.median(values):.2f} ({min(values):.2f} to {max(values):.2f})"
