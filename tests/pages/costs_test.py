# SPDX-License-Identifier: MIT
"""What reports with --device-model say, as a CSV and as tables."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

COSTS = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/costs.py"


def report(technique: str, passes: list[tuple[str, int, int]]) -> dict:
    counts = {key: 0 for key in ("requested_written_bytes", "threads", "work_groups", "commands", "barriers", "read_backs")}
    return {"version": "1.0", "timing": {"date": "2026-01-01T00:00:00Z"}, "device": {"renderer": "one", "cpu": "two", "threads": 2}, "scene": {"name": "pool"}, "technique": technique, "size": [8, 4], "parameters": {"emit.photons": "2x2", "layers.count": 8},
            "cost": {"passes": [{"name": name, "read_bytes": read, "written_bytes": written, "requested_read_bytes": 2 * read, "atomics": 3_000_000} | counts
                                for name, read, written in passes]}}


class Costs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.csv = self.folder / "costs/passes.csv"
        for one in (report("dear", [("a.b", 500_000_000, 500_000_000), ("c.d", 0, 4_000_000)]), report("cheap", [("a.b", 1_000_000, 0)])):
            target = self.folder / one["technique"] / "report.json"
            target.parent.mkdir()
            target.write_text(json.dumps(one))
        self.run_costs("slim", self.folder / "dear", self.folder / "cheap/report.json", "--csv", self.csv)

    def run_costs(self, *words) -> str:
        return subprocess.run([sys.executable, "-B", COSTS, *words], check=True, capture_output=True, text=True).stdout

    def test_a_row_is_a_pass(self):
        with self.csv.open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([(row["technique"], row["pass"], row["read_bytes"]) for row in rows],
                         [("cheap", "a.b", "1000000"), ("dear", "a.b", "500000000"), ("dear", "c.d", "0")])

    def test_bytes_over_bandwidth_are_times_the_cheapest_first(self):
        lines = self.run_costs("frames", self.csv).splitlines()
        self.assertIn("`cheap`", lines[2])
        # 1.004 GB at 500, 1000 and 4800 GB/s.
        self.assertIn("| pool | `dear` | 500 | 504 | 1000 | 6.0 | 2.01 | 1.00 | 0.21 | a.b 1.00; c.d 0.00 |", lines[3])

    def test_passes_that_a_technique_lacks_have_a_dash(self):
        self.assertIn("| c.d | – | 4.0 |", self.run_costs("passes", self.csv))


if __name__ == "__main__":
    unittest.main()
