#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Techniques against certified light: how many pixels of each are proved wrong, and by how much at least.

    /usr/bin/python3 experiments/proved_wrong.py [--out results/proved_wrong.csv] [--work results/runs/proved_wrong] [--scenes NAME...] [--techniques NAME...]
                                                 [--photons 256x256...] [--size 200x150]

For each scene, technique and number of photons `kaustik run --reference certified`, of one frame; the certificate, of two interactions, is made by the first run of a
scene and kept in the cache. Writes a row each; those of before that are not asked for stay. Shares are of `lit` pixels, as the certificate counts them: of `dark` ones
a channel is proved too dark, of `bright` ones too bright. Where light goes on beyond the second interaction, nothing is proved too bright; there `bright for two` are
those brighter than paths of two interactions can be, which longer ones may explain. `undecided` lie in an interval wider than a fifth. `off by 1 %`, `off by 10 %`: the
sum of the channels is proved too dark, or too bright, by more than that share of the nearest bound; `median`: by how much the pixel in the middle is. `unlit` is the number
of pixels that are proved wrong where there is no light, or hardly any. No noise is in the bounds: a pixel outside is wrong for these photons. `mean`: of all pixels and
channels, in W/m², and between what the certificate has it. `seconds`: what the certificate took.
"""

import argparse
import itertools
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from maker import Maker, now, rows_in, write_whole  # noqa: E402
from pictures import find_image, read_image  # noqa: E402
from sources import Tree  # noqa: E402

KAUSTIK = ROOT / "build/release/bin/kaustik"
SCENES = ("flat-water", "experiments/certified/smooth_wave.toml", "ring", "pool-reflections", "glass-sphere")
TECHNIQUES = ("exact_rays", "screen_space_photons", "caustic_triangles", "caustic_map", "hierarchical_caustic_map", "multi_resolution")
SETTINGS = ("scene", "technique", "emit.photons", "size")
COLUMNS = (*SETTINGS, "status", "message", "lit", "dark", "bright", "bright for two", "undecided", "off by 1 %", "off by 10 %", "median",
           "unlit", "mean", "mean least", "mean most", "median width", "seconds", "version", "date", "sources")


def picture(folder: pathlib.Path, name: str) -> np.ndarray:
    return read_image(find_image(folder, name, (".exr", ".pfm")) or folder / f"{name}.exr")


def cache_folder() -> pathlib.Path:
    """As framework/run/cache_folder.cpp has it."""
    if own := os.environ.get("KAUSTIK_CACHE"):
        return pathlib.Path(own)
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path(os.environ["HOME"]) / ".cache") / "kaustik"


def departures(values: np.ndarray, lower: np.ndarray, upper: np.ndarray, is_complete: bool) -> np.ndarray:
    """By what share of the nearest bound each pixel is outside at least, 0 inside; of the sums of the channels."""
    values, lower, upper = (image[..., :3].sum(axis=-1, dtype=float) for image in (values, lower, upper))
    below = np.divide(lower - values, lower, out=np.zeros_like(values), where=(values < lower) & (lower > 0.0))
    above = np.divide(values - upper, upper, out=np.zeros_like(values), where=(values > upper) & (upper > 0.0))
    return np.maximum(below, above) if is_complete else below


def lit_of(lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Pixels that may have more than a thousandth of what the certainly lit ones have in the mean (framework/certify/certificate.cpp)."""
    low, high = (image[..., :3].sum(axis=-1, dtype=float) for image in (lower, upper))
    return high > (1e-3 * low[low > 0.0].mean() if (low > 0.0).any() else 0.0)


def outside(values: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which pixels have a channel below its interval, and which of the others one above, or one that is no number (framework/certify/verdict.cpp)."""
    below = (values < lower).any(axis=-1)
    return below, ~(values <= upper).all(axis=-1) & ~below


def key_of(tree: Tree, folder: pathlib.Path) -> str:
    """Of the run's sources and of what certifies."""
    report = json.loads((folder / "report.json").read_text())
    return tree.key_of_files({*tree.files_of(report), *tree.closure(set((ROOT / "framework/certify").rglob("*")))})


def row_of(folder: pathlib.Path) -> dict:
    """The figures of a run that was judged by a certificate."""
    found = json.loads((folder / "certified.json").read_text())
    certificate = found["certificate"]
    lower, upper = (picture(cache_folder() / "certificates", f"{certificate['key']}.{end}") for end in ("lower", "upper"))
    values, is_complete = picture(folder, "caustic"), certificate["energy"]["beyond_interactions_w"][1] <= 0.0
    lit, (below, above) = lit_of(lower, upper), outside(values, lower, upper)
    counted = {"proved_too_dark": below.sum(), "proved_too_bright" if is_complete else "too_bright_for_certified_paths": above.sum()}
    if int(lit.sum()) != certificate["pixels"]["lit"] or any(found[name] != count for name, count in counted.items()):
        raise ValueError(f"'{folder}' has other counts than its pictures")
    away, count = departures(values, lower, upper, is_complete)[lit], max(int(lit.sum()), 1)
    bright = float((above & lit).sum()) / count
    return {"status": "done", "lit": int(lit.sum()), "dark": float((below & lit).sum()) / count, "bright": bright if is_complete else None, "bright for two": None if is_complete else bright,
            "undecided": found["undecided"] / count, "off by 1 %": float((away > 0.01).mean()), "off by 10 %": float((away > 0.1).mean()), "median": float(np.median(away)),
            "unlit": int(((below | above if is_complete else below) & ~lit).sum()), "mean": found["mean_w_per_m2"], "mean least": found["mean_between_w_per_m2"][0],
            "mean most": found["mean_between_w_per_m2"][1], "median width": certificate["pixels"]["median_width"], "seconds": certificate["seconds"],
            "version": json.loads((folder / "report.json").read_text())["version"]}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "results/proved_wrong.csv")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "results/runs/proved_wrong")
    parser.add_argument("--kaustik", type=pathlib.Path, default=KAUSTIK)
    parser.add_argument("--scenes", nargs="+", default=list(SCENES))
    parser.add_argument("--techniques", nargs="+", default=list(TECHNIQUES))
    parser.add_argument("--photons", nargs="+", default=["256x256"])
    parser.add_argument("--size", default="200x150")
    options = parser.parse_args()
    rows = {tuple(row[name] for name in SETTINGS): row for row in rows_in(options.out)}
    maker = Maker(options.kaustik)
    for scene, technique, photons in itertools.product(options.scenes, options.techniques, options.photons):
        settings = (pathlib.PurePath(scene).stem.replace("_", "-"), technique, photons, options.size)
        folder, begin = options.work / "-".join(settings), now()
        done = subprocess.run([options.kaustik, "run", scene, "--technique", technique, "--size", options.size, "--set", f"emit.photons={photons}", "--frames", "1", "--warmup", "0",
                               "--reference", "certified", "--out", folder], cwd=ROOT, text=True, capture_output=True)
        row = row_of(folder) if done.returncode == 0 else {"status": "refused", "message": (done.stderr.strip().splitlines() or ["no reason was given"])[-1]}
        key = maker.sources(key_of(maker.tree, folder)) if done.returncode == 0 else ""
        rows[settings] = {**dict(zip(SETTINGS, settings)), **row, "date": begin, "sources": key}
        print(f"{', '.join(settings)}: {row['status']} {row.get('message', '')}", flush=True)
        write_whole(options.out, list(COLUMNS), [{column: f"{value:.6g}" if isinstance(value, float) else value for column, value in rows[of].items()} for of in sorted(rows)])
    return 0


if __name__ == "__main__":
    sys.exit(main())
