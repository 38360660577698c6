# SPDX-License-Identifier: MIT
"""What a run depends on: its key changes with the sources that it was made by, and with no others."""

import json
import os
import pathlib
import sys
import tempfile
import time
import unittest
from unittest import mock

PLOTTING = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting"
sys.path.insert(0, str(PLOTTING))
import rebuild  # noqa: E402
import sources  # noqa: E402
import exact_rays  # noqa: E402
import maker  # noqa: E402
import noted  # noqa: E402
from sources import Present, Tree, note_recipes, recipes_of  # noqa: E402

FILES = {
    "framework/pipeline/frame.cpp": "int frame;",
    "framework/gui/window.cpp": "int window;",
    "framework/run/work.cpp": '#include "framework/judge/judge.h"',
    "framework/judge/judge.h": "int judge();",
    "shaders/framework/close.comp": "void main() {}",
    "techniques/trace/march.cpp": '#include "techniques/tracing/steps.h"\ncompute("trace/march.comp");',
    "techniques/trace/lines.cpp": 'compute("trace/lines.comp");',
    "techniques/tracing/steps.h": "int steps();",
    "techniques/tracing/steps.cpp": "int steps() { return 1; }",
    "techniques/layers/auto.cpp": "chosen();",
    "techniques/layers/peel.cpp": 'draw("layers/peel.frag");',
    "techniques/planar.cpp": "planar();",
    "shaders/trace/march.comp": '#include "include/ray.glsl"',
    "shaders/trace/lines.comp": "void main() {}",
    "shaders/layers/peel.frag": "void main() {}",
    "shaders/include/ray.glsl": "vec3 ray;",
    "experiments/scenes/pool.toml": "name = 'pool'",
    "experiments/scenes/ring.toml": "name = 'ring'",
}
REPORT = {"technique": "planar", "scene": {"name": "pool"}, "parameters": {"trace": "march", "layers": "auto", "trace.epsilon": "0.1"}}
OTHERS = {"framework/gui/window.cpp", "framework/judge/judge.h", "techniques/trace/lines.cpp", "shaders/trace/lines.comp", "experiments/scenes/ring.toml"}


class Sources(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in FILES.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def test_the_key_changes_with_what_the_run_was_made_by_and_nothing_else(self):
        key = Tree(self.root).key_of(REPORT)
        for name, text in FILES.items():
            (self.root / name).write_text(text + " ")
            self.assertEqual(Tree(self.root).key_of(REPORT) == key, name in OTHERS, name)
            (self.root / name).write_text(text)
        self.assertEqual(Tree(self.root).key_of(REPORT), key)

    def test_what_is_stale_is_told_and_made_anew_and_the_rest_stays(self):
        results = self.root / "study"
        for name, trace in (("a", "march"), ("b", "lines")):
            (results / name).mkdir(parents=True)
            (results / name / "report.json").write_text(json.dumps(REPORT | {"parameters": {"trace": trace}}))
        noted.note_sources(results, Tree(self.root), 0.0)
        self.assertEqual(noted.stale(results, Tree(self.root)), [])
        (self.root / "shaders/include/ray.glsl").write_text("vec4 ray;")
        self.assertEqual([folder.name for folder in noted.stale(results, Tree(self.root))], ["a"])
        # Runs that were there before keep their keys, and those without one have none.
        (results / "c").mkdir()
        (results / "c/report.json").write_text(json.dumps(REPORT))
        noted.note_sources(results, Tree(self.root), time.time() + 60.0)
        self.assertEqual([folder.name for folder in noted.stale(results, Tree(self.root))], ["a"])
        self.assertEqual(set(json.loads((results / sources.SOURCES).read_text())), {"a", "b"})
        noted.forget(noted.stale(results, Tree(self.root)), "are made anew")
        self.assertEqual({folder.name for folder in results.iterdir() if folder.is_dir()}, {"b", "c"})

    def test_disturbed_are_runs_made_since_then_of_scenes_that_stand_still_whose_frames_differ(self):
        results = self.root / "results"
        now = time.time()
        for name, frames, step, made in (("steady", {"mean": 10.0, "stdev": 1.0}, 0.0, now), ("disturbed", {"mean": 10.0, "stdev": 3.0}, 0.0, now),
                                         ("before", {"mean": 10.0, "stdev": 3.0}, 0.0, now - 100.0), ("moving", {"mean": 10.0, "stdev": 3.0}, 0.03, now),
                                         ("single", {"mean": 10.0, "stdev": None}, 0.0, now), ("untimed", {}, 0.0, now)):
            (results / name).mkdir(parents=True)
            report = results / name / "report.json"
            report.write_text(json.dumps(REPORT | {"frame_ms": frames, "time_step_s": step}))
            os.utime(report, (made, made))
        self.assertEqual([folder.name for folder in noted.disturbed(results, now - 50.0)], ["disturbed"])

    def test_a_studys_own_scene_is_of_its_file_and_of_what_that_extends_and_shows(self):
        own = {"experiments/maps/ring.toml": "extends = 'pool'\nname = 'mapped-ring'\nnormal_map = \"waves.png\"", "experiments/maps/waves.png": "waves"}
        for name, text in own.items():
            (self.root / name).parent.mkdir(exist_ok=True)
            (self.root / name).write_text(text)
        report = REPORT | {"scene": {"name": "mapped-ring"}}
        key = Tree(self.root).key_of(report)
        for name, text in {**own, "experiments/scenes/pool.toml": FILES["experiments/scenes/pool.toml"]}.items():
            (self.root / name).write_text(text + " ")
            self.assertNotEqual(Tree(self.root).key_of(report), key, name)
            (self.root / name).write_text(text)
        self.assertEqual(Tree(self.root).key_of(report), key)
        # Rows call it by its file, and the shipped one of that name is another.
        self.assertEqual(Tree(self.root).scene_names("ring.toml"), ["mapped-ring"])
        (self.root / "experiments/scenes/ring.toml").write_text("name = 'another'")
        self.assertEqual(Tree(self.root).key_of(report), key)

    def test_only_what_a_run_may_depend_on_makes_a_binary_old(self):
        for name in FILES:
            os.utime(self.root / name, (1000, 1000))
        for name, counts in (("framework/gui/window.cpp", False), ("shaders/trace/march.comp", False), ("techniques/trace/lines.cpp", True),
                             ("framework/pipeline/frame.cpp", True), ("techniques/tracing/steps.cpp", True)):
            os.utime(self.root / name, (2000, 2000))
            self.assertEqual(Tree(self.root).newest_source(), 2000 if counts else 1000, name)
            os.utime(self.root / name, (1000, 1000))
        # A program's file that a node includes is one that its key is of.
        (self.root / "techniques/trace/march.cpp").write_text('#include "framework/gui/window.h"')
        (self.root / "framework/gui/window.h").write_text("int shown();")
        for name in ("techniques/trace/march.cpp", "framework/gui/window.h"):
            os.utime(self.root / name, (1000, 1000))
        os.utime(self.root / "framework/gui/window.cpp", (2000, 2000))
        self.assertEqual(Tree(self.root).newest_source(), 2000)

    def test_the_newest_in_this_tree_is_of_all_that_keys_are_of(self):
        tree = Tree()
        stages = [folder.name for folder in (tree.root / "techniques").iterdir() if folder.is_dir()]
        named = tree.files_of({"technique": "caustic_map", "scene": {"name": "pool"}, "parameters": dict.fromkeys(stages, "auto")})
        folders = [tree.root / "techniques", *(tree.root / "framework" / name for name in sources.FRAMEWORK)]
        followed = tree.closure({file for folder in folders for file in folder.rglob("*") if file.suffix in sources.COMPILED})
        self.assertLess(100, len(named))
        self.assertEqual({file for file in named if file.suffix in sources.COMPILED} - followed, set())

    def test_rows_are_judged_by_recipes_where_there_are_no_reports(self):
        tree, file = Tree(self.root), self.root / "recipes.json"
        old = tree.key_of(REPORT)
        note_recipes(file, [tree.recipe_of(REPORT)])
        before = file.read_text()
        note_recipes(file, [tree.recipe_of(REPORT | {"scene": {"name": "ring"}})])  # the scene is none of it
        self.assertEqual(file.read_text(), before)
        present = Present(tree, recipes_of(file))
        self.assertTrue(present.has(old, "planar", "pool"))
        self.assertTrue(present.has(old, "", "pool"))  # a row that does not say its technique
        for key, technique, scene in ((old, "planar", "ring"), (old, "other", "pool"), ("", "planar", "pool"), ("0123456789ab", "planar", "pool")):
            self.assertFalse(present.has(key, technique, scene), (key, technique, scene))
        (self.root / "shaders/include/ray.glsl").write_text("vec4 ray;")
        changed = Present(Tree(self.root), recipes_of(file))
        self.assertFalse(changed.has(old, "planar", "pool"))
        self.assertTrue(changed.has(Tree(self.root).key_of(REPORT), "planar", "pool"))
        # Without its recipe nothing is said to be of the tree.
        self.assertFalse(Present(Tree(self.root), []).has(Tree(self.root).key_of(REPORT), "planar", "pool"))

    def test_what_is_no_run_of_a_technique_is_of_the_framework_its_scene_and_its_own_folders(self):
        key, of_nodes = Tree(self.root).key_without_technique("pool"), Tree(self.root).key_without_technique("pool", "techniques")
        self.assertNotEqual(key, of_nodes)
        for name, counts, of_nodes_too in (("techniques/planar.cpp", False, True), ("shaders/trace/lines.comp", False, True), ("framework/gui/window.cpp", False, False),
                                           ("framework/pipeline/frame.cpp", True, True), ("experiments/scenes/pool.toml", True, True)):
            (self.root / name).write_text(FILES[name] + " ")
            self.assertEqual(Tree(self.root).key_without_technique("pool") != key, counts, name)
            self.assertEqual(Tree(self.root).key_without_technique("pool", "techniques") != of_nodes, of_nodes_too, name)
            (self.root / name).write_text(FILES[name])

    def test_a_program_makes_rows_of_the_trees_keys_only_where_it_was_built_of_it_and_nothing_changes(self):
        built, elsewhere = self.root / "build/kaustik", pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "kaustik"
        built.parent.mkdir()
        for file in (built, elsewhere):
            file.write_text("")
        with mock.patch.dict(os.environ):
            os.environ.pop("KAUSTIK_ROOT", None)
            self.assertEqual(maker.Maker(elsewhere, self.root).sources("k"), "")
            own = maker.Maker(built, self.root)
            self.assertEqual(own.sources("k"), "k")
            (self.root / "shaders/trace/march.comp").write_text("void main() { return; }")
            self.assertEqual(own.sources("k"), "")
            self.assertEqual(maker.Maker(built, self.root).sources("k"), "k")  # shaders are read as they are
            os.environ["KAUSTIK_ROOT"] = str(elsewhere.parent)
            self.assertEqual(maker.Maker(built, self.root).sources("k"), "")
            os.environ.pop("KAUSTIK_ROOT")
            os.utime(built, (1000, 1000))
            self.assertEqual(maker.Maker(built, self.root).sources("k"), "")

    def test_what_a_call_made_that_was_stopped_has_a_key_unless_sources_have_changed(self):
        marker = self.root / "out/study.since.json"
        first = noted.begin_of(marker, Tree(self.root))
        self.assertEqual(noted.begin_of(marker, Tree(self.root)), first)
        (self.root / "shaders/include/ray.glsl").write_text("vec4 ray;")
        second = noted.begin_of(marker, Tree(self.root))
        self.assertGreater(second, first)
        self.assertEqual(noted.begin_of(marker, Tree(self.root)), second)
        (self.root / "framework/gui/window.cpp").write_text("int other;")  # of which no key is
        self.assertEqual(noted.begin_of(marker, Tree(self.root)), second)

    def test_in_this_tree_a_tracers_shader_is_among_them(self):
        files = {str(file) for file in Tree().files_of({"technique": "caustic_map", "scene": {"name": "pool"}, "parameters": {"trace": "secant"}})}
        for name in ("techniques/trace/secant.cpp", "shaders/trace/secant.comp", "shaders/include/views/view.glsl", "framework/pipeline/renderer.cpp"):
            self.assertTrue(any(file.endswith(name) for file in files), name)


class Slim(unittest.TestCase):
    def test_keeps_all_but_constants_folders_and_digits_that_say_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            runs, slim = pathlib.Path(folder) / "runs.csv", pathlib.Path(folder) / "slim.csv"
            runs.write_text('folder,hash,seed,error.formulas.white,balance,photons,version,device\n'
                            'a0,a0,12345678901234567890,1,2.800000000012345e-08,87041893.0,0.1.0,"a, b"\n')
            rebuild.write_slim(runs, slim)
            self.assertEqual(slim.read_text(), 'seed,balance,photons,version,device\n'
                             '12345678901234567890,2.8e-08,87041893.0,0.1.0,"a, b"\n')
            rebuild.write_slim(slim, slim)
            self.assertIn("2.8e-08", slim.read_text())

    def test_rows_have_their_keys_last_and_those_of_others_keep_theirs(self):
        with tempfile.TemporaryDirectory() as folder:
            runs, slim = pathlib.Path(folder) / "runs.csv", pathlib.Path(folder) / "slim.csv"
            head = "folder,hash,repeat,status,message,scene,frame_ms.max,device,version\n"
            slim.write_text("repeat,status,message,scene,frame_ms.max,device,version\n1,done,,ring,9,a,1\n1,done,,pool,9,a,1\n")
            runs.write_text(head + "a0,a0,1,done,,pool,8,a,2\nb0,b0,1,done,,tree,8,a,2\n")
            (pathlib.Path(folder) / sources.SOURCES).write_text('{"a0": "0123456789ab"}')
            rebuild.write_slim(runs, slim, keep=True)
            rows = "repeat,status,message,scene,frame_ms.max,device,version,sources\n1,done,,pool,8,a,2,0123456789ab\n1,done,,tree,8,a,2,\n1,done,,ring,9,a,1,\n"
            self.assertEqual(slim.read_text(), rows)
            (pathlib.Path(folder) / sources.SOURCES).write_text('{"c0": "ba9876543210"}')
            runs.write_text(head + "c0,c0,1,done,,tree,7,a,3\n")
            rebuild.write_slim(runs, slim, keep=True)
            self.assertEqual(slim.read_text().splitlines()[1:], ["1,done,,tree,7,a,3,ba9876543210", "1,done,,pool,8,a,2,0123456789ab", "1,done,,ring,9,a,1,"])

    def test_that_failed_and_do_not_say_all_settings_give_way_to_the_same_run(self):
        def row(status: str, scene: str, photons: str) -> dict:
            return {"status": status, "scene": scene, "photons": photons}

        kept = [row("failed", "ring", ""), row("failed", "pool", ""), row("done", "ring", ""), row("failed", "ring", "8")]
        self.assertEqual(rebuild.rows_of_others(kept, [row("failed", "ring", "4")], ["scene", "photons"]), kept[1:])

    def test_of_reports_too_rows_have_their_keys(self):
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder) / "a0"
            run.mkdir()
            (run / "report.json").write_text(json.dumps(
                {"passes": [], "device": {"renderer": "r", "cpu": "c", "threads": 2}, "size": [4, 3], "version": "1", "frame_ms": {"median": 1.0}, "scene": {"name": "pool"},
                 "timing": {"date": "2026-01-01"}, "parameters": {"trace": "bvh", "view": "bvh", "shadow": "bvh", "emit.photons": "1x1"}}))
            self.assertEqual(exact_rays.slim(run / "report.json")["sources"], "")
            (run.parent / sources.SOURCES).write_text('{"a0": "0123456789ab"}')
            self.assertEqual(exact_rays.slim(run / "report.json")["sources"], "0123456789ab")

    def test_leaves_errors_of_the_view_out_where_no_table_asks_for_them(self):
        with tempfile.TemporaryDirectory() as folder:
            runs, slim = pathlib.Path(folder) / "runs.csv", pathlib.Path(folder) / "slim.csv"
            runs.write_text("seed,error.view.lost,error.caustic_irradiance.rmse\n1,0.5,0.25\n")
            rebuild.write_slim(runs, slim, of_the_view=False)
            self.assertEqual(slim.read_text(), "seed,error.caustic_irradiance.rmse\n1,0.25\n")
            rebuild.write_slim(runs, slim)
            self.assertIn("error.view.lost", slim.read_text())


if __name__ == "__main__":
    unittest.main()
