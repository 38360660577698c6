#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Chooses what `tests/run.sh --quick` leaves out, and writes it to slow_tests.cmake beside this file.

    choose.py [--seconds S] [--build build/release]

S seconds (default 210) are what the chosen tests may take together, two at a time, by the times that
ctest measured in BUILD when it last ran all of them. Chosen are every unit test and those of Python, then
the cheapest test of each suite, then whatever is cheapest; none that takes a twentieth of them all. All
others get the label `slow`; `cluster` and `install` have it where they are declared. A test that is new has
no such label until this is run again, and so belongs to the quick ones.
"""

import argparse
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
NEVER_QUICK = {"cluster", "install"}
# By CMake's add_test, after ctest has read the file: it cannot change their labels.
ALWAYS_QUICK = ("unit/", "python")


def measured(build):
    """Seconds by test, of those that have run in `build`."""
    costs = {}
    for line in (build / "Testing/Temporary/CTestCostData.txt").read_text().splitlines():
        words = line.rsplit(" ", 2)
        if len(words) == 3 and int(words[1]) > 0:
            costs[words[0]] = float(words[2])
    return costs


def listed(build, *options):
    """(name, labels, processors) of every test in `build` that ctest's options leave."""
    text = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1", *options], check=True,
                          capture_output=True, text=True).stdout
    for test in json.loads(text)["tests"]:
        properties = {p["name"]: p["value"] for p in test["properties"]}
        labels = [label for label in properties.get("LABELS", []) if label != "slow"]
        yield test["name"], labels, int(properties.get("PROCESSORS", 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=210)
    parser.add_argument("--build", type=pathlib.Path, default=HERE.parents[1] / "build/release")
    arguments = parser.parse_args()

    costs = measured(arguments.build)
    tests = {name: (labels, costs.get(name, 0.0) * processors)
             for name, labels, processors in listed(arguments.build)}
    unmeasured = sum(name not in costs for name in tests)
    if unmeasured > len(tests) / 20:
        sys.exit(f"choose.py: {unmeasured} of {len(tests)} tests have not run in {arguments.build}; "
                 "run them all first, by ctest --preset release")

    by_cost = sorted(tests, key=lambda name: tests[name][1])
    units = [name for name in by_cost if tests[name][0][0].startswith(ALWAYS_QUICK)]
    suites = {}
    for name in by_cost:
        suites.setdefault(name.split(".")[0], name)
    left, chosen = 2 * arguments.seconds, set()
    longest = left / 20
    for name in dict.fromkeys(units + sorted(suites.values(), key=by_cost.index) + by_cost):
        if tests[name][1] <= min(left, longest) and not NEVER_QUICK & set(tests[name][0]):
            left -= tests[name][1]
            chosen.add(name)

    lines = ["# SPDX-License-Identifier: MIT",
             "# Written by choose.py: what `tests/run.sh --quick` leaves out. ctest reads it."]
    for name in sorted(set(tests) - chosen):
        if NEVER_QUICK & set(tests[name][0]):
            continue
        labels = ";".join([*tests[name][0], "slow"])
        lines.append(f'set_tests_properties([=[{name}]=] PROPERTIES LABELS "{labels}")')
    (HERE / "slow_tests.cmake").write_text("\n".join(lines) + "\n")
    print(f"{len(chosen)} of {len(tests)} tests are quick: "
          f"{(2 * arguments.seconds - left) / 2:.0f} s of "
          f"{sum(cost for _, cost in tests.values()) / 2:.0f} s, two at a time")


if __name__ == "__main__":
    main()
