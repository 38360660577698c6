# SPDX-License-Identifier: MIT
"""experiments/flicker.py: what it makes of changes that are known, and its rows."""

import contextlib
import csv
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

FILE = pathlib.Path(__file__).resolve().parents[2] / "experiments/flicker.py"
spec = importlib.util.spec_from_file_location("flicker", FILE)
flicker = importlib.util.module_from_spec(spec)
spec.loader.exec_module(flicker)


class Judgement(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(5)
        self.exact = 2.0 + np.sin(np.linspace(0.0, 6.0, 20))[:, None, None, None] * random.random((20, 12, 16, 3))
        self.sigma = np.full_like(self.exact, 0.2)
        self.noisy = self.exact + 0.2 * random.standard_normal(self.exact.shape)

    def test_the_truth_has_neither_error_nor_flicker_whatever_the_references_noise(self):
        judged = flicker.Truth(self.noisy, self.sigma).judge(self.exact)
        # What is left is the noise in the denominator: of 0.01, the square of 0.2 by 2, a tenth.
        self.assertLess(abs(judged["relMSE"]), 2e-3)
        self.assertAlmostEqual(judged["change"], 1.0, delta=0.05)
        self.assertLess(judged["wrong change"], 0.3)

    def test_a_picture_that_stands_still_misses_all_of_the_change(self):
        still = np.broadcast_to(self.exact.mean(axis=0), self.exact.shape)
        judged = flicker.Truth(self.exact, 0.0 * self.sigma).judge(still)
        self.assertEqual(judged["change"], 0.0)
        self.assertAlmostEqual(judged["wrong change"], 1.0)

    def test_what_shimmers_changes_more_than_it_should(self):
        shimmer = 0.3 * (-1.0) ** np.arange(20)[:, None, None, None]
        judged = flicker.Truth(self.exact, 0.0 * self.sigma).judge(self.exact + shimmer)
        self.assertGreater(judged["change"], 1.5)
        expected = 0.6 / np.sqrt((np.diff(self.exact, axis=0) ** 2).mean())
        self.assertAlmostEqual(judged["wrong change"], expected, places=6)

    def test_a_mean_has_the_standard_error_of_means_of_its_blocks(self):
        values = np.random.default_rng(7).standard_normal(60)
        mean, error = flicker.jackknife(lambda frames: np.array([values[frames].mean()]), 60, 6)
        blocks = values.reshape(6, 10).mean(axis=1)
        self.assertAlmostEqual(mean[0], values.mean())
        self.assertAlmostEqual(error[0], blocks.std(ddof=1) / np.sqrt(6))

    def test_every_mean_has_an_error_which_is_nothing_where_all_frames_are_wrong_alike(self):
        truth = flicker.Truth(self.exact, 0.0 * self.sigma)
        judged = truth.judge(1.1 * self.exact)
        self.assertEqual(list(judged), [column for mean in flicker.MEANS for column in (mean, f"{mean} ±")])
        self.assertAlmostEqual(judged["wrong change"], 0.1)
        self.assertLess(judged["wrong change ±"], 1e-7)
        wrong_at_the_end = self.exact + np.where(np.arange(20) < 15, 0.0, 0.5 * (-1.0) ** np.arange(20))[:, None, None, None]
        self.assertGreater(truth.judge(wrong_at_the_end)["wrong change ±"], 0.2)


class Study(unittest.TestCase):
    def test_has_a_row_a_technique_and_does_none_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            arguments = ["flicker.py", "--out", folder, "--scenes", "pool", "--techniques", "planar", "raytraced", "--frames", "4", "--size",
                         "32x24", "--photons", "16x16", "--reference-photons", "4096"]
            for again in (False, True):
                with mock.patch.object(sys, "argv", arguments), contextlib.redirect_stdout(io.StringIO()) as said:
                    self.assertEqual(flicker.main(), 0)
                self.assertEqual(said.getvalue().count("\n"), 1 if again else 4)  # what failed is tried again
            with open(f"{folder}/flicker.csv", newline="") as stream:
                rows = list(csv.DictReader(stream))
            self.assertTrue((pathlib.Path(folder) / "flicker.svg").is_file())
        self.assertEqual([(row["technique"], row["as_published"]) for row in rows],
                         [("planar", "false"), ("planar", "true"), ("raytraced", "false"), ("raytraced", "true")])
        self.assertEqual([row["status"] == "done" for row in rows], [True, True, True, False])
        self.assertIn("no paper", rows[3]["message"])
        self.assertGreater(float(rows[0]["change"]), 0.0)
        for mean in flicker.MEANS:
            self.assertGreater(float(rows[0][f"{mean} ±"]), 0.0)


if __name__ == "__main__":
    unittest.main()
