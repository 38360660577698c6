# SPDX-License-Identifier: MIT
"""References, comparisons and studies."""

import os
import tempfile
import unittest

import numpy

import kaustik
from support import TestCase, interrupt_after

PHOTONS = 300000


class References(TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.environ.update, {"KAUSTIK_CACHE": os.environ["KAUSTIK_CACHE"]})
        os.environ["KAUSTIK_CACHE"] = folder.name
        cls.told = []
        cls.reference = kaustik.reference(
            "ring", size=(64, 48), photons=PHOTONS, progress=lambda *news: cls.told.append(news)
        )

    def test_have_the_standard_error_of_every_pixel(self):
        self.assertGreaterEqual(self.reference.photons, PHOTONS)
        self.assertEqual(self.reference.irradiance.shape, (48, 64, 3))
        self.assertEqual(self.reference.standard_error.shape, (48, 64, 3))
        self.assertIsNone(self.reference.in_scattered)
        self.assertLess(abs(self.reference.energy["balance"]), 1e-9)
        self.assertEqual(self.told[-1][0], 1.0)

    def test_are_files_too(self):
        file = os.path.join(self.folder(), "ring.exr")
        self.reference.save(file)
        read = kaustik.read_reference(file)
        numpy.testing.assert_array_equal(read.irradiance, self.reference.irradiance)
        r = self.open()
        r.step()
        report = r.report(file)
        self.assertEqual(report["error"]["reference"], file)
        self.assertGreater(report["hits"]["agreement"], 0.9)
        r.size = (32, 24)
        r.step()
        self.assert_fails(kaustik.ConfigError, ["64x48", "32x24"], r.report, file)
        self.assertGreater(r.report()["energy"]["deposited_w"], 0)

    def test_keep_classes_of_paths_apart(self):
        kept = kaustik.reference("ring", size=(64, 48), photons=PHOTONS, classes=["once=R", "R{2,}"])
        self.assertEqual(list(kept.classes), ["once", "R{2,}", "other"])
        numpy.testing.assert_array_equal(kept.irradiance, self.reference.irradiance)
        whole = numpy.asarray(kept.irradiance)
        parts = sum(numpy.asarray(image, "float64") for image in kept.classes.values())
        self.assertTrue((abs(parts - whole) <= numpy.spacing(whole)).all())
        # A mirror refracts nothing.
        self.assertEqual(numpy.asarray(kept.classes["other"]).max(), 0)
        self.assertGreater(numpy.asarray(kept.classes["once"]).max(), 0)
        self.assertEqual(kept.class_errors["once"].shape, (48, 64, 3))
        self.assertEqual(self.reference.classes, {})
        file = os.path.join(self.folder(), "ring.exr")
        kept.save(file)
        read = kaustik.read_reference(file)
        numpy.testing.assert_array_equal(read.classes["once"], kept.classes["once"])
        self.assert_fails(kaustik.ConfigError, ["class", "'X'"], kaustik.reference, "ring", classes=["X"])

    def test_have_a_census_of_their_paths(self):
        found = kaustik.census("ring", photons=100000, techniques=["planar"], size=(64, 48))
        self.assertEqual(found["classes"][0]["class"], "R")
        self.assertAlmostEqual(sum(one["share"] for one in found["classes"]), 1.0)
        self.assertEqual(found["techniques"][0]["technique"], "planar")
        self.assert_fails(kaustik.ConfigError, ["planar"], kaustik.census, "ring", techniques=["planra"])

    def test_are_shared_out_in_shards(self):
        folder = self.folder()
        asked = {"photons": 100000, "techniques": ["planar"], "size": (64, 48)}
        for shard in ("1/2", "2/2"):
            kaustik.census("ring", shard=shard, out=folder, **asked)
        files = [os.path.join(folder, f"census-{i}-of-2.json") for i in (1, 2)]
        self.assertEqual(kaustik.census("ring", merge=files), kaustik.census("ring", **asked))
        for shard in ("1/2", "2/2"):
            kaustik.prepare_judge("ring", (24, 18), shard, photons=600000, causes=False)
        self.assert_fails(kaustik.ConfigError, ["3 of 2"], kaustik.prepare_judge, "ring", (24, 18), "3/2")

    def test_end_at_ctrl_c_and_refuse_what_makes_no_sense(self):
        interrupt_after(0.3)
        with self.assertRaises(KeyboardInterrupt):
            kaustik.reference("ring", size=(64, 48), photons=10**12)

        def stop(share, text):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            kaustik.reference("ring", size=(32, 24), photons=10**12, progress=stop)
        cases = [
            ({"photons": 0}, ["photons"]),
            ({"estimator": "lihgt"}, ["lihgt"]),
            ({"size": (0, 1)}, ["size"]),
            ({"threads": -1}, ["threads"]),
        ]
        for options, words in cases:
            self.assert_fails(kaustik.ConfigError, words, kaustik.reference, "ring", **options)
        self.assert_fails(kaustik.IoError, ["none"], kaustik.read_reference, "none.exr")


class Comparisons(TestCase):
    def setUp(self):
        self.image = numpy.linspace(0, 2, 16 * 12 * 3, dtype="float32").reshape(12, 16, 3)

    def test_of_known_errors_are_known(self):
        errors = kaustik.compare(self.image + numpy.float32(0.5), self.image)
        self.assertAlmostEqual(errors["rmse"], 0.5, places=6)
        self.assertAlmostEqual(errors["mae"], 0.5, places=6)
        self.assertEqual(kaustik.compare(self.image, self.image)["rmse"], 0)

    def test_take_arrays_as_they_lie_and_files(self):
        turned = self.image[::-1].astype("float64")
        self.assertEqual(kaustik.compare(turned[::-1], self.image)["rmse"], 0)
        r = self.open(size=(16, 12))
        r.step()
        array = r.read("caustic.irradiance")
        file = os.path.join(self.folder(), "irradiance.exr")
        array.save(file)
        self.assertEqual(kaustik.compare(file, array)["rmse"], 0)
        self.assertEqual(kaustik.heat_map(array, file).shape, (12, 16, 3))

    def test_leave_out_what_the_mask_does(self):
        mask = numpy.zeros((12, 16), "float32")
        mask[3, 4] = 1
        wrong = self.image + 1
        wrong[3, 4] = self.image[3, 4]
        self.assertEqual(kaustik.compare(wrong, self.image, mask=mask)["rmse"], 0)

    def test_refuse_what_is_no_image(self):
        cases = [
            (self.image[:6], kaustik.ConfigError, ["16x6"]),
            (self.image.astype("int32"), kaustik.ConfigError, ["floats"]),
            (self.image[0, 0], kaustik.ConfigError, ["3"]),
            (None, kaustik.ConfigError, ["NoneType"]),
            ("nothing.exr", kaustik.IoError, ["nothing.exr"]),
            (self.image * numpy.nan, kaustik.IoError, ["image"]),
        ]
        for image, kind, words in cases:
            self.assert_fails(kind, words, kaustik.compare, image, self.image)


class Studies(TestCase):
    def test_of_a_dict_give_a_row_a_run(self):
        out = os.path.join(self.folder(), "study")
        study = {
            "name": "layers",
            "base": {"scene": "ring", "size": (32, 24), "frames": 1, "warmup": 0,
                     "emit.photons": (16, 16), "shadow.map.size": 64},
            "permute": {"layers.count": [1, 4]},
        }  # fmt: skip
        rows = kaustik.run_experiment(study, out)
        self.assertEqual([row["layers.count"] for row in rows], [1, 4])
        self.assertTrue(all(row["status"] == "done" for row in rows))
        self.assertGreater(rows[0]["energy.emitted_w"], 0)
        self.assertEqual(kaustik.run_experiment(study, out, resume=True), rows)
        self.assertEqual(kaustik.read_results(out), rows)

    def test_in_shards_are_those_done_at_once(self):
        study = {
            "name": "shards",
            "base": {"scene": "ring", "size": (24, 16), "frames": 1, "warmup": 0,
                     "emit.photons": (16, 16), "shadow.map.size": 64},
            "permute": {"layers.count": [1, 2, 4]},
        }  # fmt: skip
        folders = [os.path.join(self.folder(), name) for name in ("one", "two")]
        for number, folder in enumerate(folders, 1):
            self.assertEqual(kaustik.run_experiment(study, folder, shard=f"{number}/2"), [])
        out = os.path.join(self.folder(), "all")
        self.assert_fails(kaustik.ConfigError, ["missing"],
                          kaustik.merge_experiments, folders[0], out)  # fmt: skip
        rows = kaustik.merge_experiments(folders, out)
        self.assertEqual([row["layers.count"] for row in rows], [1, 2, 4])
        self.assertTrue(all(row["status"] == "done" for row in rows))
        self.assertEqual(kaustik.read_results(out), rows)
        self.assert_fails(kaustik.ConfigError, ["no shard 3 of 2"],
                          kaustik.run_experiment, study, out, shard="3/2")  # fmt: skip

    def test_that_make_no_sense_name_what_is_wrong(self):
        out = os.path.join(self.folder(), "study")
        study = {"name": "x", "permute": {"layers.cuont": [1]}}
        self.assert_fails(kaustik.ConfigError, ["layers.cuont"], kaustik.run_experiment, study, out)
        self.assertFalse(os.path.exists(out))
        self.assert_fails(kaustik.IoError, ["runs.csv"], kaustik.read_results, out)


if __name__ == "__main__":
    unittest.main()
