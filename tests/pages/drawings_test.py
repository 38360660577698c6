# SPDX-License-Identifier: MIT
"""Drawings say what they are of, and one of older rows is found; tables that a program makes of a study's are what it makes of it now."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLOTTING = ROOT / "experiments/plotting"
sys.path.insert(0, str(PLOTTING))

import drawings  # noqa: E402
from figures import plt  # noqa: E402


class Drawings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)

    def drawn(self, folder, file):
        (self.results / folder).mkdir()
        (self.results / folder / file).write_text("a\n1\n")
        figure, axes = plt.subplots()
        axes.plot([1, 2], [3, 4])
        figure.savefig(self.results / folder / "one.svg", metadata=drawings.metadata([self.results / folder / file]))
        plt.close(figure)

    def test_of_older_rows_are_named_with_what_draws_them(self):
        self.drawn("flicker", "flicker.csv")
        self.drawn("other", "runs.csv")
        self.assertEqual(drawings.outdated(self.results), [])
        for folder, file, says in (("flicker", "flicker.csv", "'experiments/flicker.py' draws it anew"), ("other", "runs.csv", "than runs.csv have now")):
            (self.results / folder / file).write_text("a\n2\n")
            found = drawings.outdated(self.results)
            self.assertEqual(len(found), 1, folder)
            self.assertIn(says, found[0])
            (self.results / folder / file).write_text("a\n1\n")
        (self.results / "flicker/one.svg").write_text("<svg/>")
        self.assertEqual(len(drawings.outdated(self.results)), 1)

    def test_fail_the_check_of_the_pages(self):
        self.drawn("flicker", "flicker.csv")
        (self.results / "flicker/flicker.csv").write_text("a\n2\n")
        done = subprocess.run([sys.executable, "-B", PLOTTING / "pages.py", "--check", "--results", self.results], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("flicker/one.svg: drawn of other rows", done.stderr)

    def test_tables_of_speed_and_error_are_what_the_program_makes_of_the_runs(self):
        of_tree = ROOT / "results/all_techniques"
        for name in drawings.DRAWN["all_techniques"][0]:
            shutil.copy(of_tree / name, self.results)
        done = subprocess.run([sys.executable, "-B", PLOTTING / "speed_error.py", "--tables", "--results", self.results], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        made = sorted(file.name for file in self.results.glob("*.csv"))
        self.assertLessEqual({"answers.csv", "summary.csv", "goals.csv", "equal_error.csv", "costs.csv", "published.csv", "to_error.csv", "in_time.csv"}, set(made))
        self.assertEqual(list(self.results.glob("*.svg")), [])
        for name in made:
            self.assertEqual((self.results / name).read_text(), (of_tree / name).read_text(), name)


if __name__ == "__main__":
    unittest.main()
