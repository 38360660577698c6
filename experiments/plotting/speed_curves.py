# SPDX-License-Identifier: MIT
"""Curves of error against time, of techniques and of what a user would pick instead, with what they are uncertain by: what speed_error.py makes its tables of.

Times are in ms, errors relMSE net of the reference's own noise. Standard deviations are of logarithms, so that an interval goes from value * exp(-sd) to value * exp(sd). A run's time has

- the standard deviation of its frames over their mean (`spread`), times what a medium's time was taken off of where there is one, and
- what the same runs took at another hour (`drift`): the root mean square, over the scenes, of the logarithm of the default's times in runs.csv over those of in_turn.csv.

The light tracer's time for an error has the same drift, of its time a photon, and what its runs with several numbers of photons scatter by: of a scene's three each error times its photons
should be one number, and their times lie on a line. Progressive photon mapping's has the drift of the light tracer, and what its three runs lie off straight lines by, of time over photons and, in
logarithms, of error over photons. Three runs of a scene say little, so that each scatter is one for all scenes. A technique's own error has no part in it: its runs have one set of random numbers each.
"""

import csv
import math
import pathlib
import statistics
import sys
from collections import defaultdict
from typing import Iterable, NamedTuple

# What a user would pick instead: no techniques of ours, and no part of the front that is drawn.
LIGHT_TRACER, PHOTON_MAPPING = "light tracer", "progressive photon mapping"
DEFAULT, MIXTURE = "exact_rays", "best mixture"
MIDDLE = {"256x256", "1024"}  # photons along each side of the grid, or the finest cells
# What says how many photons these take; of the others it is emit.photons. The other one is in their rows too, and has no effect.
VARIED = {"adaptive_caustic_map": "refine.finest", "vertex_caustics": ""}
DISTURBED = 0.2  # frames that differ by more had the machine not for themselves


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


def name_of(row: dict) -> str:
    return row["technique"] + (", as published" if row.get("as_published") == "true" else "")


def varied(row: dict) -> tuple[str, str]:
    """The setting that says how many photons a run has, and what it is."""
    key = "refine.finest" if row.get("driver") == "adaptive" else VARIED.get(row["technique"], "emit.photons")
    return key, row.get(key) or ""


def side_of(row: dict) -> float:
    """Photons along a side of a run's grid, or the finest cells; 0 where meshes say how many."""
    return float(varied(row)[1].split("x")[0] or 0)


def is_disturbed(row: dict) -> bool:
    return (number(row, "spread") or 0.0) > DISTURBED


def frames_spread(row: dict) -> float:
    """The standard deviation of its frames as a part of its time. `spread` is that of frames with a medium's part, which has been taken off `ms`."""
    return (number(row, "spread") or 0.0) * (1.0 + (number(row, "media ms") or 0.0) / (number(row, "ms") or math.inf))


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


def by_scene(baselines: list[dict], estimator: str) -> dict[str, list[dict]]:
    by = defaultdict(list)
    for row in baselines:
        if row["estimator"] == estimator and number(row, "relMSE") is not None:
            by[row["scene"]].append(row)
    return by


def light_tracers(rows: list[dict]) -> dict[str, LightTracer]:
    return {scene: LightTracer(of) for scene, of in by_scene(rows, "light").items()}


class Line(NamedTuple):
    slope: float
    residuals: list[float]  # of each point
    slope_error: float  # its standard error; 0 of two points


def fitted(points: list[tuple[float, float]]) -> Line | None:
    """The line of least squares through three points or more."""
    if len(points) < 3:
        return None
    (x0, y0), count = (statistics.fmean(of) for of in zip(*points)), len(points)
    square = sum((x - x0) ** 2 for x, _ in points)
    if not square:
        return None
    slope = sum((x - x0) * (y - y0) for x, y in points) / square
    residuals = [y - y0 - slope * (x - x0) for x, y in points]
    return Line(slope, residuals, math.sqrt(sum(r * r for r in residuals) / (count - 2) / square))


def pooled(squares: Iterable[float]) -> float:
    """The root of the mean of variances, 0 of none."""
    return math.sqrt(statistics.fmean(found)) if (found := list(squares)) else 0.0


class Spreads:
    """Standard deviations of logarithms that runs of one machine have in common."""

    def __init__(self, runs: list[dict], baselines: list[dict], in_turn: list[dict]):
        tracers, lights, mapped = light_tracers(baselines), by_scene(baselines, "light"), by_scene(baselines, "sppm")
        turn = {row["scene"]: row for row in in_turn if row["status"] == "done" and row["technique"] == DEFAULT}
        own = {row["scene"]: row for row in runs if row["status"] == "done" and row["technique"] == DEFAULT and row.get("emit.photons") in MIDDLE}
        # Times in the study over those at another hour, by scene.
        self.default_ratios = {scene: number(own[scene], "ms") / number(row, "ms") for scene, row in turn.items() if scene in own and number(own[scene], "ms")}
        self.tracer_ratios = {scene: 1e3 * tracers[scene].ms_a_photon / number(row, "us a photon") for scene, row in turn.items() if scene in tracers}
        self.drift, self.tracer_drift = (pooled(math.log(ratio) ** 2 for ratio in ratios.values()) for ratios in (self.default_ratios, self.tracer_ratios))
        products = {scene: [net(row) * float(row["photons"]) for row in rows] for scene, rows in lights.items()}
        self.tracer_error = pooled(statistics.variance(map(math.log, of)) for of in products.values() if len(of) > 2 and min(of) > 0.0)

        def lines(rows_by: dict[str, list[dict]]) -> list[tuple[Line, list[dict]]]:
            found = ((fitted([(float(row["photons"]), float(row["seconds"])) for row in rows]), rows) for rows in rows_by.values())
            return [(line, rows) for line, rows in found if line]

        self.tracer_time = pooled((line.slope_error / line.slope) ** 2 for line, _ in lines(lights))
        self.mapping_time = pooled(sum((off / float(row["seconds"])) ** 2 for off, row in zip(line.residuals, rows)) / (len(rows) - 2) for line, rows in lines(mapped))
        logarithmic = [fitted([(math.log(float(row["photons"])), math.log(net(row))) for row in rows if net(row) > 0.0]) for rows in mapped.values()]
        self.mapping_error = pooled(sum(off * off for off in line.residuals) / (len(line.residuals) - 2) for line in logarithmic if line)

    def of_run(self, row: dict) -> float:
        return math.hypot(frames_spread(row), self.drift)

    @property
    def of_tracer(self) -> float:
        """Of the time that it takes for an error."""
        return math.hypot(self.tracer_error, self.tracer_time, self.tracer_drift)

    def of_mapping(self, points: list[tuple[float, float]]) -> float:
        """The same of photon mapping whose runs are these (ms, relMSE): its error's scatter counts as that of the time at which it has the error."""
        (t0, e0), (t1, e1) = min(points), max(points)
        fall = math.log(e0 / e1) / math.log(t1 / t0) if t1 > t0 and e0 > e1 else 1.0
        return math.hypot(self.mapping_error / fall, self.mapping_time, self.tracer_drift)


class Point(NamedTuple):
    ms: float
    error: float
    sd: float = 0.0  # of the time's logarithm
    disturbed: bool = False
    photons: float = 0.0  # a side of the grid's (side_of); of what a user would pick instead all of them


def points_of(runs: list[dict], baselines: list[dict], spreads: Spreads) -> dict[str, dict[str, list[Point]]]:
    """By scene and technique, sorted by time; of the baselines too."""
    of: dict = defaultdict(lambda: defaultdict(list))
    for row in runs:
        error, ms = net(row), number(row, "ms")
        if row["status"] == "done" and error and error > 0.0 and ms:
            of[row["scene"]][name_of(row)].append(Point(ms, error, spreads.of_run(row), is_disturbed(row), side_of(row)))
    for scene, tracer in light_tracers(baselines).items():
        if scene in of:
            of[scene][LIGHT_TRACER] = [Point(ms, tracer.error(ms), spreads.of_tracer, photons=tracer.photons(tracer.error(ms))) for ms in (0.1, 1, 10, 100, 1000, 10000)]
    for scene, rows in by_scene(baselines, "sppm").items():
        points = [(1e3 * float(row["seconds"]), error, float(row["photons"])) for row in rows if (error := net(row)) and error > 0.0]
        if scene in of and points:
            sd = spreads.of_mapping([point[:2] for point in points])
            of[scene][PHOTON_MAPPING] = [Point(ms, error, sd, photons=photons) for ms, error, photons in points]
    return {scene: {name: sorted(points) for name, points in by.items()} for scene, by in of.items()}


def curves(runs: list[dict], baselines: list[dict]) -> dict[str, dict[str, list[tuple[float, float]]]]:
    """Points (ms, net relMSE) by scene and technique, sorted by time; of the baselines too."""
    found = points_of(runs, baselines, Spreads(runs, baselines, []))
    return {scene: {name: [(point.ms, point.error) for point in points] for name, points in by.items()} for scene, by in found.items()}


def candidates(points: list[tuple[float, float]], at: float) -> list[tuple[float, tuple[int, ...]]]:
    """What `least` takes the least of, each with the places in the sorted list of the points that it is of."""
    found = [(y, (place,)) for place, (x, y) in enumerate(points) if x <= at]
    for place, ((x0, y0), (x1, y1)) in enumerate(zip(points, points[1:])):
        if x0 < at < x1:
            found.append((y0 * (y1 / y0) ** (math.log(at / x0) / math.log(x1 / x0)), (place, place + 1)))
    return found


def least(points: list[tuple[float, float]], at: float) -> float | None:
    """The least second of points (first, second) whose first is `at` or less, or which lie between two that are neighbours in the
    first, in the logarithms of both; None where all are beyond it."""
    return min((value for value, _ in candidates(sorted(points), at)), default=None)


class Found(NamedTuple):
    """Where a curve is, with the interval of one standard deviation; an end that it has no value at is None."""
    value: float
    low: float | None
    high: float | None
    at_most: bool  # the curve ends before: with fewer photons (or in more time) it would be less
    disturbed: bool
    photons: float  # as a point has them; 0 where none are known


def photons_between(points: list[Point], ats: list[float], at: float) -> float:
    """Of one point or of two, between which they are interpolated in logarithms."""
    if len(points) == 1 or min(point.photons for point in points) <= 0.0:
        return points[0].photons
    (few, many), part = (point.photons for point in points), math.log(at / ats[0]) / math.log(ats[1] / ats[0])
    return few * (many / few) ** part


def found_on(curve: list[Point], at: float, by_error: bool) -> Found | None:
    """The time to an error, or the error in a time."""
    def pairs(shift: float) -> list[tuple[float, float]]:
        shifted = [(point.ms * math.exp(shift * point.sd), point.error) for point in curve]
        return [pair[::-1] for pair in shifted] if by_error else shifted

    own = pairs(0.0)
    order = sorted(range(len(curve)), key=lambda place: own[place])
    of = candidates(sorted(own), at)
    if not of:
        return None
    value, places = min(of)
    points = [curve[order[place]] for place in places]
    return Found(value, least(pairs(-1.0), at), least(pairs(1.0), at), at > max(pair[0] for pair in own), any(point.disturbed for point in points),
                 photons_between(points, [own[order[place]][0] for place in places], at))


def half_widths(found: Found) -> tuple[float, float] | None:
    """By how much the logarithm goes down and up."""
    if not found.low or not found.high:
        return None
    return math.log(found.value / found.low), math.log(found.high / found.value)


RANKED = ["first", "value", "low", "high", "at_most", "disturbed", "photons", "second", "times", "times low", "times high", "second at_most", "second photons"]


def first_two(values: dict[str, Found | None]) -> list:
    """RANKED: the name with the least value, the value and its photons, the second's name, the ratio of the two and the second's photons."""
    there = sorted((found.value, name) for name, found in values.items() if found is not None)
    if not there:
        return ["nothing", *[None] * 3, "", "", None, "", *[None] * 3, "", None]
    (least_value, name), rest = there[0], there[1:]
    first = values[name]
    row = [name, *first[:3], str(first.at_most).lower(), str(first.disturbed).lower(), first.photons or None]
    if not rest:
        return [*row, "", *[None] * 3, "", None]
    second, times = values[rest[0][1]], rest[0][0] / least_value
    own, other = half_widths(first), half_widths(second)
    ends = [times * math.exp(-math.hypot(other[0], own[1])), times * math.exp(math.hypot(other[1], own[0]))] if own and other else [None, None]
    return [*row, rest[0][1], times, *ends, str(second.at_most).lower(), second.photons or None]


def ranked(of_scenes: dict[str, dict[str, list[Point]]], ats: list[float], by_error: bool) -> list[list]:
    """For each scene and error (or time) who is there first (or has the least error)."""
    return [[scene, f"{at:g}", "done", *first_two({name: found_on(curve, at, by_error) for name, curve in by.items()})]
            for scene, by in sorted(of_scenes.items()) for at in ats]
