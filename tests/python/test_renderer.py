# SPDX-License-Identifier: MIT
"""A renderer that is kept: settings, frames, reports, and what goes wrong."""

import json
import os
import unittest

import numpy
import OpenImageIO

import kaustik
from support import SMALL, TestCase, command_line, interrupt_after


def bits(array):
    return numpy.asarray(array).tobytes()


class Settings(TestCase):
    def test_take_short_names_and_python_values(self):
        r = self.open()
        r.set("photons", (16, 24))
        r.set({"trace": "lines", "trace.lines.width": 64, "trace.epsilon": 0.25})
        self.assertEqual(r.get("emit.photons"), (16, 24))
        self.assertEqual(r.get("trace"), "lines")
        self.assertEqual(r.get("trace.lines.width"), 64)
        self.assertIs(type(r.get("trace.lines.width")), int)
        named = {param["name"]: param for param in r.params()}
        self.assertEqual(named["emit.photons"]["value"], (16, 24))
        self.assertEqual(named["emit.photons"]["maximum"], 16384)
        self.assertIn("march", named["trace"]["choices"])
        self.assertTrue(named["trace"]["is_set"])
        self.assertFalse(named["layers.count"]["is_set"])

    def test_refuse_as_the_command_line_does_and_keep_what_was_set(self):
        r = self.open()
        for name, value in [("emit.photon", "8x8"), ("trace", "line"), ("layers.count", "99999")]:
            said = command_line("explain", "ring", "--set", f"{name}={value}")
            self.assertEqual(said.returncode, 2)
            sentence = said.stderr.strip().removeprefix("kaustik: ").removeprefix("--")
            self.assert_fails(kaustik.ConfigError, [sentence], r.set, name, value)
        self.assert_fails(kaustik.ConfigError, ["photons", "None"], r.set, {"photons": None})
        before = r.get("layers.count")
        both = {"layers.count": 2, "nothing.like.it": 1}
        self.assert_fails(kaustik.ConfigError, ["nothing.like.it"], r.set, both)
        self.assertEqual(r.get("layers.count"), before)
        self.assert_fails(kaustik.ConfigError, ["did you mean", "emit.photons"], r.get, "emit.photon")
        self.assert_fails(kaustik.ConfigError, ["secant.most", "trace.secant.max_steps"], r.set,
                          {"secant.most": 3})
        self.assertEqual(r.get("emit.photons"), (32, 32))
        r.step()

    def test_are_those_of_the_paper_where_that_is_asked_for(self):
        r = kaustik.open("ring", **{**SMALL, "technique": "caustic_map", "as_published": True})
        self.assertTrue(r.as_published)
        self.assertEqual(r.get("trace.background.steps"), 0)
        self.assertFalse(self.open().as_published)
        listed = {one["name"]: one for one in kaustik.techniques()}
        self.assertEqual(listed["caustic_map"]["as_published"]["trace.background.steps"], "0")
        self.assertEqual(listed["raytraced"]["as_published"], {})

    def test_that_do_not_go_together_are_told_by_the_step_and_can_be_taken_back(self):
        r = self.open()
        r.set("reconstruct.space", "light")
        self.assert_fails(kaustik.ConfigError, ["gather.screen", "lights' maps"], r.step)
        r.set("reconstruct.space", "screen")
        r.step()

    def test_disabled_passes_come_back(self):
        r = self.open()
        r.step()
        bright = numpy.asarray(r.read("display"))
        r.disable("compose.direct")
        self.assertEqual(r.disabled, ["compose.direct"])
        self.assert_fails(kaustik.ConfigError, ["compose.drect"], r.disable, "compose.drect")
        self.assert_fails(kaustik.ConfigError, ["required"], r.disable, "eye.receivers")
        self.assertEqual(r.disabled, ["compose.direct"])
        r.step()
        self.assertLess(numpy.asarray(r.read("display")).sum(), bright.sum())
        r.enable()
        r.step()
        self.assertEqual(bits(r.read("display")), bright.tobytes())


class Frames(TestCase):
    def test_hold_the_bits_that_the_command_line_saves(self):
        out = self.folder()
        said = command_line(
            "run", "ring", "--size", "64x48", "--set", "emit.photons=32x32",
            "--technique", "screen_space_photons",
            "--set", "shadow.map.size=64", "--frames", "1", "--warmup", "0", "--out", out,
            "--save", "caustic.irradiance", "--save", "layers.depth")  # fmt: skip
        self.assertEqual(said.returncode, 0, said.stderr)
        r = self.open()
        r.step()

        def saved(name):
            file = OpenImageIO.ImageInput.open(os.path.join(out, name + ".exr"))
            return numpy.asarray(file.read_image("float"), "float32")

        irradiance = numpy.asarray(r.read("caustic.irradiance"))
        self.assertGreater(irradiance[:, :, :3].max(), 0)
        self.assertEqual(irradiance.tobytes(), saved("caustic.irradiance").tobytes())
        depth = numpy.asarray(r.read("layers.depth"))
        self.assertEqual(depth.shape, (8, 48, 64, 4))
        self.assertEqual(depth[1].tobytes(), saved("layers.depth.1").tobytes())
        self.assertEqual(bits(r.read("layers.depth", layer=1)), depth[1].tobytes())
        with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
            theirs = json.load(file)
        ours = r.report()
        self.assertEqual(ours.keys(), theirs.keys())
        for key in ("schema", "energy", "photons", "parameters", "size", "scene", "seed", "frames"):
            self.assertEqual(ours[key], theirs[key], key)

    def test_go_on_where_the_last_step_ended(self):
        r = self.open("flat-water", set={**SMALL["set"], "temporal": "reproject"})
        times = r.step(2, warmup=1)
        self.assertEqual(times["frames"], 2)
        self.assertEqual({"median", "mean", "min", "max", "p95", "stdev"}, times["frame_ms"].keys())
        self.assertIn("trace.hierarchical", [entry["name"] for entry in times["passes"]])
        r.step(time=1.0)
        r.step(2, time_step=0.5)
        self.assertEqual(r.time, 2.0)
        report = r.report()
        self.assertEqual((report["frames"], report["warmup"], report["time_s"]), (5, 1, 2.0))
        r.set("layers.count", 2)
        r.step()
        self.assertEqual(r.report()["frames"], 1)

    def test_are_read_only_once_they_are_rendered(self):
        r = self.open()
        self.assert_fails(kaustik.ConfigError, ["step()"], r.read, "caustic.irradiance")
        self.assert_fails(kaustik.ConfigError, ["step()"], r.report)
        r.step()
        said = ["layers.detph", "did you mean 'layers.depth'"]
        self.assert_fails(kaustik.ConfigError, said, r.read, "layers.detph")
        self.assert_fails(kaustik.ConfigError, ["buffer"], r.read, "ledger")
        self.assert_fails(kaustik.ConfigError, ["layer 8", "has 8"], r.read, "layers.depth", layer=8)
        r.set("layers.count", 2)
        self.assert_fails(kaustik.ConfigError, ["changed", "step()"], r.read, "layers.depth")
        r.step()
        self.assertEqual(r.read("layers.depth").shape[0], 2)

    def test_take_another_size_seed_and_view(self):
        r = self.open()
        r.step()
        before = bits(r.read("display"))
        r.edit(camera={"position": [0, 3, 0.5]})
        r.step()
        self.assertNotEqual(bits(r.read("display")), before)
        said = ["camera", "positoin", "did you mean 'position'"]
        self.assert_fails(kaustik.ConfigError, said, r.edit, camera={"positoin": [0, 1, 0]})
        self.assert_fails(kaustik.ConfigError, ["nobody"], r.edit, light=[{"name": "nobody"}])
        r.size = (32, 24)
        r.seed = 7
        r.step()
        self.assertEqual(r.read("display").shape, (24, 32, 4))
        self.assertEqual((r.size, r.seed), ((32, 24), 7))
        with self.assertRaises(kaustik.ConfigError):
            r.size = (0, 24)
        self.assertEqual(r.size, (32, 24))

    def test_end_at_ctrl_c_and_nothing_is_lost(self):
        r = self.open()
        r.step()
        before = bits(r.read("caustic.irradiance"))
        interrupt_after(0.3)
        with self.assertRaises(KeyboardInterrupt):
            r.step(1000000)
        self.assertEqual(bits(r.read("caustic.irradiance")), before)
        r.step()
        self.assertEqual(bits(r.read("caustic.irradiance")), before)
        self.assertGreaterEqual(r.report()["frames"], 2)


class Files(TestCase):
    def test_are_those_of_a_run(self):
        r = self.open()
        r.step()
        out = os.path.join(self.folder(), "run")
        files = r.save(out, ["layers.depth"])
        self.assertEqual(sorted(files), sorted(os.path.join(out, f) for f in os.listdir(out)))
        for name in ("beauty.png", "caustic.exr", "layers.depth.0.exr", "report.json"):
            self.assertIn(os.path.join(out, name), files)
        self.assert_fails(kaustik.ConfigError, ["nothing"], r.save, out, ["nothing"])
        self.assert_fails(kaustik.IoError, ["report.json"], r.save, files[-1])
        r.step()


class Lifetime(TestCase):
    def test_a_closed_renderer_says_so(self):
        with kaustik.open("ring", **SMALL) as r:
            r.step()
            self.assertFalse(r.closed)
        self.assertTrue(r.closed)
        r.close()
        for call in (r.step, r.report, r.params, r.passes, lambda: r.size, r.explain):
            self.assert_fails(kaustik.ConfigError, ["closed", "kaustik.open()"], call)
        self.assertIn("closed", repr(r) + r._repr_html_())

    def test_explains_itself(self):
        r = self.open()
        said = command_line(
            "explain", "ring", "--size", "64x48", "--set", "emit.photons=32x32",
            "--technique", "screen_space_photons",
            "--set", "shadow.map.size=64")  # fmt: skip
        # The command goes on with what the device lacks.
        self.assertTrue(said.stdout.startswith(r.explain()))
        self.assertEqual(r.needs()["depth_complexity"], 5)
        states = {entry["name"]: entry["state"] for entry in r.passes()}
        self.assertEqual(states["trace.hierarchical"], "runs")
        self.assertIn("ring", repr(r))

    def test_notebooks_show_the_picture_and_the_passes(self):
        r = self.open()
        self.assertNotIn("<img", r._repr_html_())
        r.step()
        shown = r._repr_html_()
        self.assertIn("data:image/png;base64,", shown)
        self.assertIn("trace.hierarchical", shown)
        r.set("layers.count", 2)
        self.assertNotIn("<img", r._repr_html_())


if __name__ == "__main__":
    unittest.main()
