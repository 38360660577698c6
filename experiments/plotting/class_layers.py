#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The classes of a reference side by side, each as bright as it can be shown.

    class_layers.py NAME.classes.exr --out classes.png [--columns 3]

Above each picture stand the class, its share of the picture's irradiance, and by how much it is brighter than all of the light is shown.
"""

import argparse
import pathlib

import numpy as np
import OpenImageIO as oiio

from figures import plt


def layers(file: pathlib.Path) -> tuple[list[str], dict[str, np.ndarray]]:
    """The classes' names in their order, and by name the image; of all it is ""."""
    source = oiio.ImageInput.open(str(file))
    if source is None:
        raise SystemExit(f"class_layers: {file} cannot be read: {oiio.geterror()}")
    spec = source.spec()
    names = spec.get_string_attribute("kaustik.classes").split()
    if not names:
        raise SystemExit(f"class_layers: {file} has no classes; 'kaustik reference SCENE --classes N' makes one")
    values = source.read_image(format="float")
    place = {name: i for i, name in enumerate(spec.channelnames)}
    return names, {name: np.stack([values[..., place[f"{name}.{color}" if name else color]] for color in "RGB"], -1) for name in ["", *names]}


def white(image: np.ndarray) -> float:
    """What is shown as white: the brightest but for one pixel in two hundred of those that are lit."""
    lit = image.max(axis=-1)
    return float(np.percentile(lit[lit > 0], 99.5)) if (lit > 0).any() else 1.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--columns", type=int, default=3)
    arguments = parser.parse_args()
    names, images = layers(arguments.file)
    whole = images[""].sum()
    shown = ["", *names]
    rows = -(-len(shown) // arguments.columns)
    height, width, _ = images[""].shape
    figure, axes = plt.subplots(rows, arguments.columns, squeeze=False, figsize=(2.4 * arguments.columns, rows * (2.4 * height / width + 0.25)))
    for axis in axes.flat:
        axis.axis("off")
    for axis, name in zip(axes.flat, shown):
        image = images[name]
        axis.imshow(np.clip(image / white(image), 0.0, 1.0) ** (1 / 2.2), interpolation="nearest")
        share = 100.0 * image.sum() / whole if whole > 0 else 0.0
        axis.set_title(f"{name}: {share:.2g} %, × {white(images['']) / white(image):.2g}" if name else "all", fontsize=8)
    figure.tight_layout(pad=0.3)
    figure.savefig(arguments.out, dpi=110)


if __name__ == "__main__":
    main()
