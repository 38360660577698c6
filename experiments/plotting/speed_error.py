#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed against error over all techniques and scenes, against a light tracer on the same processor.

    speed_error.py [--results results/all_techniques] [--in-turn results/all_techniques/in_turn.csv] [--elsewhere results/all_techniques/in_turn_xeon.csv]

Reads runs.csv (all_techniques.toml, by table.py --csv), light_tracer.csv (light_tracer.py) and, where it is there, best_mixtures.csv
(best_mixtures.toml; its runs are called "best mixture") in that folder, all of a scene of one machine: the study is long, and may be made scene by scene
where there is time for it. Mixtures and light tracers of another machine than the scene's runs are left out, which is said. Writes next to them

- equal_error.csv: each run, and how many photons and ms the light tracer needs for the same relMSE; `factor` is by how much the run is
  faster, `low` and `high` its interval of one standard deviation (speed_curves.py says what it is made of). Both errors are net of the reference's own noise. The light
  tracer's error falls as one over its photons, and its time grows
  with them: both are taken from its run with the most photons, the time less that of the run with the fewest. Where a run's
  error is not above the reference's noise the factor is a bound: `at_least`.
- to_error.csv: for each scene and error, the technique that is there first, its ms, interpolated between its runs in the logarithms of
  both, the second and by how much it is later, both with their intervals. `at_most`: its run with the fewest photons is there already. `disturbed`: of a run whose frames differed much.
  `photons`: along a side of the grid (or the finest cells), interpolated too; all of them of the light tracer and of photon mapping.
- in_time.csv: the same the other way round: the least error within a time. `at_most`: its run with the most photons takes less.
- one_second.csv: for each scene the error that the light tracer has after one second, and whether and when the default has it with as many photons as it likes; `part`: the default's least error over that one.
- photon_mapping.csv: the default's runs, and how long progressive photon mapping takes to their error; `bound`: its runs end before (`≥`).
- uncertainty.csv: what the intervals are made of, and the times of the study over those in turn (--in-turn, --elsewhere), of each scene on the machine of its runs.
- goals.csv: what the goal was set for, the default at least three times as fast on ten of its thirteen scenes and ten times in the median, by the study and in turn (--in-turn). Scenes that have no
  row are named; the median then lies within `median least` and `median most`, whatever they have.
- costs.csv: what a photon costs each technique, and what all of them together do: the median over scenes of the slope between its runs with the
  fewest and the most photons, of time (also the least and the most) and memory, and of what is left at none, of scenes of the machine that most are of; and the light that it does not form, on the scene where
  that is most.
- published.csv: what defaults change of each technique as published, with as many photons: the default's time and error as parts of the
  published ones and the gain in `factor`, medians over scenes with the least and the largest, and the scenes of these gains.
- SCENE.svg: error against time, the Pareto front drawn through; bars are the standard deviation of a run's frames, bands the
  intervals of what a user would pick instead, and below the shaded height errors
  are less than the reference's own noise. A circle: a disturbed run.
- headline.svg: all scenes: the factors of equal_error.csv, of each technique's runs by default the one with the middle number of photons.
- answers.csv: the same as a table: for each scene the default's factor, and the technique with the largest.
- summary.csv: on how many scenes the default, and the best, are faster than the light tracer, and the least, the median and the largest factor; on how many the interval too is above or below one.
  So too the default over photon mapping (bounds as they are), and over the best mixture, at each number of photons.
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
from speed_curves import (DEFAULT, LIGHT_TRACER, MIDDLE, MIXTURE, PHOTON_MAPPING, RANKED, LightTracer, Point, Spreads, curves, found_on, frames_spread, is_disturbed, least,  # noqa: F401
                          light_tracers, net, number, points_of, ranked, rows_of, side_of, varied)
from study import device_of, require_one_device

ROOT = pathlib.Path(__file__).resolve().parents[2]
ERRORS = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4]
BASELINES = {LIGHT_TRACER: ":", PHOTON_MAPPING: "-."}
LEAST_FACTOR = 1e-4  # that is drawn
TIMES_MS = [50, 100, 200, 500, 1000, 2000]


def inputs(folder: pathlib.Path) -> list[pathlib.Path]:
    return [folder / name for name in drawings.DRAWN["all_techniques"][0]]


OF_THE_RUNS = ("device", "version", "date")


def of_the_runs(runs: list[dict]) -> list[str]:
    """What tables made of all runs say of them: the last date, since that is when the tables were made."""
    done = [row for row in runs if row["status"] == "done"]
    return [" and ".join(sorted({row[key] for row in done if row.get(key)})) for key in ("device", "version")] + [
        max((row["date"] for row in done if row.get("date")), default="")]


def interval(value: float, *sds: float) -> list[float]:
    """One standard deviation down and up, of logarithms that have these ones."""
    return [value * math.exp(sign * math.hypot(*sds)) for sign in (-1.0, 1.0)]


def write(file: pathlib.Path, columns: list[str], rows: list[list]) -> None:
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(["" if cell is None else f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row]
                         for row in rows)


EQUAL_ERROR = ("scene", "technique", "as_published", "emit.photons", "refine.finest", "status", "ms", "relMSE, net",
               "light tracer's photons", "light tracer's ms", "factor", "low", "high", "at_least", *OF_THE_RUNS)


def equal_error(runs: list[dict], tracers: dict[str, LightTracer], spreads: Spreads) -> list[dict]:
    """Rows of EQUAL_ERROR, and `order`: the photons, or what stands for them, `sd` of its time, and whether it was disturbed."""
    table = []
    for row in runs:
        error, ms, tracer = net(row), number(row, "ms"), tracers.get(row["scene"])
        if row["status"] != "done" or error is None or not ms or not tracer:
            continue
        noise = number(row, "relMSE, reference's own") or 0.0
        reached = max(error, noise)
        key, size = varied(row)
        sizes = [size if key == column else "" for column in ("emit.photons", "refine.finest")]
        factor, sd = tracer.ms(reached) / ms, spreads.of_run(row)
        values = (row["scene"], row["technique"], row["as_published"], *sizes, "done", ms, error, tracer.photons(reached),
                  tracer.ms(reached), factor, *interval(factor, sd, spreads.of_tracer), str(error < noise).lower(), *(row.get(key, "") for key in OF_THE_RUNS))
        table.append({**dict(zip(EQUAL_ERROR, values)), "order": int(side_of(row)), "sd": sd, "disturbed": is_disturbed(row)})
    return table


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


OF_ONE = ("ms", "relMSE, net", "light tracer's ms", "factor", "low", "high", "at_least", "disturbed")
ANSWERS = ("scene", "status", *("default's " * (key in OF_ONE[:2]) + key for key in OF_ONE), "best", *(f"best's {key}" for key in OF_ONE if key != "light tracer's ms"))


def answers(middle: dict[str, dict[str, dict]]) -> list[dict]:
    table = []
    for scene, of in sorted(middle.items()):
        best, own = max(of.values(), key=lambda row: row["factor"]), of.get(DEFAULT)
        bests = [best[key] for key in OF_ONE if key != "light tracer's ms"]
        cells = [scene, "done", *([own[key] for key in OF_ONE] if own else [None] * len(OF_ONE)), best["technique"], *bests]
        table.append(dict(zip(ANSWERS, (str(cell).lower() if isinstance(cell, bool) else cell for cell in cells))))
    return table


SUMMARY = ["who", "status", "scenes", "faster", "slower", "least", "median", "largest", "clearly faster", "clearly slower"]


def summed(who: str, factors: list[tuple[float, float, float]]) -> list[list]:
    """A row of SUMMARY of factors with their intervals; none of none."""
    values = [factor for factor, _, _ in factors]
    return [[who, "done", len(values), sum(value > 1.0 for value in values), sum(value <= 1.0 for value in values), min(values), statistics.median(values), max(values),
             sum(low > 1.0 for _, low, _ in factors), sum(high < 1.0 for _, _, high in factors)]] if values else []


def summary(table: list[dict], mapping: list[dict], equal: list[dict]) -> list[list]:
    """Of the rows of answers, of photon_mapping and of equal_error."""
    rows = []
    for who, of in (("default", ""), ("best", "best's ")):
        rows += summed(who, [tuple(row[of + key] for key in ("factor", "low", "high")) for row in table if row[of + "factor"] is not None])
    rows += summed("default over photon mapping", [tuple(row[key] for key in ("factor", "low", "high")) for row in mapping if row["emit.photons"] in MIDDLE])
    default = {(row["scene"], row["emit.photons"]): row for row in equal if row["technique"] == DEFAULT and row["as_published"] == "false"}
    pairs = [(own, row) for row in equal if row["technique"] == MIXTURE and (own := default.get((row["scene"], row["emit.photons"])))]
    # The light tracer is in both factors.
    ratios = [(own["factor"] / row["factor"], own["sd"], row["sd"]) for own, row in pairs]
    return rows + summed("default over best mixture", [(ratio[0], *interval(*ratio)) for ratio in ratios])


ONE_SECOND = ("scene", "status", "relMSE", "default's least relMSE", "emit.photons", "ms", "part", "reached", "ms to it", "low", "high", "at_most", "times", "times low", "times high",
              "first", "first's ms")


def one_second(equal: list[dict], tracers: dict[str, LightTracer], of_scenes: dict[str, dict[str, list[Point]]], spreads: Spreads) -> list[dict]:
    """Rows of ONE_SECOND: by scene the light tracer's error after a second, the default's least, and when it has the light tracer's."""
    table = []
    for scene, by in sorted(of_scenes.items()):
        own = [row for row in equal if row["scene"] == scene and row["technique"] == DEFAULT and row["as_published"] == "false"]
        if not own or scene not in tracers:
            continue
        target, lowest = tracers[scene].error(1e3), min(own, key=lambda row: row["relMSE, net"])
        first = min(((found.value, name) for name, curve in by.items() if name not in BASELINES and (found := found_on(curve, target, by_error=True))), default=(None, "nothing"))
        found = found_on(by[DEFAULT], target, by_error=True) if DEFAULT in by else None
        times = [None] * 3
        if found:
            sds = [math.log(found.value / found.low) if found.low else 0.0, spreads.of_tracer]
            times = [1e3 / found.value, *interval(1e3 / found.value, *sds)]
        cells = [*found[:3], str(found.at_most).lower()] if found else [None, None, None, ""]
        values = (scene, "done", target, lowest["relMSE, net"], lowest["emit.photons"], lowest["ms"], lowest["relMSE, net"] / target, str(found is not None).lower(), *cells, *times, *first[::-1])
        table.append(dict(zip(ONE_SECOND, values)))
    return table


MAPPING = ("scene", "emit.photons", "status", "ms", "relMSE, net", "photon mapping's ms", "bound", "factor", "low", "high")


def photon_mapping(equal: list[dict], of_scenes: dict[str, dict[str, list[Point]]]) -> list[dict]:
    """Rows of MAPPING: each run of the default, and how long photon mapping takes to its error; `bound` where that is beyond its runs."""
    table = []
    for row in sorted(equal, key=lambda row: (row["scene"], row["order"])):
        curve = of_scenes.get(row["scene"], {}).get(PHOTON_MAPPING)
        if row["technique"] != DEFAULT or row["as_published"] == "true" or not curve:
            continue
        found = found_on(curve, row["relMSE, net"], by_error=True)
        ms, bound = (found.value, "≤" if found.at_most else "") if found else (curve[-1].ms, "≥")
        table.append(dict(zip(MAPPING, (row["scene"], row["emit.photons"], "done", row["ms"], row["relMSE, net"], ms, bound, ms / row["ms"],
                                        *interval(ms / row["ms"], row["sd"], curve[-1].sd)))))
    return table


# What the goal was set for, beforehand: 3 times as fast on ten of these, and 10 times in the median. The room (experiments/room_of_water) is in no study: it is run in turn alone.
GOAL_SCENES = ("pool", "flat-water", "ring", "glass-sphere", "cornell-bunny", "glass-bunny", "glass-teapot", "concave-glass", "glass-dragon-low", "pool-reflections", "glossy-table", "water-from-below",
               "room_of_water")
GOALS = ["by", "status", "of", "scenes", "missing", "above 3", "slower", "least", "median", "largest", "median least", "median most"]


def goals(answered: list[dict], in_turn: list[dict], by_turn: str = "in turn") -> list[list]:
    """Rows of GOALS, of those of answers and of in_turn.csv; none of what has none of the scenes."""
    turn = {pathlib.PurePath(row["scene"]).stem: number(row, "factor") for row in in_turn if row["status"] == "done" and row["technique"] == DEFAULT}
    rows = []
    for by, factors in (("study", {row["scene"]: row["factor"] for row in answered}), (by_turn, turn)):
        values = sorted(factors[scene] for scene in GOAL_SCENES if factors.get(scene))
        missing = [scene for scene in GOAL_SCENES if not factors.get(scene)]
        if values:
            middle = len(GOAL_SCENES) // 2
            ends = [values[place] if 0 <= place < len(values) else None for place in (middle - len(missing), middle)]
            rows.append([by, "done", len(GOAL_SCENES), len(values), ", ".join(missing), sum(value >= 3.0 for value in values), sum(value <= 1.0 for value in values), values[0],
                         statistics.median(values), values[-1], *ends])
    return rows


UNCERTAINTY = ["what", "status", "scenes", "standard deviation", "least", "median", "largest"]


def uncertainty(spreads: Spreads) -> list[list]:
    """Rows of UNCERTAINTY; of times at another hour also the study's over those, by scene."""
    rows = []
    for what, sd, ratios in (("default's time at another hour", spreads.drift, spreads.default_ratios), ("light tracer's time at another hour", spreads.tracer_drift, spreads.tracer_ratios)):
        values = list(ratios.values())
        rows.append([what, "done", len(values), sd, *([of(values) for of in (min, statistics.median, max)] if values else [None] * 3)])
    for what, sd in (("light tracer's error", spreads.tracer_error), ("light tracer's time a photon", spreads.tracer_time), ("photon mapping's error", spreads.mapping_error),
                     ("photon mapping's time", spreads.mapping_time)):
        rows.append([what, "done", None, sd, *[None] * 3])
    return rows


def ring(axes, x: float, y: float) -> None:
    """Around a run that was disturbed."""
    axes.plot(x, y, marker="o", markersize=9, fillstyle="none", markeredgecolor="#cc0000", markeredgewidth=0.8, linestyle="", zorder=4)


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
            if name == DEFAULT:
                axes.plot([max(row[end], LEAST_FACTOR) for end in ("low", "high")], [place] * 2, color=COLORS[index % len(COLORS)], linewidth=1.2, zorder=2)
            if row["disturbed"]:
                ring(axes, max(row["factor"], LEAST_FACTOR), place)
            if row["at_least"] == "true":
                axes.annotate("", (1.35 * max(row["factor"], LEAST_FACTOR), place), (max(row["factor"], LEAST_FACTOR), place),
                              arrowprops={"arrowstyle": "->", "color": COLORS[index % len(COLORS)], "linewidth": 0.8})
    axes.axvline(1.0, color="black", linestyle=BASELINES[LIGHT_TRACER])
    axes.set(xscale="log", yticks=range(len(scenes)), xlabel="times as fast as a light tracer on the same processor, at equal error")
    axes.set_yticklabels(scenes, fontsize=8)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata(inputs(file.parent)))
    plt.close(figure)


def is_same(device: str, other: str) -> bool:
    """Whether times of both can be compared: of a renderer on a processor, and of that processor alone."""
    return device == other or device.endswith(f", {other}")


def of_most_scenes(runs: list[dict]) -> list[dict]:
    """The runs of the machine that most scenes are of, since times of several have no median."""
    scenes = defaultdict(set)
    for row in runs:
        if row["status"] == "done":
            scenes[device_of(row)].add(row["scene"])
    most = max(sorted(scenes), key=lambda device: len(scenes[device]), default="")
    return [row for row in runs if row["status"] == "done" and device_of(row) == most]


def costs(runs: list[dict]) -> list[list]:
    by = defaultdict(lambda: defaultdict(list))
    for row in of_most_scenes(runs):
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


def draw(scene: str, by: dict[str, list[Point]], runs: list[dict], file: pathlib.Path) -> None:
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    for row in runs:
        error, ms, part = net(row), number(row, "ms"), frames_spread(row)
        if row["scene"] == scene and row["status"] == "done" and error and error > 0.0 and ms and part:
            axes.errorbar(ms, error, xerr=min(part, 0.9) * ms, color="#777777", linewidth=0.6, zorder=1)
            if is_disturbed(row):
                ring(axes, ms, error)
    noise = [number(row, "relMSE, reference's own") for row in runs if row["scene"] == scene and number(row, "relMSE, reference's own")]
    if noise:
        axes.axhspan(0.0, max(noise), color="#999999", alpha=0.15, linewidth=0.0, zorder=0)
    names = sorted({name.removesuffix(", as published") for name in by} - set(BASELINES))
    for name, curve in sorted(by.items()):
        base = name.removesuffix(", as published")
        times, errors = [point.ms for point in curve], [point.error for point in curve]
        if name in BASELINES:
            axes.plot(times, errors, color="black", linestyle=BASELINES[name], label=name)
            ends = [[point.ms * math.exp(sign * point.sd) for point in curve] for sign in (-1.0, 1.0)]
            axes.fill_betweenx(errors, *ends, color="black", alpha=0.08, linewidth=0.0, zorder=0)
            continue
        index = names.index(base)
        color = COLORS[index % len(COLORS)]
        # Where colours come again their markers do not.
        marker = MARKERS[(index + 3 * (index // len(COLORS))) % len(MARKERS)]
        published = name != base
        axes.plot(times, errors, color=color, marker=marker, markersize=4, linewidth=0.8,
                  linestyle="--" if published else "-", fillstyle="none" if published else "full", label=None if published else base)
    own = [(point.ms, point.error) for name, curve in by.items() if name not in BASELINES for point in curve]
    front = pareto_front(own)
    axes.plot(*zip(*sorted(front)), color="#999999", linewidth=4, alpha=0.35, zorder=0)
    times, errors = zip(*own)
    axes.set(xscale="log", yscale="log", xlim=(min(times) / 2, max(times) * 2), ylim=(min(errors) / 2, max(errors) * 2),
             title=scene, xlabel="passes of the caustic, ms", ylabel="relMSE, net of the reference's noise")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5),
                title="filled: default\nhollow: as published\ncircle: disturbed", title_fontsize=7)
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata(inputs(file.parent)))
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results/all_techniques")
    parser.add_argument("--in-turn", type=pathlib.Path, default=ROOT / "results/all_techniques/in_turn.csv", help="times of the default and the light tracer at another hour")
    parser.add_argument("--elsewhere", type=pathlib.Path, default=ROOT / "results/all_techniques/in_turn_xeon.csv", help="the same on another processor, for its goals and for the times of the scenes whose runs are of it")
    parser.add_argument("--tables", action="store_true", help="draws nothing")
    arguments = parser.parse_args()
    folder = arguments.results
    runs = rows_of(folder / "runs.csv")
    require_one_device([row for row in runs if row["status"] == "done"], folder, a_scene=True)
    devices = {row["scene"]: device_of(row) for row in runs if row["status"] == "done"}

    def of_its_scene(rows: list[dict], called: str) -> list[dict]:
        """Those of the machine that their scene's runs are of."""
        of_others = [row for row in rows if row["scene"] in devices and row.get("device") and not is_same(devices[row["scene"]], device_of(row))]
        if of_others:
            scenes = ", ".join(sorted({row["scene"] for row in of_others}))
            print(f"speed_error: of {scenes} {called} of another machine than the runs, and left out", file=sys.stderr)
        return [row for row in rows if row not in of_others]

    if (folder / "best_mixtures.csv").is_file():
        runs += [row | {"technique": MIXTURE, "as_published": "false"} for row in of_its_scene(rows_of(folder / "best_mixtures.csv"), "the mixtures are")]
    # A light tracer into the pixels has no light in a medium either. Where there is one, rows of before its time was told apart can't be
    # compared.
    with_medium = {row["scene"] for row in runs if number(row, "media ms")}
    runs = [row for row in runs if row["scene"] not in with_medium or number(row, "media ms") or row["status"] != "done"]
    for row in runs:
        if number(row, "ms") and number(row, "media ms"):
            row["ms"] = str(number(row, "ms") - number(row, "media ms"))
    baselines = of_its_scene(rows_of(folder / "light_tracer.csv"), "the light tracer is")
    of_hours = [rows_of(file) if file.is_file() else [] for file in (arguments.in_turn, arguments.elsewhere)]
    in_turn = [row for rows in of_hours for row in rows if device_of(row) == devices.get(row["scene"])]
    spreads, tracers = Spreads(runs, baselines, in_turn), light_tracers(baselines)
    of_scenes = points_of(runs, baselines, spreads)
    equal = equal_error(runs, tracers, spreads)
    write(folder / "equal_error.csv", list(EQUAL_ERROR), [[row[key] for key in EQUAL_ERROR] for row in equal])
    middle = middle_runs(equal)
    if middle and not arguments.tables:
        draw_headline(middle, folder / "headline.svg")

    def write_table(name: str, columns: list[str], rows: list[list]) -> None:
        write(folder / name, [*columns, *OF_THE_RUNS], [row + of_the_runs(runs) for row in rows])

    answered, mapping = answers(middle), photon_mapping(equal, of_scenes)
    for name, keys, table in (("answers.csv", ANSWERS, answered), ("photon_mapping.csv", MAPPING, mapping), ("one_second.csv", ONE_SECOND, one_second(equal, tracers, of_scenes, spreads))):
        write_table(name, list(keys), [[row[key] for key in keys] for row in table])
    write_table("summary.csv", SUMMARY, summary(answered, mapping, equal))
    own, elsewhere = of_hours
    write(folder / "goals.csv", [*GOALS, *OF_THE_RUNS], [*(row + of_the_runs(runs) for row in goals(answered, own)),
                                                         *(row + of_the_runs(elsewhere) for row in goals([], elsewhere, "in turn, another processor"))])
    write_table("uncertainty.csv", UNCERTAINTY, uncertainty(spreads))
    write_table("costs.csv", ["technique", "as_published", "status", "scenes", "ns a photon", "least ns a photon", "most ns a photon", "ms at none", "bytes a photon", "MiB at none",
                              "most not formed, %", "most not formed, W", "on"], costs(runs))
    write_table("published.csv", ["technique", "status", "scenes", "ms", "least ms", "largest ms", "relMSE", "least relMSE", "largest relMSE", "gain", "least on", "least gain", "largest on", "largest gain"],
                published(equal))
    write_table("to_error.csv", ["scene", "relMSE", "status", *RANKED], ranked(of_scenes, ERRORS, by_error=True))
    write_table("in_time.csv", ["scene", "ms", "status", *RANKED], ranked(of_scenes, TIMES_MS, by_error=False))
    for scene, by in of_scenes.items() if not arguments.tables else ():
        draw(scene, by, runs, folder / f"{scene}.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
