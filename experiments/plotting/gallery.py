#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The pictures of results/gallery.md: each technique on a scene that shows what it is for.

    gallery.py [--kaustik build/release/bin/kaustik] [--out results] [--size 400x300] [--reference-photons 16777216] [TECHNIQUE...]
    gallery.py --table results/gallery/gallery.csv

Renders OUT/gallery/TECHNIQUE.jpg (the caustic, a detail of it and of the truth, its error) by the first run by default that the study all_techniques has of that
technique and scene, and writes OUT/gallery/gallery.csv, a row a technique; those not named keep theirs. `pages.py` then fills the page. Times need an idle machine.

--table prints the page's table (pages.py, `by`). Its numbers are by name (quantities.py): those of the same run in the study, else the picture's own. Ends with 1 where a
picture is not the one that its row says.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import picture_rows
from readme_pictures import SCENES
from runs import head, line
from sources import Tree
from study_plan import planned
from table import rounded

ROOT = Path(__file__).resolve().parents[2]
STUDY = tomllib.loads((ROOT / "experiments/all_techniques.toml").read_text())
STUDY_RUNS = "all_techniques/runs.csv"  # below results/
HEIGHT = 150  # px of a strip
SETTINGS = ("emit.photons", "refine.finest")  # that the study varies
# Column, its key in a report's errors, and how the page shows it.
ERRORS = (("relMSE", "rel_mse", ".2g"), ("SMAPE", "smape", ".2g"), ("energy", "energy_ratio", ""))
MEASURED = ("paper", *SETTINGS, "reference_photons", "ms", *(name for name, _, _ in ERRORS))
COMMAND = "experiments/plotting/gallery.py"


def command_of(technique: str, scene: str, size: str, reference_photons: str) -> list[str]:
    """The study's first run by default of a technique and scene, as one types it."""
    base = STUDY["base"]
    run = next(run for run in planned(STUDY) if run["technique"] == technique and run["scene"] == scene and not run.get("as_published"))
    settings = [word for key in SETTINGS if key in run for word in ("--set", f"{key}={run[key]}")]
    return ["run", scene, "--technique", technique, "--size", size, "--frames", str(base["frames"]), "--warmup", str(base["warmup"]), "--precise",
            "--reference", base["reference"], "--reference-photons", reference_photons, *settings]


def rendered(kaustik: Path, technique: str, paper: str, tree: Tree, options: argparse.Namespace) -> dict:
    """Writes the picture of a technique; its row."""
    from crops import read_run, strip  # which draw: --table needs no such libraries
    command = command_of(technique, SCENES[technique], options.size, options.reference_photons)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([kaustik, *command, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        run = read_run(Path(folder), None)
    picture = options.out / f"gallery/{technique}.jpg"
    strip(run, HEIGHT).save(picture, quality=88)
    print(technique, *run.words(), flush=True)
    error = run.report["error"]["caustic_irradiance"]
    # Of the tree's sources if the program is no older than they are.
    sources = tree.key_of(run.report) if kaustik.stat().st_mtime >= tree.newest_source() else ""
    return picture_rows.row_of(run.report, command, COMMAND) | {
        "picture": picture.name, "sha256": picture_rows.digest_of(picture), "paper": paper, "reference_photons": options.reference_photons, "sources": sources,
        **{key: run.report["parameters"][key] for key in SETTINGS}, "ms": rounded(str(run.milliseconds)),
        **{name: rounded(str(error[key])) for name, key, _ in ERRORS if error.get(key) is not None}}


def in_study(row: dict, of_study: list[dict]) -> dict | None:
    """The study's row of the same run."""
    base = STUDY["base"]
    if row["size"] != base["size"] or row["reference_photons"] != str(base["reference_photons"]):
        return None
    return next((one for one in of_study if one["as_published"] == "false" and one["status"] == "done" and
                 all(one[key] == row[key] for key in ("technique", "scene", *SETTINGS))), None)


def figures_of(row: dict, file: Path, of_study: list[dict]) -> str:
    """Time and errors, by name."""
    known = in_study(row, of_study)
    keys = ("technique", "scene", *SETTINGS)

    def named(source: str, what: str, style: str, *more: str) -> str:
        return f"<!-- = {source}: {what} {style}; {', '.join([*(f'{key}={row[key]}' for key in keys), *more])} --><!-- / -->"

    own = f"{file.parent.name}/{file.name}"
    of, more = (STUDY_RUNS, ("as_published=false",)) if known else (own, ())
    shown = known or row
    parts = [f"{named(of, 'ms', '.0f', *more)} ms", *(f"{name} {named(of, name, style, *more)}" for name, _, style in ERRORS if style and shown[name])]
    if known and f"{float(known['relMSE']):.2g}" != f"{float(row['relMSE']):.2g}":
        parts.append(f"relMSE of this picture {named(own, 'relMSE', '.2g')}")
    return ", ".join(parts)


def table(file: Path) -> str:
    rows, of_study = picture_rows.read(file), picture_rows.read(file.parents[1] / STUDY_RUNS)
    if problems := picture_rows.wrong(file):
        sys.exit(f"gallery: {'; '.join(problems)}")
    lines = [head(["technique, paper, caustic's passes and error", "caustic, detail, truth, error"])]
    for row in rows:
        lines.append(line([f"**`{row['technique']}`** on `{row['scene']}`<br>{row['paper'] or '–'}<br>{figures_of(row, file, of_study)}",
                           f"![{row['technique']} on {row['scene']}]({file.parent.name}/{row['picture']})<br>`{row['run']}`"]))
    return "\n".join(lines)


def render(options: argparse.Namespace) -> None:
    file, tree = options.out / "gallery/gallery.csv", Tree()
    file.parent.mkdir(parents=True, exist_ok=True)
    listed = json.loads(subprocess.run([options.kaustik, "list", "techniques", "--json"], check=True, capture_output=True, text=True).stdout)
    papers = {technique["name"]: technique["source"] for technique in listed}
    rows = {row["technique"]: row for row in picture_rows.read(file)}
    for technique in options.techniques or SCENES:
        rows[technique] = rendered(options.kaustik, technique, papers[technique], tree, options)
        picture_rows.write(file, [rows[name] for name in SCENES if name in rows], MEASURED)  # each at once: what is stopped half-way fits its pictures


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", type=Path, metavar="CSV")
    parser.add_argument("--kaustik", type=Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--out", type=Path, default=ROOT / "results")
    parser.add_argument("--size", default=STUDY["base"]["size"])
    parser.add_argument("--reference-photons", default=str(STUDY["base"]["reference_photons"]))
    parser.add_argument("techniques", nargs="*", metavar="TECHNIQUE")
    options = parser.parse_args()
    if unknown := [name for name in options.techniques if name not in SCENES]:
        sys.exit(f"gallery: there is no '{unknown[0]}'; there are {', '.join(SCENES)}")
    if options.table:
        print(table(options.table))
    else:
        render(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
