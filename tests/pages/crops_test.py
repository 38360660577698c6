# SPDX-License-Identifier: MIT
"""Figures of runs side by side: what is chosen, said and written."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from run_folders import grey, write_run

PLOTTING = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting"
sys.path.insert(0, str(PLOTTING))
import crops  # noqa: E402


def crops_py(*arguments) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-B", PLOTTING / "crops.py", *map(str, arguments)], capture_output=True, text=True)


class Crops(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.truth = grey(48, 36, 1.0)
        self.truth[20:26, 30:38] = 5.0
        self.image = self.truth.copy()
        self.image[2:5, 2:6] += 1.0
        write_run(self.folder / "a", self.image, self.truth)
        write_run(self.folder / "b", self.truth, self.truth, "raytraced")

    def test_the_figure_is_written_in_all_formats_with_its_caption(self):
        done = crops_py(self.folder / "a", self.folder / "b", "--out", self.folder / "out", "--name", "one", "--label", "50 % & more")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for suffix in (".pdf", ".svg", ".png", ".tex"):
            self.assertGreater((self.folder / f"out/one{suffix}").stat().st_size, 100)
        text = (self.folder / "out/one.tex").read_text()
        self.assertIn(r"box\_1, 48 x 36 pixels", text)
        self.assertIn(r"50 \% \& more: 5 ms, relMSE 0.0069; raytraced: 5 ms, relMSE 0", text)
        again = (self.folder / "out/one.pdf").read_bytes(), (self.folder / "out/one.svg").read_bytes()
        crops_py(self.folder / "a", self.folder / "b", "--out", self.folder / "out", "--name", "one", "--label", "50 % & more")
        self.assertEqual(((self.folder / "out/one.pdf").read_bytes(), (self.folder / "out/one.svg").read_bytes()), again)

    def test_crops_are_where_the_light_and_where_the_error_is(self):
        light, error = crops.chosen_crops(crops.read_run(self.folder / "a", None))
        x, y, w, h = light
        self.assertTrue(x <= 30 and x + w >= 38 and y <= 20 and y + h >= 26)
        x, y, w, h = error
        self.assertTrue(x <= 2 and x + w >= 6 and y <= 2 and y + h >= 5)

    def test_what_cannot_be_drawn_is_said(self):
        write_run(self.folder / "other", grey(8, 6, 1.0), grey(8, 6, 1.0))
        cases = ((self.folder / "a", self.folder / "other", "different scenes or sizes"),
                 (self.folder / "a", "--crop", "40,0,20,5", "is not within 48x36"),
                 (self.folder / "nothing", "No such file"))
        for *arguments, said in cases:
            done = crops_py(*arguments, "--out", self.folder / "out")
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        (self.folder / "b/reference.pfm").unlink()
        self.assertIn("--reference auto", crops_py(self.folder / "b", "--out", self.folder / "out").stderr)


if __name__ == "__main__":
    unittest.main()
