# SPDX-License-Identifier: MIT
"""The parts of an error, of pictures of which they are known."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from run_folders import grey, write_run

PLOTTING = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting"
COUNTS = (128, 252, 256, 260, 512)


class ErrorParts(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.rows = []

    def add(self, technique: str, of_count, fine) -> None:
        """`of_count`: the picture by photons a side; `fine`: the same with twice the pixels."""
        runs = [("8x6", count, of_count(count)) for count in COUNTS] + [("16x12", count, fine(count)) for count in COUNTS[1:-1]]
        for size, photons, image in runs:
            name = f"{technique}-{size}-{photons}"
            write_run(self.folder / name, image, grey(image.shape[1], image.shape[0], 1.0), technique)
            self.rows.append({"folder": name, "status": "done", "message": "", "scene": "box", "technique": technique, "size": size,
                              "emit.photons": f"{photons}x{photons}", "version": "1"})

    def parts(self, *more: str) -> dict:
        with (self.folder / "runs.csv").open("w", newline="") as stream:
            writer = csv.DictWriter(stream, self.rows[0].keys())
            writer.writeheader()
            writer.writerows(self.rows)
        done = subprocess.run([sys.executable, "-B", PLOTTING / "error_parts.py", self.folder, "--out", self.folder / "out", *more],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with (self.folder / "out/parts.csv").open(newline="") as stream:
            return {row["technique"]: row for row in csv.DictReader(stream)}

    def check(self, row: dict, **parts: float) -> None:
        for name in ("noise", "photons", "pixels", "stays"):
            self.assertAlmostEqual(float(row[name]), parts.get(name, 0.0), places=6, msg=name)
        self.assertAlmostEqual(float(row["relMSE"]), sum(parts.values()), places=6)

    def test_each_part_is_told_from_the_others(self):
        # A bias that halves with each doubling of the grid; repeats are alike.
        falling = {128: 0.4, 252: 0.2, 256: 0.2, 260: 0.2, 512: 0.1}
        self.add("photons", lambda count: grey(8, 6, 1.0 + falling[count]), lambda count: grey(16, 12, 1.2))
        # A bias of each pixel that the mean over finer ones does not have.
        checker = 1.0 + 0.3 * (-1.0) ** np.add.outer(np.arange(12), np.arange(16))[..., None].repeat(3, axis=2)
        self.add("pixels", lambda count: grey(8, 6, 1.1), lambda count: checker)
        self.add("stays", lambda count: grey(8, 6, 1.1), lambda count: grey(16, 12, 1.1))
        table = self.parts()
        self.check(table["photons"], photons=0.04)
        self.assertEqual(table["photons"]["extrapolated"], "true")
        self.check(table["pixels"], pixels=0.01)
        self.check(table["stays"], stays=0.01)
        self.assertEqual(table["stays"]["extrapolated"], "false")
        self.assertTrue((self.folder / "out/parts.svg").is_file())

    def test_biases_that_fall_by_nearly_the_same_have_no_limit_below_zero(self):
        square = {128: 0.3, 252: 0.2, 256: 0.2, 260: 0.2, 512: 0.101}
        self.add("steady", lambda count: grey(8, 6, 1.0 + square[count] ** 0.5), lambda count: grey(16, 12, 1.0 + 0.2 ** 0.5))
        row = self.parts()["steady"]
        self.check(row, photons=0.099, stays=0.101)
        self.assertEqual(row["extrapolated"], "false")

    def test_what_differs_between_repeats_is_noise(self):
        rng = np.random.default_rng(3)
        size = (6, 8, 3)
        noise = {count: 0.1 * (256 / count) * rng.standard_normal(size) for count in COUNTS}
        # Splats of as many pixels are smaller there: the mean of four is noisier than one was.
        fine = {count: 0.6 * rng.standard_normal((12, 16, 3)) for count in COUNTS}
        self.add("noisy", lambda count: 1.0 + noise[count], lambda count: 1.0 + fine[count])
        row = self.parts()["noisy"]
        self.assertAlmostEqual(float(row["noise"]), 0.01, delta=0.003)
        # Of 144 values the mean square of 0.3 is known to a sixth.
        self.assertAlmostEqual(float(row["pixels"]), 0.0, delta=0.03)

    def test_what_was_known_of_others_stays_where_that_is_asked(self):
        self.add("first", lambda count: grey(8, 6, 1.1), lambda count: grey(16, 12, 1.1))
        self.parts()
        self.rows.clear()
        self.add("second", lambda count: grey(8, 6, 1.2), lambda count: grey(16, 12, 1.2))
        table = self.parts("--keep")
        self.check(table["first"], stays=0.01)
        self.check(table["second"], stays=0.04)
        self.assertEqual(set(self.parts()), {"second"})

    def test_a_line_says_what_its_runs_are_of(self):
        self.add("stays", lambda count: grey(8, 6, 1.1), lambda count: grey(16, 12, 1.1))
        for at, row in enumerate(self.rows):
            row |= {"device": "d", "date": f"2026-01-0{at + 1}", "other_processors": f"0.{at}"}
        keys = {row["folder"]: "0123456789ab" for row in self.rows}
        (self.folder / "sources.json").write_text(json.dumps(keys))
        row = self.parts()["stays"]
        self.assertEqual([row[key] for key in ("version", "device", "sources", "date", "other_processors")], ["1", "d", "0123456789ab", "2026-01-08", "0.7"])
        (self.folder / "sources.json").write_text(json.dumps(keys | {self.rows[0]["folder"]: "ba9876543210"}))
        self.assertEqual(self.parts()["stays"]["sources"], "")  # of several

    def test_a_run_that_is_missing_or_has_failed_is_said(self):
        self.add("whole", lambda count: grey(8, 6, 1.0), lambda count: grey(16, 12, 1.0))
        self.add("part", lambda count: grey(8, 6, 1.0), lambda count: grey(16, 12, 1.0))
        self.rows.pop()
        self.add("failed", lambda count: grey(8, 6, 1.0), lambda count: grey(16, 12, 1.0))
        self.rows[-1] |= {"status": "failed", "message": "out of memory"}
        table = self.parts()
        self.assertEqual([table[name]["status"] for name in ("whole", "part", "failed")],
                         ["done", "7 of 8 runs are there", "out of memory"])

    def test_what_was_whole_before_stays_where_it_is_there_in_part(self):
        self.add("whole", lambda count: grey(8, 6, 1.0), lambda count: grey(16, 12, 1.0))
        self.add("other", lambda count: grey(8, 6, 1.0), lambda count: grey(16, 12, 1.0))
        self.parts()
        self.rows.pop()
        self.rows[0]["version"] = "2"
        table = self.parts("--keep")
        self.assertEqual([table[name]["status"] for name in ("whole", "other")], ["done", "done"])
        self.assertEqual([table[name]["version"] for name in ("whole", "other")], ["2", "1"])


if __name__ == "__main__":
    unittest.main()
