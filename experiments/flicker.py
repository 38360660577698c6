#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Flicker against error: each technique on water that moves, 60 frames, against ray-traced truth of every one.

    PYTHONPATH=build/release/python flicker.py --out results/flicker [--scenes pool cornell-bunny god-rays] [--frames 60]
               [--time-step 0.0333] [--size 200x150] [--photons 256x256] [--reference-photons 1048576]

Writes OUT/flicker.csv and OUT/flicker.svg. With I the caustic's irradiance, R the reference, whose noise is known and taken off, both of
frame t, and the mean over pixels, channels and frames:

- relMSE: that of `kaustik compare`, less what the reference's noise has in it, the mean over the frames;
- change: the root of the mean of (I' - I)², I' that of the next frame, by that of the truth: above 1 the picture changes more than it
  should;
- wrong change: the root of the mean of ((I' - I) - (R' - R))², by that of (R' - R)²: what of the truth's change is missed, and what comes on
  top of it. A picture that stands still has 1.

The ± of each is its standard error: what it would vary by over other stretches of the same water as long as this one. By the jackknife over blocks
of consecutive frames (Künsch 1989), since a frame resembles the next. Blocks of a third of a second are shorter than the longest waves' periods, so that
it is rather too small; it says nothing of other scenes.

References are kept (~/.cache/kaustik), and a row that is in OUT already, with the same settings, is not made again: it can be interrupted. With --anew those are
that are of other sources than the tree's (plotting/sources.py), or of none that are known. No times are taken, so that the machine need not be idle; on two cores
without a GPU half an hour.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "plotting"))
import drawings  # noqa: E402
import kaustik  # noqa: E402
from figures import COLORS, MARKERS, plt  # noqa: E402
from maker import Maker, now, rows_in, write_whole  # noqa: E402

SETTINGS = ["scene", "technique", "as_published", "frames", "time_step", "size", "photons", "reference_photons"]
MEANS = ["relMSE", "change", "wrong change"]
OF_THE_RUN = ["version", "device", "date", "sources"]
COLUMNS = [*SETTINGS, "status", "message", *(column for mean in MEANS for column in (mean, f"{mean} ±")), *OF_THE_RUN]
BLOCKS = 6  # of frames, for the standard errors: ten frames of 60, a third of a second


def numbers(text: str) -> tuple[int, int]:
    width, height = text.split("x")
    return int(width), int(height)


class Truth:
    def __init__(self, irradiance: np.ndarray, standard_error: np.ndarray):
        """Of every frame, with noise that is independent from frame to frame: frames x height x width x 3."""
        self.irradiance, self.standard_error = irradiance.astype(np.float32), standard_error.astype(np.float32)
        self.variance = self.standard_error.astype(np.float64) ** 2
        self.change = np.diff(self.irradiance.astype(np.float64), axis=0)
        self.change_variance = self.variance[1:] + self.variance[:-1]
        self.changes = (self.change**2 - self.change_variance).mean(axis=(1, 2, 3))

    def errors(self, images: np.ndarray) -> np.ndarray:
        """Of each frame."""
        errors = [kaustik.compare(np.ascontiguousarray(image, np.float32), truth, standard_error=sigma)
                  for image, truth, sigma in zip(images, self.irradiance, self.standard_error)]
        return np.array([one["rel_mse"] - one["truth_noise"]["rel_mse"] for one in errors])

    def judge(self, images: np.ndarray) -> dict:
        """The means over frames, with their standard errors."""
        change = np.diff(images, axis=0)
        errors, changes = self.errors(images), (change**2).mean(axis=(1, 2, 3))
        wrong = ((change - self.change) ** 2 - self.change_variance).mean(axis=(1, 2, 3))

        def means(frames: np.ndarray) -> np.ndarray:
            pairs = frames[:-1] & frames[1:]
            truth = max(self.changes[pairs].mean(), 0.0)
            return np.array([errors[frames].mean(), np.sqrt(changes[pairs].mean() / truth), np.sqrt(max(wrong[pairs].mean(), 0.0) / truth)])

        return dict(zip(COLUMNS[COLUMNS.index("relMSE"):], np.ravel(np.column_stack(jackknife(means, len(images))))))


def jackknife(means, frames: int, blocks: int = BLOCKS) -> tuple[np.ndarray, np.ndarray]:
    """Of a function of which frames count: its value of all, and the standard error by leaving out each block of consecutive frames in turn."""
    blocks = max(min(blocks, frames // 2), 1)  # of two frames at least: one alone has no next one
    block = np.arange(frames) * blocks // frames
    of_all = means(np.full(frames, True))
    if blocks == 1:
        return of_all, np.full_like(of_all, np.nan)
    without = np.array([means(block != left_out) for left_out in range(blocks)])
    return of_all, np.sqrt((blocks - 1) / blocks * ((without - without.mean(axis=0)) ** 2).sum(axis=0))


def traced(scene: str, options) -> Truth:
    made = [kaustik.reference(scene, size=numbers(options.size), photons=options.reference_photons,
                              time=frame * options.time_step, seed=frame + 1) for frame in range(options.frames)]
    return Truth(np.stack([np.asarray(one.irradiance)[..., :3] for one in made]),
                 np.stack([np.asarray(one.standard_error)[..., :3] for one in made]))


def set_up(renderer, scene: str, options) -> dict:
    """Gives what the key of its sources is of, as a report has it."""
    takes_grid = renderer.technique not in ("vertex_caustics", "adaptive_caustic_map")
    if takes_grid:
        renderer.set("emit.photons", options.photons)
    # Only the caustic is judged: what is seen through water, and scattered towards the eye, is not made.
    renderer.set("media", "none")
    renderer.set("view", "interface")
    parameters = {param["name"]: str(param["value"]) for param in renderer.params() if "." not in param["name"]}
    return {"technique": renderer.technique, "scene": {"name": scene}, "parameters": parameters}


def rendered(renderer, options) -> np.ndarray:
    """The caustic's irradiance of every frame, in their order: filters over time remember."""
    images = []
    for frame in range(options.frames):
        renderer.step(time=frame * options.time_step)
        images.append(np.array(renderer.read("caustic.irradiance"))[..., :3])
    return np.stack(images).astype(np.float64)


def draw(rows: list[dict], file: Path) -> None:
    scenes = sorted({row["scene"] for row in rows})
    techniques = sorted({row["technique"] for row in rows})
    figure, panels = plt.subplots(1, len(scenes), figsize=(4.0 * len(scenes) + 1.5, 3.6), squeeze=False)
    for scene, axes in zip(scenes, panels[0]):
        for row in (row for row in rows if row["scene"] == scene and row["status"] == "done"):
            index = techniques.index(row["technique"])
            published = row["as_published"] == "true"
            axes.errorbar(float(row["relMSE"]), float(row["wrong change"]), xerr=float(row["relMSE ±"]), yerr=float(row["wrong change ±"]),
                          linestyle="", color=COLORS[index % len(COLORS)], elinewidth=0.8,
                          marker=MARKERS[(index + 3 * (index // len(COLORS))) % len(MARKERS)], fillstyle="none" if published else "full",
                          label=None if published else row["technique"])
        axes.axhline(1.0, color="#999999", linewidth=0.8)  # a picture that stands still
        axes.set(xscale="log", yscale="log", title=scene, xlabel="relMSE, net of the reference's noise")
    panels[0][0].set_ylabel("wrong change, by the truth's change")
    # A technique may be in some of the panels alone.
    handles = {label: handle for axes in panels[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    named = [name for name in dict.fromkeys(row["technique"] for row in rows) if name in handles]
    panels[0][-1].legend([handles[name] for name in named], named, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), title="filled: default\nhollow: as published",
                         title_fontsize=7)
    figure.savefig(file, bbox_inches="tight", metadata=drawings.metadata([file.with_name("flicker.csv")]))
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--scenes", nargs="+", default=["pool", "cornell-bunny", "god-rays"])
    parser.add_argument("--techniques", nargs="+", default=[technique["name"] for technique in kaustik.techniques()])
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--time-step", type=float, default=0.0333)
    parser.add_argument("--size", default="200x150")
    parser.add_argument("--photons", default="256x256")
    parser.add_argument("--reference-photons", type=int, default=1 << 20)
    parser.add_argument("--anew", action="store_true")
    options = parser.parse_args()
    file = options.out / "flicker.csv"
    rows, maker = rows_in(file), Maker(kaustik._kaustik.__file__)
    if options.anew:
        maker.require()
    for scene in options.scenes:
        truth = None
        for technique in options.techniques:
            for published in (False, True):
                row = {"scene": scene, "technique": technique, "as_published": str(published).lower(), "frames": options.frames,
                       "time_step": options.time_step, "size": options.size, "photons": options.photons,
                       "reference_photons": options.reference_photons, "version": kaustik.__version__}
                same = [old for old in rows if all(str(row[key]) == str(old[key]) for key in SETTINGS)]
                is_done = any(old["status"] == "done" and old.get("relMSE ±") for old in same)
                if is_done and not options.anew:
                    continue
                try:
                    with kaustik.open(scene, size=numbers(options.size), technique=technique, as_published=published, time=0.0) as renderer:
                        key = maker.tree.key_of(set_up(renderer, scene, options))
                        if is_done and all(old.get("sources") == key for old in same):
                            continue
                        row |= {"device": renderer.device, "date": now()}
                        images = rendered(renderer, options)
                    truth = truth or traced(scene, options)
                    row |= {"status": "done", "sources": maker.sources(key), **{key: f"{value:.4g}" for key, value in truth.judge(images).items()}}
                except kaustik.ConfigError as error:
                    row |= {"status": "refused", "message": str(error)}
                rows = [*(old for old in rows if old not in same), row]
                write_whole(file, COLUMNS, rows)
                print(*(row.get(key, "") for key in (*SETTINGS[:3], *COLUMNS[len(SETTINGS):-len(OF_THE_RUN)])), sep=", ", flush=True)
    if len({tuple(str(row[key]) for key in SETTINGS[3:]) for row in rows}) > 1:
        sys.exit(f"flicker: the rows of {file} are of different settings, and are not drawn together")
    draw(rows, options.out / "flicker.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
