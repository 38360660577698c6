# SPDX-License-Identifier: MIT
"""The rule by which each scene's best mixture is chosen, on runs whose products of error and time are known."""

import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/best_mixtures.py"

# The reference's noise is 0.001. Of `ring` beams are best, of `pool` nothing is below the noise but by name, so that the fastest is; `tree` has no caustic.
RUNS = """scene,trace,driver,reconstruct,status,ms,relMSE,"relMSE, reference's own"
ring,hierarchical,dense,triangles,done,100,0.011,0.001
ring,raytraced,dense,beams,done,20,0.021,0.001
ring,raytraced,adaptive,beams,done,1000,0.003,0.001
pool,hierarchical,dense,triangles,done,100,0.0011,0.001
pool,raytraced,dense,triangles,done,90,0.0015,0.001
pool,raytraced,adaptive,beams,failed,,,
ball,raytraced,adaptive,beams,done,10,0.011,0.001
tree,hierarchical,dense,triangles,done,0,,
"""


class BestMixtures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def chosen(self, runs):
        (self.folder / "choice.csv").write_text(runs)
        return subprocess.run([sys.executable, "-B", PROGRAM, self.folder / "choice.csv", "--study", self.folder / "best.toml"],
                              capture_output=True, text=True)

    def test_have_the_least_product_of_error_and_time(self):
        done = self.chosen(RUNS)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines(), [
            "| scene | `hierarchical`, `triangles` | `raytraced`, `adaptive`, `beams` | `raytraced`, `beams` | `raytraced`, `triangles` |",
            "| --- | --- | --- | --- | --- |",
            "| `ball` | – | **–** | – | – |",
            "| `pool` | 1 | – | – | **0.9** |",
            "| `ring` | 1 | 2 | **0.4** | – |"])

    def test_are_run_with_what_each_driver_counts_photons_by(self):
        self.chosen(RUNS)
        by = {scene: run for run in tomllib.loads((self.folder / "best.toml").read_text())["permute"] for scene in run["scene"]}
        self.assertEqual(set(by), {"ball", "pool", "ring"})
        self.assertEqual((by["ring"]["trace"], by["ring"]["reconstruct"]), (["raytraced"], ["beams"]))
        self.assertIn("emit.photons", by["ring"])
        self.assertNotIn("driver", by["ring"])
        self.assertEqual((by["ball"]["driver"], by["ball"]["emit"]), (["adaptive"], ["deferred"]))
        self.assertNotIn("emit.photons", by["ball"])

    def test_without_runs_are_refused(self):
        done = self.chosen("scene,trace,driver,reconstruct,status,ms,relMSE\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("has an error and a time", done.stderr)


if __name__ == "__main__":
    unittest.main()
