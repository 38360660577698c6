# SPDX-License-Identifier: MIT
"""The sheets of where techniques are wrong by more than noise."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/bias.py"
RUNS = """folder,status,scene,technique,error.bias.too_bright,error.bias.too_dark
a,done,pool,exact_rays,0.012,0.034
b,done,pool,caustic_map,0.5,0.25
c,done,ring,planar,0.0,0.0
d,failed,ring,differential_area,,
"""


class Sheets(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        (self.results / "runs.csv").write_text(RUNS)
        for name, colour in (("a", "orange"), ("b", "blue"), ("c", "black")):
            (self.results / name).mkdir()
            Image.new("RGB", (40, 30), colour).save(self.results / name / "bias.png")

    def call(self):
        return subprocess.run([sys.executable, "-B", PROGRAM, self.results, "--out", self.results / "out"], capture_output=True, text=True)

    def test_are_one_a_scene_with_the_picture_of_each_run(self):
        done = self.call()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(file.name for file in (self.results / "out").iterdir()), ["pool.jpg", "ring.jpg"])
        with Image.open(self.results / "out/pool.jpg") as sheet:
            colours = sheet.convert("RGB").getcolors(1 << 24)
        # Each fills about a tenth of its sheet.
        near = lambda wanted: sum(count for count, colour in colours if all(abs(a - b) < 12 for a, b in zip(colour, wanted)))
        whole = sum(count for count, _ in colours)
        for wanted in ((255, 165, 0), (0, 0, 255)):
            self.assertGreater(near(wanted), 0.05 * whole, wanted)

    def test_name_a_run_without_a_picture(self):
        (self.results / "b/bias.png").unlink()
        done = self.call()
        self.assertEqual(done.returncode, 1)
        self.assertIn("the run of caustic_map has no bias.png", done.stderr)
        (self.results / "runs.csv").unlink()
        self.assertIn("there is no '", self.call().stderr)


if __name__ == "__main__":
    unittest.main()
