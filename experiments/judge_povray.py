#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""POV-Ray's photons on our scenes, judged: for results/judge.md.

    PATH=build/release/bin:$PATH judge_povray.py --out results/judge [--work results/runs/judge] [--size 200x150]
               [--photons 6000000] [--reference-photons 4000000] [--causes] [SCENE...]

Exports each scene, has POV-Ray shoot its photons and render, and judges the picture. Writes OUT/classes.csv, a row for each class of light,
and OUT/scenes.csv, a row for each scene, with all findings in words; rows of other scenes stay as they are. A picture that is in WORK already is not rendered again. With
--causes also by references of other indices, lights and normals. Rows have the day of the verdict, and the key of the sources (plotting/sources.py: the framework, what
exports and what judges, the scene), unless the picture is of another export.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "plotting"))
from maker import Maker, made, now, rows_in, write_whole  # noqa: E402

SCENES = ["flat-water", "ring", "concave-glass", "pool-reflections", "glass-sphere",
          *(str(ROOT / f"judge/{name}.toml") for name in ("ball-in-sun", "far-lamp", "clear-pool"))]


def output_of(command: list[str], folder: Path | None = None) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"judge_povray: {' '.join(command)}: {done.stderr.strip()}")
    return done.stdout + done.stderr


def judged(scene: str, options: argparse.Namespace, maker: Maker) -> tuple[dict, int, dict[str, str]]:
    """The verdict, how many photons POV-Ray has shot, and what rows say of when and by what."""
    name = Path(scene).stem
    folder = options.work / name
    log, note = folder / "shoot.log", folder / "made.json"
    key = maker.tree.key_without_technique(scene, "framework/exporters", "framework/judge")
    if not (log.is_file() and (folder / "theirs.exr").is_file()):
        output_of(["kaustik", "export", scene, "--to", "povray", "--out", str(folder), "--size", options.size, "--photons", str(options.photons)])
        shot = output_of(["povray", "shoot.ini"], folder)
        output_of(["povray", "scene.ini"], folder)
        log.write_text(shot)
        maker.note(note, key)
    found = subprocess.run(["kaustik", "judge", scene, str(folder / "theirs.exr"), "--photons", str(options.reference_photons), "--json",
                            "--out", str(folder / "judged"), *([] if options.causes else ["--no-causes"])], capture_output=True, text=True)
    if found.returncode:
        sys.exit(f"judge_povray: {found.stderr.strip()}")
    photons = int(re.search(r"Surface photons stored:\s+(\d+)", log.read_text())[1])
    return json.loads(found.stdout), photons, {"date": now(), "sources": maker.sources(key) if made(note)["sources"] == key else ""}


def write(file: Path, rows: list[dict]) -> None:
    """With the rows that it has of other scenes, each scene where it was."""
    of_scenes: dict[str, list[dict]] = {}
    for row in rows_in(file):
        of_scenes.setdefault(row["scene"], []).append(row)
    of_scenes |= {row["scene"]: [] for row in rows}
    for row in rows:
        of_scenes[row["scene"]].append(row)
    write_whole(file, list(rows[0]), [row for of in of_scenes.values() for row in of])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--work", type=Path, default=Path("results/runs/judge"))
    parser.add_argument("--size", default="200x150")
    parser.add_argument("--photons", type=int, default=6_000_000)
    parser.add_argument("--reference-photons", type=int, default=4_000_000)
    parser.add_argument("--causes", action="store_true")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    options = parser.parse_args()
    version = output_of(["kaustik", "--version"]).strip().removeprefix("kaustik ")
    classes, scenes, maker = [], [], Maker("kaustik")
    for scene in options.scenes or SCENES:
        verdict, photons, of_it = judged(scene, options, maker)
        name = Path(scene).stem
        for of in verdict["classes"]:
            classes.append({"scene": name, "class": of["name"], "share": of["flux_share"], "c": of["c"],
                            "stderr": "nan" if of["c_stderr"] is None else of["c_stderr"], "verdict": of["verdict"], "version": version, **of_it})
        residual = verdict["residual"]
        scenes.append({"scene": name, "photons": photons, "exposure": verdict["exposure"], "exposure_stderr": verdict["exposure_stderr"],
                       "blur": verdict["blur_px"], "unexplained": residual["unexplained_share"],
                       "significant": residual["significant_pixels"] / residual["pixels"],
                       "findings": " ".join(f"{finding['sentence']}." for finding in verdict["findings"]) or "none", "version": version, **of_it})
    for file, rows in (("classes.csv", classes), ("scenes.csv", scenes)):
        write(options.out / file, rows)


if __name__ == "__main__":
    main()
