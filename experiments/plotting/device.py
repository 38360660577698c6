#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a device draws and takes, next to what another one does.

    device.py slim RUNS... --csv FILE
    device.py errors FILE
    device.py times FILE

slim: of one or more runs.csv of device_errors.toml or device_times.toml (or their folders) what is committed; a run that was refused has no row.
errors: relMSE of the caustic there, and over that of the same run of all_techniques.toml (results/all_techniques/runs.csv), which another
device has made: 1 where both draw the same picture. Prints Markdown, scenes by techniques. times: a row a run: the median of its frames, what 95 of
100 keep to, and its three slowest passes, ms.
"""

import argparse
import csv
import pathlib
import sys

from study import device_of
from table import number

ROOT = pathlib.Path(__file__).resolve().parents[2]
OTHER = ROOT / "results/all_techniques/runs.csv"
COLUMNS = ["scene", "technique", "emit.photons", "refine.finest", "ledger", "status", "relMSE", "energy", "emitted", "traced", "ms", "ms, p95", "slowest passes, ms",
           "device", "version", "date", "other_processors"]
SLOWEST = 3


def read(file: pathlib.Path) -> list[dict]:
    csv.field_size_limit(sys.maxsize)
    with (file / "runs.csv" if file.is_dir() else file).open(newline="") as stream:
        return list(csv.DictReader(stream))


def slowest(row: dict) -> str:
    passes = {key[5:]: time for key in row if key.startswith("pass:") and (time := number(row, key))}
    return "; ".join(f"{name} {passes[name]:.1f}" for name in sorted(passes, key=passes.get, reverse=True)[:SLOWEST])


def digits(row: dict, key: str) -> str:
    value = number(row, key)
    return "" if value is None else f"{value:.6g}"


def slim(row: dict) -> dict:
    named = {"relMSE": "error.caustic_irradiance.rel_mse", "energy": "error.caustic_irradiance.energy_ratio", "emitted": "photons.emitted",
             "traced": "photons.traced", "ms": "frame_ms.median", "ms, p95": "frame_ms.p95"}
    return {key: row.get(key, "") for key in COLUMNS} | {key: digits(row, name) for key, name in named.items()} | {
        "slowest passes, ms": slowest(row), "device": device_of(row)}


def write(files: list[pathlib.Path], target: pathlib.Path) -> None:
    rows = [slim(row) for file in files for row in read(file) if row["status"] == "done"]
    rows.sort(key=lambda row: row["scene"])  # otherwise in the study's own order
    target.parent.mkdir(parents=True, exist_ok=True)
    with target.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def same_run(row: dict) -> tuple:
    # Adaptive maps have no count of photons, and others no finest cell.
    is_adaptive = row["technique"] == "adaptive_caustic_map"
    has_vertices = row["technique"] == "vertex_caustics"
    return row["scene"], row["technique"], "" if is_adaptive or has_vertices else row["emit.photons"], row["refine.finest"] if is_adaptive else ""


def of(value: float) -> str:
    return f"{value:.1e}" if value < 0.001 else f"{value:.2g}"


def errors(rows: list[dict]) -> str:
    other = {same_run(row): number(row, "relMSE") for row in read(OTHER) if row["status"] == "done" and row["as_published"] != "true"}
    scenes = list(dict.fromkeys(row["scene"] for row in rows if row["relMSE"]))
    techniques = list(dict.fromkeys(row["technique"] for row in rows))
    lines = [" | ".join(["| scene", *(f"`{name}`" for name in techniques)]) + " |", "|" + " --- |" * (len(techniques) + 1)]
    for scene in scenes:
        cells = []
        for technique in techniques:
            found = [row for row in rows if (row["scene"], row["technique"]) == (scene, technique)]
            error = number(found[0], "relMSE") if found else None
            before = other.get(same_run(found[0])) if found else None
            cells.append("–" if error is None else f"{of(error)}; {error / before:.3f}" if before else of(error))
        lines.append(" | ".join([f"| `{scene}`", *cells]) + " |")
    return "\n".join(lines)


def photons(row: dict) -> str:
    if row["technique"] == "vertex_caustics":
        return "a vertex"
    side = row["emit.photons"].split("x")[0]
    if row["technique"] == "adaptive_caustic_map":
        return f"cells of {row['refine.finest']}"
    return f"{side}², no ledger" if row.get("ledger") == "false" else f"{side}²"


def times(rows: list[dict]) -> str:
    lines = ["| scene | technique | photons | ms | p95 | slowest passes, ms |", "|" + " --- |" * 6]
    lines += [f"| `{row['scene']}` | `{row['technique']}` | {photons(row)} | {number(row, 'ms'):.1f} | {number(row, 'ms, p95'):.1f} | "
              f"{row['slowest passes, ms']} |"
              for row in rows]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["slim", "errors", "times"])
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        if arguments.what == "slim":
            if not arguments.csv:
                sys.exit("device: slim needs --csv")
            write(arguments.files, arguments.csv)
        else:
            print((errors if arguments.what == "errors" else times)(read(arguments.files[0])))
    except (OSError, KeyError) as error:
        sys.exit(f"device: {arguments.files[0]} is not what {arguments.what} takes: {error}")


if __name__ == "__main__":
    main()
