# SPDX-License-Identifier: MIT
"""What programs without times say of their rows, census.py, certified.py and judge_povray.py: when and of which sources; rows of before stay."""

import argparse
import contextlib
import csv
import importlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "experiments/plotting"), str(ROOT / "experiments")]

import census  # noqa: E402
import judge_povray  # noqa: E402
import maker  # noqa: E402
import sources  # noqa: E402

CENSUS = """#!/usr/bin/env python3
import pathlib, sys
if sys.argv[1] == "list":
    print('[{"name": "pool"}, {"name": "ring"}]')
else:
    out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
    out.mkdir(parents=True)
    (out / "census.json").write_text("{}")
    for name in ("classes", "techniques"):
        (out / f"{name}.csv").write_text(f"scene,emitted,device,kind,version\\n{sys.argv[2]},1,d,new,2\\n")
"""


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(mock.patch.object(sources.Tree, "has_built", lambda *_: True))
        self.enterContext(mock.patch.object(sources.Tree, "key_without_technique", lambda _, scene, *folders: f"{pathlib.Path(scene).stem} {self.key}"))
        self.key = "a"

    def rows(self, name: str) -> list[dict]:
        with (self.folder / name).open(newline="") as stream:
            return list(csv.DictReader(stream))

    def call(self, program, *arguments) -> None:
        with mock.patch.object(sys, "argv", ["program", *map(str, arguments)]), contextlib.redirect_stdout(io.StringIO()):
            program.main()


class Census(Folder):
    def setUp(self):
        super().setUp()
        self.kaustik = self.folder / "kaustik"
        self.kaustik.write_text(CENSUS)
        self.kaustik.chmod(0o755)
        for name in ("classes", "techniques"):
            (self.folder / f"{name}.csv").write_text("scene,kind,version\npool,old,1\npool,older,1\nring,old,1\n")

    def census(self, *arguments) -> list[tuple]:
        self.call(census, "--kaustik", self.kaustik, "--out", self.folder, "--runs", self.folder / "runs", *arguments)
        self.assertEqual(self.rows("classes.csv"), self.rows("techniques.csv"))
        return [(row["scene"], row["kind"], bool(row["date"]), row["sources"]) for row in self.rows("classes.csv")]

    def test_rows_of_other_scenes_stay_and_new_ones_say_what_they_are_of(self):
        old = [("pool", "old", False, ""), ("pool", "older", False, "")]
        self.assertEqual(self.census("ring"), [*old, ("ring", "new", True, "ring a")])
        self.assertEqual(list(self.rows("classes.csv")[0]), ["scene", "kind", "version", "date", "sources"])
        self.assertEqual(self.census(), [("pool", "new", True, "pool a"), ("ring", "new", True, "ring a")])

    def test_scenes_of_other_sources_are_made_again_where_that_is_asked(self):
        self.census("ring")
        self.key = "b"
        self.assertEqual(self.census("ring")[-1][-1], "ring a")
        self.assertEqual(self.census("--anew", "ring")[-1][-1], "ring b")
        (self.folder / "runs/ring" / census.MADE).unlink()  # as of a version that noted nothing
        self.assertEqual(self.census("ring")[-1], ("ring", "new", False, ""))

    def test_versions_that_say_different_things_are_not_joined(self):
        (self.folder / "classes.csv").write_text("scene,another,version\npool,old,1\n")
        with self.assertRaises(SystemExit) as raised:
            self.census("ring")
        self.assertIn("different versions", str(raised.exception))


class Judge(Folder):
    def test_rows_say_the_day_and_the_sources_of_picture_and_verdict(self):
        (self.folder / "judge").mkdir()
        (self.folder / "judge/classes.csv").write_text("scene,class,version\nring,T,1\npool,T,1\n")
        (self.folder / "judge/scenes.csv").write_text("scene,photons,version\nring,5,1\npool,5,1\n")
        verdict = {"classes": [{"name": "R", "flux_share": 1.0, "c": 1.0, "c_stderr": None, "verdict": "there"}], "exposure": 1.0, "exposure_stderr": 0.1, "blur_px": 0.0,
                   "residual": {"unexplained_share": 0.0, "significant_pixels": 1, "pixels": 4}, "findings": []}
        called = []

        def run(command, **_):
            called.append(command[1])
            if command[1] == "export":
                pathlib.Path(command[command.index("--out") + 1]).mkdir(parents=True, exist_ok=True)
            if command[1] == "scene.ini":
                (self.folder / "work/ring/theirs.exr").write_text("")
            said = {"--version": "kaustik 2", "shoot.ini": "Surface photons stored: 7", "judge": json.dumps(verdict)}.get(command[1], "")
            return argparse.Namespace(returncode=0, stdout=said, stderr="")

        with mock.patch("subprocess.run", run):
            for again, of in ((False, "ring a"), (True, "ring a"), (True, "")):
                called.clear()
                self.call(judge_povray, "--out", self.folder / "judge", "--work", self.folder / "work", "ring")
                self.assertEqual("export" in called, not again)
                for name, settings in (("judge/classes.csv", "class"), ("judge/scenes.csv", "photons")):
                    new, old = self.rows(name)
                    self.assertEqual((new["scene"], new["version"], len(new["date"]), new["sources"]), ("ring", "2", 20, of))
                    self.assertEqual((old["scene"], old["version"], old["date"], old["sources"]), ("pool", "1", "", ""))
                    self.assertIn(old[settings], ("T", "5"))
                # Then the picture is of an export that is older than the judge.
                self.key = "b" if again else "a"


class Certified(Folder):
    def test_rows_say_the_day_and_the_sources_of_all_their_files(self):
        with mock.patch.dict(sys.modules, {"OpenImageIO": mock.Mock()}):
            certified = importlib.import_module("certified")
        (self.folder / "certified.csv").write_text("scene,interactions,status,version\nring,1,done,1\nflat-water,1,done,1\n")

        def run(command, **_):
            pathlib.Path(command[command.index("--out") + 1]).with_suffix(".json").write_text("{}")

        class Process:
            def __init__(self, command, **_):
                run(command)

            def wait(self, _):
                pass

        row_of = lambda name, certificate, reference: {"scene": name, "interactions": 1, "status": "done", "version": "2", "undecided": 1 / 3,  # noqa: E731
                                                       **maker.made(certified.note_of(certificate), certified.note_of(reference))}
        with mock.patch("subprocess.run", run), mock.patch("subprocess.Popen", Process), mock.patch.object(certified, "row_of", row_of):
            def certify(*arguments):
                self.call(certified, "--out", self.folder, "--work", self.folder / "work", "--cases", "ring", *arguments)
                return [(row["scene"], row["version"], bool(row["date"]), row["sources"]) for row in self.rows("certified.csv")]

            old = ("flat-water", "1", False, "")
            self.assertEqual(certify(), [old, ("ring", "2", True, "ring a")])
            self.key = "b"
            self.assertEqual(certify(), [old, ("ring", "2", True, "ring a")])
            (self.folder / "work/ring-1.reference.json").unlink()  # made again, next to a certificate of before
            self.assertEqual(certify(), [old, ("ring", "2", True, "")])
            self.assertEqual(certify("--anew"), [old, ("ring", "2", True, "ring b")])
            self.assertEqual(self.rows("certified.csv")[1]["undecided"], "0.3333333")


if __name__ == "__main__":
    unittest.main()
