#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Chooses each scene's best mixture of stages, by a rule.

    best_mixtures.py CHOICE.csv [--study experiments/best_mixtures.toml]

CHOICE.csv is of experiments/best_mixtures_choice.toml, by table.py --csv. Error times time is what a light tracer keeps constant, so that a mixture
is as much ahead of it as its own product is small: of those that are done the one with the least relMSE, net of the reference's
noise, times ms is chosen. Where the error is below that noise the noise stands for it. Prints, in Markdown, each mixture's product as a part
of the default's (`hierarchical`, `triangles`): below 1 is ahead of it. The chosen one is bold. --study writes the study that runs what was chosen with other photons, pixels and random
numbers, whose figures are shown.
"""

import argparse
import sys
from collections import defaultdict
from pathlib import Path

from runs import head, line
from speed_error import net, number, rows_of

DEFAULT = ("hierarchical", "dense", "triangles")
SETTINGS = ("trace", "driver", "reconstruct")
STUDY = '''# SPDX-License-Identifier: MIT
# Each scene's best mixture of stages, as plotting/best_mixtures.py has chosen it from best_mixtures_choice.toml and written it here.
#   experiments/fetch_meshes.sh --dragons --teapot
#   kaustik experiment run experiments/best_mixtures.toml --resume
#   experiments/rebuild_results.sh best_mixtures
# On two cores without a GPU ten minutes.
name = "best_mixtures"
description = "Error of the caustic against the time of its passes: each scene's best mixture of stages."

[base]
size = "400x300"
frames = 3
warmup = 1
precise = true
reference = "auto"
reference_photons = 16777216
technique = "screen_space_photons"
'''
DENSE = '"emit.photons" = ["128x128", "256x256", "512x512"]\n'
ADAPTIVE = 'emit = ["deferred"]\n"refine.metric" = ["eye"]\n"refine.check" = [128]\n"refine.finest" = [512, 1024, 2048]\n'


def products(rows: list[dict]) -> dict[str, dict[tuple, float]]:
    """relMSE times ms, by scene and mixture."""
    found: dict = defaultdict(dict)
    for row in rows:
        error, ms = net(row), number(row, "ms")
        if row["status"] == "done" and error is not None and ms:
            noise = number(row, "relMSE, reference's own") or 0.0
            found[row["scene"]][tuple(row[key] for key in SETTINGS)] = max(error, noise) * ms
    return found


def chosen(of: dict[tuple, float]) -> tuple:
    return min(of, key=lambda mixture: of[mixture])


def study(found: dict[str, dict[tuple, float]]) -> str:
    """Scenes with the same choice stand together."""
    scenes = defaultdict(list)
    for scene, of in sorted(found.items()):
        scenes[chosen(of)].append(scene)
    text = STUDY
    for mixture, names in sorted(scenes.items()):
        settings = "".join(f'{key} = ["{value}"]\n' for key, value in zip(SETTINGS, mixture) if value != "dense")
        listed = ", ".join(f'"{name}"' for name in names)
        text += f"\n[[permute]]\nscene = [{listed}]\n{settings}{ADAPTIVE if 'adaptive' in mixture else DENSE}"
    return text


def named(mixture: tuple) -> str:
    return ", ".join(f"`{part}`" for part in mixture if part != "dense")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("choice", type=Path)
    parser.add_argument("--study", type=Path)
    arguments = parser.parse_args()
    found = products(rows_of(arguments.choice))
    if not found:
        print(f"best_mixtures: no run of '{arguments.choice}' has an error and a time", file=sys.stderr)
        return 1
    mixtures = sorted({mixture for of in found.values() for mixture in of}, key=lambda mixture: (mixture != DEFAULT, mixture))
    print(head(["scene", *map(named, mixtures)]))
    for scene, of in sorted(found.items()):
        own = of.get(DEFAULT)
        cells = [f"{of[mixture] / own:.2g}" if own and mixture in of else "–" for mixture in mixtures]
        best = chosen(of)
        print(line([f"`{scene}`", *(f"**{cell}**" if mixture == best else cell for mixture, cell in zip(mixtures, cells))]))
    if arguments.study:
        arguments.study.write_text(study(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
