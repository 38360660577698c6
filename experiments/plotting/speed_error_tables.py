#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of speed_and_error.md from what speed_error.py has written, with intervals of one standard deviation after the figures.

    speed_error_tables.py answers|to_error|in_time|one_second|photon_mapping|counts|goals CSV

`≤`, `≥`: the curve ends before, and the figure is a bound. `249²` are the photons of a technique's grid, `1.7M` those of the light tracer. Below a winner stands the second with `×`, how far it is behind,
or `≈`, where that is no lead: its interval has 1 in it, or it is less than a twentieth, since two techniques' errors are of one set of random numbers each. Where the light tracer is first the second is
the first technique. A star: of a run whose frames differed much.
"""

import argparse
import pathlib
import sys

from quantities import formatted
from runs import head, line
from speed_curves import DEFAULT, LIGHT_TRACER, PHOTON_MAPPING, VARIED, rows_of

LEAST_MS = 0.1  # where the light tracer's curve begins
LEAD = 1.05


def digits(text: str) -> str:
    """Two digits; of what is above 100 whole numbers."""
    value = float(text)
    return f"{value:,.0f}" if abs(value) >= 99.5 else formatted(repr(value), ".2g")


def with_interval(row: dict, value: str, low: str, high: str) -> str:
    figure, *ends = [digits(row[key]) if row[key] else "–" for key in (value, low, high)]
    return figure if ends == [figure] * 2 else f"{figure} ({ends[0]} to {ends[1]})"


def star(is_disturbed: str) -> str:
    return "\\*" if is_disturbed == "true" else ""


def of_answers(rows: list[dict]) -> str:
    lines = [head(["scene", "default's ms", "default's relMSE, net", "light tracer's ms for it", "default: times as fast", "best", "best's ms", "best's relMSE, net", "best: times as fast"])]
    for row in rows:
        own = [digits(row[key]) for key in ("default's ms", "default's relMSE, net", "light tracer's ms")] if row["factor"] else ["–"] * 3
        factors = [("≥ " if row[of + "at_least"] == "true" else "") + with_interval(row, of + "factor", of + "low", of + "high") + star(row[of + "disturbed"]) if row[of + "factor"] else "–"
                   for of in ("", "best's ")]
        lines.append(line([f"`{row['scene']}`", *own, factors[0], f"`{row['best']}`", digits(row["best's ms"]), digits(row["best's relMSE, net"]), factors[1]]))
    return "\n".join(lines)


def photons_of(name: str, photons: str) -> str:
    """` 249²`; of an adaptive map its finest cells; of what a user would pick instead all of them, ` 1.7M`; nothing where meshes say how many."""
    if not photons:
        return ""
    value, base = float(photons), name.removesuffix(", as published")
    if base in (LIGHT_TRACER, PHOTON_MAPPING):
        scale, unit = next(((scale, unit) for scale, unit in ((1e6, "M"), (1e3, "k")) if value >= scale), (1.0, ""))
        return f" {digits(repr(value / scale))}{unit}"
    return (" cells of " if VARIED.get(base) else " ") + f"{value:.0f}²"


def winner(row: dict) -> str:
    if not row["value"]:
        return "–"
    tracer_is_first = row["first"] == LIGHT_TRACER
    figure = ("≤ " if row["at_most"] == "true" else "") + with_interval(row, "value", "low", "high")
    photons = photons_of(row["first"], row["photons"])
    if tracer_is_first and row["at_most"] == "true" and float(row["value"]) <= LEAST_MS:  # its curve begins there, and not its photons
        figure, photons = f"≤ {LEAST_MS}", ""
    second = "no technique" if tracer_is_first else ""
    if row["times"]:
        is_even = float(row["times"]) < LEAD or row["times low"] and float(row["times low"]) <= 1.0
        own = photons_of(row["second"], row["second photons"]) if tracer_is_first else ""
        bound = " ≤" if own and row["second at_most"] == "true" else ""
        second = f"`{row['second']}`{bound}{own} " + ("≈" if is_even else f"×{digits(row['times'])}")
    return f"`{row['first']}`{star(row['disturbed'])}{photons}: {figure}" + (f"<br>{second}" if second else "")


def pivot(rows: list[dict], across: str, cell) -> str:
    columns = sorted({row[across] for row in rows}, key=lambda text: float(text.split("x")[0]))
    cells = {(row["scene"], row[across]): cell(row) for row in rows}
    return "\n".join([head(["scene", *columns]), *(line([f"`{scene}`", *(cells.get((scene, column), "–") for column in columns)]) for scene in sorted({row["scene"] for row in rows}))])


def of_one_second(rows: list[dict]) -> str:
    lines = [head(["scene", "light tracer's relMSE after 1 s", "default's least relMSE", "its photons", "its ms", "least as a part", "ms to the light tracer's", "times as fast"])]
    for row in rows:
        reached = [with_interval(row, *keys) for keys in (("ms to it", "low", "high"), ("times", "times low", "times high"))] if row["reached"] == "true" else ["not reached", "–"]
        if row["at_most"] == "true":
            reached = ["≤ " + reached[0], "≥ " + reached[1]]
        lines.append(line([f"`{row['scene']}`", digits(row["relMSE"]), digits(row["default's least relMSE"]), f"`{row['emit.photons']}`", digits(row["ms"]), digits(row["part"]), *reached]))
    return "\n".join(lines)


def of_counts(rows: list[dict]) -> str:
    """The default's runs, of equal_error.csv: the first table that somebody who takes it looks at."""
    own = [row for row in rows if row["technique"] == DEFAULT and row["as_published"] == "false"]
    counts = sorted({row["emit.photons"] for row in own}, key=lambda size: int(size.split("x")[0]))
    cells = {(row["scene"], row["emit.photons"]): [digits(row["ms"]), digits(row["relMSE, net"]), ("≥ " if row["at_least"] == "true" else "") + digits(row["factor"])] for row in own}
    lines = [head(["scene", *(f"{what}, {size.split('x')[0]}²" for what in ("ms", "relMSE, net", "times as fast") for size in counts)])]
    for scene in sorted({row["scene"] for row in own}):
        lines.append(line([f"`{scene}`", *(cells.get((scene, size), ["–"] * 3)[place] for place in range(3) for size in counts)]))
    return "\n".join(lines)


def of_goals(rows: list[dict]) -> str:
    lines = [head(["times of", "scenes", "without", "3 times as fast or more", "slower", "least", "median", "largest"])]
    for row in rows:
        median = digits(row["median"])
        if row["missing"]:
            median += " (with " + ("it" if "," not in row["missing"] else "them") + f" {digits(row['median least']) if row['median least'] else '–'} to {digits(row['median most']) if row['median most'] else '–'})"
        lines.append(line([row["by"], f"{row['scenes']} of {row['of']}", ", ".join(f"`{scene}`" for scene in row["missing"].split(", ")) if row["missing"] else "–", row["above 3"], row["slower"],
                           digits(row["least"]), median, digits(row["largest"])]))
    return "\n".join(lines)


TABLES = {"answers": of_answers, "to_error": lambda rows: pivot(rows, "relMSE", winner), "in_time": lambda rows: pivot(rows, "ms", winner), "one_second": of_one_second,
          "counts": of_counts, "goals": of_goals,
          "photon_mapping": lambda rows: pivot(rows, "emit.photons", lambda row: f"{row['bound']} {with_interval(row, 'factor', 'low', 'high')}".strip())}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=TABLES)
    parser.add_argument("file", type=pathlib.Path)
    arguments = parser.parse_args()
    print(TABLES[arguments.table](rows_of(arguments.file)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
