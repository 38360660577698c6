# SPDX-License-Identifier: MIT
"""Where the time of a technique goes, by stage, and what share of its light is chaotic: of a folder of `kaustik experiment run`."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROFILES = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/profiles.py"
sys.path.insert(0, str(PROFILES.parent))

from sources import SOURCES  # noqa: E402

# The surfaces are in two passes, tracing in two, and the medium in one, which is none of the caustic's.
RUNS = """folder,technique,scene,emit.photons,as_published,status,pass:geometry.meshes,pass:layers.peel,pass:emit.grid,pass:specular.rays,pass:trace.bvh,pass:reconstruct.triangles,pass:gather.eye,pass:view.around,pass:media.lines,\
energy.primitives.beams,energy.primitives.triangles,energy.primitives.splats,device,version,date,other_processors,of_measured_frame
1,exact_rays,ring,256x256,false,done,1,1,4,6,2,4,2,50,900,10,25,5,a,2,2026-01-01T00:00:00Z,0.1,false
2,exact_rays,pool,256x256,false,done,,,5,,5,,,50,,0,8,0,a,2,2026-01-01T00:00:00Z,0.1,false
3,screen_space_photons,pool,256x256,false,done,,,5,,5,,,50,,,,7,a,2,2026-01-01T00:00:00Z,0.1,false
4,exact_rays,tree,256x256,false,done,,,,,,,,50,,,,,a,2,2026-01-01T00:00:00Z,0.1,false
5,exact_rays,pool,64x64,false,done,,,9,,9,,,50,,0,8,0,a,2,2026-01-01T00:00:00Z,0.1,false
6,exact_rays,pool,256x256,true,done,,,9,,9,,,50,,0,8,0,a,2,2026-01-01T00:00:00Z,0.1,false
7,caustic_map,pool,256x256,false,done,,,9,,9,,,50,,0,8,0,a,2,2026-01-01T00:00:00Z,0.1,false
8,exact_rays,god-rays,256x256,false,failed,,,,,,,,,,,,,a,2,2026-01-01T00:00:00Z,,false
9,exact_rays,flat-water,256x256,false,done,,,5,,5,,,50,,0,8,0,a,2,2026-01-01T00:00:00Z,0.1,true
"""
PARTS = ("surfaces", "emission", "tracing", "spreading", "gathering")


class Profile(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "runs.csv").write_text(RUNS)
        (self.folder / SOURCES).write_text(json.dumps({"1": "abc"}))

    def profile(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, "-B", PROFILES, self.folder, "--out", self.folder / "profile.csv", *words], capture_output=True, text=True)

    def rows(self, *words) -> dict[tuple, dict]:
        done = self.profile(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with (self.folder / "profile.csv").open(newline="") as stream:
            return {(row["technique"], row["scene"]): row for row in csv.DictReader(stream)}

    def test_has_a_row_a_technique_and_scene_of_runs_with_these_photons(self):
        self.assertEqual(list(self.rows()), [("exact_rays", "flat-water"), ("exact_rays", "pool"), ("exact_rays", "ring"), ("exact_rays", "tree"), ("screen_space_photons", "pool")])
        self.assertEqual(list(self.rows("--technique", "caustic_map")), [("caustic_map", "pool")])
        self.assertEqual(list(self.rows("--photons", "64x64")), [("exact_rays", "pool")])

    def test_keeps_rows_of_what_has_no_run_where_that_is_asked(self):
        self.rows()
        (self.folder / "runs.csv").write_text("\n".join(RUNS.replace("1,exact_rays,ring,256x256,false,done,1,1,", "1,exact_rays,ring,256x256,false,done,11,1,").split("\n")[:2]) + "\n")
        rows = self.rows("--keep")
        self.assertEqual((len(rows), rows["exact_rays", "ring"]["ms"], rows["exact_rays", "pool"]["ms"]), (5, "30.0", "10.0"))
        self.assertEqual(list(self.rows()), [("exact_rays", "ring")])

    def test_has_shares_that_add_up_to_all_without_the_medium_and_the_view(self):
        rows = self.rows()
        ring = rows["exact_rays", "ring"]
        self.assertEqual(float(ring["ms"]), 20.0)
        self.assertEqual([float(ring[part]) for part in PARTS], [0.1, 0.2, 0.4, 0.2, 0.1])
        self.assertEqual([float(rows["exact_rays", "pool"][part]) for part in PARTS], [0.0, 0.5, 0.5, 0.0, 0.0])
        for row in rows.values():
            if row["ms"]:
                self.assertAlmostEqual(sum(float(row[part]) for part in PARTS), 1.0)

    def test_says_which_share_of_the_flux_beams_of_cells_of_their_own_spread(self):
        rows = self.rows()
        self.assertEqual([rows["exact_rays", scene]["chaotic"] for scene in ("ring", "pool")], ["0.25", "0.0"])
        self.assertEqual(rows["screen_space_photons", "pool"]["chaotic"], "")  # by splats alone: no photons are joined

    def test_says_nothing_of_a_scene_without_a_caustic(self):
        tree = self.rows()["exact_rays", "tree"]
        self.assertEqual([tree[name] for name in ("status", "ms", *PARTS, "chaotic")], ["done", "", "", "", "", "", "", ""])

    def test_has_no_times_of_a_frame_that_was_measured_otherwise_too(self):
        water = self.rows()["exact_rays", "flat-water"]
        self.assertEqual([water[name] for name in ("ms", *PARTS, "chaotic")], ["", "", "", "", "", "", "0.0"])

    def test_says_what_rows_are_of(self):
        ring = self.rows()["exact_rays", "ring"]
        self.assertEqual([ring[name] for name in ("device", "version", "sources", "date", "other_processors")], ["a", "2", "abc", "2026-01-01T00:00:00Z", "0.1"])

    def test_of_a_folder_that_is_no_study_says_so(self):
        (self.folder / "runs.csv").unlink()
        done = self.profile()
        self.assertEqual(done.returncode, 1)
        self.assertIn("the results of 'kaustik experiment run'?", done.stderr)


if __name__ == "__main__":
    unittest.main()
