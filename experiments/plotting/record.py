#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Puts a table that was typed into a page of results/ into a CSV of its own, and the page's table between the comments that show it (pages.py).

    record.py PAGE LINE CSV --command COMMAND [--device DEVICE] [--seed SEED] [--version VERSION] [--date DATE] [--load PROCESSORS]

LINE is any line of the table, CSV is below results/. For what no study makes: a single run, a test's figures, a count. What a study makes has its rows from there.
"""

import argparse
import csv
import datetime
import pathlib
import re
import sys

from views import PROVENANCE, cells_of


def table_at(lines: list[str], line: int) -> tuple[int, int]:
    """The first line of the table that a line is of, and the one after its last, counted from 0."""
    first = last = line - 1
    if not 0 <= first < len(lines) or not lines[first].startswith("|"):
        sys.exit(f"record: line {line} is not of a table")
    while first > 0 and lines[first - 1].startswith("|"):
        first -= 1
    while last < len(lines) and lines[last].startswith("|"):
        last += 1
    if last - first < 3:
        sys.exit(f"record: the table at line {line} has no rows")
    return first, last


def columns_of(head: list[str]) -> list[str]:
    """Its headings as names of columns: each once, none that says where the table is from."""
    columns: list[str] = []
    for cell in head:
        name = re.sub(r"[`*]", "", cell) or "what"
        name = f"{name} here" if name in PROVENANCE else name
        columns.append(name if name not in columns else f"{name} ({sum(one.split(' (')[0] == name for one in columns) + 1})")
    return columns


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("line", type=int)
    parser.add_argument("csv")
    parser.add_argument("--command", required=True)
    for name, default in (("device", ""), ("seed", ""), ("version", ""), ("date", datetime.date.today().isoformat()), ("load", "")):
        parser.add_argument(f"--{name}", default=default)
    arguments = parser.parse_args()
    lines = arguments.page.read_text().split("\n")
    first, last = table_at(lines, arguments.line)
    head, rows = cells_of(lines[first]), [cells_of(line) for line in lines[first + 2:last]]
    columns = columns_of(head)
    if wrong := [row for row in rows if len(row) != len(columns)]:
        sys.exit(f"record: a row has {len(wrong[0])} cells, the table {len(columns)} columns: {' | '.join(wrong[0])}")
    for row, before in zip(rows[1:], rows):
        row[0] = row[0] or before[0]  # a first cell that stands for several rows
    words = [name for i, name in enumerate(columns) if all(re.fullmatch(r"`[^`]+`|", row[i]) for row in rows) and any(row[i] for row in rows)]
    of_all = [arguments.command, arguments.version, arguments.device, arguments.seed, arguments.date, arguments.load]
    target = arguments.page.parent / arguments.csv
    target.parent.mkdir(parents=True, exist_ok=True)
    with target.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([*columns, *PROVENANCE])
        writer.writerows([cell.strip("`") if name in words else cell for name, cell in zip(columns, row)] + of_all for row in rows)
    spec = [f'file = "{arguments.csv}"']
    if words:
        spec.append("words = [" + ", ".join(f'"{name}"' for name in words) + "]")
    if names := {name: cell for name, cell in zip(columns, head) if name != cell}:
        spec.append("names = { " + ", ".join(f'"{name}" = "{cell}"' for name, cell in names.items()) + " }")
    lines[first:last] = ["<!-- table", *spec, "-->", "<!-- end -->"]
    arguments.page.write_text("\n".join(lines))
    print(f"{target}: {len(rows)} rows; pages.py {arguments.page} shows them")
    return 0


if __name__ == "__main__":
    sys.exit(main())
