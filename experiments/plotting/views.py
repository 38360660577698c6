# SPDX-License-Identifier: MIT
"""What the pages of results/ are made of, as rows of cells: a CSV there, the table that a paper's program prints of one, or the tables of another page.

A study's CSV may be of before its program's table needed all that it needs now, and some tables need pictures, which are not kept. Then NAME_recorded.csv
next to NAME.csv has the table as it was printed, with its command, version and date, until the study is run again (rebuild.py removes or rewrites it).
"""

import csv
import functools
import pathlib
import re
import subprocess
import sys

from study import device_of
from table import MEASURED

PLOTTING = pathlib.Path(__file__).resolve().parent
# Columns of a recorded table that say what it is of.
PROVENANCE = ("command", "version", "device", "seed", "date", "other_processors")
# So many processors are busy on an idle machine too.
BUSY = 0.2
COMMENT = re.compile(r"<!--.*?-->", re.S)


class PageError(Exception):
    """What a page asks for and no CSV has."""


@functools.cache
def runs(file: pathlib.Path) -> tuple[dict, ...]:
    if not file.is_file():
        raise PageError(f"there is no '{file}'")
    with file.open(newline="") as stream:
        rows = tuple(csv.DictReader(stream))
    if rows and "frame_ms.median" in rows[0]:  # all of a study's runs.csv: its device with its threads, as in other CSVs
        for row in rows:
            row["device"] = device_of(row)
    return rows


def column(row: dict, name: str) -> str:
    """A cell; of a study's runs.csv also what table.py makes of it."""
    if name in row:
        return row[name]
    if "frame_ms.median" in row:
        for measured, _, get in MEASURED:
            if measured == name:
                value = get(row)
                return "" if value is None else repr(value)
    raise PageError(f"there is no column '{name}'; there are {', '.join(row)}")


def chosen(rows: tuple[dict, ...], settings: dict) -> list[dict]:
    return [row for row in rows
            if all(column(row, key) in map(str, value if isinstance(value, list) else [value]) for key, value in settings.items())]


def recorded_of(file: str) -> str:
    return file.removesuffix(".csv") + "_recorded.csv"


@functools.cache
def printed(program: str, arguments: str, file: pathlib.Path) -> str:
    """What a program next to this one prints of a CSV."""
    done = subprocess.run([sys.executable, "-B", PLOTTING / program, *arguments.split(), file], capture_output=True, text=True)
    if done.returncode:
        raise PageError(f"'{program} {arguments}' ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout.strip()


def plain(cell: str) -> str:
    """A cell's text without what only sets it."""
    return COMMENT.sub("", cell).replace("**", "").replace("`", "").strip()


def cells_of(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().removeprefix("|").removesuffix("|"))]


def rows_of(markdown: str) -> list[dict]:
    """The rows of all its tables; `under` is the heading, or the line alone, that a table stands under. A heading that comes again has its number."""
    rows, under, lines = [], "", markdown.splitlines()
    head: list[str] = []
    for line, after in zip(lines, [*lines[1:], ""]):
        if not line.startswith("|"):
            if line.strip() and (line.startswith("#") or re.match(r"`[\w-]+`", line)):
                under = plain(line.lstrip("# ")).split(":")[0]
            head = []
        elif not head:
            if re.match(r"\|[\s:|-]+\|$", after.strip()):
                head = []
                for cell in map(plain, cells_of(line)):
                    head.append(cell if cell not in head else f"{cell} ({sum(other.split(' (')[0] == cell for other in head) + 1})")
        elif not re.match(r"\|[\s:|-]+\|$", line.strip()):
            rows.append({"under": under, **dict(zip(head, map(plain, cells_of(line))))})
    return rows


@functools.cache
def printed_rows(results: pathlib.Path, file: str, table: str) -> tuple[dict, ...]:
    """The rows of what a program of its own, or a table of the one of the folder's name, prints of a CSV."""
    if not (results / file).is_file():
        raise PageError(f"there is no '{file}'")
    own = (PLOTTING / f"{table}.py").is_file()
    program, arguments = (f"{table}.py", "") if own else (f"{pathlib.PurePath(file).parts[0]}.py", table)
    return tuple(rows_of(printed(program, arguments, results / file)))


@functools.cache
def is_recorded(results: pathlib.Path, file: str, table: str) -> bool:
    """Whether a table has to be taken as it once was printed."""
    if not (results / recorded_of(file)).is_file():
        return False
    try:
        printed_rows(results, file, table)
        return False
    except PageError:
        return True


@functools.cache
def view(results: pathlib.Path, file: str, table: str = "") -> tuple[dict, ...]:
    """The rows of a CSV, of a page, or of `table`, which the program of the CSV's folder prints of it."""
    if file.endswith(".md"):
        if not (results / file).is_file():
            raise PageError(f"there is no '{file}'")
        return tuple(rows_of((results / file).read_text()))
    if not table:
        return runs(results / file)
    if is_recorded(results, file, table):
        return tuple({key: plain(cell) for key, cell in row.items()} for row in runs(results / recorded_of(file)))
    return printed_rows(results, file, table)
