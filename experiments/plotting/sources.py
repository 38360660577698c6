#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which sources a run depends on, so that after a change only what it touched is run again.

    sources.py REPORT.json        prints its key
    sources.py REPORT.json --list prints the files

The key of a run is a hash of the files that it was made by: of each stage the node that it chose (all of a stage's where the choice is `auto`),
what these include, the shaders that they name and what those include; the framework, but for the programs around it; and the scene's
file. Its settings are in the study's own hash. A header brings the source file of its name.
"""

import argparse
import functools
import hashlib
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# What makes, times and judges a frame; the rest of the framework shows, reads files and runs studies.
FRAMEWORK = ("audit", "core", "gl", "graph", "image", "measure", "params", "pipeline", "reference", "render", "report", "run", "scene", "transport")
SHADER = re.compile(r'"([\w/]+\.(?:comp|frag|vert|geom|glsl))"')
INCLUDE = re.compile(r'#include "([\w/.]+)"')


class Tree:
    def __init__(self, root: Path = ROOT):
        self.root = root

    @functools.cache
    def text(self, file: Path) -> str:
        return file.read_text(encoding="utf-8", errors="surrogateescape")

    def newest_source(self) -> float:
        """When the newest of the files that are compiled was changed."""
        return max(file.stat().st_mtime for folder in ("framework", "techniques") for file in (self.root / folder).rglob("*")
                   if file.suffix in (".cpp", ".h"))

    @functools.cache
    def framework(self) -> frozenset[Path]:
        folders = [self.root / "framework" / name for name in FRAMEWORK] + [self.root / "shaders/framework"]
        return frozenset(file for folder in folders for file in folder.rglob("*") if file.is_file())

    def needed_by(self, file: Path) -> set[Path]:
        """The files that one names."""
        text = self.text(file)
        shaders = [self.root / "shaders" / name for name in SHADER.findall(text)]
        included = INCLUDE.findall(text)
        files = shaders + [self.root / name for name in included] + [self.root / "shaders" / name for name in included]
        if file.suffix == ".h":
            files.append(file.with_suffix(".cpp"))
        return {one for one in files if one.is_file()}

    def nodes_of(self, parameters: dict) -> set[Path]:
        files = set()
        for stage, node in parameters.items():
            folder = self.root / "techniques" / stage
            if "." in stage or not folder.is_dir():
                continue
            chosen = [folder / f"{node}.cpp"]
            if node == "auto" or not chosen[0].is_file():
                chosen = sorted(folder.glob("*.cpp"))
            files.update(chosen)
        return files

    def files_of(self, report: dict) -> set[Path]:
        waiting = set(self.framework()) | self.nodes_of(report["parameters"])
        waiting.add(self.root / f"techniques/{report['technique']}.cpp")
        waiting.add(self.root / f"experiments/scenes/{report['scene']['name']}.toml")
        found: set[Path] = set()
        while waiting:
            file = waiting.pop()
            if not file.is_file() or file in found:
                continue
            found.add(file)
            waiting |= self.needed_by(file) - found
        return found

    def key_of(self, report: dict) -> str:
        digest = hashlib.sha256()
        for file in sorted(self.files_of(report)):
            digest.update(f"{file.relative_to(self.root)}\n".encode())
            digest.update(self.text(file).encode(errors="surrogateescape"))
        return digest.hexdigest()[:12]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report", type=Path)
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    report, tree = json.loads(arguments.report.read_text(encoding="utf-8")), Tree()
    if arguments.list:
        print("\n".join(str(file.relative_to(ROOT)) for file in sorted(tree.files_of(report))))
    else:
        print(tree.key_of(report))
    return 0


if __name__ == "__main__":
    sys.exit(main())
