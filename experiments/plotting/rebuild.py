#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs studies and makes of them what stands in results/; then calls the programs of all else that is there (result_steps.py).

    rebuild.py [--kaustik build/release/bin/kaustik] [--out results/runs/experiments] [--anew] [--shard K/N | --missing | --only KEY=VALUE]... [STUDY | STEP]...
    rebuild.py --list
    rebuild.py --stale [--out results/runs/experiments] [STUDY...]
    rebuild.py --quick [--out DIR] [STUDY | STEP]...

Each study is run into OUT/STUDY, where what is finished stays (`--resume`), its CSV is written to results/, and then all pages are filled from the CSVs
(pages.py). Each row has the key of the sources that it was made by (sources.py), as far as that is known; --stale says how many rows of a study are of the
tree's sources, in a fresh clone too, and how many runs below OUT are of others; --anew makes those again, and no others. A study of which runs have failed
keeps them as rows with their message. Runs whose frames differ by more than a fifth (other work, or a driver that had still to
compile) are made once more, but for moving scenes and shards.
With --only those runs alone are made that have these values of what the study varies (`kaustik experiment run --only`), and the CSV keeps its rows of all
others; with --missing those that the CSV has no row of (studies.md names them), or, with --anew too, no row that is known to be of the tree's sources: so a
clone without any run makes what is no longer true, and nothing else. With --shard only the K-th of N equal parts is run and nothing is written to results/;
when all are done, run without.
Steps are what no study makes: censuses, certificates, pictures; --list names them. Without names all studies are run and then all steps, but for those that
need what is not here, which it says; with --only, --missing or --shard no step is.
--quick makes the plan of each study, runs its first run with few photons and pixels, makes its CSV in DIR, and checks the pages: whether the commands of
results/ still work, in minutes; of steps only whether their programs are there and take what they are called with. Ends with 1 where something does not.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

from maker import rows_in
from noted import begin_of, disturbed, forget, judged, note_sources, of_tree, recipes_in, reports_of, stale
from result_steps import STEPS, described, make, missing_for, wrong_with
from sources import RECIPES, Present, Tree, keys_noted, note_recipes, recipes_of
from speed_curves import DISTURBED
from study import device_of
from study_plan import missing_of
from table import rounded, rows_of_others
from views import BUSY, PageError, printed, recorded_of, rows_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLOTTING = ROOT / "experiments/plotting"

# The CSV of each study below results/. TABLE: the columns of table.py; RUNS: all of runs.csv, which those pages are made of that have
# a program of their own.
TABLE = {
    "all_techniques": "all_techniques/runs.csv",
    "best_mixtures_choice": "all_techniques/choice.csv",
    "best_mixtures": "all_techniques/best_mixtures.csv",
    "bias": "bias/runs.csv",
    "blocker_sizes": "all_scenes/blocker_sizes.csv",
    "coverage": "all_scenes/coverage.csv",
    "defaults": "defaults.csv",
    "dispersion": "dispersion/runs.csv",
    "lamps": "lamps/runs.csv",
    "lamps_widened": "lamps/widened.csv",
    "soft_and_colored": "lamps/soft_and_colored.csv",
    "krueger2006_god_rays": "krueger2006/god_rays.csv",
    "krueger2006_refracted_scene": "krueger2006/refracted_scene.csv",
    "normal_maps": "normal_maps/runs.csv",
    "picked": "all_techniques/picked.csv",
    "refined": "refined/runs.csv",
    "vertices_and_gather": "vertices_and_gather.csv",
    "view_rays": "all_scenes/view_rays.csv",
    "wyman2008_interpolants": "wyman2008/interpolants.csv",
    "wyman2008_iterations": "wyman2008/iterations.csv",
    "wyman_nichols2009_convergence": "wyman_nichols2009/convergence.csv",
    "wyman_nichols2009_levels": "wyman_nichols2009/levels.csv",
    "wyman_nichols2009_several": "wyman_nichols2009/several.csv",
    "wyman_nichols2009_traversal": "wyman_nichols2009/traversal.csv",
}
RUNS = {
    "equal_error": "reconstructions/equal_error.csv",
    "krueger2006_caustics": "krueger2006/caustics.csv",
    "krueger2006_needs": "krueger2006/needs.csv",
    "krueger2006_photons": "krueger2006/photons.csv",
    "krueger2006_refraction": "krueger2006/refraction.csv",
    "krueger2006_shadows": "krueger2006/shadows.csv",
    "krueger2006_sprites": "krueger2006/sprites.csv",
    "krueger2006_tracers": "krueger2006/tracers.csv",
    "reconstructions": "reconstructions/runs.csv",
    "tracer_accuracy": "tracer_accuracy/runs.csv",
    **{f"umenhoffer2008_{name}": f"umenhoffer2008/{name}.csv"
       for name in ("error", "grazing", "merge", "points", "reach", "secant", "steps")},
    **{f"wyman2008_{name}": f"wyman2008/{name}.csv" for name in ("error", "flicker", "reach", "ringing", "times")},
    **{f"wyman_nichols2009_{name}": f"wyman_nichols2009/{name}.csv"
       for name in ("batches", "buffers", "cascades", "deferred", "error", "god_rays", "photons", "starts", "times")},
}
# Made of the pictures too, by a program of its own.
PARTS = {"error_parts": "error_parts/parts.csv"}
# Of the reports, whose passes are summed by stage.
REPORTS = {"exact_rays": "exact_rays/errors.csv"}
STUDIES = {**TABLE, **PARTS, **REPORTS, **RUNS}
# Of a device that this machine may not have: their commands say how its rows come to stand next to others'. Only tried here, never run.
DEVICE = {"device_errors": "device/errors.csv", "device_times": "device/times.csv", "exact_rays_times": "exact_rays/times.csv"}

# Their tables need reports or pictures too: where their CSVs are not enough, they are kept as printed, next to them.
PRINTED = ("umenhoffer2008_grazing", "umenhoffer2008_merge", "umenhoffer2008_reach", "wyman2008_ringing", "wyman2008_times",
           *(f"wyman_nichols2009_{name}" for name in ("batches", "cascades", "deferred", "photons", "starts", "times")))

# Whose tables say where the eye's rays go; other files of all of runs.csv are without that.
OF_THE_VIEW = ("krueger2006_refraction",)

INTERRUPTED = "kaustik: Interrupted;"  # how a study ends that was stopped; the same command goes on
SMALL = {"size": "64x48", "frames": 1, "warmup": 0, "reference_photons": 65536, "emit.photons": "32x32",
         "refine.finest": 64, "refine.start": 16, "refine.check": 32, "reconstruct.map_size": 128, "around.cubes.size": 64}


class Failure(Exception):
    """What a step has said before it ended."""


def call(*command) -> None:
    done = subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise Failure(f"'{' '.join(map(str, command))}' ended with {done.returncode}: {(done.stderr or done.stdout).strip()}")


def toml(value) -> str:
    """A table, list or value of a study as TOML has it; its strings and numbers are those of JSON."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def first_of(axis):
    """The first value of a list, or of a range."""
    return axis["from"] if isinstance(axis, dict) and "from" in axis else axis[0]


def small(study: pathlib.Path) -> str:
    """The first run of a study, with few photons and pixels, as the text of a study."""
    described = tomllib.loads(study.read_text())
    permute = described.get("permute", {})
    first = permute[0] if isinstance(permute, list) else permute
    run = {**described.get("base", {}), **{key: first_of(axis) for key, axis in first.items()}}
    run |= {key: value for key, value in SMALL.items() if key in run or key in ("size", "frames", "warmup")}
    if (study.parent / run["scene"]).is_file():
        run["scene"] = str(study.parent / run["scene"])
    elif isinstance(run.get("reference"), str) and (study.parent / run["reference"]).is_file():
        run["reference"] = str(study.parent / run["reference"])
    lines = [f'name = "{study.stem}"', 'description = "The first run, small."', "[base]"]
    return "\n".join([*lines, *(f"{json.dumps(key)} = {toml(value)}" for key, value in run.items())]) + "\n"


def write_slim(runs: pathlib.Path, target: pathlib.Path, keep: bool = False, of_the_view: bool = True) -> None:
    """As it is, but for the constants of the errors' formulas and where its folders are, with five digits a number: what is committed has to be small.
    Where runs have keys of their sources, rows have them last. `keep`: with the rows that the file has of other runs. Without `of_the_view` errors of what the eye
    sees are left out too."""
    def stays(name: str) -> bool:
        return name not in ("folder", "hash") and ".formulas." not in name and (of_the_view or not name.startswith("error.view."))

    csv.field_size_limit(sys.maxsize)
    with runs.open(newline="") as stream:
        reader = csv.DictReader(stream)
        rows = list(reader)
    columns, kept = [name for name in reader.fieldnames if stays(name)], []
    if (keys := keys_noted(runs.parent)) and "sources" not in columns:
        columns.append("sources")
        rows = [row | {"sources": keys.get(row["folder"], "")} for row in rows]
    if keep and target.is_file():
        with target.open(newline="", encoding="utf-8") as stream:
            before = list(csv.DictReader(stream))
        settings = columns[columns.index("message") + 1:columns.index("frame_ms.max")]
        if missing := [key for key in settings if before and key not in before[0]]:
            raise Failure(f"the rows of '{target}' do not say {missing[0]}, which tells runs apart")
        kept = rows_of_others(before, rows, settings + ["repeat"])
        devices = {device_of(row) for row in [*kept, *rows] if row.get("status") == "done"}
        if len(devices) > 1:  # its program compares times of all rows
            raise Failure(f"'{target}' would have times of {len(devices)} models of devices, {' and '.join(sorted(devices))}; make it anew as a whole, without --only")
        columns += [name for name in (before[0] if before else {}) if name not in columns and stays(name)]
    with target.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([rounded(row.get(name, "")) for name in columns] for row in rows)
        writer.writerows([row.get(name, "") for name in columns] for row in kept)


def csv_of(results: pathlib.Path, study: str, target: pathlib.Path, keep: bool = False) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if study in TABLE:
        call(sys.executable, "-B", PLOTTING / "table.py", results, "--csv", target, *(["--keep"] if keep else []))
    elif study.startswith("exact_rays"):
        call(sys.executable, "-B", PLOTTING / "exact_rays.py", "slim", results, "--csv", target)
    elif study in DEVICE:
        call(sys.executable, "-B", PLOTTING / "device.py", "slim", results, "--csv", target)
    elif study in PARTS:
        call(sys.executable, "-B", PLOTTING / "error_parts.py", results, "--out", target.parent, *(["--keep"] if keep else []))
    else:
        write_slim(results / "runs.csv", target, keep, study in OF_THE_VIEW)


def record(results: pathlib.Path, study: str, target: pathlib.Path) -> None:
    """Where a study's CSV is not enough for its table, keeps that as its program prints it of the study's folder. What was kept of an older version goes."""
    kept, program = pathlib.Path(recorded_of(str(target))), f"{target.parent.name}.py"
    kept.unlink(missing_ok=True)
    if study not in PRINTED:
        return
    try:
        printed(program, target.stem, target)
    except PageError:
        with (results / "runs.csv").open(newline="") as stream:
            runs = [row for row in csv.DictReader(stream) if row["status"] == "done"]
        of_runs = {"command": f"experiments/rebuild_results.sh {study}", "version": runs[0]["version"], "device": device_of(runs[0]),
                   "seed": runs[0].get("seed", ""), "date": max(row.get("date", "") for row in runs)[:10]}
        loads = [float(row["other_processors"]) for row in runs if row.get("other_processors")]
        of_runs |= {"other_processors": f"{max(loads):.1f}"} if loads and max(loads) > BUSY else {}
        rows = [{**{key: cell for key, cell in row.items() if key != "under"}, **of_runs} for row in rows_of(printed(program, target.stem, results))]
        with kept.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def quick(kaustik: pathlib.Path, out: pathlib.Path, studies: list[str], steps: list[str]) -> list[str]:
    failures = [f"{step}: {what}" for step in steps for what in wrong_with(STEPS[step])]
    for study in studies:
        file = out / f"{study}.toml"
        file.write_text(small(ROOT / f"experiments/{study}.toml"))
        try:
            # A part of so many has no run, but the whole plan is made and checked.
            call(kaustik, "experiment", "run", f"experiments/{study}.toml", "--shard", "9999/9999", "--out", out / f"{study}-plan")
            call(kaustik, "experiment", "run", file, "--out", out / study)
            csv_of(out / study, study, out / (STUDIES | DEVICE)[study])
            print(f"{study}: its first run works", flush=True)
        except Failure as failure:
            if "run experiments/fetch_meshes.sh" in str(failure):
                print(f"{study}: not tried; its mesh is not here (experiments/fetch_meshes.sh)", flush=True)
            else:
                failures.append(f"{study}: {failure}")
    try:
        call(sys.executable, "-B", PLOTTING / "pages.py", "--check")
    except Failure as failure:
        failures.append(str(failure))
    return failures


def compare_with_light_tracer(kaustik: pathlib.Path, anew: bool, scenes: list[str]) -> None:
    """`anew`: its rows of other sources too, of these scenes where a part is made."""
    light_tracer = ROOT / "results/all_techniques/light_tracer.csv"
    call(sys.executable, "-B", ROOT / "experiments/light_tracer.py", "--kaustik", kaustik, "--out", light_tracer,
         *(["--anew"] if anew else []), *(["--scenes", *scenes] if scenes else []))
    call(sys.executable, "-B", PLOTTING / "speed_error.py")


def conditions_of(run: dict) -> list[str]:
    """What tells a run of a study from the others, for --only."""
    texts = {key: value if isinstance(value, str) else json.dumps(value) for key, value in run.items()}
    return [word for key, text in texts.items() for word in ("--only", f"{key}={text}")]


def missing_parts(study: str, present: Present | None = None) -> list[list[str]]:
    """The conditions of each run that the study's CSV has no row of, or none that is `present`; where it has no such row at all, none: all runs are."""
    described_study = tomllib.loads((ROOT / f"experiments/{study}.toml").read_text())
    rows = tuple(row for row in rows_in(ROOT / "results" / STUDIES[study]) if present is None or of_tree(described_study, row, present))
    if not rows:
        return [[]]
    _, missing = missing_of(described_study, rows)
    if missing and study in RUNS and "as_published" not in rows[0]:
        raise Failure(f"{study}: the rows of results/{STUDIES[study]} are of a version that did not write all settings, so that {len(missing)} that are missing "
                      "cannot stand next to them; make it whole, without --missing")
    return [conditions_of(run) for run in missing]


def run_parts(kaustik: pathlib.Path, study: str, out: pathlib.Path, parts: list[list[str]]) -> tuple[bool, list[str]]:
    """Whether it was interrupted, and what failed: rows say why, and the others count."""
    failures = []
    for part in parts:
        try:
            call(kaustik, "experiment", "run", f"experiments/{study}.toml", "--resume", "--out", out / study, *part)
        except Failure as failure:
            failures.append(f"{study}: {failure}")
            if INTERRUPTED in str(failure):
                return True, failures
    return False, failures


def rebuild(kaustik: pathlib.Path, out: pathlib.Path, shard: str | None, anew: bool, only: list[str] | None, studies: list[str],
            steps: list[str]) -> list[str]:
    """`only`: conditions; None: what is missing."""
    failures = []
    for study in studies:
        tree = Tree()
        of_all = ["--shard", shard] if shard else [word for condition in only or [] for word in ("--only", condition)]
        try:
            parts = [of_all] if only is not None else missing_parts(study, Present(tree, recipes_of(ROOT / "results" / RECIPES)) if anew else None)
        except Failure as failure:
            failures.append(str(failure))
            continue
        is_part = any(parts)
        if not parts:
            print(f"{study}: nothing is missing", flush=True)
            continue
        if anew:
            forget(stale(out / study, tree), "of other sources are made anew")
        marker = out / f"{study}{'-' + shard.replace('/', '-of-') if shard else ''}.since.json"
        begin = begin_of(marker, tree)
        is_interrupted, said = run_parts(kaustik, study, out, parts)
        if not shard and not is_interrupted and (again := disturbed(out / study, begin)):
            forget(again, f"whose frames differ by more than {DISTURBED:.0%} are made once more")
            is_interrupted, said = run_parts(kaustik, study, out, parts)
        failures += said
        if not tree.has_built(kaustik):
            print(f"{study}: '{kaustik}' is of another tree; its rows have no keys of sources", flush=True)
        elif Tree().fingerprint() != tree.fingerprint():
            failures.append(f"{study}: sources were changed while it ran; its new runs are of none that are known")
        elif (out / study).is_dir():
            note_sources(out / study, tree, begin)
        marker.unlink(missing_ok=True)
        if is_interrupted:  # the rows that there are would take the place of all
            return failures
        if shard or not (out / study / "runs.csv").is_file():
            continue
        try:
            csv_of(out / study, study, ROOT / "results" / STUDIES[study], is_part)
            note_recipes(ROOT / "results" / RECIPES, recipes_in(out / study, tree))
            if not is_part:  # of a part no whole table can be printed
                record(out / study, study, ROOT / "results" / STUDIES[study])
            if study == "bias":
                call(sys.executable, "-B", PLOTTING / "bias.py", out / study, "--out", ROOT / "results/bias")
            if study == "all_techniques":
                call(sys.executable, "-B", PLOTTING / "profiles.py", out / study, "--out", ROOT / "results/all_techniques/profile.csv", *(["--keep"] if is_part else []))
            if study in ("all_techniques", "best_mixtures"):
                compare_with_light_tracer(kaustik, anew, [condition.removeprefix("scene=") for condition in only or [] if condition.startswith("scene=")])
            if study == "best_mixtures_choice":
                call(sys.executable, "-B", PLOTTING / "best_mixtures.py", ROOT / "results" / STUDIES[study],
                     "--study", ROOT / "experiments/best_mixtures.toml")
            print(f"{study}: results/{STUDIES[study]}", flush=True)
        except (Failure, PageError) as failure:
            failures.append(f"{study}: {failure}")
    for step in steps:
        if wrong := make(STEPS[step], kaustik, anew):
            failures.append(f"{step}: {wrong}")
        else:
            print(f"{step}: results/{STEPS[step].makes}", flush=True)
    try:
        if not shard:
            call(sys.executable, "-B", PLOTTING / "pages.py")
    except Failure as failure:
        failures.append(str(failure))
    return failures


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--shard")
    parser.add_argument("--only", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--missing", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--stale", action="store_true")
    parser.add_argument("--anew", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("names", nargs="*", metavar="STUDY | STEP")
    arguments = parser.parse_args()
    if unknown := set(arguments.names) - set(STUDIES | DEVICE if arguments.quick else STUDIES) - set(STEPS):
        sys.exit(f"rebuild: there is no study or step '{sorted(unknown)[0]}'; --list names them")
    studies = [name for name in arguments.names if name not in STEPS] if arguments.names else list(STUDIES)
    steps = [name for name in arguments.names if name in STEPS] if arguments.names else list(STEPS)
    if arguments.list:
        print("\n".join([*(f"{study:32} results/{STUDIES[study]}" for study in studies), *map(described, steps)]))
        return 0
    kaustik = arguments.kaustik.resolve()
    if arguments.stale:
        tree, out = Tree(), (arguments.out or ROOT / "results/runs/experiments").resolve()
        present = Present(tree, recipes_of(ROOT / "results" / RECIPES))
        for study in studies:
            counts = judged(tomllib.loads((ROOT / f"experiments/{study}.toml").read_text()), rows_in(ROOT / "results" / STUDIES[study]), present)
            parts = [", ".join(f"{count} {what}" for what, count in counts.items() if count) or "no rows"]
            if reports := reports_of(out / study):
                parts.append(f"of {len(reports)} runs there {len(stale(out / study, tree))} are of others")
            print(f"{study:32} {'; '.join(parts)}")
        return 0
    if arguments.quick:
        with tempfile.TemporaryDirectory() as folder:
            out = arguments.out.resolve() if arguments.out else pathlib.Path(folder)
            out.mkdir(parents=True, exist_ok=True)
            failures = quick(kaustik, out, studies if arguments.names else [*STUDIES, *DEVICE], steps)
    else:
        if arguments.only and (len(studies) != 1 or studies[0] in REPORTS):
            sys.exit("rebuild: --only is of one study, whose CSV has a row a run; name it")
        if arguments.only or arguments.missing or arguments.shard:  # parts, of studies
            if steps and arguments.names:
                sys.exit(f"rebuild: '{steps[0]}' is no study: it has no --only, --missing or --shard")
            steps = []
        if arguments.missing and (arguments.only or arguments.shard):
            sys.exit("rebuild: --missing says by itself which runs are made: it goes with no --only or --shard")
        if arguments.missing:
            studies = [study for study in studies if study not in REPORTS]
        if arguments.anew and arguments.shard:
            sys.exit("rebuild: --anew with --shard would take from other shards what they have made")
        if not kaustik.is_file() or kaustik.stat().st_mtime < Tree().newest_source():
            sys.exit(f"rebuild: '{kaustik}' is not there, or older than the sources; build it first")
        out = (arguments.out or ROOT / "results/runs/experiments").resolve()
        cannot = {step: why for step in steps if (why := missing_for(STEPS[step], bool(arguments.names)))}
        for step, why in cannot.items():
            print(f"{step}: not made; {why}", flush=True)
        steps = [step for step in steps if step not in cannot]
        failures = rebuild(kaustik, out, arguments.shard, arguments.anew, None if arguments.missing else arguments.only, studies, steps)
        failures += [f"{step}: {why}" for step, why in cannot.items() if arguments.names]
    for failure in failures:
        print(f"rebuild: {failure}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
