# SPDX-License-Identifier: MIT
"""The pages of results/: what stands in them is what their CSVs say, and pages.py sees where it is not."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "experiments/plotting/pages.py"

RUNS = """scene,photons,status,relMSE,hits right,version,device,date,other_processors
pool,256,done,0.00012,0.5,1,a,2026-11-24T10:00:00Z,0.01
pool,1024,done,0.000034,0.98765,1,a,2026-11-25T10:00:00Z,1.26
ball,256,failed,,,1,a,,
ball,1024,done,12345,,2,a,2026-11-24T10:00:00Z,
"""
PAGE = """Before.

<!-- table
file = "runs.csv"
rows = ["scene", "photons"]
cells = ["relMSE .2g; hits right .1%"]
-->
<!-- end -->

It is <!-- = runs.csv: relMSE .1g; scene=pool, photons=256 -->0<!-- / -->, no more.
"""


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        (self.results / "runs.csv").write_text(RUNS)

    def pages(self, *options, page=None):
        if page is not None:
            (self.results / "page.md").write_text(page)
        return subprocess.run([sys.executable, "-B", PAGES, "--results", self.results, *options],
                              capture_output=True, text=True)

    def test_of_the_project_are_what_their_files_say(self):
        done = subprocess.run([sys.executable, "-B", PAGES, "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_are_made_of_three_megabytes_at_most(self):
        files = [file for file in (ROOT / "results").rglob("*.csv") if "runs" not in file.relative_to(ROOT / "results").parts[:-1]]
        self.assertLess(sum(file.stat().st_size for file in files), 3e6)

    def test_are_written_in_order_and_leave_prose_alone(self):
        self.assertEqual(self.pages(page=PAGE).returncode, 0)
        text = (self.results / "page.md").read_text()
        self.assertIn("\n".join(["| scene | photons | relMSE; hits right |", "| --- | --- | --- |",
                                 "| `ball` | 256 | failed |", "| `ball` | 1024 | 1.2e+4; – |",
                                 "| `pool` | 256 | 0.00012; 50.0 % |", "| `pool` | 1024 | 3.4e-5; 98.8 % |"]), text)
        self.assertIn("*[`runs.csv`](runs.csv), 4 rows; version 1, a; version 2, a; 2026-11-24 to 2026-11-25; other work kept up to 1.3 "
                      "processors busy.*", text)
        self.assertIn("-->0.0001<!-- / -->, no more.", text)
        self.assertTrue(text.startswith("Before.\n"))
        self.assertEqual(self.pages("--check").returncode, 0)

    def test_have_a_row_for_each_machine(self):
        (self.results / "other.csv").write_text(RUNS.replace(",a,", ",b,").replace("0.00012", "0.00013"))
        page = PAGE.replace('"runs.csv"\n', '["runs.csv", "other.csv"]\n')
        self.assertEqual(self.pages(page=page).returncode, 0)
        text = (self.results / "page.md").read_text()
        self.assertIn("\n".join(["| scene | photons | on device | relMSE; hits right |", "| --- | --- | --- | --- |",
                                 "| `ball` | 256 | 1 | failed |", "| `ball` | 256 | 2 | failed |"]), text)
        self.assertIn("| `pool` | 256 | 1 | 0.00012; 50.0 % |\n| `pool` | 256 | 2 | 0.00013; 50.0 % |", text)
        self.assertIn("*[`runs.csv`](runs.csv), [`other.csv`](other.csv), 8 rows; version 1, device 1: a; version 1, device 2: b; version 2, device 1: a; "
                      "version 2, device 2: b; ", text)

    def test_that_differ_are_named_with_what_stands_there(self):
        self.pages(page=PAGE)
        page = self.results / "page.md"
        page.write_text(page.read_text().replace("3.4e-5", "3.5e-5"))
        done = self.pages("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("page.md:14: stands there: | `pool` | 1024 | 3.5e-5; 98.8 % |", done.stderr)
        self.assertIn("3.5e-5", page.read_text())

    def test_that_ask_for_what_is_not_there_are_refused_with_the_line(self):
        for wanted, says in [("relMSE .2g;", "page.md:3: there is no column 'error'"),
                             ('"runs.csv"\nrows', "page.md:3: there is no '"),
                             ('["scene", "photons"]', "page.md:3: 2 runs for one cell"),
                             ("photons=256", "page.md:"),
                             ("<!-- end -->", "is not ended")]:
            other = {"relMSE .2g;": "error .2g;", '"runs.csv"\nrows': '"other.csv"\nrows',
                     '["scene", "photons"]': '["scene"]', "photons=256": "photon=256", "<!-- end -->": ""}[wanted]
            done = self.pages(page=PAGE.replace(wanted, other))
            self.assertEqual(done.returncode, 2, wanted)
            self.assertIn(says, done.stderr)

    def test_with_a_table_of_numbers_outside_of_comments_are_refused(self):
        for cell, is_refused in [("0.12", True), ("1,024 of them", True), ("−3·10⁻⁴", True), ("[0.38](runs.csv)", True), ("none", False), ("`layers=4`", False),
                                 ("1024²", False), ("an H100", False), ("[Table 1 of it](page.md#runs)", False),
                                 ("<!-- = runs.csv: relMSE .1g; scene=pool, photons=256 -->0.0001<!-- / -->", False)]:
            page = f"# Runs\n\n| what | figure |\n| --- | --- |\n| a | {cell} |\n"
            done = self.pages("--check", page=page)
            self.assertEqual(done.returncode, 2 if is_refused else 0, f"{cell}: {done.stderr}")
            if is_refused:
                self.assertIn("page.md:5: a table outside of comments says '", done.stderr)
                # What is quoted may be typed, in the columns that say so.
                self.assertEqual(self.pages("--check", page=page.replace("| what", "<!-- typed: figure -->\n| what")).returncode, 0, cell)
        self.assertEqual(self.pages("--check", page="<!-- typed: nothing -->\n| what |\n| --- |\n| a |\n").returncode, 2)
        self.assertEqual(self.pages("--check", page="```\n| what |\n| --- |\n| 3 |\n```\n").returncode, 0)

    def test_whose_numbers_in_sentences_are_others_in_the_csv_fail(self):
        self.pages(page=PAGE)
        (self.results / "runs.csv").write_text(RUNS.replace("0.00012", "0.00034"))
        done = self.pages("--check")
        self.assertEqual(done.returncode, 1)
        text = (self.results / "page.md").read_text()
        self.assertIn("-->0.0001<!-- / -->", text)
        self.pages()
        self.assertIn("-->0.0003<!-- / -->", (self.results / "page.md").read_text())

    def test_with_measured_numbers_typed_in_sentences_are_refused(self):
        for sentence, number in [("It takes 38 ms.", "38"), ("It takes 43 and 60 ms.", "43 and 60"), ("Lost are\n3 % of it.", "3"), ("It is 1.5 times as fast.", "1.5"), ("It has relMSE\n0.0055.", "0.0055"),
                                 ("Hits are right 0.72 of the time.", "0.72"), ("An energy of 1 is right.", "1"), ("Equal to 6·10⁻⁸ of it.", "6·10⁻⁸"), ("A [share of 0.38](page.md).", "0.38"),
                                 ("- **12 s** in all", "12"), ("![A picture in 5 ms](page.md)", "5"), ("Right are 3 of 16 scenes.", "3 of 16"), ("It stores 66 thousand.", "66 thousand"), ("It stores 1,024.", "1,024"), ("A ` alone.\n\nIt takes 7 ms.\n\nAnother ` alone.", "7"),
                                 ("`pool` takes 3 to\n<!-- = runs.csv: photons .0f; scene=pool, relMSE=0.00012 -->256<!-- / --> ms.", "3 to …")]:
            done = self.pages("--check", page=f"# Runs\n\n{sentence}\n")
            self.assertEqual(done.returncode, 2, sentence)
            self.assertIn(f"a sentence says '{number}'", done.stderr)
        done = self.pages("--check", page="# Runs\n\nOne line.\nTwo of\nit take 3 ms.\n")
        self.assertIn("page.md:5: a sentence says '3'", done.stderr)

    def test_with_numbers_in_sentences_that_are_not_measured_or_say_their_origin_pass(self):
        number = "<!-- = runs.csv: relMSE .1g; scene=pool, photons=256 -->0.0001<!-- / -->"
        for sentence in [f"It has relMSE {number}.", "`--error 0.003` in 400×300, 256² photons.", "A ball of 0.5 m, at 1.5°, by OpenGL 4.5 and Mesa 22.3.6 (section 3.2, Eq. 8).", "16.8 million photons.",
                         "```\nkaustik run pool  # 38 ms\n```", "<!-- typed: once; kaustik run pool -->38 ms, in all\n12 s<!-- / --> here.", "At <!-- typed: paper -->0.01<!-- / --> it is best.",
                         "Eight layers and 12 scenes of 2009, the error of 256² photons.", "| what |\n| --- |\n| `38 ms` |"]:
            done = self.pages("--check", page=f"# Runs in 3 ms\n\n{sentence}\n")
            self.assertEqual(done.returncode, 0, f"{sentence}: {done.stderr}")
        done = self.pages("--check", page="It takes <!-- typed: measured -->38 ms<!-- / -->.\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("page.md:1: a number is typed as 'measured'; kinds are setting", done.stderr)

    def test_whose_links_lead_nowhere_are_refused(self):
        for link, says in [("other.md", "there is no 'other.md'"), ("page.md#two", "'page.md' has no heading '#two'"), ("#two", "no heading '#two'"),
                           ("page.md#one-more-it-is", ""), ("#one-more-it-is", ""), ("https://example.org/a.md", "")]:
            done = self.pages("--check", page=f"# One more: \"it\" is\n\n[there]({link})\n")
            self.assertEqual(done.returncode, 2 if says else 0, link)
            self.assertIn(says, done.stderr)

    def test_show_what_was_recorded_until_the_study_can_make_it(self):
        (self.results / "old_recorded.csv").write_text("scene,relMSE,command,version,device,seed,date\npool,**3e-5**,make it,1 (abc),a,1,2026-11-21\n")
        page = PAGE.split("It is")[0].replace("runs.csv", "old.csv").replace("-->\n<!-- end", 'words = ["scene"]\n-->\n<!-- end')
        self.assertEqual(self.pages(page=page).returncode, 0)
        text = (self.results / "page.md").read_text()
        self.assertIn("| scene | relMSE |\n| --- | --- |\n| `pool` | **3e-5** |\n\n*[`old_recorded.csv`](old_recorded.csv), recorded 2026-11-21; version 1 (abc); a; seed 1; by `make it`.*", text)
        (self.results / "old.csv").write_text(RUNS)
        self.assertEqual(self.pages().returncode, 0)
        text = (self.results / "page.md").read_text()
        self.assertNotIn("recorded", text)
        self.assertIn("| `pool` | 256 | 0.00012; 50.0 % |", text)


if __name__ == "__main__":
    unittest.main()
