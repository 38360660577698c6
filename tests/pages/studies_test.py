# SPDX-License-Identifier: MIT
"""What results/studies.md says of a study: how many runs it has, which are missing, and where numbers lead."""

import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments/plotting"))

import studies  # noqa: E402
import study_plan  # noqa: E402

STUDY = """
[base]
technique = "march"
size = "8x8"

[[permute]]
scene = ["pool", "own/ball.toml"]
"trace.epsilon" = { from = 0.001, to = 0.1, factor = 10 }

[[permute]]
scene = ["pool"]
technique = ["lines", "march"]
as_published = [true]
"""
ROWS = tuple({"scene": scene, "technique": "march", "trace.epsilon": epsilon, "as_published": published} for scene, epsilon, published in (
    ("pool", "0.001", "false"), ("pool", "0.01", "false"), ("ball.toml", "0.001", "false"), ("ball.toml", "0.1", "false"), ("pool", "0.3", "true")))


class Studies(unittest.TestCase):
    def test_have_the_runs_that_their_files_name(self):
        runs = study_plan.planned(tomllib.loads(STUDY))
        self.assertEqual(len(runs), 8)
        self.assertEqual([run.get("trace.epsilon") for run in runs if run["scene"] == "pool" and "trace.epsilon" in run], [0.001, 0.01, 0.1])
        self.assertEqual(study_plan.values_of({"from": 1, "to": 2, "steps": 3}), [1, 1.5, 2])
        self.assertEqual(study_plan.values_of({"from": 1, "to": 7, "step": 3}), [1, 4, 7])

    def test_of_the_tree_have_as_many_as_their_files_of_results_where_all_are_done(self):
        for study, file in (("lamps", "lamps/runs.csv"), ("defaults", "defaults.csv"), ("dispersion", "dispersion/runs.csv")):
            count, missing = study_plan.missing_of(tomllib.loads((ROOT / f"experiments/{study}.toml").read_text()), rows := studies.runs(ROOT / "results" / file))
            self.assertEqual((count, missing), (len(rows), []), study)

    def test_say_of_which_days_the_rows_are_whose_sources_are_known(self):
        def rows(**days: int):
            return tuple({"sources": f"{at // 2}{day}", "date": f"2026-01-{day.removeprefix('of')}T10:00:00Z"} for day, count in days.items() for at in range(count))

        self.assertEqual(studies.sources_of(({"scene": "pool"}, {"sources": "", "date": ""})), "sources of no row are known")
        self.assertEqual(studies.sources_of(rows(of02=3)), "sources of all rows are known: 3 of 2026-01-02 (2 keys)")
        self.assertEqual(studies.sources_of((*rows(of01=1, of04=2, of02=3, of09=1, of05=4), {"sources": ""})),
                         "sources of 11 rows are known: 1 of 2026-01-09 (1 key), 4 of 2026-01-05 (2 keys), 2 of 2026-01-04 (1 key), 4 of 2 other days; of 1 they are not")

    def test_say_which_runs_no_row_is_of(self):
        count, missing = study_plan.missing_of(tomllib.loads(STUDY), ROWS)
        self.assertEqual(count, 8)
        self.assertEqual(sorted((run["scene"], run.get("trace.epsilon", 0), run["technique"]) for run in missing),
                         [("own/ball.toml", 0.01, "march"), ("pool", 0, "lines"), ("pool", 0.1, "march")])

    def test_are_where_numbers_lead(self):
        with tempfile.TemporaryDirectory() as folder:
            results = pathlib.Path(folder)
            (results / "some_runs.csv").write_text("scene,relMSE,command,version\npool,0.5,kaustik run pool,1 (abc)\n")
            number = "<!-- = some_runs.csv: relMSE .1f; scene=pool -->0<!-- / -->"
            (results / "page.md").write_text(f"It is {number}, and [{number}](page.md).\n")
            (results / "studies.md").write_text("")

            def pages(*options):
                return subprocess.run([sys.executable, "-B", ROOT / "experiments/plotting/pages.py", "--results", results, *options], capture_output=True, text=True)

            self.assertEqual(pages().returncode, 0)
            text = (results / "page.md").read_text()
            self.assertIn("-->[0.5](studies.md#some_runscsv)<!-- / -->, and [<!--", text)
            self.assertIn("-->0.5<!-- / -->](page.md)", text)
            state = (results / "studies.md").read_text()
            self.assertIn("### some_runs.csv\n\n- [`some_runs.csv`](some_runs.csv), 1 row, by `kaustik run pool`\n- version 1 (abc); of a day that was not kept\n"
                          "- shown on [page.md](page.md)\n", state)
            self.assertEqual(pages("--check").returncode, 0)
            (results / "studies.md").write_text(state.replace("1 row", "2 rows"))
            self.assertEqual(pages("--check").returncode, 1)


if __name__ == "__main__":
    unittest.main()
