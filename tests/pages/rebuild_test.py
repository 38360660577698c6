# SPDX-License-Identifier: MIT
"""What rebuild.py keeps of a table that its study's CSV is not enough for."""

import csv
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments/plotting"))

import rebuild  # noqa: E402
from views import PageError  # noqa: E402

RUNS = "status,version,device,cpu,threads,seed,date\ndone,2,a,c,4,7,2026-11-27T10:00:00Z\nfailed,,,,,,\n"


class Recorded(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.study = pathlib.Path(folder.name) / "study"
        self.target = pathlib.Path(folder.name) / "wyman2008/ringing.csv"
        for made in (self.study, self.target.parent):
            made.mkdir()
        (self.study / "runs.csv").write_text(RUNS)
        self.kept = self.target.with_name("ringing_recorded.csv")
        self.kept.write_text("splats\nold\n")

    def test_tables_that_need_the_pictures_are_kept_as_printed_of_the_studys_folder(self):
        def printed(program, arguments, of):
            self.assertEqual((program, arguments), ("wyman2008.py", "ringing"))
            if of != self.study:
                raise PageError("it has no pictures")
            return "| splats | RMS |\n| --- | --- |\n| `fixed` | 6.97 |\n"

        with mock.patch.object(rebuild, "printed", printed):
            rebuild.record(self.study, "wyman2008_ringing", self.target)
        with self.kept.open(newline="") as stream:
            self.assertEqual(list(csv.DictReader(stream)), [
                {"splats": "fixed", "RMS": "6.97", "command": "experiments/rebuild_results.sh wyman2008_ringing", "version": "2", "device": "a, c, 4 threads",
                 "seed": "7", "date": "2026-11-27"}])

    def test_tables_that_the_new_csv_can_make_are_kept_no_longer(self):
        with mock.patch.object(rebuild, "printed", lambda *_: ""):
            rebuild.record(self.study, "wyman2008_ringing", self.target)
        self.assertFalse(self.kept.exists())

    def test_every_study_names_a_file_and_every_file_one_study(self):
        self.assertEqual(len(set(rebuild.STUDIES.values())), len(rebuild.STUDIES))
        for study in {*rebuild.STUDIES, *rebuild.DEVICE}:
            self.assertTrue((ROOT / f"experiments/{study}.toml").is_file(), study)
        self.assertLessEqual(set(rebuild.PRINTED), set(rebuild.RUNS))


class Missing(unittest.TestCase):
    """What --missing runs of a study."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for made in ("experiments", "results/refined"):
            (self.root / made).mkdir(parents=True)
        (self.root / "experiments/refined.toml").write_text('[permute]\nscene = ["pool", "ring"]\n"driver.dense.refine" = [1, 3]\nas_published = [true]\n')
        self.enterContext(mock.patch.object(rebuild, "ROOT", self.root))

    def test_is_each_run_that_no_row_is_of(self):
        (self.root / "results/refined/runs.csv").write_text("scene,driver.dense.refine,as_published\npool,1,true\nring,1,true\nring,3,true\n")
        self.assertEqual(rebuild.missing_parts("refined"), [["--only", "scene=pool", "--only", "driver.dense.refine=3", "--only", "as_published=true"]])

    def test_is_nothing_of_a_study_that_is_whole(self):
        rows = "".join(f"{scene},{refine},true\n" for scene in ("pool", "ring") for refine in (1, 3))
        (self.root / "results/refined/runs.csv").write_text("scene,driver.dense.refine,as_published\n" + rows)
        self.assertEqual(rebuild.missing_parts("refined"), [])

    def test_is_all_of_a_study_that_was_never_run(self):
        self.assertEqual(rebuild.missing_parts("refined"), [[]])

    def test_is_refused_before_any_run_where_old_rows_do_not_say_all_settings(self):
        (self.root / "experiments/equal_error.toml").write_text('[permute]\nscene = ["pool", "ring"]\n')
        file = self.root / "results/reconstructions/equal_error.csv"
        file.parent.mkdir()
        file.write_text("scene,status\npool,done\n")
        with self.assertRaises(rebuild.Failure) as raised:
            rebuild.missing_parts("equal_error")
        self.assertIn("make it whole", str(raised.exception))
        file.write_text("scene,status,as_published\npool,done,false\n")
        self.assertEqual(len(rebuild.missing_parts("equal_error")), 1)


ALL = """folder,hash,repeat,status,message,scene,trace,frame_ms.max,frame_ms.mean,frame_ms.median,frame_ms.stdev,photons.emitted,device,version
1,1,1,done,,pool,lines,9,8,8,1,100,a,1
2,2,1,done,,pool,march,9,8,8,1,200,a,1
3,3,1,done,,ball,lines,9,8,8,1,300,a,1
"""


class Parts(unittest.TestCase):
    """What --only leaves of a study's CSV."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.study = pathlib.Path(folder.name)
        self.target = self.study / "kept.csv"
        head, first, second, third = ALL.splitlines()
        self.part = "\n".join([head, second.replace(",200,a,1", ",222,a,2")]) + "\n"

    def rows(self):
        with self.target.open(newline="") as stream:
            return sorted((row["scene"], row["trace"], float(row.get("emitted") or row["photons.emitted"]), row["version"]) for row in csv.DictReader(stream))

    def test_has_new_rows_for_those_that_were_made_and_the_old_ones_of_all_others(self):
        for study in ("wyman2008_iterations", "wyman2008_times"):  # by table.py, and all of runs.csv
            self.target.unlink(missing_ok=True)
            (self.study / "runs.csv").write_text(ALL)
            rebuild.csv_of(self.study, study, self.target)
            self.assertEqual(len(self.rows()), 3, study)
            (self.study / "runs.csv").write_text(self.part)
            rebuild.csv_of(self.study, study, self.target, keep=True)
            self.assertEqual(self.rows(), [("ball", "lines", 300.0, "1"), ("pool", "lines", 100.0, "1"), ("pool", "march", 222.0, "2")], study)
            rebuild.csv_of(self.study, study, self.target, keep=True)
            self.assertEqual(len(self.rows()), 3, study)

    def test_is_not_mixed_where_rows_cannot_be_told_apart(self):
        for study in ("wyman2008_iterations", "wyman2008_times"):
            (self.study / "runs.csv").write_text(self.part.replace("trace", "tracer"))
            self.target.write_text("scene,trace,status,message,version\npool,lines,done,,1\n")
            with self.assertRaises(rebuild.Failure, msg=study) as raised:
                rebuild.csv_of(self.study, study, self.target, keep=True)
            self.assertIn("trace", str(raised.exception))

    def test_is_not_mixed_of_devices_whose_times_a_program_compares(self):
        (self.study / "runs.csv").write_text(ALL)
        rebuild.csv_of(self.study, "wyman2008_times", self.target)
        before = self.target.read_text()
        (self.study / "runs.csv").write_text(self.part.replace(",a,2", ",b,2"))
        with self.assertRaises(rebuild.Failure) as raised:
            rebuild.csv_of(self.study, "wyman2008_times", self.target, keep=True)
        self.assertIn("a and b", str(raised.exception))
        self.assertEqual(self.target.read_text(), before)


if __name__ == "__main__":
    unittest.main()
