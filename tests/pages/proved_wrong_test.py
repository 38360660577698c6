# SPDX-License-Identifier: MIT
"""What a certificate proves of a picture: which pixels are outside of their interval, and by what share at least."""

import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "experiments/plotting"), str(ROOT / "experiments")]

import proved_wrong  # noqa: E402
from run_folders import write_pfm  # noqa: E402


def grey(*values: float) -> np.ndarray:
    """A picture of one row."""
    return np.repeat(np.array(values, np.float32)[None, :, None], 3, axis=2)


# Two pixels with some light, one with much, one that may have a trace, a dark one, and one of which little is known.
LOWER, UPPER = grey(1.0, 1.0, 8.0, 0.0, 0.0, 2.0), grey(1.1, 1.1, 8.0, 1e-3, 0.0, 4.0)


class Departures(unittest.TestCase):
    def test_are_shares_of_the_nearest_bound_and_nothing_inside(self):
        found = proved_wrong.departures(grey(0.5, 1.05, 10.0, 0.0, 0.0, 3.0), LOWER, UPPER, True)
        np.testing.assert_allclose(found, [[0.5, 0.0, 0.25, 0.0, 0.0, 0.0]], rtol=1e-6)

    def test_are_none_above_where_longer_paths_may_bring_more(self):
        found = proved_wrong.departures(grey(0.5, 2.2, 10.0, 1.0, 0.0, 1.0), LOWER, UPPER, False)
        np.testing.assert_allclose(found, [[0.5, 0.0, 0.0, 0.0, 0.0, 0.5]], rtol=1e-6)

    def test_have_no_share_of_a_bound_of_nothing(self):
        self.assertEqual(proved_wrong.departures(grey(9.0), grey(0.0), grey(0.0), True), 0.0)

    def test_are_of_the_sum_of_the_channels(self):
        values = np.array([[[0.0, 2.0, 1.0]]])
        self.assertEqual(proved_wrong.departures(values, np.ones((1, 1, 3)), np.ones((1, 1, 3)), True), 0.0)
        below, above = proved_wrong.outside(values, np.ones((1, 1, 3)), np.ones((1, 1, 3)))
        self.assertEqual((below.item(), above.item()), (True, False))  # which it is proved all the same, by a channel


class Lit(unittest.TestCase):
    def test_is_what_may_have_a_thousandth_of_the_mean_of_what_has_some(self):
        # The mean of the four that are certain to have light is 3, of which a thousandth is 0.003.
        np.testing.assert_array_equal(proved_wrong.lit_of(LOWER, UPPER), [[True, True, True, False, False, True]])
        np.testing.assert_array_equal(proved_wrong.lit_of(grey(0.0, 0.0), grey(0.0, 1e-9)), [[False, True]])


class Row(unittest.TestCase):
    def row(self, values: np.ndarray, beyond_w: float, **counts) -> dict:
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"KAUSTIK_CACHE": folder}):
            run, kept = pathlib.Path(folder) / "run", pathlib.Path(folder) / "certificates"
            run.mkdir()
            kept.mkdir()
            write_pfm(run / "caustic.pfm", values)
            write_pfm(kept / "abc.lower.pfm", LOWER)
            write_pfm(kept / "abc.upper.pfm", UPPER)
            certificate = {"key": "abc", "energy": {"beyond_interactions_w": [0.0, beyond_w]}, "pixels": {"lit": 4, "median_width": 0.1}, "seconds": 12.0}
            (run / "certified.json").write_text(json.dumps({"certificate": certificate, "proved_too_dark": 0, "proved_too_bright": 0, "too_bright_for_certified_paths": 0, "undecided": 1,
                                                            "mean_w_per_m2": 2.0, "mean_between_w_per_m2": [1.0, 3.0], **counts}))
            (run / "report.json").write_text('{"version": "2"}')
            return proved_wrong.row_of(run)

    def test_has_shares_of_lit_pixels_and_others_by_their_number(self):
        row = self.row(grey(0.5, 1.05, 8.4, 1.0, 1.0, 3.0), 0.0, proved_too_dark=1, proved_too_bright=3)
        self.assertEqual([row[name] for name in ("lit", "dark", "bright", "bright for two", "unlit", "undecided")], [4, 0.25, 0.25, None, 2, 0.25])
        self.assertEqual([row[name] for name in ("off by 1 %", "off by 10 %")], [0.5, 0.25])  # by a half and by a twentieth
        self.assertAlmostEqual(row["median"], 0.025, 6)
        self.assertEqual([row[name] for name in ("mean", "mean least", "mean most", "median width", "seconds", "version", "status")], [2.0, 1.0, 3.0, 0.1, 12.0, "2", "done"])

    def test_does_not_call_bright_pixels_wrong_where_longer_paths_may_be_the_cause(self):
        row = self.row(grey(0.5, 1.05, 8.4, 1.0, 1.0, 3.0), 0.1, proved_too_dark=1, too_bright_for_certified_paths=3)
        self.assertEqual([row[name] for name in ("dark", "bright", "bright for two", "unlit", "off by 1 %")], [0.25, None, 0.25, 0, 0.25])

    def test_is_refused_where_the_program_has_counted_otherwise(self):
        with self.assertRaisesRegex(ValueError, "other counts"):
            self.row(grey(0.5, 1.05, 8.4, 1.0, 1.0, 3.0), 0.0, proved_too_dark=2, proved_too_bright=3)


if __name__ == "__main__":
    unittest.main()
