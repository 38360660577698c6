# SPDX-License-Identifier: MIT
"""What a device's runs are made smaller to, and how they are set against those of another."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PLOTTING = Path(__file__).resolve().parents[2] / "experiments/plotting"
OTHER = Path(__file__).resolve().parents[2] / "results/all_techniques/runs.csv"


def call(*arguments):
    return subprocess.run([sys.executable, "-B", PLOTTING / "device.py", *arguments], capture_output=True, text=True)


class Device(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.runs, self.slim = Path(folder.name) / "runs.csv", Path(folder.name) / "slim.csv"
        with OTHER.open(newline="") as stream:
            self.other = next(row for row in csv.DictReader(stream)
                              if (row["scene"], row["technique"], row["as_published"], row["emit.photons"]) == ("pool", "planar", "false", "256x256"))
        done = {"scene": "pool", "technique": "planar", "emit.photons": "256x256", "refine.finest": "4096", "ledger": "", "status": "done", "frame_ms.median": "7",
                "frame_ms.p95": "8", "error.caustic_irradiance.rel_mse": str(2.0 * float(self.other["relMSE"])), "pass:trace.plane": "1.5",
                "pass:emit.grid": "0.25", "pass:shadow.map": "", "pass:view.refraction": "3", "pass:compose.display": "0.5", "renderer": "a card"}
        refused = {"scene": "glass-bunny", "technique": "planar", "status": "failed"}
        with self.runs.open("w", newline="") as stream:
            writer = csv.DictWriter(stream, list(done), restval="")
            writer.writeheader()
            writer.writerows([done, refused])

    def test_keeps_what_was_done_and_its_slowest_passes(self):
        self.assertEqual(call("slim", self.runs, "--csv", self.slim).returncode, 0)
        with self.slim.open(newline="") as stream:
            row, = csv.DictReader(stream)
        self.assertEqual(row["slowest passes, ms"], "view.refraction 3.0; trace.plane 1.5; compose.display 0.5")
        self.assertIn("| `pool` | `planar` | 256² | 7.0 | 8.0 | view.refraction 3.0; trace.plane 1.5; compose.display 0.5 |", call("times", self.slim).stdout)

    def test_says_which_frames_kept_no_ledger(self):
        with self.runs.open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        rows[0]["ledger"] = "false"
        with self.runs.open("w", newline="") as stream:
            writer = csv.DictWriter(stream, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
        call("slim", self.runs, "--csv", self.slim)
        self.assertIn("| `pool` | `planar` | 256², no ledger | 7.0", call("times", self.slim).stdout)

    def test_errors_stand_over_those_of_the_same_run_elsewhere(self):
        call("slim", self.runs, "--csv", self.slim)
        self.assertIn("; 2.000 |", call("errors", self.slim).stdout)

    def test_says_what_it_cannot_read(self):
        done = call("errors", self.runs.with_name("nothing.csv"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing.csv", done.stderr)


if __name__ == "__main__":
    unittest.main()
