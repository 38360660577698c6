#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many small defects the quick tests catch of those that all tests catch.

    mutations.py [--count 60] [--seed 1] [--commit HEAD] [--tree build/mutations]

Draws `count` of all small changes that there are to C++ files and shaders (an operator, a number, a condition,
a statement that goes), each as likely as any other, and for each alone builds and runs the quick tests up to
the first that fails. What does not compile is replaced by the next that is drawn; of a shader, which is
compiled when it is used, the output of the test that fails says so.

What the quick tests miss is then put in all at once and the slow tests are run: where they find nothing,
nobody sees any of these changes, or they change nothing. A test that fails is run for each of them alone, those
that it sees go, and the slow tests run again with what is left, until they find nothing.

It works in a clone, `tree`, at `commit`, with a build of its own. A line a mutation goes to
tree/mutations.jsonl, and one that stands there already, of the same commit, is not tried again. It can be
interrupted. Prints the commit, a table and a ratio.
"""

import argparse
import contextlib
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
# After so many seconds a test hangs, by a loop that a mutation has no end for.
HANGS_S = 900
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


def update(source, commit):
    """Brings the clone to `commit`, without what a mutation has left. Gives its full name."""
    if not source.exists():
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(source)], check=True)
    commit = git(ROOT, "rev-parse", commit)
    git(source, "fetch", "--quiet", str(ROOT), commit)
    git(source, "checkout", "--quiet", "--force", "--detach", commit)
    if (ROOT / "meshes").is_dir():
        subprocess.run(["cp", "-a", "--update", str(ROOT / "meshes"), str(source)], check=True)
    return commit


def is_uncompilable(file, log):
    """Whether the tests have failed because the shader that was changed does not compile."""
    return file.suffix != ".cpp" and re.search(r"does not (compile|link):$", log.read_text(errors="replace"), re.M)


def failed(log):
    """The names of the tests that ctest says have failed."""
    return re.findall(r"^\s*\d+ - (\S+) \(", log.read_text(errors="replace"), re.M)


class Mutation:
    """A change at an offset of a file."""

    def __init__(self, source, file, offset, old, new):
        self.file, self.offset, self.old, self.new = file, offset, old, new
        line = file.read_text().count("\n", 0, offset) + 1
        self.site = f"{file.relative_to(source)}:{line} {old.strip()} -> {new.strip()} @{offset}"


class Clone:
    """A clone with a build, into which mutations are put and taken out again."""

    def __init__(self, source, log):
        self.source, self.log = source, log

    def build(self):
        return run(["cmake", "--build", "--preset", "release", "--parallel", "2"], self.source, self.log)

    def test(self, *options):
        return run(["ctest", "--preset", "release", "--parallel", "2", "--timeout", str(HANGS_S),
                    *options], self.source, self.log)

    @contextlib.contextmanager
    def mutated(self, mutations):
        originals = {mutation.file: mutation.file.read_text() for mutation in mutations}
        try:
            # From the back, so that the offsets of those before stay.
            for mutation in sorted(mutations, key=lambda mutation: -mutation.offset):
                text = mutation.file.read_text()
                mutation.file.write_text(text[:mutation.offset] + mutation.new
                                         + text[mutation.offset + len(mutation.old):])
            yield
        finally:
            for file, text in originals.items():
                file.write_text(text)


def try_quick(clone, mutation):
    """The quick tests' row for a mutation."""
    row = {"site": mutation.site, "by": None, "quick": False}
    with clone.mutated([mutation]):
        row["compiles"], row["build_s"] = clone.build()
        if row["compiles"]:
            passes, row["quick_s"] = clone.test("--stop-on-failure", "-LE", "^slow$")
            row["quick"], row["by"] = not passes, None if passes else (failed(clone.log) or ["?"])[0]
            row["compiles"] = passes or not is_uncompilable(mutation.file, clone.log)
    return row


def seen_by_slow(clone, missed):
    """Which of the missed mutations a slow test sees: site to test."""
    seen = {}
    while left := [mutation for mutation in missed if mutation.site not in seen]:
        with clone.mutated(left):
            compiles, _ = clone.build()
            passes, seconds = clone.test("-L", "^slow$") if compiles else (True, 0.0)
            failures = [] if passes else failed(clone.log)
        if not compiles:
            sys.exit(f"mutations.py: all that are left do not compile together; see {clone.log}")
        print(f"slow tests with {len(left)} mutations: {len(failures)} fail ({seconds:.0f} s)", flush=True)
        before = len(seen)
        for mutation in left if failures else []:
            with clone.mutated([mutation]):
                clone.build()
                passes, _ = clone.test("--stop-on-failure", "-R", f"^({'|'.join(map(re.escape, failures))})$")
                if not passes:
                    seen[mutation.site] = (failed(clone.log) or ["?"])[0]
        if len(seen) == before:
            if failures:
                print(f"only together: {', '.join(failures)}", flush=True)
            break
    return seen


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--commit", default="HEAD")
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT / "build/mutations")
    arguments = parser.parse_args()
    base, source = arguments.tree.resolve(), arguments.tree.resolve() / "source"
    base.mkdir(parents=True, exist_ok=True)
    commit = update(source, arguments.commit)
    print(f"commit {commit}", flush=True)
    clone = Clone(source, base / "log")
    if not run(["experiments/set_up.sh", "release", "all"], source, clone.log)[0]:
        sys.exit(f"mutations.py: the clone cannot be built; see {clone.log}")
    passes, seconds = clone.test("--stop-on-failure", "-LE", "^slow$")
    if not passes:
        sys.exit(f"mutations.py: {failed(clone.log)} fails without any mutation; see {clone.log}")
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
    rows, missed = [], []
    while drawn and len(rows) < arguments.count:
        mutation = Mutation(source, *drawn.pop())
        row = done.get(mutation.site)
        if row is None:
            row = {"commit": commit, **try_quick(clone, mutation)}
            with record_file.open("a") as out:
                out.write(json.dumps(row) + "\n")
        if not row["compiles"]:
            continue
        rows.append(row)
        if not row["quick"]:
            missed.append(mutation)
        print(f"{'quick' if row['quick'] else 'missed':6} {row['build_s'] + row['quick_s']:5.0f} s  "
              f"{mutation.site}  {row['by'] or ''}", flush=True)

    slow = seen_by_slow(clone, missed)
    for mutation in missed:
        print(f"{'slow' if mutation.site in slow else 'none':6} {mutation.site}  {slow.get(mutation.site, '')}")
    quick = len(rows) - len(missed)
    print(f"\n{len(rows)} mutations of {commit}: all tests catch {quick + len(slow)}, the quick ones {quick} of "
          f"these ({100 * quick / max(quick + len(slow), 1):.0f} %)")


if __name__ == "__main__":
    main()
