#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many small defects the quick tests catch of those that all tests catch.

    mutations.py [--count 60] [--seed 1] [--tree build/mutations]

Draws `count` of all small changes that there are to C++ files and shaders (an operator, a number, a condition,
a statement that goes), each as likely as any other, and for each alone builds and runs the quick tests up to
the first that fails. What these miss, the slow tests are run for: where they find nothing either, no test can
see the change, or it changes nothing. What does not compile is replaced by the next that is drawn; of a
shader, which is compiled when it is used, the output of the test that fails says so.

It works in a clone, `tree`, at the commit that the working tree is at (what is not committed is not tested),
with a build of its own. A line a mutation goes to tree/mutations.jsonl, and one that stands there already,
of the same commit, is not tried again. It can be interrupted. Prints the commit, a table and a ratio.
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
    """Every change that there is: (file, offset, old, new)."""
    found = []
    for file in files:
        text = blanked(file.read_text())
        for old, new in SWAPS:
            start = text.find(old)
            while start >= 0:
                if not old[0].isalpha() or not (text[start - 1].isalnum() or text[start - 1] == "_"):
                    found.append((file, start, old, new))
                start = text.find(old, start + 1)
        for match in NUMBER.finditer(text):
            value = match.group()
            new = str(int(value) + 1) if "." not in value else str(float(value) * 1.5 or 1.0)
            found.append((file, match.start(), value, new))
        offset = 0
        for line in text.splitlines(keepends=True):
            if CALL_OR_ASSIGNMENT.match(line.rstrip("\n")) and line.count("(") == line.count(")"):
                statement = line.strip()
                found.append((file, offset + line.index(statement), statement, ";"))
            offset += len(line)
    return found


def run(command, folder, log):
    start = time.monotonic()
    with log.open("w") as out:
        code = subprocess.run(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL).returncode
    return code == 0, time.monotonic() - start


def git(folder, *command):
    return subprocess.run(["git", *command], cwd=folder, check=True, capture_output=True, text=True).stdout.strip()


def update(source):
    """Brings the clone to the commit of the working tree, without what a mutation has left. Gives the commit."""
    if not source.exists():
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(source)], check=True)
    commit = git(ROOT, "rev-parse", "HEAD")
    git(source, "fetch", "--quiet", str(ROOT), "HEAD")
    git(source, "checkout", "--quiet", "--force", "--detach", commit)
    if (ROOT / "meshes").is_dir():
        subprocess.run(["cp", "-a", "--update", str(ROOT / "meshes"), str(source)], check=True)
    return commit


def is_uncompilable(file, log):
    """Whether the tests have failed because the shader that was changed does not compile."""
    return file.suffix != ".cpp" and re.search(r"does not (compile|link):$", log.read_text(errors="replace"), re.M)


def failed(log):
    match = re.search(r"^\s*\d+ - (\S+)", log.read_text(errors="replace"), re.M)
    return match.group(1) if match else "?"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT / "build/mutations")
    arguments = parser.parse_args()
    base, source = arguments.tree.resolve(), arguments.tree.resolve() / "source"
    base.mkdir(parents=True, exist_ok=True)
    commit = update(source)
    print(f"commit {commit}", flush=True)
    log = base / "log"

    def build():
        return run(["cmake", "--build", "--preset", "release", "--parallel", "2"], source, log)

    def test(*options):
        return run(["ctest", "--preset", "release", "--parallel", "2", "--stop-on-failure", *options], source,
                   log)

    if not run(["experiments/set_up.sh", "release", "all"], source, log)[0]:
        sys.exit(f"mutations.py: the clone cannot be built; see {log}")
    passes, seconds = test("-LE", "^slow$")
    if not passes:
        sys.exit(f"mutations.py: {failed(log)} fails without any mutation; see {log}")
    print(f"the quick tests: {seconds:.0f} s", flush=True)

    drawn = sites(sorted(file for folder in ("framework", "techniques", "shaders")
                         for file in (source / folder).rglob("*")
                         if file.suffix in {".cpp", ".comp", ".vert", ".frag", ".geom", ".glsl"}))
    random.Random(arguments.seed).shuffle(drawn)
    record_file = base / "mutations.jsonl"
    done = {}
    if record_file.exists():
        recorded = map(json.loads, record_file.read_text().splitlines())
        done = {row["site"]: row for row in recorded if row.get("commit") == commit}
    rows = []
    while drawn and len(rows) < arguments.count:
        file, offset, old, new = drawn.pop()
        original = file.read_text()
        name = f"{file.relative_to(source)}:{original.count(chr(10), 0, offset) + 1}"
        site = f"{name} {old.strip()} -> {new.strip()} @{offset}"
        row = done.get(site)
        if row is None:
            row = {"commit": commit, "site": site, "by": None}
            try:
                file.write_text(original[:offset] + new + original[offset + len(old):])
                row["compiles"], row["build_s"] = build()
                for kind, option in (("quick", "-LE"), ("whole", "-L")):
                    if not row["compiles"] or row["by"]:
                        break
                    passes, row[f"{kind}_s"] = test(option, "^slow$")
                    row[kind], row["by"] = not passes, None if passes else failed(log)
                    row["compiles"] = passes or not is_uncompilable(file, log)
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
    print(f"\n{len(rows)} mutations of {commit}: all tests catch {whole}, the quick ones {quick} of these "
          f"({100 * quick / max(whole, 1):.0f} %)")


if __name__ == "__main__":
    main()
