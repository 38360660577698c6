#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed against error over all techniques and scenes, against a light tracer on the same processor.

    speed_error.py [--results results/all_techniques]

Reads runs.csv (all_techniques.toml, by table.py --csv), light_tracer.csv (light_tracer.py) and, where it is there, best_mixtures.csv
(best_mixtures.toml; its runs are called "best mixture") in that folder, all of one machine (another
has a folder of its own; pages.py puts tables of several next to each other), and writes next to them

- equal_error.csv: each run, and how many photons and ms the light tracer needs for the same relMSE; `factor` is by how much the run is
  faster. Both errors are net of the reference's own noise. The light tracer's error falls as one over its photons, and its time grows
  with them: both are taken from its run with the most photons, the time less that of the run with the fewest. Where a run's
  error is not above the reference's noise the factor is a bound: `at_least`.
- to_error.csv: for each scene and error, the technique that is there first, its ms, interpolated between its runs in the logarithms of
  both, the second and by how much it is later.
- in_time.csv: the same the other way round: the least error within a time.
- costs.csv: what a photon costs each technique, and what all of them together do: the median over scenes of the slope between its runs with the
  fewest and the most photons, of time (also the least and the most) and memory, and of what is left at none; and the light that it does not form, on the scene where
  that is most.
- published.csv: what defaults change of each technique as published, with as many photons: the default's time and error as parts of the
  published ones and the gain in `factor`, medians over scenes with the least and the largest, and the scenes of these gains.
- SCENE.svg: error against time, the Pareto front drawn through; bars are the standard deviation of a run's frames, and below the shaded height errors
  are less than the reference's own noise.
- headline.svg: all scenes: the factors of equal_error.csv, of each technique's runs by default the one with the middle number of photons.
- answers.csv: the same as a table: for each scene the default's factor, and the technique with the largest.
- summary.csv: on how many scenes the default, and the best, are faster than the light tracer, and the least, the median and the largest factor.
"""

import argparse
import csv
import math
import pathlib
import statistics
import sys
from collections import defaultdict

import drawings
from figures import COLORS, MARKERS, pareto_front, plt
from study import require_one_device

ROOT = pathlib.Path(__file__).resolve().parents[2]
ERRORS = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4]
# What a user would pick instead: no techniques of ours, and no part of the front that is drawn.
LIGHT_TRACER, PHOTON_MAPPING = "light tracer", "progressive photon mapping"
BASELINES = {LIGHT_TRACER: ":", PHOTON_MAPPING: "-."}
DEFAULT, MIXTURE = "exact_rays", "best mixture"
MIDDLE = {"256x256", "1024"}  # photons along each side of the grid, or the finest cells
LEAST_FACTOR = 1e-4  # that is drawn
TIMES_MS = [50, 100, 200, 500, 1000, 2000]


def inputs(folder: pathlib.Path) -> list[pathlib.Path]:
    return [folder / name for name in drawings.DRAWN["all_techniques"][0]]


def rows_of(file: pathlib.Path) -> list[dict]:
    if not file.is_file():
        sys.exit(f"speed_error: there is no '{file}'")
    with file.open(newline="") as stream:
        return list(csv.DictReader(stream))


def number(row: dict, key: str) -> float | None:
    return float(row[key]) if row.get(key) else None


def net(row: dict) -> float | None:
    """relMSE without the part that the reference's own noise has in it."""
    error, noise = number(row, "relMSE"), number(row, "relMSE, reference's own")
    return None if error is None else error - (noise or 0.0)


OF_THE_RUNS = ("device", "version", "date")


def of_the_runs(runs: list[dict]) -> list[str]:
    """What tables made of all runs say of them: the last date, since that is when the tables were made."""
    done = [row for row in runs if row["status"] == "done"]
    return [" and ".join(sorted({row[key] for row in done if row.get(key)})) for key in ("device", "version")] + [
        max((row["date"] for row in done if row.get("date")), default="")]


def name_of(row: dict) -> str:
    return row["technique"] + (", as published" if row.get("as_published") == "true" else "")


class LightTracer:
    """Its error and time at any number of photons, of one scene."""

    def __init__(self, rows: list[dict]):
        rows = sorted(rows, key=lambda row: float(row["photons"]))
        few, many = rows[0], rows[-1]
        photons = float(many["photons"])
        if photons == float(few["photons"]):
            sys.exit(f"speed_error: the light tracer has run with {photons:.0f} photons alone on '{many['scene']}', which does "
                     "not say what one costs; light_tracer.py --photons takes several")
        self.error_times_photons = net(many) * photons
        self.ms_a_photon = 1e3 * (float(many["seconds"]) - float(few["seconds"])) / (photons - float(few["photons"]))

    def photons(self, error: float) -> float:
        return self.error_times_photons / error

    def ms(self, error: float) -> float:
        return self.photons(error) * self.ms_a_photon

    def error(self, ms: float) -> float:
        return self.error_times_photons * self.ms_a_photon / ms


def light_tracers(rows: list[dict]) -> dict[str, LightTracer]:
    by_scene = defaultdict(list)
    for row in rows:
        if row["estimator"] == "light" and number(row, "relMSE") is not None:
            by_scene[row["scene"]].append(row)
    return {scene: LightTracer(of) for scene, of in by_scene.items()}


def least(points: list[tuple[float, float]], at: float) -> float | None:
    """The least second of points (first, second) whose first is `at` or less, or which lie between two that are neighbours in the
    first, in the logarithms of both; None where all are beyond it."""
    points = sorted(points)
    found = [y for x, y in points if x <= at]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x0 < at < x1:
            found.append(y0 * (y1 / y0) ** (math.log(at / x0) / math.log(x1 / x0)))
    return min(found, default=None)


def curves(runs: list[dict], baselines: list[dict]) -> dict[str, dict[str, list[tuple[float, float]]]]:
    """Points (ms, net relMSE) by scene and technique, sorted by time; of the baselines too."""
    of: dict = defaultdict(lambda: defaultdict(list))
    for row in runs:
        error, ms = net(row), number(row, "ms")
        if row["status"] == "done" and error and error > 0.0 and ms:
            of[row["scene"]][name_of(row)].append((ms, error))
    for scene, tracer in light_tracers(baselines).items():
        if scene in of:
            of[scene][LIGHT_TRACER] = [(ms, tracer.error(ms)) for ms in (0.1, 1, 10, 100, 1000, 10000)]
    for row in baselines:
        error = net(row)
        if row["estimator"] == "sppm" and row["scene"] in of and error and error > 0.0:
            of[row["scene"]][PHOTON_MAPPING].append((1e3 * float(row["seconds"]), error))
    return {scene: {name: sorted(points) for name, points in by.items()} for scene, by in of.items()}


def write(file: pathlib.Path, columns: list[str], rows: list[list]) -> None:
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(["" if cell is None else f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row]
                         for row in rows)


EQUAL_ERROR = ("scene", "technique", "as_published", "emit.photons", "refine.finest", "status", "ms", "relMSE, net",
               "light tracer's photons", "light tracer's ms", "factor", "at_least", *OF_THE_RUNS)


def equal_error(runs: list[dict], tracers: dict[str, LightTracer]) -> list[dict]:
    """Rows of EQUAL_ERROR, and `order`: the photons, or what stands for them."""
    table = []
    for row in runs:
        error, ms, tracer = net(row), number(row, "ms"), tracers.get(row["scene"])
        if row["status"] != "done" or error is None or not ms or not tracer:
            continue
        noise = number(row, "relMSE, reference's own") or 0.0
        reached = max(error, noise)
        key, size = varied(row)
        sizes = [size if key == column else "" for column in ("emit.photons", "refine.finest")]
        values = (row["scene"], row["technique"], row["as_published"], *sizes, "done", ms, error, tracer.photons(reached),
                  tracer.ms(reached), tracer.ms(reached) / ms, str(error < noise).lower(), *(row.get(key, "") for key in OF_THE_RUNS))
        table.append({**dict(zip(EQUAL_ERROR, values)), "order": int(size.split("x")[0] or 0)})
    return table


# What says how many photons these take; of the others it is emit.photons. The other one is in their rows too, and has no effect.
VARIED = {"adaptive_caustic_map": "refine.finest", "vertex_caustics": ""}


def varied(row: dict) -> tuple[str, str]:
    key = "refine.finest" if row.get("driver") == "adaptive" else VARIED.get(row["technique"], "emit.photons")
    return key, row.get(key) or ""


def middle_runs(table: list[dict]) -> dict[str, dict[str, dict]]:
    """By scene and technique, of the rows of equal_error the one by default with the study's middle number of photons (MIDDLE); where no run has
    it, the middle one of those that there are."""
    by = defaultdict(lambda: defaultdict(list))
    for row in table:
        if row["as_published"] == "false":
            by[row["scene"]][row["technique"]].append(row)

    def chosen(rows: list[dict]) -> dict:
        named = [row for row in rows if row["emit.photons"] in MIDDLE or row["refine.finest"] in MIDDLE]
        return named[0] if named else sorted(rows, key=lambda row: row["order"])[(len(rows) - 1) // 2]

    return {scene: {name: chosen(rows) for name, rows in of.items()} for scene, of in by.items()}


def answers(middle: dict[str, dict[str, dict]]) -> list[list]:
    table = []
    for scene, of in sorted(middle.items()):
        best = max(of.values(), key=lambda row: row["factor"])
        own = of.get(DEFAULT)
        table.append([scene, "done", *([own["ms"], own["relMSE, net"], own["light tracer's ms"], own["factor"], own["at_least"]] if own
                                       else [None] * 5),
                      best["technique"], best["ms"], best["relMSE, net"], best["factor"], best["at_least"]])
    return table


def summary(table: list[list]) -> list[list]:
    """Of the rows of answers."""
    rows = []
    for who, column in (("default", 5), ("best", 10)):
        factors = [row[column] for row in table if row[column] is not None]
        if factors:
            rows.append([who, "done", len(factors), sum(factor > 1.0 for factor in factors), sum(factor <= 1.0 for factor in factors),
                         min(factors), statistics.median(factors), max(factors)])
    return rows


def draw_headline(middle: dict[str, dict[str, dict]], file: pathlib.Path) -> None:
    names = sorted({name for of in middle.values() for name in of}, key=lambda name: (name != DEFAULT, name))
    scenes = sorted(middle, key=lambda scene: middle[scene].get(DEFAULT, {"factor": 0.0})["factor"])
    figure, axes = plt.subplots(figsize=(7.2, 0.32 * len(scenes) + 1.2))
    for index, name in enumerate(names):
        rows = [(middle[scene][name], place) for place, scene in enumerate(scenes) if name in middle[scene]]
        axes.plot([max(row["factor"], LEAST_FACTOR) for row, _ in rows], [place for _, place in rows], linestyle="", label=name,
                  color=COLORS[index % len(COLORS)], marker=MARKERS[(index + 3 * (index // len(COLORS))) % len(MARKERS)],
                  markersize=9 if name == DEFAULT else 5, zorder=3 if name == DEFAULT else 2)
        for row, place in rows:
            if row["at_least"] == "true":
                axes.annotate("", (1.35 * max(row["factor"], LEAST_FACTOR), place), (max(row["factor"], LEAST_FACTOR), place),
                              arrowprops={"arrowstyle": "->", "color": COLORS[index % len(COLORS)], "linewidth": 0.8})
    axes.axvline(1.0, color="black", linestyle=BASELINES[LIGHT_TRACER])
    axes.set(xscale="log", yticks=range(len(scenes)), xlabel="times as fast as a light tracer on the same processor, at equal error")
    axes.set_yticklabels(scenes, fontsize=8)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata(inputs(file.parent)))
    plt.close(figure)


def costs(runs: list[dict]) -> list[list]:
    by = defaultdict(lambda: defaultdict(list))
    for row in runs:
        if row["status"] == "done" and number(row, "emitted") and number(row, "ms"):
            by[row["technique"], row["as_published"]][row["scene"]].append(row)
    table = []
    for (technique, published), scenes in sorted(by.items()):
        slopes = defaultdict(list)
        for rows in scenes.values():
            few, many = (choose(rows, key=lambda row: number(row, "emitted")) for choose in (min, max))
            photons, more = (number(row, "emitted") for row in (few, many))
            if more < 1.5 * photons:
                continue
            for key, unit in (("ms", 1e6), ("peak MiB", 2.0**20)):
                low, high = number(few, key), number(many, key)
                if low is None or high is None:
                    continue
                slope = (high - low) / (more - photons)
                slopes[key].append(slope * unit)
                slopes[key, "at none"].append(low - slope * photons)
        lost = max(((number(row, "not formed, %"), number(row, "not formed, W"), row["scene"]) for rows in scenes.values() for row in rows
                    if number(row, "not formed, %") is not None and number(row, "not formed, W") is not None), default=(None, None, ""))
        middle = {key: statistics.median(values) for key, values in slopes.items()}
        ends = [choose(slopes["ms"], default=None) for choose in (min, max)]
        table.append([technique, published, "done", len(slopes["ms"]), middle.get("ms"), *ends, *(middle.get(key) for key in (
            ("ms", "at none"), "peak MiB", ("peak MiB", "at none"))), *lost])
    return table


def published(equal: list[dict]) -> list[list]:
    """By technique what its defaults are next to what its paper has, of pairs of rows of equal_error.csv with one scene and size."""
    pairs = defaultdict(dict)
    for row in equal:
        pairs[row["technique"], row["scene"], row["emit.photons"], row["refine.finest"]][row["as_published"]] = row
    by = defaultdict(list)
    for (technique, scene, *_), pair in pairs.items():
        if len(pair) == 2 and pair["true"]["relMSE, net"] > 0.0 and pair["false"]["relMSE, net"] > 0.0:
            of = {key: pair["false"][key] / pair["true"][key] for key in ("ms", "relMSE, net", "factor")}
            by[technique].append({**of, "scene": scene})
    table = []
    for technique, rows in sorted(by.items()):
        by_gain = sorted(rows, key=lambda row: row["factor"])
        table.append([technique, "done", len({row["scene"] for row in rows}),
                      *(of_all(row[key] for row in rows) for key in ("ms", "relMSE, net") for of_all in (statistics.median, min, max)),
                      statistics.median(row["factor"] for row in rows),
                      by_gain[0]["scene"], by_gain[0]["factor"], by_gain[-1]["scene"], by_gain[-1]["factor"]])
    return table


def first_two(values: dict[str, float | None]) -> list:
    """The name with the least value, the value, the second's name, and the ratio of the two."""
    there = sorted((value, name) for name, value in values.items() if value is not None)
    if not there:
        return ["nothing", None, "", None]
    second = there[1] if len(there) > 1 else (None, "")
    return [there[0][1], there[0][0], second[1], second[0] / there[0][0] if second[0] else None]


def ranked(of_scenes: dict, ats: list[float], by_error: bool) -> list[list]:
    """For each scene and error (or time) who is there first (or has the least error)."""
    return [[scene, f"{at:g}", "done", *first_two({name: least([point[::-1] if by_error else point for point in curve], at)
                                                   for name, curve in by.items()})]
            for scene, by in sorted(of_scenes.items()) for at in ats]


def draw(scene: str, by: dict[str, list[tuple[float, float]]], runs: list[dict], file: pathlib.Path) -> None:
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    for row in runs:
        error, ms, part = net(row), number(row, "ms"), number(row, "spread")
        if row["scene"] == scene and row["status"] == "done" and error and error > 0.0 and ms and part:
            axes.errorbar(ms, error, xerr=min(part, 0.9) * ms, color="#777777", linewidth=0.6, zorder=1)
    noise = [number(row, "relMSE, reference's own") for row in runs if row["scene"] == scene and number(row, "relMSE, reference's own")]
    if noise:
        axes.axhspan(0.0, max(noise), color="#999999", alpha=0.15, linewidth=0.0, zorder=0)
    names = sorted({name.removesuffix(", as published") for name in by} - set(BASELINES))
    for name, curve in sorted(by.items()):
        base = name.removesuffix(", as published")
        if name in BASELINES:
            axes.plot(*zip(*curve), color="black", linestyle=BASELINES[name], label=name)
            continue
        index = names.index(base)
        color = COLORS[index % len(COLORS)]
        # Where colours come again their markers do not.
        marker = MARKERS[(index + 3 * (index // len(COLORS))) % len(MARKERS)]
        published = name != base
        axes.plot(*zip(*curve), color=color, marker=marker, markersize=4, linewidth=0.8,
                  linestyle="--" if published else "-", fillstyle="none" if published else "full", label=None if published else base)
    own = [point for name, curve in by.items() if name not in BASELINES for point in curve]
    front = pareto_front(own)
    axes.plot(*zip(*sorted(front)), color="#999999", linewidth=4, alpha=0.35, zorder=0)
    times, errors = zip(*own)
    axes.set(xscale="log", yscale="log", xlim=(min(times) / 2, max(times) * 2), ylim=(min(errors) / 2, max(errors) * 2),
             title=scene, xlabel="passes of the caustic, ms", ylabel="relMSE, net of the reference's noise")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5),
                title="filled: default\nhollow: as published", title_fontsize=7)
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata(inputs(file.parent)))
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results/all_techniques")
    parser.add_argument("--tables", action="store_true", help="draws nothing")
    arguments = parser.parse_args()
    folder = arguments.results
    runs = rows_of(folder / "runs.csv")
    if (folder / "best_mixtures.csv").is_file():
        runs += [row | {"technique": MIXTURE, "as_published": "false"} for row in rows_of(folder / "best_mixtures.csv")]
    # A light tracer into the pixels has no light in a medium either. Where there is one, rows of before its time was told apart can't be
    # compared.
    with_medium = {row["scene"] for row in runs if number(row, "media ms")}
    runs = [row for row in runs if row["scene"] not in with_medium or number(row, "media ms") or row["status"] != "done"]
    for row in runs:
        if number(row, "ms") and number(row, "media ms"):
            row["ms"] = str(number(row, "ms") - number(row, "media ms"))
    require_one_device([row for row in runs if row["status"] == "done"], folder)
    baselines = rows_of(folder / "light_tracer.csv")
    of_scenes = curves(runs, baselines)
    equal = equal_error(runs, light_tracers(baselines))
    write(folder / "equal_error.csv", list(EQUAL_ERROR), [[row[key] for key in EQUAL_ERROR] for row in equal])
    middle = middle_runs(equal)
    if middle and not arguments.tables:
        draw_headline(middle, folder / "headline.svg")

    def write_table(name: str, columns: list[str], rows: list[list]) -> None:
        write(folder / name, [*columns, *OF_THE_RUNS], [row + of_the_runs(runs) for row in rows])

    write_table("answers.csv", ["scene", "status", "default's ms", "default's relMSE, net", "light tracer's ms", "factor", "at_least", "best",
                                "best's ms", "best's relMSE, net", "best's factor", "best's at_least"], answers(middle))
    write_table("summary.csv", ["who", "status", "scenes", "faster", "slower", "least", "median", "largest"], summary(answers(middle)))
    write_table("costs.csv", ["technique", "as_published", "status", "scenes", "ns a photon", "least ns a photon", "most ns a photon", "ms at none", "bytes a photon", "MiB at none",
                              "most not formed, %", "most not formed, W", "on"], costs(runs))
    write_table("published.csv", ["technique", "status", "scenes", "ms", "least ms", "largest ms", "relMSE", "least relMSE", "largest relMSE", "gain", "least on", "least gain", "largest on", "largest gain"],
                published(equal))
    names = ["first", "value", "second", "times"]
    write_table("to_error.csv", ["scene", "relMSE", "status", *names], ranked(of_scenes, ERRORS, by_error=True))
    write_table("in_time.csv", ["scene", "ms", "status", *names], ranked(of_scenes, TIMES_MS, by_error=False))
    for scene, by in of_scenes.items() if not arguments.tables else ():
        draw(scene, by, runs, folder / f"{scene}.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
