# SPDX-License-Identifier: MIT
"""A typed table becomes a CSV and is shown as it was."""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLOTTING = ROOT / "experiments/plotting"
TABLE = ["| scene | `view.*` | n | n | command |", "| --- | --- | --- | --- | --- |", "| `pool` | 3·10⁻⁸ | **2**, 3 | – | `kaustik run` |",
         "| `ring` | 1,024 |  | 5 | `kaustik run` |"]


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        self.page = self.results / "page.md"

    def call(self, program, *arguments):
        return subprocess.run([sys.executable, "-B", PLOTTING / program, *map(str, arguments)], capture_output=True, text=True)

    def record(self, text, line):
        self.page.write_text(text)
        return self.call("record.py", self.page, line, "page/runs.csv", "--command", "kaustik run SCENE", "--version", "1 (abc)", "--date", "2026-11-27", "--seed", 1)

    def test_keeps_every_cell_and_says_where_it_is_from(self):
        done = self.record("# Page\n\n" + "\n".join(TABLE) + "\n\nAfter.\n", 5)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.call("pages.py", "--results", self.results).returncode, 0)
        text = self.page.read_text()
        self.assertIn("\n".join([TABLE[0], "| --- | --- | --- | --- | --- |", *TABLE[2:]]) +
                      "\n\n*[`page/runs.csv`](page/runs.csv), recorded 2026-11-27; version 1 (abc); seed 1; by `kaustik run SCENE`.*", text)
        self.assertTrue(text.endswith("<!-- end -->\n\nAfter.\n"), text)
        self.assertEqual(self.call("pages.py", "--check", "--results", self.results).returncode, 0)
        with (self.results / "page/runs.csv").open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([(row["scene"], row["n"], row["n (2)"], row["command"]) for row in rows], [("pool", "**2**, 3", "–", "kaustik run SCENE"),
                                                                                                    ("ring", "", "5", "kaustik run SCENE")])

    def test_refuses_what_is_no_table(self):
        for line, says in [(1, "line 1 is not of a table"), (99, "line 99 is not of a table")]:
            done = self.record("# Page\n\n" + "\n".join(TABLE), line)
            self.assertEqual(done.returncode, 1)
            self.assertIn(says, done.stderr)
        self.assertIn("has no rows", self.record("\n".join(TABLE[:2]), 1).stderr)
        self.assertIn("a row has 2 cells", self.record("\n".join([*TABLE, "| a | b |"]), 1).stderr)


if __name__ == "__main__":
    unittest.main()
