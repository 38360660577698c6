#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A page of pictures: each technique on a scene that shows what it is for.

    gallery.py [--kaustik build/release/bin/kaustik] [--out results] [--size 400x300] [--reference-photons 16777216]

Writes OUT/gallery.md and OUT/gallery/TECHNIQUE.jpg: the caustic, a detail of it and of the truth, its error. Times need an idle machine.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from crops import read_run, strip
from readme_pictures import SCENES

ROOT = Path(__file__).resolve().parents[2]
HEIGHT = 150  # px of a strip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kaustik", type=Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--out", type=Path, default=ROOT / "results")
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--reference-photons", default="16777216")
    options = parser.parse_args()
    (options.out / "gallery").mkdir(parents=True, exist_ok=True)
    listed = json.loads(subprocess.run([options.kaustik, "list", "techniques", "--json"], check=True, capture_output=True,
                                       text=True).stdout)
    of = {technique["name"]: technique for technique in listed}
    rows, last = [], {}
    for technique, scene in SCENES.items():
        command = ["run", scene, "--technique", technique, "--size", options.size, "--precise", "--reference", "auto",
                   "--reference-photons", options.reference_photons]
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([options.kaustik, *command, "--out", folder], check=True, stdout=subprocess.DEVNULL)
            run = read_run(Path(folder), None)
        strip(run, HEIGHT).save(options.out / f"gallery/{technique}.jpg", quality=88)
        last = run.report
        rows.append(f"| **`{technique}`** on `{scene}`<br>{of[technique]['source'] or '–'}<br>{', '.join(run.words())} | "
                    f"![{technique} on {scene}](gallery/{technique}.jpg)<br>`kaustik {' '.join(command)}` |")
        print(technique, *run.words(), flush=True)
    page = ["# Gallery", "",
            "Each technique by its defaults on a scene that shows what it is for: the irradiance of its caustic, a detail of it, the same of the "
            "truth, and the magnitude of its error (bright is wrong; each to its own scale). All scenes and counts: "
            f"[speed_and_error.md](speed_and_error.md). Pictures and figures are of {last['timing']['date'][:10]}; errors of a later day are there, and in "
            "[all_scenes.md](all_scenes.md) for the screen's tracer and `raytraced`.", "",
            "| technique, paper, caustic's passes and error | caustic, detail, truth, error |", "| --- | --- |", *rows, "",
            f"*`experiments/plotting/gallery.py`; version {last['version']}, {last['device']['renderer']}, {last['timing']['date'][:10]}; "
            "made by hand of the command, no test holds it to the code.*", ""]
    (options.out / "gallery.md").write_text("\n".join(page), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
