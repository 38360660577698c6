# SPDX-License-Identifier: MIT
"""The README's pictures: a strip of scenes, and a thumbnail of each technique.

    readme_pictures.py build/release/bin/kaustik [--out results/readme]

Renders each at twice its size with four samples a pixel and writes OUT/*.png and, next to them, OUT/pictures.csv, which says of which run each is. A
minute or two on a software rasteriser with two cores.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

import picture_rows

ROOT = Path(__file__).resolve().parents[2]
STRIP = ("pool", "god-rays", "ring", "cornell-bunny", "glass-sphere")
STRIP_TECHNIQUE = "screen_space_photons"
STRIP_SIZE = (216, 162)
THUMBNAIL_SIZE = (132, 99)
COMMAND = "experiments/plotting/readme_pictures.py build/release/bin/kaustik"
SCENES = {  # one that shows what the technique is for
    "screen_space_photons": "pool",
    "exact_rays": "concave-glass",
    "raytraced": "cornell-bunny",
    "planar": "pool",
    "differential_area": "flat-water",
    "caustic_map": "glass-sphere",
    "vertex_caustics": "glass-sphere",
    "multi_resolution": "glass-sphere",
    "lens_splats": "glass-sphere",
    "eye_gather": "glass-sphere",
    "caustic_triangles": "ring",
    "hierarchical_caustic_map": "glass-bunny",
    "adaptive_caustic_map": "glass-bunny",
}


def render(kaustik: str, scene: str, technique: str, size: tuple[int, int]) -> tuple[Image.Image, dict]:
    """The picture, and the row of its run."""
    command = ["run", scene, "--technique", technique, "--size", f"{2 * size[0]}x{2 * size[1]}", "--frames", "1", "--warmup", "0", "--set", "eye.samples=4"]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([kaustik, *command, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        report = json.loads((Path(folder) / "report.json").read_text(encoding="utf-8"))
        with Image.open(Path(folder) / "beauty.png") as picture:
            smaller = picture.convert("RGB").resize(size, Image.Resampling.BOX)
    return smaller, picture_rows.row_of(report, command, COMMAND)


def save(picture: Image.Image, file: Path, rows: list[dict]) -> list[dict]:
    """The rows of the runs that it is made of."""
    file.parent.mkdir(parents=True, exist_ok=True)
    picture.save(file, optimize=True)
    print(f"wrote {file.name}, {file.stat().st_size} bytes", flush=True)
    return [row | {"picture": file.name, "sha256": picture_rows.digest_of(file)} for row in rows]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kaustik")
    parser.add_argument("--out", type=Path, default=ROOT / "results/readme")
    options = parser.parse_args()
    gap = 4
    across = len(STRIP) * (STRIP_SIZE[0] + gap) - gap
    strip, of_strip = Image.new("RGB", (across, STRIP_SIZE[1]), "white"), []
    for i, scene in enumerate(STRIP):
        picture, row = render(options.kaustik, scene, STRIP_TECHNIQUE, STRIP_SIZE)
        strip.paste(picture, (i * (STRIP_SIZE[0] + gap), 0))
        of_strip.append(row)
    rows = save(strip, options.out / "strip.png", of_strip)
    for technique, scene in SCENES.items():
        picture, row = render(options.kaustik, scene, technique, THUMBNAIL_SIZE)
        rows += save(picture, options.out / f"{technique}.png", [row])
    picture_rows.write(options.out / "pictures.csv", rows)


if __name__ == "__main__":
    main()
