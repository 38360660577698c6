# SPDX-License-Identifier: MIT
"""What a run depends on: its key changes with the sources that it was made by, and with no others."""

import json
import pathlib
import sys
import tempfile
import time
import unittest

PLOTTING = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting"
sys.path.insert(0, str(PLOTTING))
import rebuild  # noqa: E402
from sources import Tree  # noqa: E402

FILES = {
    "framework/pipeline/frame.cpp": "int frame;",
    "framework/gui/window.cpp": "int window;",
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
OTHERS = {"framework/gui/window.cpp", "techniques/trace/lines.cpp", "shaders/trace/lines.comp", "experiments/scenes/ring.toml"}


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
        rebuild.note_sources(results, Tree(self.root), 0.0)
        self.assertEqual(rebuild.stale(results, Tree(self.root)), [])
        (self.root / "shaders/include/ray.glsl").write_text("vec4 ray;")
        self.assertEqual([folder.name for folder in rebuild.stale(results, Tree(self.root))], ["a"])
        # Runs that were there before keep their keys, and those without one have none.
        (results / "c").mkdir()
        (results / "c/report.json").write_text(json.dumps(REPORT))
        rebuild.note_sources(results, Tree(self.root), time.time() + 60.0)
        self.assertEqual([folder.name for folder in rebuild.stale(results, Tree(self.root))], ["a"])
        self.assertEqual(set(json.loads((results / rebuild.SOURCES).read_text())), {"a", "b"})
        rebuild.forget_stale(results, Tree(self.root))
        self.assertEqual({folder.name for folder in results.iterdir() if folder.is_dir()}, {"b", "c"})

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
