# SPDX-License-Identifier: MIT
"""Speed against error compared with a light tracer, on runs whose factors are known: its relMSE is 1000 over its photons, each takes 1 us."""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/speed_error.py"

NOISE = 0.0005
RUNS = f"""scene,technique,as_published,emit.photons,refine.finest,status,ms,relMSE,"relMSE, reference's own",emitted,peak MiB,"not formed, %","not formed, W",device,version
ring,a,false,1x1,4096,done,10,{0.1 + NOISE},{NOISE},1000,2,7,0.7,d,1
ring,a,false,2x2,4096,done,100,{0.01 + NOISE},{NOISE},4000,5,6,0.6,d,1
ring,a,true,2x2,4096,done,50,{0.01 + NOISE},{NOISE},4000,5,,,d,1
ring,b,false,2x2,4096,done,1000,{0.0001 + NOISE},{NOISE},4000,5,,,d,1
ring,c,false,2x2,4096,failed,,,,,,,,d,1
"""
LIGHT_TRACER = f"""scene,estimator,photons,seconds,relMSE,"relMSE, reference's own"
ring,light,100000,0.3,{0.01 + NOISE},{NOISE}
ring,light,1000000,1.2,{0.001 + NOISE},{NOISE}
ring,sppm,1000000,9,0.5,{NOISE}
tree,light,0,0,,
"""


class SpeedError(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "runs.csv").write_text(RUNS)
        (cls.folder / "light_tracer.csv").write_text(LIGHT_TRACER)
        subprocess.run([sys.executable, "-B", PROGRAM, "--results", cls.folder], check=True)

    def rows(self, name):
        with (self.folder / name).open(newline="") as stream:
            return list(csv.DictReader(stream))

    def test_at_equal_error_is_the_ratio_of_times_net_of_noise(self):
        rows = {(row["technique"], row["as_published"], row["emit.photons"]): row for row in self.rows("equal_error.csv")}
        self.assertEqual(set(rows), {("a", "false", "1x1"), ("a", "false", "2x2"), ("a", "true", "2x2"), ("b", "false", "2x2")})
        for key, photons, factor in [(("a", "false", "1x1"), 1e4, 1.0), (("a", "false", "2x2"), 1e5, 1.0),
                                     (("a", "true", "2x2"), 1e5, 2.0)]:
            self.assertAlmostEqual(float(rows[key]["light tracer's photons"]) / photons, 1.0, places=3)
            self.assertAlmostEqual(float(rows[key]["factor"]), factor, places=3)
            self.assertEqual(rows[key]["at_least"], "false")

    def test_below_the_references_noise_is_a_bound(self):
        row = next(row for row in self.rows("equal_error.csv") if row["technique"] == "b")
        self.assertEqual(row["at_least"], "true")
        self.assertAlmostEqual(float(row["light tracer's photons"]), 1000.0 / NOISE, delta=1.0)

    def test_to_an_error_takes_the_first_there_and_interpolates(self):
        rows = {float(row["relMSE"]): row for row in self.rows("to_error.csv")}
        self.assertEqual(rows[0.01]["first"], "a, as published")
        self.assertAlmostEqual(float(rows[0.01]["value"]), 50.0, places=2)
        # Half way between two runs of `a` in the logarithms: 10 to 100 ms; the light tracer has 33.3 ms for 0.03.
        self.assertAlmostEqual(float(rows[0.03]["value"]), 10.0 * 10.0 ** 0.5228787, delta=0.05)
        self.assertEqual(rows[0.001]["first"], "light tracer")

    def test_in_a_time_takes_the_least_error(self):
        rows = {float(row["ms"]): row for row in self.rows("in_time.csv")}
        self.assertEqual(rows[50.0]["first"], "a, as published")
        self.assertAlmostEqual(float(rows[50.0]["value"]), 0.01, places=5)
        self.assertEqual(rows[1000.0]["first"], "b")

    def test_of_photon_mapping_are_its_own_runs(self):
        done = subprocess.run([sys.executable, "-B", "-c", "import sys; sys.path.insert(0, sys.argv[1]);"
                               "from speed_error import *; f = pathlib.Path(sys.argv[2]);"
                               "of = curves(rows_of(f / 'runs.csv'), rows_of(f / 'light_tracer.csv'))['ring'];"
                               "print(of[PHOTON_MAPPING])", PROGRAM.parent, self.folder], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), f"[(9000.0, {0.5 - NOISE})]")

    def test_costs_are_slopes_between_few_and_many_photons(self):
        rows = {(row["technique"], row["as_published"]): row for row in self.rows("costs.csv")}
        self.assertEqual(set(rows), {("a", "false"), ("a", "true"), ("b", "false")})
        row = rows["a", "false"]
        self.assertEqual([float(row[key]) for key in ("ns a photon", "ms at none", "bytes a photon", "MiB at none")],
                         [90e6 / 3000, -20.0, 1049.0, 1.0])
        self.assertEqual((row["least ns a photon"], row["most ns a photon"]), (row["ns a photon"],) * 2)  # one scene
        self.assertEqual((row["most not formed, %"], row["most not formed, W"], row["on"]), ("7", "0.7", "ring"))
        self.assertEqual((rows["b", "false"]["scenes"], rows["b", "false"]["ns a photon"]), ("0", ""))

    def test_answers_are_of_the_middle_runs_by_default(self):
        row, = self.rows("answers.csv")
        # Of `a` by default the run with fewer photons of two; `b` has one.
        self.assertEqual((row["scene"], row["factor"], row["best"], row["best's at_least"]), ("ring", "", "b", "true"))
        self.assertTrue((self.folder / "headline.svg").is_file())

    def test_published_are_pairs_of_one_scene_and_size(self):
        row, = self.rows("published.csv")  # of `a` with 2x2; `b` has no row as published
        self.assertEqual((row["technique"], row["scenes"], row["least on"]), ("a", "1", "ring"))
        self.assertEqual([round(float(row[key]), 3) for key in ("ms", "least ms", "largest ms", "relMSE", "largest relMSE", "gain", "least gain", "largest gain")],
                         [2.0, 2.0, 2.0, 1.0, 1.0, 0.5, 0.5, 0.5])

    def test_draws_each_scene_that_has_a_caustic(self):
        self.assertTrue((self.folder / "ring.svg").is_file())
        self.assertFalse((self.folder / "tree.svg").exists())


if __name__ == "__main__":
    unittest.main()
