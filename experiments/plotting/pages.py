#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables and numbers of the pages in results/, from the CSVs there.

    pages.py [--check] [--results results] [PAGE...]

Rewrites what stands between two comments of a page and leaves all else, which is prose, as it is:

    <!-- table
    file = "wyman_nichols2009/traversal.csv"       # below results/; a list of several stand together, as of several machines
    rows = ["scene", "refine.finest"]              # the settings that a row has, in its first columns
    where = { scene = "pool" }                     # optional: only the runs with these settings; a list: any of its values
    across = ["refine.metric"]                     # optional: a column for each of these settings' values
    cells = ["emitted ,.0f", "relMSE .3g; SMAPE .3f"]   # columns of the CSV, each with a format; `%` for shares, `s` for words
    names = { "refine.finest" = "cells a side" }   # optional: what a heading says instead
    -->
    ...
    <!-- end -->

    relMSE of <!-- = traversal.csv: relMSE .3g; scene=pool, refine.finest=1024 -->0.0123<!-- / --> at 1024.

A table that more is computed for has `by = "wyman2008.py error"` in place of rows and cells: what that program, which lies next to this one, prints of the file.

Rows are sorted by their settings. A run that is not done has its status instead, a value that is not there "–". Runs of several devices have a row each, never one for all, and a column with the
device's number. Under a table stand the version and the device of its runs, each where there are several, their dates, and how busy the machine was with other work while they were timed. --check writes nothing and ends with 1 where a page is not what the CSVs say. Ends with 2 where a page asks
for what is not there, with its line.
"""

import argparse
import csv
import functools
import pathlib
import re
import subprocess
import sys
import tomllib

from rebuild import STUDIES

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What is made of other files than a study's runs here, by which file in experiments/.
DERIVED = {"costs/passes.csv": "costs.sh", "device/h100_errors.csv": "device_errors.toml", "device/h100_times.csv": "device_times.toml",
           "wyman2008/lens_widths.csv": "plotting/lens_widths.py", "flicker/flicker.csv": "flicker.py",
           **{f"all_techniques/{name}.csv": "plotting/speed_error.py" for name in ("answers", "costs", "equal_error", "in_time", "published", "summary", "to_error")}}
TABLE = re.compile(r"^<!-- table\n(.*?)^-->\n(.*?)^<!-- end -->$", re.M | re.S)
NUMBER = re.compile(r"<!-- = ([\w./-]+): ([^;>]+?) (\S+); ([^>]*?) -->(.*?)<!-- / -->")
# So many processors are busy on an idle machine too.
BUSY = 0.2
KEYS = {"file", "rows", "where", "across", "cells", "names", "by"}


class PageError(Exception):
    """What a page asks for and no CSV has."""


@functools.cache
def runs(file: pathlib.Path) -> tuple[dict, ...]:
    if not file.is_file():
        raise PageError(f"there is no '{file}'")
    with file.open(newline="") as stream:
        return tuple(csv.DictReader(stream))


def column(row: dict, name: str) -> str:
    if name not in row:
        raise PageError(f"there is no column '{name}'; there are {', '.join(row)}")
    return row[name]


def chosen(rows: tuple[dict, ...], settings: dict) -> list[dict]:
    return [row for row in rows
            if all(column(row, key) in map(str, value if isinstance(value, list) else [value]) for key, value in settings.items())]


def formatted(text: str, style: str) -> str:
    """A cell's number as Python's format says; `.2%` of a share is a percentage with its sign apart; `s` is a word as it stands."""
    if text in ("", "nan"):
        return "–"
    if style == "s":
        return f"`{text}`"
    number = float(text)
    if style.endswith("%"):
        return f"{100.0 * number:{style[:-1]}f} %"
    return re.sub(r"e([+-])0?(\d)", r"e\1\2", f"{number:{style}}")


def cell(rows: list[dict], spec: str, names: dict) -> str:
    """`spec`: columns with their formats, divided by semicolons."""
    if not rows:
        return "–"
    if len(rows) > 1:
        raise PageError(f"{len(rows)} runs for one cell: 'rows', 'across' and 'where' do not tell them apart")
    row, = rows
    if row.get("status", "done") != "done":
        return names.get(row["status"], row["status"])
    values = []
    for part in spec.split(";"):
        name, _, style = part.strip().rpartition(" ")
        values.append(formatted(column(row, name), style))
    return "–" if set(values) == {"–"} else "; ".join(values)


def in_order(text: str) -> tuple:
    """A key that sorts numbers by their size, and among other words: as they are read."""
    return tuple((0, float(part), "") if re.fullmatch(r"\d+(\.\d+)?", part) else (1, 0.0, part)
                 for part in re.split(r"(\d+(?:\.\d+)?)", text) if part)


def shown(value: str) -> str:
    if not value:
        return "–"
    return value if in_order(value)[:1] and in_order(value)[0][0] == 0 else f"`{value}`"


def devices_of(rows: list[dict]) -> list[str]:
    """A run that is not done may not say which."""
    return sorted({row["device"] for row in rows if row.get("device")})


def command_of(file: str) -> str:
    """The command that makes it."""
    studies = [study for study, target in STUDIES.items() if target == file]
    if not studies and file in DERIVED:
        return f" by `experiments/{DERIVED[file]}`"
    return f" by `experiments/rebuild_results.sh {studies[0]}`" if studies else ""


def of_which_runs(rows: list[dict], files: list[str]) -> str:
    """What a table's runs are of, under it."""
    kinds = sorted({(row.get("version", ""), row.get("device", "")) for row in rows})
    devices = devices_of(rows)

    def named(device: str) -> str:
        return f"device {devices.index(device) + 1}: {device}" if device and len(devices) > 1 else device

    parts = [f"{', '.join(f'[`{file}`]({file}){command_of(file)}' for file in files)}, {len(rows)} {'row' if len(rows) == 1 else 'rows'}",
             *(", ".join(filter(None, (version and f"version {version}", named(device)))) for version, device in kinds if version or device)]
    dates = sorted({row["date"][:10] for row in rows if row.get("date")})
    if dates:
        parts.append(dates[0] if len(dates) == 1 else f"{dates[0]} to {dates[-1]}")
    loads = [float(row["other_processors"]) for row in rows if row.get("other_processors")]
    if loads and max(loads) > BUSY:
        parts.append(f"other work kept up to {max(loads):.1f} processors busy")
    return "; ".join(parts)


def printed(command: str, file: pathlib.Path) -> str:
    program, *arguments = command.split()
    done = subprocess.run([sys.executable, "-B", ROOT / "experiments/plotting" / program, *arguments, file], capture_output=True, text=True)
    if done.returncode:
        raise PageError(f"'{command}' ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout.strip()


def table(spec: dict, results: pathlib.Path) -> str:
    if unknown := set(spec) - KEYS:
        raise PageError(f"a table has no '{sorted(unknown)[0]}'; it has {', '.join(sorted(KEYS))}")
    needs, never = ({"file"}, {"rows", "where", "across", "cells", "names"}) if "by" in spec else ({"file", "rows", "cells"}, set())
    if excess := never & set(spec):
        raise PageError(f"a table by a program has no '{sorted(excess)[0]}'")
    if missing := needs - set(spec):
        raise PageError(f"a table needs '{sorted(missing)[0]}'")
    files = [spec["file"]] if isinstance(spec["file"], str) else spec["file"]
    rows = [row for file in files for row in chosen(runs(results / file), spec.get("where", {}))]
    if not rows:
        raise PageError(f"no run of '{', '.join(files)}' has these settings")
    if "by" in spec:
        if len(files) > 1:
            raise PageError(f"'{spec['by']}' takes one file")
        return f"\n{printed(spec['by'], results / files[0])}\n\n*{of_which_runs(rows, files)}.*\n\n"
    keys, names, across = spec["rows"], spec.get("names", {}), spec.get("across", [])
    devices = devices_of(rows)
    if len(devices) > 1:
        keys = [*keys, "on device"]
        rows = [row | {"on device": str(devices.index(row["device"]) + 1 if row.get("device") else "–")} for row in rows]

    def values_of(row: dict, settings: list[str]) -> tuple:
        return tuple(column(row, key) for key in settings)

    def combinations(settings: list[str]) -> list[tuple]:
        return sorted({values_of(row, settings) for row in rows},
                      key=lambda values: [in_order(value) for value in values])

    def heading(cells: str, variant: tuple) -> str:
        columns = [part.strip().rpartition(" ")[0] for part in cells.split(";")]
        quantity = "; ".join(names.get(name, name) for name in columns)
        if not variant:
            return quantity
        of = names.get(", ".join(variant), ", ".join(names.get(value, shown(value)) for value in variant))
        return f"{quantity}, {of}" if len(spec["cells"]) > 1 else of

    columns = [(cells, variant) for cells in spec["cells"] for variant in combinations(across)]
    head = [*(names.get(key, key) for key in keys), *(heading(*of) for of in columns)]
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    for values in combinations(keys):
        of_row = [row for row in rows if values_of(row, keys) == values]
        cells = [cell([row for row in of_row if values_of(row, across) == variant], cells, names)
                 for cells, variant in columns]
        lines.append("| " + " | ".join([*map(shown, values), *cells]) + " |")
    return "\n" + "\n".join(lines) + f"\n\n*{of_which_runs(rows, files)}.*\n\n"


def number(match: re.Match, results: pathlib.Path) -> str:
    file, name, style, conditions, _ = match.groups()
    settings = dict(pair.strip().split("=", 1) for pair in conditions.split(","))
    return cell(chosen(runs(results / file), settings), f"{name} {style}", {})


def remade(page: pathlib.Path, results: pathlib.Path) -> str:
    """The page as the CSVs say it is."""
    text = page.read_text()

    def at(match: re.Match, make):
        try:
            return make(match)
        except (PageError, tomllib.TOMLDecodeError, ValueError) as error:
            line = match.string.count("\n", 0, match.start()) + 1
            raise PageError(f"{page}:{line}: {error}") from error

    def new_table(match):
        return f"<!-- table\n{match[1]}-->\n{table(tomllib.loads(match[1]), results)}<!-- end -->"

    def new_number(match):
        comment = match[0][:match[0].index("-->") + 3]
        return f"{comment}{number(match, results)}<!-- / -->"

    if text.count("<!-- table\n") != len(TABLE.findall(text)):
        raise PageError(f"{page}: a table is not ended by a line '<!-- end -->'")
    with_tables = TABLE.sub(lambda match: at(match, new_table), text)
    return NUMBER.sub(lambda match: at(match, new_number), with_tables)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    different, problems = [], 0
    for page in arguments.pages or sorted(arguments.results.glob("*.md")):
        try:
            text, new = page.read_text(), remade(page, arguments.results)
        except (PageError, OSError) as error:
            print(f"pages: {error}", file=sys.stderr)
            problems += 1
            continue
        if new == text:
            continue
        different.append(page)
        if not arguments.check:
            page.write_text(new)
            continue
        for line, (old, now) in enumerate(zip(text.splitlines(), new.splitlines()), 1):
            if old != now:
                print(f"{page}:{line}: stands there: {old}\n  the CSV says: {now}", file=sys.stderr)
                break
    for page in different:
        print(f"{page} {'is not what its CSVs say' if arguments.check else 'is new'}")
    if problems:
        return 2
    return 1 if arguments.check and different else 0


if __name__ == "__main__":
    sys.exit(main())
