#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of speed_and_error.md from what speed_error.py has written, with intervals of one standard deviation behind the figures.

    speed_error_tables.py answers|to_error|in_time|one_second|photon_mapping CSV

`≤`, `≥`: the curve ends before, and the figure is a bound. Behind a winner stands the second with `×`, how far it is behind, or `≈`, where that is no lead: its interval has 1 in it, or it is less than a
twentieth, since two techniques' errors are of one set of random numbers each. A star: of a run whose frames differed much.
"""

import argparse
import pathlib
import sys

from quantities import formatted
from runs import head, line
from speed_curves import rows_of

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


def winner(row: dict) -> str:
    if not row["value"]:
        return "–"
    is_first = row["first"] == "light tracer" and row["at_most"] == "true" and float(row["value"]) <= LEAST_MS
    figure = f"≤ {LEAST_MS}" if is_first else ("≤ " if row["at_most"] == "true" else "") + with_interval(row, "value", "low", "high")
    lead = ""
    if row["times"]:
        is_even = float(row["times"]) < LEAD or row["times low"] and float(row["times low"]) <= 1.0
        lead = f"; `{row['second']}` " + ("≈" if is_even else f"×{digits(row['times'])}")
    return f"`{row['first']}`{star(row['disturbed'])} {figure}{lead}"


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


TABLES = {"answers": of_answers, "to_error": lambda rows: pivot(rows, "relMSE", winner), "in_time": lambda rows: pivot(rows, "ms", winner), "one_second": of_one_second,
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
