#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether `kaustik schema` says what the program reads and writes: schemas.py KAUSTIK

A key or a value is right where the schema takes it and the program does too, or neither: both are
asked about every key of every table that the schema has. The program is asked with tables that have
one key more, of which it complains once it has taken the rest.
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

from jsonschema import Draft202012Validator

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "experiments/plotting"))
from rebuild import toml  # noqa: E402
KAUSTIK = pathlib.Path(sys.argv.pop(1)).resolve()

NO_KEY = "zzzzzz"


def document(table):
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in table.items())


class Schema:
    def __init__(self, name):
        done = subprocess.run([KAUSTIK, "schema", name], capture_output=True, check=True)
        self.root = json.loads(done.stdout)
        Draft202012Validator.check_schema(self.root)
        self.validator = Draft202012Validator(self.root)
        self.defs = self.root.get("$defs", {})

    def resolved(self, schema):
        while "$ref" in schema:
            schema = self.defs[schema["$ref"].removeprefix("#/$defs/")]
        return schema

    def tables(self, schema=None, path="", within=lambda table: table):
        """(path, schema, what makes a whole document of a table) of all tables in tables."""
        schema = self.root if schema is None else schema
        if "properties" not in schema:
            for part in (*schema.get("oneOf", ()), *(schema[k] for k in ("then", "else")
                                                     if k in schema)):
                yield from self.tables(part, f"{path}/{part.get('title', '')}", within)
            return
        yield path, schema, within
        for key, part in schema["properties"].items():
            def inside(table, key=key, is_list="items" in part):
                return within({**self.smallest(schema), key: [table] if is_list else table})
            yield from self.tables(part.get("items", part), f"{path}.{key}", inside)

    def takes(self, value, schema):
        return self.validator.evolve(schema={**schema, "$defs": self.defs}).is_valid(value)

    def sample(self, schema):
        """A value that the schema takes."""
        schema = self.resolved(schema)
        for candidate in (schema.get("const"), *schema.get("enum", ()), 1, 0, 30, "a", "1x1", False,
                          [1, 1, 1], [1, 1], []):
            if candidate is not None and self.takes(candidate, schema):
                return candidate
        return self.smallest(schema)

    def smallest(self, schema):
        """A table with the keys that it must have."""
        keys = list(schema.get("required", ()))
        for rule in schema.get("oneOf", ())[:1]:
            keys += rule["required"]
        return {key: self.sample(schema["properties"][key]) for key in keys}

    def candidates(self, schema):
        """Values within and beyond what the schema says."""
        schema = self.resolved(schema)
        if re.search('"properties"|"[$]ref"', json.dumps(schema)):
            return [1, "zzz", True, [1]]  # of tables only the type; their keys are asked for apart
        found = [self.sample(schema), {NO_KEY: 1}, 1, "zzz", "z z", "", True,
                 *schema.get("enum", ())]
        for part in (schema, *schema.get("anyOf", ())):
            part = self.resolved(part)
            for key, sign in (("minimum", -1), ("exclusiveMinimum", -1), ("maximum", 1),
                              ("exclusiveMaximum", 1)):
                # TOML has no whole numbers beyond 64 bits.
                if abs(part.get(key, 1e99)) < 2**62:
                    found += [part[key], part[key] + sign * (abs(part[key]) / 8 + 1)]
            if part.get("type") == "integer":
                found.append(0.5)
            if part.get("type") == "array":
                one = self.sample(part["items"])
                size = part.get("maxItems", 1)
                beyond = part["items"].get("maximum", 0) * 2 if size > 1 else "zzz"
                found += [[one] * size, [one] * (size + 1), [one] * (size - 1) + [beyond],
                          [0] * size]
        return found

    def unseen(self, values, schema, path=""):
        """Keys that none of the values has, other than free ones."""
        schema = self.resolved(schema)
        schema = self.resolved(schema["anyOf"][0]) if "anyOf" in schema else schema
        found = set()
        if schema.get("type") == "array":
            inner = [element for value in values for element in value]
            return self.unseen(inner, schema["items"], path) if inner else found
        for key, part in schema.get("properties", {}).items():
            inner = [value[key] for value in values if isinstance(value, dict) and key in value]
            place = f"{path}.{key}".removeprefix(".")
            found |= self.unseen(inner, part, place) if inner else {place}
        return found


class Asks(unittest.TestCase):
    """Has a folder, and a program that reads files there."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "file").write_text("")

    def complaint(self, table, command, *words):
        file = self.folder / "file.toml"
        file.write_text(document(table))
        return subprocess.run([KAUSTIK, *command, str(file), *words], capture_output=True,
                              text=True, check=False).stderr

    def ask(self, table):
        raise NotImplementedError

    def check(self, schema, tables):
        """That the program and the schema agree about all keys of these tables."""
        seen = set()
        for path, table, within in tables:
            if json.dumps(table) in seen:
                continue
            seen.add(json.dumps(table))
            self.check_keys(path, schema, table, within)
            for key, part in table["properties"].items():
                is_new = (key, json.dumps(part)) not in seen
                seen.add((key, json.dumps(part)))
                if is_new and "const" not in part and key not in self.KINDS:
                    self.check_values(f"{path}.{key}", key, schema, table, within)

    def check_keys(self, path, schema, table, within):
        smallest = schema.smallest(table)
        # Keys without which there are no others.
        needed = {key for keys in table.get("dependentRequired", {}).values() for key in keys}
        whole = {**smallest, **{key: schema.sample(table["properties"][key]) for key in needed}}
        with self.subTest(path):
            message = self.ask(within({**whole, NO_KEY: 1}))
            found = re.search(f"'{NO_KEY}' is not a key; the keys are (.*)\\.\n", message)
            self.assertTrue(found, message)
            self.assertEqual(set(re.split(", | and ", found[1])) - self.KINDS,
                             set(table["properties"]) - self.KINDS)
            self.assertFalse(schema.takes({**smallest, NO_KEY: 1}, table))
            self.assertTrue(schema.takes(smallest, table))
            self.assertNotRegex(self.ask(within(smallest)), f"is missing|{self.RULES}")
        for key in smallest:
            with self.subTest(f"{path} without {key}"):
                less = {other: value for other, value in smallest.items() if other != key}
                self.assertFalse(schema.takes(less, table))
                if key not in self.KINDS:
                    self.assertRegex(self.ask(within(less)), f"'{key}' is missing|{self.RULES}")

    def check_values(self, path, key, schema, table, within):
        # Keys that it must have next to it, and that it must not.
        others = table.get("dependentRequired", {}).get(key, ())
        rivals = {other for rule in table.get("oneOf", ()) for other in rule["required"]}
        base = {other: schema.sample(table["properties"][other]) for other in others}
        base |= {other: value for other, value in schema.smallest(table).items()
                 if not {key, other} <= rivals}
        for value in schema.candidates(table["properties"][key]):
            with self.subTest(f"{path} = {value}"):
                message = self.ask(within({**base, key: value, NO_KEY: 1}))
                self.assertEqual(schema.takes({**base, key: value}, table),
                                 f"'{NO_KEY}' is not a key" in message, message)


class SceneFiles(Asks):
    # Keys by which a table is of one kind or another, of which the program knows all.
    KINDS = {"mesh", "shape", "extends"}
    RULES = "either|must be {height|Exactly one"

    def ask(self, table):
        return self.complaint(table, ["explain"])

    def test_are_read_as_the_schema_says(self):
        schema = Schema("scene")
        self.check(schema, schema.tables())


class ExperimentFiles(Asks):
    KINDS = {"suite"}
    RULES = "a range takes one of"

    @classmethod
    def setUpClass(cls):
        cls.schema = Schema("experiment")

    def ask(self, table):
        return self.complaint(table, ["experiment", "run"], "--out",
                              str(self.folder / "file/nowhere"))

    def test_are_read_as_the_schema_says(self):
        ranges = ("range", self.schema.defs["range"],
                  lambda table: {"name": "a", "permute": {"time": table}})
        self.check(self.schema, [*self.schema.tables(), ranges])

    def test_settings_are_those_that_the_program_takes(self):
        parts = {key.removeprefix("run."): part for key, part in self.schema.defs.items()
                 if key.startswith("run.") and key not in ("run.scene", "run.reference")}  # files
        kinds = {}
        for form, part in self.parameters():  # one of each kind
            kinds.setdefault("choice" if "enum" in part else part["type"], (form, part))
        for key, part in (*parts.items(), *kinds.values()):
            for value in self.schema.candidates(part):
                if part.get("type") == "boolean" and value is not True and value == 1:
                    continue  # as on the command line, where 1 is true
                with self.subTest(f"{key} = {value}"):
                    # One that has a row as published.
                    settings = {"scene": "ring", "technique": "screen_space_photons", key: value}
                    message = self.ask({"name": "a", "base": settings})
                    took = "nowhere cannot be made" in message or "no pass" in message
                    self.assertEqual(self.schema.takes(settings, self.schema.defs["base"]), took,
                                     message)

    def test_every_form_of_a_parameter_is_one_that_the_program_knows(self):
        values = {form: [part["default"]] for form, part in self.parameters()}
        # One product a form, since two forms of one name exclude each other.
        study = {"name": "a", "base": {"scene": "ring"},
                 "permute": [{form: value} for form, value in values.items()]}
        self.assertTrue(self.schema.validator.is_valid(study))
        self.assertIn("nowhere cannot be made", self.ask(study))

    def parameters(self):
        for form, part in self.schema.defs["base"]["properties"].items():
            part = next((each for each in part.get("anyOf", ()) if "$ref" in each), part)
            if part.get("$ref", "").startswith("#/$defs/parameter."):
                yield form, self.schema.resolved(part)

    def test_names_that_are_no_parameters_are_refused(self):
        for key in ("trace.epsilom", "memory", NO_KEY):
            self.assertFalse(self.schema.takes({key: 1}, self.schema.defs["base"]), key)
            self.assertIn(f"'{key}'", self.ask({"name": "a", "base": {key: 1}}))


class Reports(Asks):
    # What only a run of another kind, or with other numbers, says.
    ELSEWHERE = re.compile(r"\$schema|between_frames_ms|cells|ended_early.*|map\.maps\.(generator|cascade)|.*reasons|limits\..*|"
                           r"energy\.lost_w\..*|error\.flicker|error\.view\..*|.*\.image_m|"
                           r".*\.reference_m")

    def test_of_runs_are_as_the_schema_says(self):
        schema = Schema("report")
        (self.folder / "scene.toml").write_text(SCENE)
        for time in ("0", "0.5"):  # of the runs' last frames
            subprocess.run([KAUSTIK, "census", "scene.toml", "--size", "24x18", "--photons", "20000", "--technique",
                            "caustic_map", "--technique-photons", "16x16", "--time", time],
                           check=True, capture_output=True, cwd=self.folder)
        reports = []
        for words in (("--frames", "1"),
                      ("--technique", "caustic_map", "--frames", "2", "--time-step", "0.5",
                       "--reference", "auto", "--reference-photons", "20000",
                       "--device-model", "1000GB/s")):
            subprocess.run([KAUSTIK, "run", "scene.toml", "--size", "24x18", "--warmup", "0",
                            "--set", "emit.photons=16x16", "--out", "out", *words],
                           check=True, capture_output=True, cwd=self.folder)
            reports.append(json.loads((self.folder / "out/report.json").read_text()))
            self.assertEqual([error.message for error in
                              schema.validator.iter_errors(reports[-1])], [])
        missing = [key for key in schema.unseen(reports, schema.root)
                   if not self.ELSEWHERE.fullmatch(key)]
        self.assertEqual(missing, [], "keys that no report has")
        for part in ("device", "energy", "error"):
            changed = copy.deepcopy(reports[-1])
            changed[part][NO_KEY] = 1
            self.assertFalse(schema.validator.is_valid(changed), "a key that no report has")


class ShippedFiles(unittest.TestCase):
    def test_are_as_the_schemas_say(self):
        for name, folder in (("scene", "experiments/scenes"), ("experiment", "experiments")):
            validator = Schema(name).validator
            files = sorted((SOURCE / folder).glob("*.toml"))
            self.assertTrue(files)
            for file in files:
                with self.subTest(file.name):
                    errors = validator.iter_errors(tomllib.loads(file.read_text()))
                    self.assertEqual([error.message for error in errors], [])


class CommandLine(unittest.TestCase):
    def test_what_there_is_no_schema_of_is_refused(self):
        for words in ([], ["scenes"]):
            done = subprocess.run([KAUSTIK, "schema", *words], capture_output=True, text=True,
                                  check=False)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("scene, experiment", done.stderr)


SCENE = """\
[camera]
position = [0, 1.5, 3]
[medium]
scattering_per_meter = 0.05
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -1, 0]
irradiance = 100
[[material]]
name = "floor"
type = "glossy"
albedo = 0.5
specular = 0.2
[[material]]
name = "glass"
type = "dielectric"
ior = 1.33
[[object]]
name = "floor"
shape = "plane"
material = "floor"
size = [6, 6]
[[object]]
name = "ball"
shape = "sphere"
segments = 12
material = "glass"
radius = 0.5
position = [0, 1, 0]
"""

if __name__ == "__main__":
    unittest.main()
