#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws what `kaustik experiment run` found: figures/*.svg and *.png, summary.csv and report.html,
all in the folder of the results. Started by `kaustik experiment report DIR`.

    report.py DIR
"""

import csv
import io
import os
import sys
from pathlib import Path

MAX_PICTURES = 12  # configurations whose pictures are shown; all are in the table


def write_whole(path: Path, data: bytes) -> None:
    """Under its final name only when complete."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
    print(f"wrote {path}")


def number(value: float | None, spread: float = 0.0) -> str:
    if value is None:
        return ""
    return f"{value:.4g} ± {spread:.2g}" if spread > 0.0 else f"{value:.4g}"


def summary(study) -> tuple[list[str], list[list[str]], str]:
    """One row a configuration: the settings that vary, then means and spreads over repeats."""
    from figures import error_measures
    from study import as_text

    measured = [("frame_ms.median", "frame (ms)"), ("frame_ms.p95", "95th percentile (ms)")]
    measured += [(m.column, m.column.split(".", 1)[1]) for m in error_measures(study)]
    measured += [
        ("energy.balance", "energy balance"),
        ("memory.peak_bytes", "peak memory (bytes)"),
        ("warnings", "warnings"),
    ]
    measured = [(c, name) for c, name in measured if study.columns_like(c.replace(".", r"\."))]
    devices = study.devices
    header = ["settings"] + [axis.label for axis in study.axes]
    header += ["device"] if len(devices) > 1 else []
    header += ["repeats"]
    header += [name for _, name in measured]
    rows = []
    for configuration in study.configurations:
        row = [configuration.hash[:8]]
        row += [as_text(configuration.axes.get(axis.key)) for axis in study.axes]
        row += [str(devices.index(configuration.device) + 1)] if len(devices) > 1 else []
        row.append(str(len(configuration.rows)))
        row += [number(configuration.mean(c), configuration.spread(c)) for c, _ in measured]
        rows.append(row)
    caption = (
        "Means over repeats, ± their standard deviation. runs.csv has every run and column, "
        "samples.json every frame."
    )
    return header, rows, caption


def latex_table(header: list[str], rows: list[list[str]], caption: str) -> str:
    """For a paper that uses the package booktabs."""
    special = {"\\": r"\textbackslash{}", "±": r"$\pm$", "²": r"\textsuperscript{2}", "–": "--",
               **{c: "\\" + c for c in "&%$#_{}"}}

    def line(cells: list[str]) -> str:
        return " & ".join("".join(special.get(c, c) for c in cell) for cell in cells) + r" \\"

    columns = "l" + "r" * (len(header) - 1)
    return "\n".join([f"% {caption}", rf"\begin{{tabular}}{{{columns}}}", r"\toprule", line(header), r"\midrule",
                      *map(line, rows), r"\bottomrule", r"\end{tabular}"]) + "\n"


def draw(folder: Path) -> None:
    import matplotlib.pyplot as plt

    from figures import all_figures
    from page import make_page
    from pictures import CAUSTIC, IN_SCATTERED, Pictures, gallery, side_by_side
    from study import evenly, read_study

    study = read_study(folder)
    shown = evenly(study.configurations, MAX_PICTURES)
    outputs = [Pictures(shown, output) for output in (CAUSTIC, IN_SCATTERED)]
    for problem in dict.fromkeys(problem for pictures in outputs for problem in pictures.problems):
        print(f"warning: {problem}")
    of_pictures = []
    for pictures in outputs:
        name = "pictures" if pictures.output is CAUSTIC else f"pictures-{pictures.output.file}"
        what = f"the {pictures.output.kind} of each configuration"
        of_pictures += [
            (
                name,
                f"The reference, {what}, and where it is wrong; one exposure for each reference.",
                side_by_side(pictures),
            ),
            (name, f"{what.capitalize()}, at one exposure.", gallery(pictures)),
        ]
    (folder / "figures").mkdir(exist_ok=True)
    written = []
    for name, caption, figure in [*all_figures(study), *of_pictures]:
        if figure is None:
            continue
        for suffix, metadata in (("svg", {"Date": None}), ("pdf", {"CreationDate": None}), ("png", {})):
            buffer = io.BytesIO()
            figure.savefig(buffer, format=suffix, metadata=metadata, bbox_inches="tight")
            write_whole(folder / "figures" / f"{name}.{suffix}", buffer.getvalue())
        plt.close(figure)
        written.append((name, caption, folder / "figures" / f"{name}.svg"))
    header, rows, caption = summary(study)
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([header, *rows])
    write_whole(folder / "summary.csv", text.getvalue().encode("utf-8"))
    write_whole(folder / "summary.tex", latex_table(header, rows, caption).encode("utf-8"))
    on_page = [picture for pictures in outputs for picture in pictures.for_page()]
    page = make_page(study, written, on_page, (header, rows, caption))
    write_whole(folder / "report.html", page.encode("utf-8"))


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: report.py DIR", file=sys.stderr)
        return 2
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        print(
            f"{sys.executable} has no matplotlib, which draws the figures; install the package "
            "python3-matplotlib.",
            file=sys.stderr,
        )
        return 1
    from study import StudyError

    try:
        draw(Path(sys.argv[1]))
    except StudyError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error.filename or 'Standard output'}: {error.strerror}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
