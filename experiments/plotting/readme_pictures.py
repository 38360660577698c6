# SPDX-License-Identifier: MIT
"""The README's pictures: a strip of scenes, and a thumbnail of each technique.

usage: readme_pictures.py build/release/bin/kaustik

Renders each at twice its size with four samples a pixel and writes results/readme/*.png. A minute or two on a software
rasteriser with two cores.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
STRIP = ("pool", "god-rays", "ring", "cornell-bunny", "glass-sphere")
STRIP_SIZE = (216, 162)
THUMBNAIL_SIZE = (132, 99)
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


def render(kaustik: str, scene: str, technique: str, size: tuple[int, int]) -> Image.Image:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [kaustik, "run", scene, "--technique", technique]
            + ["--size", f"{2 * size[0]}x{2 * size[1]}", "--frames", "1", "--warmup", "0"]
            + ["--set", "eye.samples=4", "--out", folder],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        with Image.open(Path(folder) / "beauty.png") as picture:
            return picture.convert("RGB").resize(size, Image.Resampling.BOX)


def save(picture: Image.Image, name: str) -> None:
    file = ROOT / "results/readme" / name
    file.parent.mkdir(exist_ok=True)
    picture.save(file, optimize=True)
    print(f"wrote {file.relative_to(ROOT)}, {file.stat().st_size} bytes", flush=True)


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    kaustik = sys.argv[1]
    gap = 4
    across = len(STRIP) * (STRIP_SIZE[0] + gap) - gap
    strip = Image.new("RGB", (across, STRIP_SIZE[1]), "white")
    for i, scene in enumerate(STRIP):
        picture = render(kaustik, scene, "screen_space_photons", STRIP_SIZE)
        strip.paste(picture, (i * (STRIP_SIZE[0] + gap), 0))
    save(strip, "strip.png")
    for technique, scene in SCENES.items():
        save(render(kaustik, scene, technique, THUMBNAIL_SIZE), f"{technique}.png")


if __name__ == "__main__":
    main()
