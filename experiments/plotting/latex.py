#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables of a page of results/ for a paper: LaTeX with booktabs, one file a table, with what stands under it as caption.

    latex.py PAGE... [--out DIR]

Writes DIR/PAGE-N.tex, N from 1 in the page's order. A table may be wider than a column: \\resizebox or \\tiny are the paper's to choose.
"""

import argparse
import pathlib
import re
import sys
import unicodedata

from pages import TABLE
from quantities import SUPERSCRIPT
from views import cells_of

SIGNS = {"×": r"$\times$", "→": r"$\rightarrow$", "±": r"$\pm$", "≥": r"$\geq$", "≤": r"$\leq$", "−": "$-$", "–": "--", "·": r"$\cdot$", "†": r"\dag{}", "≈": r"$\approx$", "°": r"$^\circ$",
         "…": r"\dots{}", "’": "'", "<": "$<$", ">": "$>$", "|": "$|$", "µ": r"$\mu$", "—": "---", "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
         **{letter: "\\" + letter for letter in "&%$#_{}"}}


def sign(letter: str) -> str:
    """One letter; Greek ones by their names."""
    if letter in SIGNS:
        return SIGNS[letter]
    match = re.fullmatch(r"GREEK (SMALL|CAPITAL) LETTER (\w+)", unicodedata.name(letter, "").replace("LAMDA", "LAMBDA"))
    return rf"$\{match[2].lower() if match[1] == 'SMALL' else match[2].capitalize()}$" if match else letter


def plain(text: str) -> str:
    """Text as LaTeX has it."""
    text = re.sub(r'"([^"]*)"', r"``\1''", text)
    parts = re.split(r"([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)", text)
    return "".join(f"$^{{{part.translate(SUPERSCRIPT)}}}$" if i % 2 else "".join(map(sign, part)) for i, part in enumerate(parts))


def latex(markdown: str) -> str:
    """A cell or a line: `code`, **bold**, *italics* and the words of links."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"<!--.*?-->", "", markdown))
    parts = re.split(r"(`[^`]*`|\*\*[^*]+\*\*|\*[^*]+\*)", text)
    for i, part in enumerate(parts):
        if i % 2 == 0:
            parts[i] = plain(part)
        elif part.startswith("`"):
            parts[i] = rf"\texttt{{{plain(part[1:-1])}}}"
        else:
            stars = 2 if part.startswith("**") else 1
            parts[i] = rf"\{'textbf' if stars == 2 else 'emph'}{{{latex(part[stars:-stars])}}}"
    return "".join(parts)


def table_of(lines: list[str], caption: str) -> str:
    head, rows = cells_of(lines[0]), [cells_of(line) for line in lines[2:]]
    # A column of numbers is set to the right, as far as its cells begin with one.
    kinds = "".join("r" if all(re.match(r"[*+−-]*[\d–]|$", row[i]) for row in rows if i < len(row)) else "l" for i in range(len(head)))
    body = [" & ".join(map(latex, cells)) + r" \\" for cells in rows]
    return "\n".join([r"\begin{table}", r"\centering", rf"\begin{{tabular}}{{{kinds}}}", r"\toprule", " & ".join(map(latex, head)) + r" \\", r"\midrule", *body,
                      r"\bottomrule", r"\end{tabular}", rf"\caption{{{caption}}}", r"\end{table}", ""])


def tables_of(text: str) -> list[str]:
    """All tables of a page that are made of CSVs; of a program that prints several, each with the line that it stands under."""
    found = []
    for match in TABLE.finditer(text):
        heads = re.findall(r"^#+ (.*)$", text[:match.start()], re.M)
        under = re.findall(r"^\*(.*)\*$", match[2], re.M)
        blocks = re.split(r"\n\s*\n", match[2].strip())
        for before, block in zip(["", *blocks], blocks):
            lines = block.split("\n")
            if not lines[0].startswith("|"):
                continue
            own = before if before and not before.startswith(("|", "*[")) and len(before) < 60 else ""
            found.append(table_of(lines, ". ".join(filter(None, [latex(heads[-1]) if heads else "", latex(own), latex(under[-1]).rstrip(".") if under else ""])) + "."))
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for page in arguments.pages:
        if not page.is_file():
            sys.exit(f"latex: there is no '{page}'")
        tables = tables_of(page.read_text())
        for number, table in enumerate(tables, 1):
            (arguments.out / f"{page.stem}-{number}.tex").write_text(table)
        print(f"{page}: {len(tables)} tables")
    return 0


if __name__ == "__main__":
    sys.exit(main())
