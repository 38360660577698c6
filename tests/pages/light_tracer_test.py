# SPDX-License-Identifier: MIT
"""The rows of light_tracer.py: which are made, which are made again, and that those of before stay as they are."""

import contextlib
import csv
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "experiments/plotting"), str(ROOT / "experiments")]

import light_tracer  # noqa: E402

OLD = """scene,estimator,size,photons,seconds,relMSE,"relMSE, reference's own",SMAPE,HDR FLIP,energy,version,asked
ring,light,400x300,11,0.1,0.2,0.01,0.3,0.4,1.0,0.1.0,10
ring,light,400x300,21,0.2,0.1,0.01,0.3,0.4,1.0,0.1.0,20
"""


class Rows(unittest.TestCase):
    def setUp(self):
        self.file = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "light_tracer.csv"
        self.made, self.key, self.known, self.device = [], "0123456789ab", True, "c, 2 threads"

    def call(self, *arguments: str) -> list[dict]:
        def measure(options, scene, estimator, photons, folder):
            self.made.append((scene, estimator, photons))
            return {"scene": scene, "estimator": estimator, "size": options.size, "photons": photons + 2, "seconds": 0.5, "relMSE": 0.25, "version": "2",
                    "date": "2026-12-01T00:00:00Z", "device": self.device, "other_processors": "0.01"}

        maker = light_tracer.Maker("kaustik")
        maker.known, maker.sources = self.known, lambda key: key
        maker.tree = mock.Mock(key_without_technique=lambda scene: self.key)
        self.made.clear()
        with mock.patch.object(light_tracer, "measure", measure), mock.patch.object(light_tracer, "Maker", lambda _: maker), \
                mock.patch.object(light_tracer, "processor", lambda _: self.device), mock.patch.object(sys, "argv", ["light_tracer.py", "--out", str(self.file), "--scenes", "ring", "--photons", "10", "20", *arguments]), \
                contextlib.redirect_stdout(io.StringIO()):
            light_tracer.main()
        with self.file.open(newline="") as stream:
            return list(csv.DictReader(stream))

    def test_of_before_stay_and_say_nothing_of_what_was_not_kept(self):
        self.file.write_text(OLD)
        rows = self.call()
        self.assertEqual(self.made, [("ring", "sppm", 10), ("ring", "sppm", 20)])
        for line, new in zip(OLD.splitlines()[1:], self.file.read_text().splitlines()[1:]):
            self.assertEqual(new, line + ",,,,")
        self.assertEqual([(row["date"], row["device"], row["other_processors"], row["sources"]) for row in rows],
                         2 * [("", "", "", "")] + 2 * [("2026-12-01T00:00:00Z", "c, 2 threads", "0.01", "0123456789ab")])
        self.call()
        self.assertEqual(self.made, [])

    def test_of_other_sources_or_none_are_made_again_in_their_places_where_that_is_asked(self):
        self.file.write_text(OLD)
        self.call()
        rows = self.call("--anew")
        self.assertEqual(self.made, [("ring", "light", 10), ("ring", "light", 20)])
        self.assertEqual([(row["estimator"], row["asked"], row["version"]) for row in rows],
                         [("light", "10", "2"), ("light", "20", "2"), ("sppm", "10", "2"), ("sppm", "20", "2")])
        self.call("--anew")
        self.assertEqual(self.made, [])
        self.key = "ba9876543210"
        self.call("--anew")
        self.assertEqual(len(self.made), 4)

    def test_are_not_made_again_by_a_program_that_is_not_of_the_tree(self):
        self.file.write_text(OLD)
        self.known = False
        with self.assertRaises(SystemExit) as raised:
            self.call("--anew")
        self.assertIn("build it first", str(raised.exception))
        self.assertEqual(self.file.read_text(), OLD)

    def test_of_another_device_are_no_neighbours(self):
        self.file.write_text(OLD)
        self.call()
        self.device, before = "d, 2 threads", self.file.read_text()
        with self.assertRaises(SystemExit) as raised:
            self.call("--photons", "10", "20", "40")
        self.assertIn("c, 2 threads, and this is d, 2 threads", str(raised.exception))
        self.assertEqual(self.file.read_text(), before)
        self.assertEqual({row["device"] for row in self.call("--anew")}, {"d, 2 threads"})

    def test_of_another_scene_may_be_of_another_device(self):
        self.file.write_text(OLD)
        self.call()
        before = self.file.read_text().replace("ring,", "tree,")
        self.file.write_text(before)
        self.device = "d, 2 threads"
        self.assertEqual({row["device"] for row in self.call() if row["scene"] == "ring"}, {"d, 2 threads"})
        self.assertIn("c, 2 threads", {row["device"] for row in self.call() if row["scene"] == "tree"})

    def test_say_how_busy_the_machine_was_with_other_work(self):
        load = light_tracer.Load()
        load.begin = (load.begin[0] - 3.0, load.begin[1] - 1.0, load.begin[2] - 2.0)
        self.assertAlmostEqual(load.others(), 1.0, delta=0.1)
        self.assertIn("3 threads", light_tracer.processor(3))


if __name__ == "__main__":
    unittest.main()
