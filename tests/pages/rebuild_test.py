# SPDX-License-Identifier: MIT
"""What rebuild.py keeps of a table that its study's CSV is not enough for."""

import contextlib
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments/plotting"))

import maker  # noqa: E402
import noted  # noqa: E402
import rebuild  # noqa: E402
import sources  # noqa: E402
import result_steps as steps  # noqa: E402
import studies  # noqa: E402
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

    def test_is_each_run_without_a_row_of_the_trees_sources_where_that_is_asked(self):
        (self.root / "results/refined/runs.csv").write_text("scene,driver.dense.refine,as_published,sources\npool,1,true,new\npool,3,true,old\nring,1,true,\nring,3,true,new\n")
        present = mock.Mock(has=lambda key, technique, scene: key == "new" and scene in ("pool", "ring"))
        self.assertEqual(rebuild.missing_parts("refined"), [])
        self.assertEqual([part[1::2][:2] for part in rebuild.missing_parts("refined", present)], [["scene=pool", "driver.dense.refine=3"], ["scene=ring", "driver.dense.refine=1"]])
        # None of them is: all runs are made.
        self.assertEqual(rebuild.missing_parts("refined", mock.Mock(has=lambda *_: False)), [[]])

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


KAUSTIK = """#!/usr/bin/env python3
import json, pathlib, sys
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
rows = ["folder,hash,repeat,status,message,scene,frame_ms.max,frame_ms.median,device,version,date"]
for scene in ("pool", "ring"):
    (out / scene).mkdir(parents=True, exist_ok=True)
    if not (out / scene / "report.json").is_file():
        (out / scene / "report.json").write_text(json.dumps({"technique": "planar", "scene": {"name": scene}, "parameters": {"trace": "plane", "trace.epsilon": "1"}}))
    rows.append(f"{scene},{scene},1,done,,{scene},9,8,d,1,2026-12-01")
(out / "runs.csv").write_text("\\n".join(rows) + "\\n")
"""


class Whole(unittest.TestCase):
    """A study, from its runs to rows that say of which sources they are, by a program that only pretends."""

    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in {"build/kaustik": KAUSTIK, "experiments/refined.toml": '[base]\ntechnique = "planar"\n[permute]\nscene = ["pool", "ring"]\n', "results/x": "",
                           "techniques/trace/plane.cpp": "plane();", "experiments/scenes/pool.toml": "name = 'pool'"}.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)
        (self.root / "build/kaustik").chmod(0o755)
        os.utime(self.root / "build/kaustik")  # newer than all sources
        call = rebuild.call
        self.enterContext(mock.patch.object(rebuild, "ROOT", self.root))
        self.enterContext(mock.patch.object(rebuild, "Tree", lambda: sources.Tree(self.root)))
        self.enterContext(mock.patch.object(rebuild, "call", lambda *command: None if command[-1] == rebuild.PLOTTING / "pages.py" else call(*command)))
        self.enterContext(contextlib.redirect_stdout(io.StringIO()))

    def rebuild(self, anew: bool = False) -> dict[str, str]:
        self.assertEqual(rebuild.rebuild(self.root / "build/kaustik", self.root / "out", None, anew, [], ["refined"], []), [])
        return {row["scene"]: row["sources"] for row in maker.rows_in(self.root / "results/refined/runs.csv")}

    def judged(self) -> list[int]:
        present = sources.Present(sources.Tree(self.root), sources.recipes_of(self.root / "results" / sources.RECIPES))
        rows = maker.rows_in(self.root / "results/refined/runs.csv")
        return list(noted.judged({"base": {"technique": "planar"}}, rows, present).values())

    def test_has_rows_of_the_tree_that_a_clone_knows_as_such_until_sources_change(self):
        first = self.rebuild()
        self.assertEqual({len(key) for key in first.values()}, {12})
        shutil.rmtree(self.root / "out")
        self.assertEqual(self.judged(), [2, 0, 0])
        (self.root / "experiments/scenes/pool.toml").write_text("name = 'pool' ")
        self.assertEqual(self.judged(), [1, 1, 0])
        (self.root / "techniques/trace/plane.cpp").write_text("planes();")
        self.assertEqual(self.judged(), [0, 2, 0])
        os.utime(self.root / "build/kaustik")
        self.rebuild(anew=True)
        self.assertEqual(self.judged(), [2, 0, 0])

    def test_makes_runs_once_more_that_were_disturbed(self):
        # The second frame is slow the first two times that a run is made; it is not made a third time.
        disturbed = KAUSTIK.replace('"trace.epsilon": "1"}}', '"trace.epsilon": "1"}, "frame_ms": {"mean": 2.0, "stdev": spread(scene)}}').replace(
            'rows =', 'def spread(scene):\n    log = out.parent / f"{scene}.log"\n    made = log.read_text() if log.is_file() else ""\n'
            '    log.write_text(made + "x")\n    return 1.0 if scene == "ring" and len(made) < TIMES else 0.1\nrows =', 1)
        for times, made in ((0, 1), (1, 2), (2, 2)):
            (self.root / "build/kaustik").write_text(disturbed.replace("TIMES", str(times)))
            shutil.rmtree(self.root / "out", ignore_errors=True)
            self.assertEqual(set(self.rebuild()), {"pool", "ring"})
            self.assertEqual((self.root / "out/ring.log").read_text(), made * "x")
            self.assertEqual((self.root / "out/pool.log").read_text(), "x")

    def test_that_is_interrupted_takes_no_rows_place(self):
        self.rebuild()
        before = (self.root / "results/refined/runs.csv").read_text()
        stopped = KAUSTIK.replace('("pool", "ring")', '("pool",)') + 'sys.exit("kaustik: Interrupted; 1 of 2 runs are finished.")\n'
        (self.root / "build/kaustik").write_text(stopped)
        shutil.rmtree(self.root / "out")
        failures = rebuild.rebuild(self.root / "build/kaustik", self.root / "out", None, False, [], ["refined", "lamps"], [])
        self.assertEqual(len(failures), 1)  # nothing else is begun
        self.assertIn("Interrupted", failures[0])
        self.assertEqual((self.root / "results/refined/runs.csv").read_text(), before)
        self.assertEqual(len(json.loads((self.root / "out/refined" / sources.SOURCES).read_text())), 1)

    def test_runs_that_were_there_before_have_no_key(self):
        out = self.root / "out/refined"
        subprocess.run([self.root / "build/kaustik", "--out", out], check=True)
        os.utime(out / "ring/report.json", (1000, 1000))
        shutil.rmtree(out / "pool")
        self.assertEqual({scene: bool(key) for scene, key in self.rebuild().items()}, {"pool": True, "ring": False})
        self.assertEqual(self.judged(), [1, 0, 1])

    def test_runs_of_a_program_of_another_tree_have_no_key(self):
        with mock.patch.object(sources.Tree, "has_built", lambda *_: False):
            self.assertEqual(set(self.rebuild().values()), {""})
        self.assertFalse((self.root / "results" / sources.RECIPES).exists())


class Judged(unittest.TestCase):
    """What --stale says of rows."""

    def test_are_of_the_tree_of_others_or_not_known_by_what_the_row_or_else_the_study_says(self):
        asked = []

        def has(key, technique, scene):
            asked.append((key, technique, scene))
            return key == "new"

        rows = [{"scene": "pool", "sources": "new"}, {"technique": "planar", "sources": "old"}, {"sources": ""}, {}]
        self.assertEqual(list(noted.judged({"base": {"technique": "march", "scene": "ring"}}, rows, mock.Mock(has=has)).values()), [1, 1, 2])
        self.assertEqual(asked, [("new", "march", "pool"), ("old", "planar", "ring")])


class Steps(unittest.TestCase):
    """What is in results/ of no study."""

    def test_name_no_study_and_programs_that_take_their_arguments(self):
        self.assertEqual(set(rebuild.STEPS) & {*rebuild.STUDIES, *rebuild.DEVICE}, set())
        for name, step in rebuild.STEPS.items():
            self.assertEqual(steps.wrong_with(step), [], name)
            self.assertTrue(step.commands or step.elsewhere, name)

    def test_are_found_wrong_where_a_program_or_an_option_is_not_there(self):
        self.assertEqual(steps.wrong_with(steps.Step("", (("experiments/nowhere.py",),))), ["there is no 'experiments/nowhere.py'"])
        wrong = steps.wrong_with(steps.Step("", (("experiments/census.py", "--kaustik", steps.KAUSTIK, "--no-such", "1"),), takes_anew=True))
        self.assertEqual(wrong, ["'experiments/census.py' has no option --no-such"])
        self.assertEqual(steps.wrong_with(steps.Step("", (("experiments/costs.sh", "--scenes", "x"),), takes_anew=True)), ["'experiments/costs.sh' has no option --anew"])

    def test_all_that_makes_files_of_no_study_is_one(self):
        called = {pathlib.Path(program).name for step in rebuild.STEPS.values() for program, *_ in step.commands}
        # What a study's folder is needed for.
        called |= set(re.findall(r'"(\w+\.py)"', (ROOT / "experiments/plotting/rebuild.py").read_text()))
        # Of two builds, or of devices that are elsewhere.
        apart = {name for name in studies.DERIVED.values() if name == "two_builds.py" or name.endswith(".toml")}
        self.assertEqual({pathlib.Path(name).name for name in {*studies.DERIVED.values()} - apart} - called, set())

    def test_are_called_with_our_programs_in_reach_and_what_they_left_is_copied(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(steps, "ROOT", pathlib.Path(folder)):
            root = pathlib.Path(folder)
            for made in ("experiments", "results"):
                (root / made).mkdir()
            (root / "experiments/program.py").write_text("import os, pathlib, sys\npathlib.Path('left.csv').write_text(' '.join(sys.argv[1:]) + os.environ['PATH'].split(':')[0])\n")
            step = steps.Step("kept.csv", (("experiments/program.py", steps.KAUSTIK),), copies=("left.csv", "kept.csv"), takes_anew=True)
            self.assertEqual(steps.make(step, pathlib.Path("/b/bin/kaustik"), anew=False), "")
            self.assertEqual((root / "results/kept.csv").read_text(), "/b/bin/kaustik/b/bin")
            self.assertEqual(steps.make(step, pathlib.Path("/b/bin/kaustik"), anew=True), "")
            self.assertEqual((root / "results/kept.csv").read_text(), "/b/bin/kaustik --anew/b/bin")
            (root / "experiments/program.py").write_text("import sys\nsys.exit('no luck')\n")
            self.assertIn("ended with 1: no luck", steps.make(step, pathlib.Path("/b/bin/kaustik"), anew=False))

    def test_say_what_they_need_that_is_not_here(self):
        with mock.patch("shutil.which", lambda _: None):
            self.assertIn("POV-Ray", steps.missing_for(rebuild.STEPS["judge"], True))
        with mock.patch("shutil.which", lambda name: name):
            self.assertEqual(steps.missing_for(rebuild.STEPS["judge"], False), "")
            self.assertIn("name it", steps.missing_for(rebuild.STEPS["second_driver"], False))
            self.assertEqual(steps.missing_for(rebuild.STEPS["second_driver"], True), "")
        self.assertIn("GPU", steps.missing_for(rebuild.STEPS["gpu"], True))


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
