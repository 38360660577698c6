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

More of such numbers in quantities.py. A table that more is computed for has `by = "wyman2008.py error"` in place of rows and cells: what that program, which lies next to this
one, prints of the file. A table of `file` alone shows the CSV as it stands, but for what says where it is from; `words` are columns of names. Where a study's CSV
cannot make its table, NAME_recorded.csv has it as it was (views.py).

A table of numbers that stands outside of such comments is an error: nothing would say when it is no longer true. What is only quoted may be typed: before the table stands
`<!-- typed: claim; section -->`, which names those columns. A number in a sentence that looks measured and is neither by name nor marked as typed, with why, is an error too
(sentences.py), on the README of the project as well. Links to other pages and their headings have to lead somewhere.

Rows are sorted by their settings. A run that is not done has its status instead, a value that is not there "–". Runs of several devices have a row each, never one for all, and a column with the
device's number. Under a table stand the version and the device of its runs, each where there are several, their dates, and how busy the machine was with other work while they were timed. --check writes nothing and ends with 1 where a page is not what the CSVs say. Ends with 2 where a page asks
for what is not there, with its line.
"""

import argparse
import pathlib
import re
import sys
import tomllib

import drawings
import studies
from quantities import NUMBER, formatted, source_of, text_of
from sentences import unnamed
from studies import anchor_of, command_of, seeds_of
from views import BUSY, PROVENANCE, PageError, cells_of, chosen, column, printed, recorded_of, runs

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Pages that a program writes as a whole.
WRITTEN = ("numerics.md", studies.PAGE)
TABLE = re.compile(r"^<!-- table\n(.*?)^-->\n(.*?)^<!-- end -->$", re.M | re.S)
KEYS = {"file", "rows", "where", "across", "cells", "names", "by", "columns", "words"}


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


def recorded(rows: list[dict], file: str, anew: str) -> str:
    """What a table is of that was kept as it was printed, under it."""
    def all_of(key: str) -> list[str]:
        return sorted({row[key] for row in rows if row.get(key)})

    # What rebuild.py keeps has the version alone; what was copied from a page has the commit at which it stood there.
    is_current = not any("(" in version for version in all_of("version"))
    parts = [f"[`{file}`]({file}), recorded {', '.join(all_of('date')) or 'earlier'}", *(f"version {version}" for version in all_of("version")), *all_of("device"),
             *(f"seed {seed}" for seed in all_of("seed")), *(f"other work kept {load} processors busy" for load in all_of("other_processors")),
             f"by {anew}" + ("" if is_current else ", which makes it anew: this is of an older version") if anew else "; ".join(f"by `{command}`" for command in all_of("command"))]
    return "; ".join(filter(None, parts))


def of_which_runs(rows: list[dict], files: list[str]) -> str:
    """What a table's runs are of, under it."""
    kinds = sorted({(row.get("version", ""), row.get("device", "")) for row in rows})
    devices = devices_of(rows)

    def named(device: str) -> str:
        return f"device {devices.index(device) + 1}: {device}" if device and len(devices) > 1 else device

    parts = [f"{', '.join(f'[`{file}`]({file}){command_of(file)}' for file in files)}, {len(rows)} {'row' if len(rows) == 1 else 'rows'}",
             *(", ".join(filter(None, (version and f"version {version}", named(device)))) for version, device in kinds if version or device)]
    parts += filter(None, dict.fromkeys(map(seeds_of, files)))
    dates = sorted({row["date"][:10] for row in rows if row.get("date")})
    if dates:
        parts.append(dates[0] if len(dates) == 1 else f"{dates[0]} to {dates[-1]}")
    loads = [float(row["other_processors"]) for row in rows if row.get("other_processors")]
    if loads and max(loads) > BUSY:
        parts.append(f"other work kept up to {max(loads):.1f} processors busy")
    return "; ".join(parts)


def as_it_stands(spec: dict, file: str, anew: str, results: pathlib.Path) -> str:
    """A recorded table."""
    rows = chosen(runs(results / file), spec.get("where", {}))
    if not rows:
        raise PageError(f"no row of '{file}' has these settings")
    columns = spec.get("columns") or [name for name in rows[0] if name not in (*PROVENANCE, "sources")]
    names, words = spec.get("names", {}), spec.get("words", [])
    lines = ["| " + " | ".join(names.get(name, name) for name in columns) + " |", "|" + " --- |" * len(columns)]
    for row in rows:
        cells = [column(row, name) for name in columns]
        lines.append("| " + " | ".join(f"`{cell}`" if cell and name in words else cell for name, cell in zip(columns, cells)) + " |")
    return "\n" + "\n".join(lines) + f"\n\n*{recorded(rows, file, anew)}.*\n\n"


def table(spec: dict, results: pathlib.Path) -> str:
    if unknown := set(spec) - KEYS:
        raise PageError(f"a table has no '{sorted(unknown)[0]}'; it has {', '.join(sorted(KEYS))}")
    if "by" in spec and (excess := {"rows", "where", "across", "cells"} & set(spec)):
        raise PageError(f"a table by a program has no '{sorted(excess)[0]}'")
    if "file" not in spec or ("rows" in spec) != ("cells" in spec):
        raise PageError(f"a table needs '{next(key for key in ('file', 'rows', 'cells') if key not in spec)}'")
    files = [spec["file"]] if isinstance(spec["file"], str) else spec["file"]
    if not {"by", "rows"} & set(spec):
        return as_it_stands(spec, files[0], "", results)
    kept = recorded_of(files[0])
    try:
        return made(spec, files, results)
    except PageError:
        if not (results / kept).is_file():
            raise
        shown_as = {key: value for key, value in spec.items() if key in ("words", "names")}
        return as_it_stands(shown_as, kept, command_of(files[0]).removeprefix(" by "), results)


def made(spec: dict, files: list[str], results: pathlib.Path) -> str:
    """A table of what its files say."""
    rows = [row for file in files for row in chosen(runs(results / file), spec.get("where", {}))]
    if not rows:
        raise PageError(f"no run of '{', '.join(files)}' has these settings")
    if "by" in spec:
        if len(files) > 1:
            raise PageError(f"'{spec['by']}' takes one file")
        program, _, arguments = spec["by"].partition(" ")
        return f"\n{printed(program, arguments, results / files[0])}\n\n*{of_which_runs(rows, files)}.*\n\n"
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


def without_tables(text: str) -> str:
    """A page without the tables that are made, on the same lines."""
    return TABLE.sub(lambda match: "\n" * match[0].count("\n"), text)


def typed_numbers(text: str) -> list[tuple[int, str]]:
    """The tables outside of comments that have a number which nothing says the origin of: their lines, and what stands there."""
    found, columns, allowed, is_in_code, is_found = [], None, set(), False, False
    lines = without_tables(text).splitlines()
    for at, line in enumerate(lines):
        is_in_code ^= line.startswith("```")
        if match := re.fullmatch(r"<!-- typed: (.*) -->", line):
            allowed = {name.strip() for name in match[1].split(";")}
        elif is_in_code or not line.startswith("|"):
            allowed = allowed if columns is None else set()
            columns = None
        elif columns is None:
            columns, is_found = cells_of(line), False
            if unknown := allowed - set(columns):
                raise PageError(f"line {at + 1}: the table has no column '{sorted(unknown)[0]}'")
        elif not is_found:
            for name, cell in zip(columns, cells_of(line)):
                # Links by their words (of a heading), but not by a number.
                bare = re.sub(r"\[[^\]]*[a-z]{3}[^\]]*\]\([^)]*\)|`[^`]*`|\]\([^)]*\)|<!-- .*?-->", "", NUMBER.sub("", cell))
                # What a setting is called (1024², 400×300) and names such as H100 are no results.
                bare = re.sub(r"\d+²|\d+×\d+²?", "", bare)
                if name not in allowed and (number := re.search(r"(?<![\w.])[+−-]?\d[\d.,]*", bare)):
                    found.append((at + 1, f"a table outside of comments says '{number[0]}' in column '{name}'"))
                    is_found = True
                    break
    return found


def anchors_of(page: pathlib.Path) -> set[str]:
    """As GitHub makes them of headings."""
    return {anchor_of(head) for head in re.findall(r"^#+ (.*)$", page.read_text(), re.M)}


def broken_links(page: pathlib.Path, text: str) -> list[tuple[int, str]]:
    found = []
    for match in re.finditer(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)", text):
        target = (page.parent / match[1]) if match[1] else page
        line = text.count("\n", 0, match.start()) + 1
        if not target.exists():
            found.append((line, f"there is no '{match[1]}'"))
        elif match[2] and target.suffix == ".md" and match[2] not in anchors_of(target):
            found.append((line, f"'{target.name}' has no heading '#{match[2]}'"))
    return found


def remade(page: pathlib.Path, results: pathlib.Path) -> str:
    """The page as the CSVs say it is."""
    text, problems = page.read_text(), []

    def at(match: re.Match, make):
        try:
            return make(match)
        except (PageError, tomllib.TOMLDecodeError, ValueError) as error:
            line = match.string.count("\n", 0, match.start()) + 1
            problems.append(f"{page}:{line}: {error}")
            return match[0]

    def new_table(match):
        return f"<!-- table\n{match[1]}-->\n{table(tomllib.loads(match[1]), results)}<!-- end -->"

    def new_number(match):
        comment = match[0][:match[0].index("-->") + 3]
        value, source = text_of(match, results), source_of(match, results)
        # It leads to where its file's command stands, unless it is within a link already.
        if match.string[match.start() - 1:match.start()] != "[" and (results / studies.PAGE).is_file():
            value = f"[{value}]({source if source.endswith('.md') else f'{studies.PAGE}#{anchor_of(source)}'})"
        return f"{comment}{value}<!-- / -->"

    if text.count("<!-- table\n") != len(TABLE.findall(text)):
        raise PageError(f"{page}: a table is not ended by a line '<!-- end -->'")
    with_tables = TABLE.sub(lambda match: at(match, new_table), text)
    with_numbers = NUMBER.sub(lambda match: at(match, new_number), with_tables)
    if problems:
        raise PageError("\npages: ".join(problems))
    return with_numbers


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    different, problems = [], 0
    state = arguments.results / studies.PAGE
    if state.is_file() and not arguments.check:
        state.write_text(studies.page_of(arguments.results))
    for page in arguments.pages or sorted(arguments.results.glob("*.md")):
        try:
            text = page.read_text()
            new = studies.page_of(arguments.results) if page == state else remade(page, arguments.results)
            wrong = [] if page.name in WRITTEN else typed_numbers(text) + unnamed(without_tables(text))
            for line, what in wrong + broken_links(page, text):
                print(f"pages: {page}:{line}: {what}", file=sys.stderr)
                problems += 1
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
    if state.is_file() and not arguments.check:  # once more, of what the pages show now
        state.write_text(studies.page_of(arguments.results))
    if not arguments.pages and arguments.results == ROOT / "results":
        for line, what in unnamed((ROOT / "README.md").read_text()):
            print(f"pages: {ROOT / 'README.md'}:{line}: {what}", file=sys.stderr)
            problems += 1
    for what in drawings.outdated(arguments.results) if not arguments.pages else ():
        print(f"pages: {what}", file=sys.stderr)
        problems += 1
    for page in different:
        print(f"{page} {'is not what its CSVs say' if arguments.check else 'is new'}")
    if problems:
        return 2
    return 1 if arguments.check and different else 0


if __name__ == "__main__":
    sys.exit(main())
