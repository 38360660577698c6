#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many small defects the quick tests catch of those that all tests catch.

    mutations.py [--count 60] [--seed 1] [--commit HEAD] [--tree build/mutations]

Draws `count` of all small changes that there are to C++ files and shaders (an operator, a number, a
condition, a statement that goes), each as likely as any other. What does not compile is replaced by the next
that is drawn; of a shader, which is compiled when it is used, the output of a test that fails says so.

Fifteen at once, all quick tests are run. Those that fail are run for halves of these changes, as long as one fails, and for
each change that is left alone, the cheapest first: what a change fails alone it fails in company too. With those that are left the slow tests are run in the same way.
Where these find nothing either nobody sees the change, or it changes nothing.

It works in a clone, `tree`, at `commit`, with a build of its own. What is known stands in mutations.jsonl next to
this file, by commit, and is not tried again: it can be interrupted, and goes on elsewhere. Prints the commit, a
table and a ratio.
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

import choose

ROOT = pathlib.Path(__file__).resolve().parents[2]

SWAPS = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "), (" > ", " >= "),
         (" <= ", " < "), (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "),
         (" || ", " && "), ("min(", "max("), ("max(", "min("), ("true", "false"), ("false", "true"),
         ("sin(", "cos("), ("cos(", "sin("), ("++", "--"), (" += ", " -= "), ("if (", "if (!")]
CALL_OR_ASSIGNMENT = re.compile(r"^\s+[\w.\->\[\]:]+(\(.*\)|\s*[-+*/|]?=\s.*);$")
TOGETHER = 15
# So many failures together say little about each change: one of them is seen by most tests.
MANY = 150
# Of the tests that fail so many are tried first.
FEW = 20
# So many seconds a test may take: a loop that a change has made endless is ended.
HANGS_S = 300
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
    """Whether it succeeds."""
    with log.open("w") as out:
        return subprocess.run(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                              check=False).returncode == 0


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


def is_check(file):
    """Whether it is itself a check of others: a hard case."""
    return file.stem.endswith("_cases") or file.parent.name == "cases"


def is_uncompilable(file, log):
    """Whether the tests have failed because the shader that was changed does not compile."""
    return file.suffix != ".cpp" and re.search(r"does not (compile|link):$", log.read_text(errors="replace"), re.M)


def failed(log):
    """The names of the tests that ctest says have failed."""
    return re.findall(r"^\s*\d+ - (\S+) \((?!Skipped)", log.read_text(errors="replace"), re.M)


def any_of(names):
    """The expression by which ctest takes these tests alone."""
    return f"^({'|'.join(map(re.escape, names))})$"


class Mutation:
    """A change at an offset of a file."""

    def __init__(self, source, file, offset, old, new):
        self.file, self.offset, self.old, self.new = file, offset, old, new
        line = file.read_text().count("\n", 0, offset) + 1
        self.site = f"{file.relative_to(source)}:{line} {old.strip()} -> {new.strip()} @{offset}"


class Trials:
    """A clone with a build, into which mutations are put and taken out again, and what is known of them."""

    def __init__(self, base, commit):
        self.source, self.log, self.commit = base / "source", base / "log", commit
        self.file = pathlib.Path(__file__).with_name("mutations.jsonl")
        lines = map(json.loads, self.file.read_text().splitlines()) if self.file.exists() else []
        self.known = {(row["site"], row["by"]): row["found"] for row in lines if row["commit"] == commit}

    def record(self, mutation, by, found):
        """`found`: the test that fails; "": none; None: it does not compile."""
        self.known[mutation.site, by] = found
        with self.file.open("a") as out:
            row = {"commit": self.commit, "site": mutation.site, "by": by, "found": found}
            out.write(json.dumps(row) + "\n")
        print(f"{by:6} {mutation.site}  {'does not compile' if found is None else found or '-'}", flush=True)

    def build(self):
        return run(["cmake", "--build", "--preset", "release", "--parallel", "2"], self.source, self.log)

    def test(self, *options):
        """The tests that fail."""
        passes = run(["ctest", "--preset", "release", "--parallel", "2", *options], self.source, self.log)
        return [] if passes else failed(self.log) or ["?"]

    def cheapest_first(self, tests):
        costs = choose.measured(self.source / "build/release")
        return sorted(tests, key=lambda name: costs.get(name, 0.0))

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

    def compiles(self, mutation):
        """Whether it does: known, or tried."""
        if (mutation.site, "build") not in self.known:
            with self.mutated([mutation]):
                self.record(mutation, "build", "" if mutation.file.suffix != ".cpp" or self.build() else None)
        return self.known[mutation.site, "build"] is not None

    def alone(self, mutation, by, tests):
        """Whether one of these tests fails; it is recorded where one does."""
        with self.mutated([mutation]):
            if not self.build():
                sys.exit(f"mutations.py: {mutation.site} has compiled before; see {self.log}")
            for some in (tests[:FEW], tests[FEW:]):
                failures = self.test("--stop-on-failure", "-R", any_of(some)) if some else []
                # A test of the workbench may fail by chance on a machine with other work.
                if failures and (failures == ["?"] or self.test("-R", any_of(failures))):
                    self.record(mutation, by, None if is_uncompilable(mutation.file, self.log) else failures[0])
                    return True
        return False

    def culprits(self, mutations, by, tests):
        """Those that one of these tests sees, each recorded: halved as long as a test fails, since most are seen by none."""
        if len(mutations) == 1:
            return mutations if self.alone(mutations[0], by, tests) else []
        with self.mutated(mutations):
            if not self.build():
                sys.exit(f"mutations.py: {len(mutations)} changes do not compile together; see {self.log}")
            failures = self.cheapest_first(self.test("-R", any_of(tests)))
        if not failures:
            return []
        half = len(mutations) // 2
        return self.culprits(mutations[:half], by, failures) + self.culprits(mutations[half:], by, failures)

    def together(self, mutations, by, *options):
        """Finds out which of the mutations the tests of `options` see."""
        left = [mutation for mutation in mutations if (mutation.site, by) not in self.known]
        while left:
            with self.mutated(left):
                if not self.build():
                    sys.exit(f"mutations.py: {len(left)} changes do not compile together; see {self.log}")
                failures = self.cheapest_first(self.test(*options))
            print(f"{by} tests with {len(left)} changes: {len(failures)} fail", flush=True)
            # Of hundreds, those that one change fails hide the others': without that one once more.
            before = len(left)
            if len(failures) > MANY:
                left = [mutation for mutation in left if not self.alone(mutation, by, failures[:2 * FEW])]
            if len(left) == before:
                seen = self.culprits(left, by, failures) if failures else []
                left = [mutation for mutation in left if mutation not in seen]
                break
        for mutation in left:
            self.record(mutation, by, "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--commit", default="HEAD")
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT / "build/mutations")
    arguments = parser.parse_args()
    base = arguments.tree.resolve()
    base.mkdir(parents=True, exist_ok=True)
    commit = update(base / "source", arguments.commit)
    print(f"commit {commit}", flush=True)
    trials = Trials(base, commit)
    if not run(["experiments/set_up.sh", "release", "all"], trials.source, trials.log) or not run(
            ["cmake", "--preset", "release", f"-DKAUSTIK_TEST_TIMEOUT={HANGS_S}"], trials.source, trials.log):
        sys.exit(f"mutations.py: the clone cannot be built; see {trials.log}")
    if not trials.known:
        begin = time.monotonic()
        if failures := trials.test("-LE", "^slow$"):
            sys.exit(f"mutations.py: {', '.join(failures)} fail without any mutation; see {trials.log}")
        print(f"the quick tests: {time.monotonic() - begin:.0f} s", flush=True)

    drawn = sites(sorted(file for folder in ("framework", "techniques", "shaders")
                         for file in (trials.source / folder).rglob("*")
                         if file.suffix in {".cpp", ".comp", ".vert", ".frag", ".geom", ".glsl"}
                         and not is_check(file)))
    random.Random(arguments.seed).shuffle(drawn)
    mutations = []
    while drawn and len(mutations) < arguments.count:
        mutation = Mutation(trials.source, *drawn.pop())
        if trials.compiles(mutation):
            mutations.append(mutation)

    for first in range(0, len(mutations), TOGETHER):
        trials.together(mutations[first:first + TOGETHER], "quick", "-LE", "^slow$")
    slow = [mutation for mutation in mutations if trials.known[mutation.site, "quick"] == ""]
    trials.together(slow, "slow", "-L", "^slow$")
    uncompilable = sum(trials.known.get((mutation.site, by), "") is None
                       for mutation in mutations for by in ("quick", "slow"))
    caught_slowly = sum(bool(trials.known[mutation.site, "slow"]) for mutation in slow)
    quick = len(mutations) - len(slow) - uncompilable
    print(f"\n{len(mutations) - uncompilable} mutations of {commit}: all tests catch {quick + caught_slowly}, "
          f"the quick ones {quick} of these ({100 * quick / max(quick + caught_slowly, 1):.0f} %)")


if __name__ == "__main__":
    main()
