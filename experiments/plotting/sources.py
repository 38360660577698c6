#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which sources a run depends on, so that after a change only what it touched is run again.

    sources.py REPORT.json        prints its key
    sources.py REPORT.json --list prints the files

The key of a run is a hash of the files that it was made by: of each stage the node that it chose (all of a stage's where the choice is `auto`),
what these include, the shaders that they name and what those include; the framework, but for the programs around it and the judge (LEFT_OUT); and the scene's
file, with what that extends and the pictures next to it. Its settings are in the study's own hash. A header brings the source file of its name.

rebuild.py notes the key of each run as soon as it is made (SOURCES in a study's folder), and each row of results/ has its run's. Reports, which say
technique, nodes and scene, are not committed. So that rows can be judged in a fresh clone too, results/recipes.json (RECIPES) has each technique with its
nodes that a noted run had: a row is of the present sources if one of these recipes, on its scene, has its key in this tree (`Present`). As the key is of
the files' names and contents, a row of other sources is never called present, whatever the recipes are; without its recipe, or without a key, it is never called so either.
"""

import argparse
import functools
import hashlib
import json
import os
import re
import shutil
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = "sources.json"  # in a study's folder of runs: the key of each run's sources
RECIPES = "recipes.json"  # in results/: technique and nodes of runs that have a key
# What makes, times and judges a frame; the rest of the framework shows, reads files and runs studies.
FRAMEWORK = ("audit", "core", "gl", "graph", "image", "measure", "params", "pipeline", "reference", "render", "report", "run", "scene", "transport")
# Named by the framework, but about pictures of other programs: no run's frame, time or error is made by it.
LEFT_OUT = ("framework/judge",)
SHADER = re.compile(r'"([\w/]+\.(?:comp|frag|vert|geom|glsl))"')
INCLUDE = re.compile(r'#include "([\w/.]+)"')
COMPILED = (".cpp", ".h", ".inc")


class Tree:
    def __init__(self, root: Path = ROOT):
        self.root = root

    @functools.cache
    def text(self, file: Path) -> str:
        return file.read_text(encoding="utf-8", errors="surrogateescape")

    @functools.cache
    def part(self, file: Path) -> bytes:
        """What a file adds to a key."""
        return f"{file.relative_to(self.root)}\n".encode() + self.text(file).encode(errors="surrogateescape")

    def newest_source(self) -> float:
        """When the newest of the compiled files was changed that a run may depend on: no key has another. Programs around a run and tests are none."""
        folders = [self.root / "techniques", *(self.root / "framework" / name for name in FRAMEWORK)]
        files = self.closure({file for folder in folders for file in folder.rglob("*") if file.suffix in COMPILED})
        return max((file.stat().st_mtime for file in files if file.suffix in COMPILED), default=0.0)

    @functools.cache
    def framework(self) -> frozenset[Path]:
        folders = [self.root / "framework" / name for name in FRAMEWORK] + [self.root / "shaders/framework"]
        return frozenset(file for folder in folders for file in folder.rglob("*") if file.is_file())

    @functools.cache
    def needed_by(self, file: Path) -> frozenset[Path]:
        """The files that one names."""
        text = self.text(file)
        shaders = [self.root / "shaders" / name for name in SHADER.findall(text)]
        included = INCLUDE.findall(text)
        files = shaders + [self.root / name for name in included] + [self.root / "shaders" / name for name in included]
        if file.suffix == ".h":
            files.append(file.with_suffix(".cpp"))
        left_out = [self.root / name for name in LEFT_OUT]
        return frozenset(one for one in files if one.is_file() and not any(one.is_relative_to(folder) for folder in left_out))

    def closure(self, waiting: set[Path]) -> set[Path]:
        """These files and all that they need."""
        found: set[Path] = set()
        while waiting:
            file = waiting.pop()
            if not file.is_file() or file in found:
                continue
            found.add(file)
            waiting |= self.needed_by(file) - found
        return found

    @functools.cache
    def needed_by_framework(self) -> frozenset[Path]:
        return frozenset(self.closure(set(self.framework())))

    def fingerprint(self) -> str:
        """Of all files that any run's key may be of."""
        scenes = [file for file in (self.root / "experiments").glob("*/*") if file.suffix in (".toml", ".png")]
        folders = ("techniques", "shaders", "framework/certify", "framework/judge", "framework/exporters")
        return self.key_of_files({*self.needed_by_framework(), *scenes, *self.closure({file for folder in folders for file in (self.root / folder).rglob("*")})})

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

    @functools.cache
    def own_scenes(self) -> dict[str, tuple[Path, ...]]:
        """The scenes that are no shipped ones, by their names: those of studies, in folders of their own."""
        found: dict[str, tuple[Path, ...]] = {}
        for file in sorted((self.root / "experiments").glob("*/*.toml")):
            if file.parent.name != "scenes":
                name = self.described(file).get("name", file.stem)
                found[name] = (*found.get(name, ()), file)
        return found

    @functools.cache
    def described(self, file: Path) -> dict:
        try:
            return tomllib.loads(self.text(file))
        except (tomllib.TOMLDecodeError, UnicodeEncodeError):
            return {}

    def scene_names(self, scene: str) -> list[str]:
        """What a report calls a scene that a row calls so: a shipped one by its name, another by its file's."""
        if not scene.endswith(".toml"):
            return [scene]
        return [name for name, files in self.own_scenes().items() if Path(scene).name in {file.name for file in files}]

    @functools.cache
    def scene_files(self, name: str) -> frozenset[Path]:
        """The file of a scene, those that it extends, and what they name that lies next to them (pictures, not fetched meshes)."""
        shipped = self.root / f"experiments/scenes/{name}.toml"
        waiting, found = {shipped} if shipped.is_file() else set(self.own_scenes().get(name, ())), set()
        while waiting:
            file = waiting.pop()
            if not file.is_file() or file in found:
                continue
            found.add(file)
            if file.suffix == ".toml":
                waiting |= {file.parent / text for text in re.findall(r'"([\w.-]+)"', self.text(file))}
                extended = str(self.described(file).get("extends", ""))
                waiting |= {self.root / f"experiments/scenes/{extended}.toml", file.parent / extended} if extended else set()
        return frozenset(found)

    def files_of(self, report: dict) -> set[Path]:
        nodes = self.nodes_of(report["parameters"]) | {self.root / f"techniques/{report['technique']}.cpp"}
        return self.closure(nodes) | self.needed_by_framework() | self.scene_files(report["scene"]["name"])

    def key_of_files(self, files: set[Path]) -> str:
        digest = hashlib.sha256()
        for file in sorted(files):
            if file.is_file():
                digest.update(self.part(file))
        return digest.hexdigest()[:12]

    def key_of(self, report: dict) -> str:
        return self.key_of_files(self.files_of(report))

    def key_without_technique(self, scene: str, *folders: str) -> str:
        """Of what is no run of a technique, such as a reference: the framework, the scene, and what else lies in these folders below the root."""
        more = self.closure({file for folder in folders for file in (self.root / folder).rglob("*") if file.is_file()})
        scenes = [self.scene_files(name) for name in self.scene_names(scene)]
        return self.key_of_files(more.union(self.needed_by_framework(), *scenes))

    def has_built(self, kaustik: str | Path) -> bool:
        """Whether a program was built of this tree as it is now, and reads its shaders: only then is what it makes of this tree's keys."""
        file, root = Path(shutil.which(kaustik) or kaustik).resolve(), self.root.resolve()
        read = Path(os.environ.get("KAUSTIK_ROOT") or root).resolve()
        return file.is_file() and file.is_relative_to(root) and read == root and file.stat().st_mtime >= self.newest_source()

    def recipe_of(self, report: dict) -> dict:
        """What of a report, but for its scene, its key is of."""
        nodes = {stage: node for stage, node in report["parameters"].items() if "." not in stage and (self.root / "techniques" / stage).is_dir()}
        return {"technique": report["technique"], "nodes": dict(sorted(nodes.items()))}


def keys_noted(results: Path) -> dict[str, str]:
    """By a run's folder the key of its sources, as far as it was noted when it was made."""
    file = results / SOURCES
    return json.loads(file.read_text()) if file.is_file() else {}


def recipes_of(file: Path) -> list[dict]:
    return json.loads(file.read_text()) if file.is_file() else []


def note_recipes(file: Path, recipes: list[dict]) -> None:
    """Adds those that are not there; a line each, in order."""
    before = recipes_of(file)
    lines = sorted({json.dumps(recipe, sort_keys=True) for recipe in [*before, *recipes]})
    if len(lines) > len(before):
        file.write_text("[\n" + ",\n".join(lines) + "\n]\n")


class Present:
    """Tells which rows of results/ are of a tree's sources, without their reports."""

    def __init__(self, tree: Tree, recipes: list[dict]):
        self.tree, self.recipes = tree, recipes

    @functools.cache
    def keys(self, technique: str, scene: str) -> frozenset[str]:
        return frozenset(self.tree.key_of({"technique": recipe["technique"], "parameters": recipe["nodes"], "scene": {"name": name}})
                         for recipe in self.recipes if not technique or recipe["technique"] == technique for name in self.tree.scene_names(scene))

    def has(self, key: str, technique: str, scene: str) -> bool:
        """`technique`: none where a row does not say it."""
        return bool(key) and key in self.keys(technique, scene)


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
