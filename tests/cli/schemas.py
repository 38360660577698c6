#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether experiments/schemas says what the program reads and writes: schemas.py KAUSTIK

A key or a value is right where the schema takes it and the program does too, or neither. The program
is asked with files that are wrong in one more place, which it comes to last: that it complains of
that place says that it took the rest, and costs no picture.
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
SCHEMAS = SOURCE / "experiments/schemas"
KAUSTIK = pathlib.Path(sys.argv.pop(1)).resolve()

NO_KEY = "zzzzzz"
# For keys whose values must be right in another way than the schema can say.
SAMPLES = {"direction": [0, -1, 0], "up": [0, 0, 1], "texture": "scene.toml", "image": "scene.toml",
           "mesh": "mesh.ply", "specular": 0, "albedo": 0, "outer_cone_degrees": 90,
           "fit": {"height": 1}}
# Keys that say of what kind a table is, of which the program knows all.
KINDS = {"mesh", "shape", "extends", "suite"}
# Values that are checked together with others, or name a file that must be there.
RELATED = {"extends", "mesh", "texture", "image"}


def schema_of(name):
    return json.loads((SCHEMAS / f"{name}.schema.json").read_text())


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def document(table):
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in table.items())


class Schema:
    def __init__(self, name):
        self.root = schema_of(name)
        Draft202012Validator.check_schema(self.root)
        self.validator = Draft202012Validator(self.root)
        self.defs = self.root["$defs"]

    def resolved(self, schema):
        while "$ref" in schema:
            found = self.root
            for part in schema["$ref"].removeprefix("#/").split("/"):
                found = found[part]
            schema = found
        return schema

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

    def takes(self, value, schema):
        return self.validator.evolve(schema={**schema, "$defs": self.defs}).is_valid(value)

    def sample(self, key, schema):
        """A value that the schema takes."""
        schema = self.resolved(schema)
        if key in SAMPLES:
            return SAMPLES[key]
        for candidate in (schema.get("const"), *schema.get("enum", ()), 0, 1, 30, "a", "1x1", False,
                          [0, 0, 0], [1, 1, 1], [1, 1], []):
            if candidate is not None and self.takes(candidate, schema):
                return candidate
        return self.smallest(schema)

    def smallest(self, schema):
        """A table with the keys that it must have."""
        schema = self.resolved(schema)
        schema = self.resolved(schema["oneOf"][0]) if "properties" not in schema else schema
        keys = list(schema.get("required", ()))
        for rule in schema.get("oneOf", ())[:1]:
            keys += rule["required"]
        return {key: self.sample(key, schema["properties"][key]) for key in keys}

    def candidates(self, key, schema):
        """Values within and beyond what the schema says."""
        schema = self.resolved(schema)
        wrong = [{NO_KEY: 1}] if schema.get("type") != "object" else [1]
        wrong += ["zzz"] if schema.get("type") != "string" else [1]
        edges = []
        for part in (schema, *schema.get("anyOf", ())):
            part = self.resolved(part)
            least, most = part.get("minimum"), part.get("maximum")
            low, high = part.get("exclusiveMinimum"), part.get("exclusiveMaximum")
            edges += [x for x in (least, most, low, high) if x is not None]
            edges += [x - abs(x) / 8 - 1 for x in (least, low) if x is not None]
            edges += [x + abs(x) / 8 + 1 for x in (most, high) if x is not None]
            if part.get("type") == "array":
                item = self.resolved(part["items"])
                size = part.get("maxItems", 1)
                inside = self.sample("", part)
                edges += [inside, inside + inside[:1] if size > 1 else ["zzz"]]
                if size > 1:
                    edges += [inside[:-1] + [2 * item["maximum"]]]
        edges += schema.get("enum", ())
        if schema.get("type") == "integer":
            edges += [schema.get("minimum", 0) + 0.5]
        return [self.sample(key, schema), *wrong, *edges]


class Asks(unittest.TestCase):
    """Has a folder, and a program that reads files there."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "mesh.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")

    def complaint(self, name, table, *words):
        file = self.folder / name
        file.write_text(document(table))
        done = subprocess.run([KAUSTIK, *words[:2], str(file), *words[2:]], capture_output=True,
                              text=True, check=False)
        self.assertNotEqual(done.returncode, 0, f"{table} is wrong")
        return done.stderr

    def keys_read(self, message):
        found = re.search(f"'{NO_KEY}' is not a key; the keys are (.*)\\.\n", message)
        self.assertTrue(found, message)
        return set(re.split(", | and ", found[1]))


class SceneFiles(Asks):
    schema = Schema("scene")

    # Where a table of each kind stands in a scene.
    PLACES = {"camera": ("camera",), "medium": ("medium",), "environment": ("environment",),
              "wave": ("object", "waves"), "light_edit": ("light",), "water_edit": ("water",)}

    def scene_with(self, name, table):
        if name in ("scene", "extension"):
            return table
        scene = {"extends": "ring"} if name.endswith("_edit") else {}
        place = self.PLACES.get(name, (name.split("_")[0],))
        if name == "wave":
            water = self.schema.smallest({"$ref": "#/$defs/object_water"})
            table = {**water, "waves": [table], NO_KEY: 1} if NO_KEY not in table else \
                {**water, "waves": [table]}
        return {**scene, place[0]: table if place[0] in ("camera", "medium", "environment")
                else [table]}

    def explain(self, name, table):
        return self.complaint("scene.toml", self.scene_with(name, table), "explain", "")

    def complaint(self, name, table, *words):
        return super().complaint(name, table, *[word for word in words if word])

    def tables(self):
        for name, schema in self.schema.defs.items():
            if "properties" in schema:
                yield name, schema

    def test_keys_are_those_that_the_program_reads(self):
        for name, schema in self.tables():
            with self.subTest(name):
                table = self.schema.smallest(schema)
                if name == "light_spot":
                    table["texture"] = "scene.toml"  # or there is no `up`
                read = self.keys_read(self.explain(name, {**table, NO_KEY: 1}))
                self.assertEqual(read - KINDS, set(schema["properties"]) - KINDS)
                self.assertFalse(self.schema.takes({**table, NO_KEY: 1}, schema))

    def test_what_is_required_is(self):
        for name, schema in self.tables():
            for key in schema.get("required", ()):
                with self.subTest(f"{name}.{key}"):
                    table = self.schema.smallest(schema)
                    del table[key]
                    if key not in ("type", "shape", "mesh", "extends"):
                        self.assertIn(f"'{key}' is missing", self.explain(name, table))
                    self.assertFalse(self.schema.takes(table, schema))

    def test_values_are_those_that_the_program_takes(self):
        seen = set()
        for name, schema in self.tables():
            for key, part in schema["properties"].items():
                resolved = self.schema.resolved(part)
                is_new = (key, json.dumps(resolved)) not in seen
                seen.add((key, json.dumps(resolved)))
                if not is_new or key in RELATED or "properties" in resolved or "const" in resolved:
                    continue
                if "$ref" in resolved.get("items", {}):
                    continue  # tables, which are looked at by themselves
                table = self.schema.smallest(schema)
                for other in schema.get("dependentRequired", {}).get(key, ()):
                    table[other] = SAMPLES[other]
                if key == "inner_cone_degrees":
                    table["outer_cone_degrees"] = 90
                if key in ("intensity", "power_watts"):
                    table.pop("intensity", None)
                if key in ("image", "pattern"):
                    table.pop("image", None)
                for value in self.schema.candidates(key, part):
                    with self.subTest(f"{name}.{key} = {value}"):
                        message = self.explain(name, {**table, key: value, NO_KEY: 1})
                        self.assertEqual(self.schema.takes({**table, key: value}, schema),
                                         f"'{NO_KEY}' is not a key" in message, message)


class ExperimentFiles(Asks):
    schema = Schema("experiment")

    def run_study(self, table):
        return self.complaint("study.toml", table, "experiment", "run", "--out",
                              str(self.folder / "mesh.ply/nowhere"))

    def test_keys_are_those_that_the_program_reads(self):
        for name in ("study", "suite"):
            table = self.schema.smallest(self.schema.defs[name])
            read = self.keys_read(self.run_study({**table, NO_KEY: 1}))
            self.assertEqual(read - KINDS, set(self.schema.defs[name]["properties"]) - KINDS)
        steps = {"from": 1, "to": 2, "steps": 2}
        read = self.keys_read(self.run_study({"name": "a", "permute": {"time": steps | {NO_KEY: 1}}}))
        self.assertEqual(read, set(self.schema.defs["range"]["properties"]))

    def test_values_of_parameters_are_those_that_the_program_takes(self):
        kinds = {}
        for form, part in self.parameters():  # one of each kind
            kinds.setdefault("choice" if "enum" in part else part["type"], (form, part))
        for form, part in kinds.values():
            if part.get("type") == "string":
                continue  # WIDTHxHEIGHT, whose limits a pattern does not say
            for value in self.schema.candidates(form, part):
                with self.subTest(f"{form} = {value}"):
                    settings = {"scene": "ring", form: value}
                    message = self.run_study({"name": "a", "base": settings})
                    self.assertEqual(self.schema.takes(settings, self.schema.defs["base"]),
                                     "nowhere cannot be made" in message, message)

    def test_settings_of_runs_are_those_that_the_program_takes(self):
        base = self.schema.defs["base"]
        for name, part in self.schema.defs.items():
            kind, _, key = name.partition(".")
            if kind != "run" or key in ("scene", "reference"):
                continue  # names of files
            for value in self.schema.candidates(key, part):
                with self.subTest(f"{key} = {value}"):
                    settings = {"scene": "ring", key: value}
                    message = self.run_study({"name": "a", "base": settings})
                    took = "nowhere cannot be made" in message or "no pass" in message
                    self.assertEqual(self.schema.takes(settings, base), took, message)

    def test_every_form_of_a_parameter_is_one_that_the_program_knows(self):
        values = {form: [part["default"]] for form, part in self.parameters()}
        # One product a form, since two forms of one name exclude each other.
        study = {"name": "a", "base": {"scene": "ring"},
                 "permute": [{form: value} for form, value in values.items()]}
        self.assertTrue(self.schema.validator.is_valid(study))
        self.assertIn("nowhere cannot be made", self.run_study(study))

    def parameters(self):
        for form, part in self.schema.defs["base"]["properties"].items():
            part = next((each for each in part.get("anyOf", ()) if "$ref" in each), part)
            if part.get("$ref", "").startswith("#/$defs/parameter."):
                yield form, self.schema.resolved(part)

    def test_names_that_are_no_parameters_are_refused(self):
        for key in ("trace.epsilom", "memory", NO_KEY):
            self.assertFalse(self.schema.takes({key: 1}, self.schema.defs["base"]), key)
            self.assertIn(f"'{key}'", self.run_study({"name": "a", "base": {key: 1}}))


class Reports(Asks):
    # What only a run of another kind, or with other numbers, says.
    ELSEWHERE = re.compile(r"\$schema|cells|error\.flicker|map\.maps\.generator|.*reasons|limits\..*|"
                           r"error\.view\..*|.*\.image_m|.*\.reference_m")

    def test_of_runs_are_as_the_schema_says(self):
        schema = Schema("report")
        (self.folder / "scene.toml").write_text(SCENE)
        reports = []
        for words in (("--frames", "1"),
                      ("--technique", "caustic_map", "--frames", "2", "--time-step", "0.5",
                       "--reference", "auto", "--reference-photons", "20000")):
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
    def test_schemas_are_what_their_script_makes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", SCHEMAS / "make.py", KAUSTIK, folder], check=True)
            for name in ("scene", "experiment", "report"):
                made = json.loads((pathlib.Path(folder) / f"{name}.schema.json").read_text())
                self.assertEqual(made, schema_of(name),
                                 "run experiments/schemas/make.py build/release/bin/kaustik")

    def test_are_as_the_schemas_say(self):
        for name, folder in (("scene", "experiments/scenes"), ("experiment", "experiments")):
            validator = Schema(name).validator
            files = sorted((SOURCE / folder).glob("*.toml"))
            self.assertTrue(files)
            for file in files:
                with self.subTest(file.name):
                    errors = validator.iter_errors(tomllib.loads(file.read_text()))
                    self.assertEqual([error.message for error in errors], [])


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
