#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A figure for a paper: runs of one scene side by side with the truth, details of each, and where each is wrong.

    crops.py RUN... --out DIR [--name crops] [--crop X,Y,W,H ...] [--label TEXT ...]

Each RUN is a folder that `kaustik run --reference …` has written; all are of one scene and size. A column a run and one for the truth: the
caustic's irradiance, all with the exposure of the truth; below it each crop (pixels from the top left corner; without any, the one
with most of the truth's light and the one with most of the first run's error), magnified without smoothing; the error's magnitude,
all on one scale; and time and error together. Writes DIR/NAME.pdf, .svg and .png, and .tex, which includes the PDF with its caption.
"""

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from figures import COLORS, plt
from pictures import LUMINANCE, displayed, find_image, read_image, white_of
from table import CAUSTIC

Crop = tuple[int, int, int, int]  # x, y, width, height


@dataclass
class Run:
    label: str
    image: np.ndarray  # the caustic's irradiance, W/m²: height x width x 3
    truth: np.ndarray
    report: dict

    @property
    def milliseconds(self) -> float:
        """Of the caustic's passes: those of a study's table."""
        return sum(one["gpu_ms"]["median"] for one in self.report["passes"] if one["ran"] and one["name"].startswith(CAUSTIC))

    def words(self) -> list[str]:
        error = self.report["error"]["caustic_irradiance"]
        return [f"{self.milliseconds:.0f} ms", f"relMSE {error['rel_mse']:.2g}"]


def read_run(folder: Path, label: str | None) -> Run:
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    image, truth = (find_image(folder, name, (".exr", ".pfm")) for name in ("caustic", "reference"))
    error = report.get("error", {}).get("caustic_irradiance")
    if error and error["rel_mse"] is None:
        raise ValueError(f"the reference in {folder} has no caustic")
    if truth is None or not error:
        raise ValueError(f"{folder} was not compared with a reference; 'kaustik run --reference auto' does that")
    technique = report["technique"] + (", as published" if report["as_published"] else "")
    return Run(label or technique, read_image(image), read_image(truth), report)


def densest(values: np.ndarray, width: int, height: int) -> Crop:
    """The window of this size with the largest sum."""
    sums = np.zeros((values.shape[0] + 1, values.shape[1] + 1))
    sums[1:, 1:] = np.nan_to_num(values).cumsum(axis=0).cumsum(axis=1)
    window = sums[height:, width:] - sums[:-height, width:] - sums[height:, :-width] + sums[:-height, :-width]
    y, x = np.unravel_index(np.argmax(window), window.shape)
    return int(x), int(y), width, height


def error_of(run: Run) -> np.ndarray:
    return np.abs(run.image - run.truth) @ LUMINANCE


def chosen_crops(run: Run) -> list[Crop]:
    height, width = run.truth.shape[:2]
    size = max(width // 6, 8), max(height // 6, 8)
    light = densest(run.truth @ LUMINANCE, *size)
    error = error_of(run)
    x, y, w, h = light
    error[max(y - h // 2, 0):y + 3 * h // 2, max(x - w // 2, 0):x + 3 * w // 2] = 0.0  # not the same place twice
    return [light, densest(error, *size)]


def cut(image: np.ndarray, crop: Crop) -> np.ndarray:
    x, y, width, height = crop
    return image[y:y + height, x:x + width]


def draw(runs: list[Run], crops: list[Crop]):
    height, width = runs[0].truth.shape[:2]
    white = white_of(runs[0].truth)
    columns = [(run.label, run.image, run) for run in runs] + [("ray-traced truth", runs[0].truth, None)]
    shapes = [height / width, *(crop[3] / crop[2] for crop in crops), height / width]
    figure, rows = plt.subplots(len(shapes), len(columns), squeeze=False, layout="constrained",
                                gridspec_kw={"height_ratios": shapes},
                                figsize=(2.1 * len(columns) + 0.5, 2.1 * sum(shapes) + 0.8))
    largest = max(float(np.percentile(error_of(run), 99.0)) for run in runs) or 1.0
    for column, (label, image, run) in enumerate(columns):
        cells = rows[:, column]
        for axes in cells:
            axes.set(xticks=[], yticks=[])
            axes.grid(False)
        cells[0].imshow(displayed(image, white))
        cells[0].set_title(label, fontsize=8)
        for crop, axes, color in zip(crops, cells[1:], COLORS):
            x, y, w, h = crop
            cells[0].add_patch(plt.Rectangle((x - 0.5, y - 0.5), w, h, fill=False, edgecolor=color, linewidth=1.2))
            axes.imshow(displayed(cut(image, crop), white), interpolation="nearest")
            for spine in axes.spines.values():
                spine.set(visible=True, edgecolor=color, linewidth=2.0)
        if run is None:
            cells[-1].axis("off")
            continue
        shade = cells[-1].imshow(error_of(run), cmap="cividis", vmin=0.0, vmax=largest)
        cells[-1].set_xlabel("\n".join(run.words()), fontsize=8)
    scale = rows[-1, -1].inset_axes((0.02, 0.05, 0.06, 0.9))  # in the place of the truth's error
    figure.colorbar(shade, cax=scale, label="|error|, W/m²")
    return figure


def plain(text: str) -> str:
    return "".join("\\" + letter if letter in "&%$#_{}" else letter for letter in text)


def caption(runs: list[Run]) -> str:
    report = runs[0].report
    parts = "; ".join(f"{run.label}: {', '.join(run.words())}" for run in runs)
    device = report["device"].get("renderer", "")
    return (f"Caustic on {report['scene']['name']}, {report['size'][0]} x {report['size'][1]} pixels, against ray-traced truth. "
            f"{parts}. Times are those of the caustic's passes ({device}).")


def save(runs: list[Run], crops: list[Crop], folder: Path, name: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    figure = draw(runs, crops)
    for suffix, metadata in ((".pdf", {"CreationDate": None}), (".svg", {"Date": None}), (".png", {})):
        figure.savefig(folder / f"{name}{suffix}", metadata=metadata, dpi=200)
    plt.close(figure)
    lines = ["\\begin{figure*}", "  \\centering", f"  \\includegraphics[width=\\linewidth]{{{name}.pdf}}",
             f"  \\caption{{{plain(caption(runs))}}}", f"  \\label{{fig:{name}}}", "\\end{figure*}"]
    (folder / f"{name}.tex").write_text("\n".join(lines) + "\n", encoding="utf-8")


def strip(run: Run, height: int) -> Image.Image:
    """One line: the caustic, a detail of it and of the truth, and the error."""
    white = white_of(run.truth)
    crop = chosen_crops(run)[0]
    largest = float(np.percentile(error_of(run), 99.5)) or 1.0
    shade = plt.get_cmap("cividis")(np.clip(error_of(run) / largest, 0.0, 1.0))[..., :3]
    parts = []
    for pixels, nearest in ((displayed(run.image, white), False), (displayed(cut(run.image, crop), white), True),
                            (displayed(cut(run.truth, crop), white), True), (shade, False)):
        picture = Image.fromarray((255.0 * pixels + 0.5).astype(np.uint8))
        size = round(height * picture.width / picture.height), height
        parts.append(picture.resize(size, Image.Resampling.NEAREST if nearest else Image.Resampling.BOX))
    whole = Image.new("RGB", (sum(part.width for part in parts) + 4 * (len(parts) - 1), height), "white")
    at = 0
    for part in parts:
        whole.paste(part, (at, 0))
        at += part.width + 4
    return whole


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--name", default="crops")
    parser.add_argument("--crop", action="append", default=[], metavar="X,Y,W,H")
    parser.add_argument("--label", action="append", default=[])
    arguments = parser.parse_args()
    try:
        labels = arguments.label + [None] * len(arguments.runs)
        runs = [read_run(folder, label) for folder, label in zip(arguments.runs, labels)]
        of = {(run.report["scene"]["name"], run.truth.shape) for run in runs}
        if len(of) > 1:
            raise ValueError("the runs are of different scenes or sizes")
        height, width = runs[0].truth.shape[:2]
        crops = [tuple(map(int, text.split(","))) for text in arguments.crop] or chosen_crops(runs[0])
        for crop in crops:
            x, y, w, h = crop
            if min(x, y) < 0 or min(w, h) < 1 or x + w > width or y + h > height:
                raise ValueError(f"--crop {x},{y},{w},{h} is not within {width}x{height} pixels")
        save(runs, crops, arguments.out, arguments.name)
    except (OSError, ValueError) as error:
        sys.exit(f"crops: {error}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
