#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What exact tracing on the device costs and gains next to screen space.

    exact_rays.py slim FOLDER --csv FILE
    exact_rays.py errors FILE
    exact_rays.py times FILE

slim: of the report.json of all runs below a folder what is committed. errors: a row a scene: relMSE of the caustic, percent of the photons whose hit
is wrong, relMSE of what the eye sees through specular surfaces, percent of the receivers that are wrongly lit or in shadow; by screen space; exact.
times: a row a scene: ms of a frame, and of the passes of photons' tracing, the view and shadows, by each way that the file has runs of. Both print
Markdown.
"""

import argparse
import csv
import json
import pathlib
import sys

from sources import keys_noted

COLUMNS = ["scene", "trace", "view", "shadow", "size", "emit.photons", "relMSE", "wrong hits", "view relMSE", "wrong shadows", "ms", "trace, ms",
           "view, ms", "shadow, ms", "layers, ms", "reconstruct, ms", "geometry, ms", "device", "version", "date", "other_processors", "sources"]
WAYS = {("hierarchical", "refraction", "map"): "fragments", ("hierarchical_compute", "refraction", "map"): "compute",
        ("raytraced", "refraction", "map"): "processor", ("bvh", "refraction", "map"): "exact photons", ("bvh", "bvh", "bvh"): "all exact",
        ("raytraced", "bvh", "bvh"): "all by the processor"}


def way_of(row: dict) -> str | None:
    return WAYS.get((row["trace"], row["view"], row["shadow"]))


def digits(value: float | None) -> str:
    return "" if value is None else f"{value:.5g}"


def below(report: dict, *keys: str):
    for key in keys:
        report = report.get(key) if isinstance(report, dict) else None
    return report


def slim(file: pathlib.Path) -> dict:
    report = json.loads(file.read_text(encoding="utf-8"))
    passes: dict[str, float] = {}
    for entry in report["passes"]:
        if entry["ran"] and "gpu_ms" in entry:
            passes[entry["stage"]] = passes.get(entry["stage"], 0.0) + entry["gpu_ms"]["median"]
    device = report["device"]
    agreement = below(report, "hits", "agreement")
    row = {"scene": below(report, "scene", "name"), "size": "x".join(map(str, report["size"])), "version": report["version"],
           "relMSE": digits(below(report, "error", "caustic_irradiance", "rel_mse")), "wrong hits": digits(None if agreement is None else 1.0 - agreement),
           "view relMSE": digits(below(report, "error", "view", "radiance", "rel_mse")),
           "wrong shadows": digits(below(report, "error", "shadow", "misclassified")), "ms": digits(report["frame_ms"]["median"]),
           "device": f"{device['renderer']}, {device['cpu']}, {device['threads']} threads", "date": report["timing"]["date"],
           "other_processors": digits(below(report, "timing", "other_processors")),
           "sources": keys_noted(file.parents[1]).get(file.parent.name, "")}
    row |= {key: report["parameters"][key] for key in ("trace", "view", "shadow", "emit.photons")}
    return row | {f"{stage}, ms": digits(passes.get(stage, 0.0)) for stage in ("trace", "view", "shadow", "layers", "reconstruct", "geometry")}


def write(folder: pathlib.Path, target: pathlib.Path) -> None:
    rows = [row for file in folder.rglob("report.json") if way_of(row := slim(file))]
    if not rows:
        sys.exit(f"exact_rays: {folder} holds no run of exact_rays.toml")
    order = list(WAYS.values())
    rows.sort(key=lambda row: (row["scene"], order.index(way_of(row))))
    target.parent.mkdir(parents=True, exist_ok=True)
    with target.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def by_scene(file: pathlib.Path) -> dict[str, dict[str, dict]]:
    scenes: dict[str, dict[str, dict]] = {}
    with file.open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            scenes.setdefault(row["scene"], {})[way_of(row)] = row
    return scenes


def of(row: dict | None, key: str, scale: float = 1.0) -> str:
    if row is None or row[key] == "":
        return "–"
    value = scale * float(row[key])
    return f"{value:.1e}" if 0.0 < value < 0.001 else f"{value:.2g}"


def errors(file: pathlib.Path) -> str:
    lines = ["| scene | relMSE of the caustic | wrong hits, % | relMSE of the view | wrong shadows, % |", "|" + " --- |" * 5]
    for scene, ways in by_scene(file).items():
        screen, exact = ways.get("fragments"), ways.get("all exact")
        cells = [f"{of(screen, key, scale)}; {of(exact, key, scale)}"
                 for key, scale in (("relMSE", 1.0), ("wrong hits", 100.0), ("view relMSE", 1.0), ("wrong shadows", 100.0))]
        lines.append(f"| `{scene}` | " + " | ".join(cell if cell != "–; –" else "–" for cell in cells) + " |")
    return "\n".join(lines)


def ms(row: dict | None, key: str) -> str:
    if row is None:
        return "–"
    value = float(row[key])
    return f"{value:.1f}" if value < 100.0 else f"{value:.0f}"


def times(file: pathlib.Path) -> str:
    scenes = by_scene(file)
    ways = [way for way in WAYS.values() if any(way in found for found in scenes.values())]
    lines = ["| scene | " + " | ".join(ways) + " |", "|" + " --- |" * (len(ways) + 1)]
    for scene, found in scenes.items():
        cells = []
        for way in ways:
            row = found.get(way)
            cells.append("–" if row is None else f"{ms(row, 'ms')}: {ms(row, 'trace, ms')}, {ms(row, 'view, ms')}, {ms(row, 'shadow, ms')}")
        lines.append(f"| `{scene}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["slim", "errors", "times"])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        if arguments.what == "slim":
            if not arguments.csv:
                sys.exit("exact_rays: slim needs --csv")
            write(arguments.file, arguments.csv)
        else:
            print((errors if arguments.what == "errors" else times)(arguments.file))
    except (OSError, KeyError) as error:
        sys.exit(f"exact_rays: {arguments.file} is not what {arguments.what} takes: {error}")


if __name__ == "__main__":
    main()
