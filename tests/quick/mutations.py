#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many small defects the quick tests catch of those that all tests catch.

    mutations.py [--count 60] [--seed 1] [--tree build/mutations]

Draws `count` places in the C++ files and shaders, changes one thing at each (an operator, a number, a
condition, a statement that goes), and for each change alone builds and runs the quick tests up to the first
that fails. What these miss, the slow tests are run for: where they find nothing either, no test can
see the change, or it changes nothing. Changes that do not compile are drawn again.

It works in a clone, `tree`, with a build of its own; a line a mutation goes to tree/mutations.jsonl, and
one that stands there already is not tried again. It can be interrupted. Prints a table and a ratio.
"""

import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]

SWAPS = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "), (" > ", " >= "),
         (" <= ", " < "), (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "),
         (" || ", " && "), ("min(", "max("), ("max(", "min("), ("true", "false"), ("false", "true"),
         ("sin(", "cos("), ("cos(", "sin("), ("++", "--"), (" += ", " -= "), ("if (", "if (!")]
CALL_OR_ASSIGNMENT = re.compile(r"^\s+[\w.\->\[\]:]+(\(.*\)|\s*[-+*/|]?=\s.*);$")
NUMBER = re.compile(r"(?<![\w.])\d+(\.\d+)?(?![\w.]*[xX])")


def blanked(text):
    """`text` with comments, strings and preprocessor lines as spaces, so that offsets stay."""
    pattern = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*#[^\n]*",
                         re.S | re.M)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def sites(files):
    """By kind of change, every (file, offset, old, new)."""
    kinds = {}
    for file in files:
        text = blanked(file.read_text())
        for old, new in SWAPS:
            start = text.find(old)
            while start >= 0:
                if not old[0].isalpha() or not (text[start - 1].isalnum() or text[start - 1] == "_"):
                    kinds.setdefault(f"{old.strip()} to {new.strip()}", []).append((file, start, old, new))
                start = text.find(old, start + 1)
        for match in NUMBER.finditer(text):
            value = match.group()
            new = str(int(value) + 1) if "." not in value else str(float(value) * 1.5 or 1.0)
            kinds.setdefault("number", []).append((file, match.start(), value, new))
        offset = 0
        for line in text.splitlines(keepends=True):
            if CALL_OR_ASSIGNMENT.match(line.rstrip("\n")) and line.count("(") == line.count(")"):
                statement = line.strip()
                kinds.setdefault("statement goes", []).append(
                    (file, offset + line.index(statement), statement, ";"))
            offset += len(line)
    return kinds


def run(command, folder, log):
    start = time.monotonic()
    with log.open("w") as out:
        code = subprocess.run(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL).returncode
    return code == 0, time.monotonic() - start


def failed(log):
    match = re.search(r"^\s*\d+ - (\S+)", log.read_text(), re.M)
    return match.group(1) if match else "?"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT / "build/mutations")
    arguments = parser.parse_args()
    base, source = arguments.tree.resolve(), arguments.tree.resolve() / "source"
    base.mkdir(parents=True, exist_ok=True)
    if not source.exists():
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(source)], check=True)
        if (ROOT / "meshes").is_dir():
            subprocess.run(["cp", "-a", str(ROOT / "meshes"), str(source)], check=True)
    log = base / "log"

    def build():
        return run(["cmake", "--build", "--preset", "release", "--parallel", "2"], source, log)

    def test(*options):
        return run(["ctest", "--preset", "release", "--parallel", "2", "--stop-on-failure", *options], source,
                   log)

    subprocess.run(["git", "checkout", "--quiet", "."], cwd=source, check=True)
    if not run(["experiments/set_up.sh", "release", "all"], source, log)[0]:
        sys.exit(f"mutations.py: the clone cannot be built; see {log}")
    passes, seconds = test("-LE", "^slow$")
    if not passes:
        sys.exit(f"mutations.py: {failed(log)} fails without any mutation; see {log}")
    print(f"the quick tests: {seconds:.0f} s", flush=True)

    kinds = sites(sorted(file for folder in ("framework", "techniques", "shaders")
                         for file in (source / folder).rglob("*")
                         if file.suffix in {".cpp", ".comp", ".vert", ".frag", ".geom", ".glsl"}))
    draw = random.Random(arguments.seed)
    record_file = base / "mutations.jsonl"
    done = {}
    if record_file.exists():
        done = {row["site"]: row for row in map(json.loads, record_file.read_text().splitlines())}
    rows = []
    while len(rows) < arguments.count:
        kind = draw.choice(sorted(kinds))
        file, offset, old, new = draw.choice(kinds[kind])
        original = file.read_text()
        name = f"{file.relative_to(source)}:{original.count(chr(10), 0, offset) + 1}"
        site = f"{name} {old.strip()} -> {new.strip()} @{offset}"
        row = done.get(site)
        if row is None:
            row = {"site": site, "by": None}
            try:
                file.write_text(original[:offset] + new + original[offset + len(old):])
                row["compiles"], row["build_s"] = build()
                if row["compiles"]:
                    passes, row["quick_s"] = test("-LE", "^slow$")
                    row["quick"], row["by"] = not passes, None if passes else failed(log)
                    if passes:
                        passes, row["slow_s"] = test("-L", "^slow$")
                        row["whole"], row["by"] = not passes, None if passes else failed(log)
            finally:
                file.write_text(original)
            with record_file.open("a") as out:
                out.write(json.dumps(row) + "\n")
        if not row["compiles"]:
            continue
        rows.append(row)
        verdict = "quick" if row["quick"] else "slow" if row["whole"] else "none"
        print(f"{verdict:6} {row['build_s'] + row['quick_s']:5.0f} s  {site}  {row['by'] or ''}", flush=True)

    quick = sum(row["quick"] for row in rows)
    whole = quick + sum(row.get("whole", False) for row in rows)
    print(f"\n{len(rows)} mutations: all tests catch {whole}, the quick ones {quick} of these "
          f"({100 * quick / max(whole, 1):.0f} %)")


if __name__ == "__main__":
    main()
