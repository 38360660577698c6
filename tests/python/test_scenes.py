# SPDX-License-Identifier: MIT
"""Scenes by name, from files and from dicts; what there is to choose from."""

import copy
import os
import tomllib
import unittest

import numpy

import kaustik
from support import SOURCE, WATER, TestCase, command_line


class Scenes(TestCase):
    def picture(self, scene, **options):
        r = self.open(scene, **options)
        r.step()
        return numpy.asarray(r.read("display")).tobytes()

    def test_from_a_dict_are_those_of_the_file(self):
        file = os.path.join(SOURCE, "experiments/scenes/ring.toml")
        with open(file, "rb") as stream:
            table = tomllib.load(stream)
        self.assertEqual(self.picture(table), self.picture("ring"))
        self.assertEqual(self.picture({"extends": "ring"}), self.picture(file))

    def test_take_what_numpy_has(self):
        scene = copy.deepcopy(WATER)
        scene["camera"]["position"] = numpy.array([0, 2, 2.5])
        scene["object"][1]["radius"] = numpy.float32(0.4)
        scene["light"][0]["irradiance"] = numpy.int64(1000)
        r = self.open(scene)
        r.step()
        self.assertGreater(r.report()["energy"]["deposited_w"], 0)

    def test_find_their_files_beside_the_base(self):
        folder = self.folder()
        with open(os.path.join(folder, "ball.obj"), "w", encoding="ascii") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        scene = copy.deepcopy(WATER)
        scene["object"].append({"name": "triangle", "material": "floor", "mesh": "ball.obj"})
        self.assertTrue(self.picture(scene, base=folder))
        self.assert_fails(kaustik.IoError, ["the scene", "ball.obj"], self.open, scene)

    def test_that_make_no_sense_name_what_is_wrong(self):
        def changed(change):
            scene = copy.deepcopy(WATER)
            change(scene)
            return scene

        cyclic = copy.deepcopy(WATER)
        cyclic["camera"]["self"] = cyclic
        cases = [
            ("poool", ["poool", "did you mean 'pool'"]),
            (changed(lambda s: s.update(lihgt=[])), ["'lihgt'", "did you mean 'light'"]),
            (changed(lambda s: s["object"][1].update(radius=-1)), ["ball", "radius", "-1"]),
            (changed(lambda s: s["camera"].update(near=None)), ["camera.near", "NoneType"]),
            (changed(lambda s: s.update({1: 2})), ["key 1"]),
            (changed(lambda s: s["camera"].update(near=10**30)), ["camera.near", "too large"]),
            (cyclic, ["nested"]),
            (3.5, ["name, a path or a dict", "float"]),
        ]
        for scene, words in cases:
            self.assert_fails(kaustik.ConfigError, words, self.open, scene)
        self.assert_fails(kaustik.IoError, ["nowhere.toml"], self.open, "nowhere.toml")

    def test_are_opened_with_options_that_are_checked(self):
        cases = [
            ({"technique": "plana"}, ["plana", "did you mean 'planar'"]),
            ({"size": (0, 3)}, ["size", "0x3"]),
            ({"size": "big"}, ["size", "big"]),
            ({"set": {"photns": 3}}, ["photns"]),
            ({"disable": ["compose.drect"]}, ["compose.drect"]),
            ({"seed": -1}, ["seed"]),
            ({"time": float("nan")}, ["time"]),
        ]
        for options, words in cases:
            self.assert_fails(kaustik.ConfigError, words, self.open, **options)
        with self.assertRaisesRegex(TypeError, "sise"):
            kaustik.open("ring", sise=(3, 3))


class Lists(TestCase):
    def test_are_those_of_the_command_line(self):
        def names(*arguments):
            lines = command_line("list", *arguments).stdout.splitlines()
            return [line.split()[0] for line in lines if not line.startswith(" ")]

        self.assertEqual([s["name"] for s in kaustik.scenes()], names("scenes"))
        self.assertEqual([t["name"] for t in kaustik.techniques()], names("techniques"))
        self.assertEqual([n["name"] for n in kaustik.nodes()], names("nodes"))
        planar = [n["name"] for n in kaustik.nodes("planar")]
        self.assertEqual(planar, names("nodes", "--technique", "planar"))
        self.assertIn("trace.plane", planar)
        self.assertIn("emit.photons", [p["name"] for p in kaustik.params("planar")])
        self.assert_fails(kaustik.ConfigError, ["'plana'"], kaustik.nodes, "plana")


if __name__ == "__main__":
    unittest.main()
