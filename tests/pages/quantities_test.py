# SPDX-License-Identifier: MIT
"""Numbers in sentences: single ones, of several rows, and of two rows compared."""

import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments/plotting"))

from quantities import NUMBER, numbers_in, text_of  # noqa: E402
from views import PageError, rows_of  # noqa: E402

RUNS = """scene,by,"ms, all",cell,word
pool,lines,200,"1.20 (1.10 to 1.30)",slow
pool,march,50,"0.30 (0.20 to 0.40)",fast
ball,lines,90,"1,024 (2.5 %)",slow
ball,march,30,"−3·10⁻⁴",fast
"""
PAGE = """# One

| scene | n | n |
| --- | --- | --- |
| `pool` | **4** | 5 |

`ball`

| scene | other |
| --- | --- |
| a | 7 <!-- not 8 --> |
"""


class Quantities(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        (self.results / "runs.csv").write_text(RUNS)
        (self.results / "page.md").write_text(PAGE)

    def text(self, request):
        match = NUMBER.fullmatch(f"<!-- = {request} -->old<!-- / -->")
        self.assertIsNotNone(match, request)
        return text_of(match, self.results)

    def test_are_a_cell_or_one_of_its_numbers(self):
        self.assertEqual(self.text("runs.csv: ms, all ,.0f; scene=pool, by=lines"), "200")
        self.assertEqual(self.text("runs.csv: word s; scene=pool, by=lines"), "`slow`")
        self.assertEqual(self.text("runs.csv: {cell}[3] .2f; scene=pool, by=march"), "0.40")
        self.assertEqual(self.text("runs.csv: {cell}[-1] .1f; scene=ball, by=lines"), "2.5")
        self.assertEqual(self.text("runs.csv: {cell} ,.0f; scene=ball, by=lines"), "1,024")

    def test_are_of_several_rows_where_that_is_said(self):
        self.assertEqual(self.text("runs.csv: max ms, all .0f; by=lines"), "200")
        self.assertEqual(self.text("runs.csv: range ms, all .0f; scene=pool or ball"), "30 to 200")
        self.assertEqual(self.text("runs.csv: range {ms, all} / 200 .0%; scene=pool"), "25 to 100 %")
        self.assertEqual(self.text("runs.csv: range ms, all .0f; scene=pool, by=march"), "50")
        self.assertEqual(self.text("runs.csv: sum ms, all .0f; -"), "370")
        self.assertEqual(self.text("runs.csv: count .0f; by=lines"), "2")
        self.assertEqual(self.text("runs.csv: count .0f; by=none"), "0")
        self.assertEqual(self.text('runs.csv: count .0f; "ms, all" above 45, "ms, all" below 100, scene!=none'), "2")
        self.assertEqual(self.text("runs.csv: range ms, all .0f; scene!=pool or none"), "30 to 90")

    def test_compare_rows(self):
        self.assertEqual(self.text("runs.csv: {ms, all} / {ms, all}' .1f; scene=pool, by=lines / scene=pool, by=march"), "4.0")
        self.assertEqual(self.text("runs.csv: range 1 - {ms, all}' / {ms, all} .1%; by=lines / by=march by scene"), "66.7 to 75.0 %")

    def test_ask_each_of_two_rows_for_its_own_cells(self):
        (self.results / "gaps.csv").write_text("scene,by,first,second\npool,a,8,–\npool,b,–,2\nball,a,9,–\nball,b,–,–\n")
        self.assertEqual(self.text("gaps.csv: range {first} / {second}' .0f; by=a / by=b by scene"), "4")

    def test_are_of_a_pages_tables_too(self):
        self.assertEqual(self.text("page.md: n (2) .0f; scene=pool"), "5")
        self.assertEqual(self.text("page.md: other .0f; under=ball"), "7")
        self.assertEqual([row["under"] for row in rows_of(PAGE)], ["One", "ball"])

    def test_that_are_not_one_number_are_refused(self):
        for request, says in [("runs.csv: ms, all .0f; by=lines", "2 rows have by=lines"), ("runs.csv: ms .0f; scene=pool, by=lines", "no column 'ms'"),
                              ("runs.csv: ms, all .0f; scene=none", "no row has scene=none"), ("runs.csv: {cell}[4] .0f; scene=pool, by=lines", "has no number 4"),
                              ("runs.csv: {ms, all} / {ms, all}' .0f; scene=pool, by=lines", "a second row"),
                              ("runs.csv: {ms, all} ** 2 .0f; scene=pool, by=lines", "no sum, difference"),
                              ("runs.csv: {ms, all} / 0 .0f; scene=pool, by=lines", "division"),
                              ("runs.csv: {ms, all}' .0f; by=lines / by=march", "'by KEY' says which"),
                              ("runs.csv: word .0f; scene=pool, by=lines", "has no number 1"), ("none.csv: ms .0f; -", "there is no '"),
                              ("page.md: none .0f; scene=pool", "no table has the columns")]:
            with self.assertRaises(PageError, msg=request) as raised:
                self.text(request)
            self.assertIn(says, str(raised.exception), request)

    def test_are_read_as_people_write_them(self):
        self.assertEqual(numbers_in("−3·10⁻⁴"), [-3e-4])
        self.assertEqual(numbers_in("37, 45 and 1,024 of 9.5e-05"), [37.0, 45.0, 1024.0, 9.5e-5])
        self.assertEqual(numbers_in("1/2.2"), [1.0, 2.2])
        self.assertEqual(numbers_in("an H100"), [])


if __name__ == "__main__":
    unittest.main()
