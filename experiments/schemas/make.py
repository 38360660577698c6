#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the JSON schemas that editors use: make.py KAUSTIK [FOLDER]

KAUSTIK is the program, which is asked for its parameters and techniques; FOLDER is that of this
script by default. The keys of scenes and reports stand in the scripts beside this one;
tests/cli/schemas.py compares them with what the program reads and writes.
"""
import json
import pathlib
import subprocess
import sys

from experiment import experiment
from report import report
from scene import scene


def lines(schema):
    """JSON with a definition a line."""
    defs = schema.pop("$defs")
    entries = (f"{json.dumps(name)}: {json.dumps(each, ensure_ascii=False)}"
               for name, each in defs.items())
    top = json.dumps(schema, indent=1, ensure_ascii=False).removesuffix("\n}")
    return top + ',\n "$defs": {\n  ' + ",\n  ".join(entries) + "\n }\n}\n"


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)

    def ask(*words):
        return json.loads(subprocess.run([sys.argv[1], *words], check=True,
                                         capture_output=True).stdout)

    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else pathlib.Path(__file__).parent
    for name, schema in {"scene": scene(), "experiment": experiment(ask),
                         "report": report()}.items():
        (folder / f"{name}.schema.json").write_text(lines(schema))


if __name__ == "__main__":
    main()
