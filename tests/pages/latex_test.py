# SPDX-License-Identifier: MIT
"""The tables of a page as LaTeX: what stands in a cell, and what is said of where it is from."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments/plotting"))

from latex import latex, tables_of  # noqa: E402

PAGE = """# Page

## Times & errors

| prose | none |
| --- | --- |
| a | b |

<!-- table
file = "runs.csv"
-->

`pool`

| scene | ms |
| --- | --- |
| `a_b` | **1,024** |
| `c` | – |

`ring`

| scene | what |
| --- | --- |
| `d` | <!-- = x.csv: y .1f; - -->[2·10⁻⁵](studies.md#x)<!-- / --> % |

*[`runs.csv`](runs.csv) by `make_it`, 2 rows; version 1.*

<!-- end -->
"""


class Latex(unittest.TestCase):
    def test_has_a_file_a_table_with_its_heading_and_what_stands_under_it(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text(PAGE)
            done = subprocess.run([sys.executable, "-B", ROOT / "experiments/plotting/latex.py", page, "--out", pathlib.Path(folder) / "tex"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(file.name for file in (pathlib.Path(folder) / "tex").iterdir()), ["page-1.tex", "page-2.tex"])
            first = (pathlib.Path(folder) / "tex/page-1.tex").read_text()
        self.assertIn("\\begin{tabular}{lr}\n\\toprule\nscene & ms \\\\\n\\midrule\n\\texttt{a\\_b} & \\textbf{1,024} \\\\\n\\texttt{c} & -- \\\\\n\\bottomrule", first)
        self.assertIn("\\caption{Times \\& errors. \\texttt{pool}. \\texttt{runs.csv} by \\texttt{make\\_it}, 2 rows; version 1.}", first)
        self.assertIn("\\texttt{d} & 2$\\cdot$10$^{-5}$ \\% \\\\", tables_of(PAGE)[1])

    def test_leaves_no_sign_that_latex_has_no_letter_for(self):
        for page in (ROOT / "results").glob("*.md"):
            for table in tables_of(page.read_text()):
                self.assertEqual(re.findall(r"[^\x00-\x7Fäöüé]", table), [], page)
                for line in table.splitlines():
                    self.assertEqual(line.count("{"), line.count("}"), line)
                rows = [line for line in table.splitlines() if line.endswith("\\\\")]
                self.assertEqual({len(re.findall(r"(?<!\\)&", row)) for row in rows}, {len(re.findall(r"(?<!\\)&", rows[0]))}, page)

    def test_writes_marks_of_a_line(self):
        self.assertEqual(latex("λ ≤ 3 σ²"), r"$\lambda$ $\leq$ 3 $\sigma$$^{2}$")
        self.assertEqual(latex('it says "yes", 2 < 3'), "it says ``yes'', 2 $<$ 3")
        self.assertEqual(latex("`a_b` *and* **c**, [50 %](x.md)"), r"\texttt{a\_b} \emph{and} \textbf{c}, 50 \%")

    @unittest.skipUnless(shutil.which("pdflatex"), "needs pdflatex")
    def test_is_compiled_without_an_error_or_a_letter_that_is_missing(self):
        head = r"\documentclass{article}\usepackage{booktabs}\usepackage[paperwidth=200cm,paperheight=300cm]{geometry}\begin{document}"
        tables = [table for page in sorted((ROOT / "results").glob("*.md")) for table in tables_of(page.read_text())]
        self.assertTrue(tables)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "all.tex").write_text("\\clearpage\n".join([head, *tables, r"\end{document}"]))
            done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "all.tex"], cwd=folder, capture_output=True, text=True, errors="replace")
            log = (pathlib.Path(folder) / "all.log").read_text(errors="replace")
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        self.assertEqual(re.findall(r"^!.*|Missing character.*", log, re.M), [])


if __name__ == "__main__":
    unittest.main()
