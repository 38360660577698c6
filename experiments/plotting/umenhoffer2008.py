#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of the studies of caustic triangles (experiments/umenhoffer2008_*.toml), in Markdown.

    umenhoffer2008.py steps|error|reach|secant|grazing|points|merge|seen RESULTS

steps:   ms of every step of a frame, median over the repeats with their spread.
error:   relMSE and time from emission to gather, and who is on the front of error against time.
reach:   by scene, shares of the emitted flux that a cube around each generator cannot reach, by cause.
secant:  photons that the secant search has right, and how far off, by size, layers and their order.
grazing: error by the angle of the receiver, and light where the truth has none.
points:  points of one texel, splats of several sizes and triangles: errors by the number of photons.
merge:   time and error over the size up to which cells are merged.
seen:    caustics in a mirror and through glass, as experiments/umenhoffer2008_seen.sh has rendered them.
"""

import argparse
import statistics
import sys
from collections import defaultdict
from pathlib import Path

from runs import causes_of, error_of, head, line, maps_of, ms_of, passes_of, print_table, runs_of, scene_of, spread, value

STEPS = [("layers around", "around."), ("photon hit image: emit", "emit."),
         ("photon hit image: interactions", "specular."), ("photon hit image: secant search", "trace."),
         ("receivers on the faces", "generator."), ("triangles", "reconstruct."),
         ("projection", "gather."), ("reflections and refractions", "view."), ("the rest", "")]


def steps(rows: list[dict]) -> None:
    names = [name for name, _ in STEPS]
    print(head(["scene"] + names + ["frame, ms"]))
    by_scene: dict = defaultdict(list)
    for row in rows:
        times = dict.fromkeys(names, 0.0)
        for one, ms in passes_of(row["report"]).items():
            times[next(name for name, start in STEPS if one.startswith(start))] += ms
        times["frame"] = row["report"]["frame_ms"]["median"]
        by_scene[scene_of(row)].append(times)
    for scene, found in by_scene.items():
        print(line([f"`{scene}`"] + [f"{statistics.median(t[name] for t in found):.0f}" for name in names] +
                   [spread([t["frame"] for t in found])]))


def name_of(row: dict) -> str:
    technique = row["report"]["technique"]
    name = value(row, "reconstruct")
    if row["report"].get("as_published"):
        return f"{technique}, as published"
    if technique == "caustic_triangles":
        if name == "triangles":
            name += ", " + value(row, "reconstruct.triangles.shading")
        return name + " @ cube"
    return name + (" @ screen" if technique == "screen_space_photons" else " @ light")


def error(rows: list[dict]) -> None:
    by_scene: dict = defaultdict(list)
    for row in rows:
        by_scene[scene_of(row)].append((ms_of(row["report"]) + ms_of(row["report"], ("around.", "generator.")),
                                        error_of(row)["rel_mse"],
                                        row["report"]["error"]["caustic_irradiance"]["rel_mse"],
                                        name_of(row), int(row["emit.photons"].split("x")[0])))
    print("relMSE against the paths that the photons model (against all light), and ms from emission to "
          "gather; **bold**: nothing is both faster and better")
    for scene, found in by_scene.items():
        print(f"\n`{scene}`\n")
        photons = sorted({one[4] for one in found})
        print(head(["reconstruction"] + [f"{n}²" for n in photons]))
        front = [one for one in found if not any(o[0] < one[0] and o[1] < one[1] for o in found)]
        for name in sorted({one[3] for one in found}):
            cells = []
            for n in photons:
                cell = [one for one in found if one[3] == name and one[4] == n]
                text = "; ".join(f"{one[1]:.2g} ({one[2]:.2g}), {one[0]:.0f}" for one in cell)
                cells.append(f"**{text}**" if cell and cell[0] in front else text or "–")
            print(line([name] + cells))


def reach(rows: list[dict]) -> None:
    causes = causes_of(rows, ["hidden_in_map", "beyond_layers", "edge_on", "bounce_limit", "internal_reflection_limit",
                              "untraced_branch", "as_published", "tracer", "unresolved"])
    print(head(["scene", "generators", "stored", *causes, "right hits", "relMSE", "of modelled paths"]))
    for row in rows:
        report = row["report"]
        energy = report["energy"]
        emitted = energy["emitted_w"]
        if not emitted:
            print(line([f"`{scene_of(row)}`", "0", "nothing is specular"] + [""] * (len(causes) + 3)))
            continue
        judged = report["error"]
        models = judged.get("modelled_paths", {}).get("caustic_irradiance")
        right = report["hits"].get("agreement_reachable")
        print(line([f"`{scene_of(row)}`", maps_of(row)[0],
                    f"{100 * energy['deposited_w'] / emitted:.2f} %"] +
                   [f"{100 * energy['lost_w'].get(cause, 0.0) / emitted:.2f} %" for cause in causes] +
                   ["–" if right is None else f"{100 * right:.2f} %",
                    f"{judged['caustic_irradiance']['rel_mse']:.3g}",
                    f"{models['rel_mse']:.3g}" if models else "–"]))


def secant(rows: list[dict]) -> None:
    for vary, fixed, at in (("around.cubes.size", "around.cubes.layers", 4),
                            ("around.cubes.layers", "around.cubes.size", 256)):
        chosen = [row for row in rows if value(row, fixed) == at]
        values = sorted({value(row, vary) for row in chosen})
        print(f"\nBy `{vary}`, at `{fixed}` = {at}: right hits of those that there are, %; of the hits, "
              "distance that 99 % are within, mm; ms of the search\n")
        print(head(["scene", "order"] + [str(v) for v in values]))
        for scene in sorted({scene_of(row) for row in chosen}):
            for order in ("smooth", "depth"):
                cells = []
                for v in values:
                    found = [row for row in chosen if scene_of(row) == scene and value(row, vary) == v
                             and value(row, "around.cubes.order") == order]
                    if not found:
                        cells.append("–")
                        continue
                    report = found[0]["report"]
                    hits = report["hits"]
                    ms = passes_of(report).get("trace.secant", 0.0)
                    within = hits["distance_m"]["p99"] if "distance_m" in hits else hits.get("p99_m", 0.0)
                    cells.append(f"{100 * hits['agreement_reachable']:.2f}, {1000 * within:.2g}, {ms:.0f}")
                print(line([f"`{scene}`", order] + cells))


def grey(path: Path):
    """The mean of an image's channels, as an array."""
    sys.path.insert(0, "/usr/lib/python3/dist-packages")
    import OpenImageIO
    return OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[:, :, :3].mean(axis=2)


def leaked(row: dict, results: Path) -> float:
    """What is too much where the truth has hardly any, of all its light, summed over pixels."""
    image = grey(results / row["folder"] / "caustic.exr")
    truth = grey(results / row["folder"] / "reference.exr")
    dark = truth < 1e-3 * truth.max()
    return float((image - truth)[dark].clip(min=0.0).sum() / truth.sum())


def grazing(rows: list[dict], results: Path) -> None:
    def kind(row: dict) -> str:
        name = value(row, "reconstruct")
        return name if name == "triangles" else f"splats of {value(row, 'reconstruct.fixed.diameter')} texels"

    names = sorted({kind(row) for row in rows}, key=lambda n: (n != "triangles", len(n), n))
    print(head(["scene"] + names))
    scenes = list(dict.fromkeys(scene_of(row) for row in rows))
    for scene in scenes:
        cells = []
        for name in names:
            row = next(r for r in rows if scene_of(r) == scene and kind(r) == name)
            errors = error_of(row)
            cells.append(f"{errors['rel_mse']:.2g}; {errors['energy_ratio']:.3f}; {100 * leaked(row, results):.2f} %")
        print(line([f"`{scene}`"] + cells))


def points(rows: list[dict]) -> None:
    def kind(row: dict) -> str:
        if value(row, "reconstruct") == "triangles":
            return "triangles"
        diameter = value(row, "reconstruct.fixed.diameter")
        return "points" if diameter == 1 else f"splats of {diameter}"

    names = sorted({kind(row) for row in rows}, key=lambda n: (n == "triangles", n != "points", len(n), n))
    counts = sorted({row["emit.photons"] for row in rows}, key=lambda c: int(c.split("x")[0]))
    print("relMSE; SMAPE; FLIP; energy ratio, all against the modelled paths; **bold**: the least relMSE of "
          "points and splats, the size that is right")
    for scene in dict.fromkeys(scene_of(row) for row in rows):
        print(f"\n`{scene}`\n")
        print(head(["photons"] + names))
        for count in counts:
            found = {kind(row): error_of(row) for row in rows
                     if scene_of(row) == scene and row["emit.photons"] == count}
            best = min((one["rel_mse"], name) for name, one in found.items() if name != "triangles")[1]
            cells = []
            for name in names:
                one = found[name]
                text = (f"{one['rel_mse']:.2g}; {one['smape']:.2f}; {one['flip_hdr']:.3f}; "
                        f"{one['energy_ratio']:.3f}")
                cells.append(f"**{text}**" if name == best else text)
            print(line([count] + cells))


def merge(rows: list[dict]) -> None:
    sizes = sorted({value(row, "reconstruct.triangles.merge") for row in rows})
    print(head(["scene", "photons"] + [f"{size:g} px" for size in sizes]))
    cells: dict = defaultdict(dict)
    for row in rows:
        report = row["report"]
        ms = passes_of(report).get("reconstruct.triangles", 0.0)
        lost = report["energy"]["lost_w"]
        arrived = report["energy"]["deposited_w"] + sum(
            lost.get(cause, 0.0) for cause in ("hidden_in_map", "outside_map", "edge_on", "discarded_triangle"))
        ratio = report["map"]["flux_ratio"] * arrived / report["energy"]["deposited_w"] - 1.0
        cells[(scene_of(row), row["emit.photons"])][value(row, "reconstruct.triangles.merge")] = (
            f"{ms:.0f}; {error_of(row)['rel_mse']:.3g}; {ratio:+.0e}")
    for (scene, photons), found in cells.items():
        print(line([f"`{scene}`", photons] + [found.get(size, "–") for size in sizes]))


def seen(results: Path) -> None:
    import numpy
    print(head(["scene", "view", "light seen, of the truth's", "relMSE", "specular pixels"]))
    for scene in ("mirror-room", "pane-room"):
        truth = grey(results / f"{scene}.caustic_view.exr")
        for view in ("around", "refraction"):
            image = (grey(results / f"{scene}-{view}-on" / "beauty.exr")
                     - grey(results / f"{scene}-{view}-off" / "beauty.exr"))
            # What the eye sees straight is no part of it.
            off = grey(results / f"{scene}-around-off" / "beauty.exr")
            there = abs(off - grey(results / f"{scene}-straight" / "beauty.exr")) > 1e-6
            image = numpy.where(there, image, 0.0)
            epsilon = 0.01 * truth[there].mean() ** 2
            error_square = (image - truth) ** 2 / (truth ** 2 + epsilon)
            print(line([f"`{scene}`", view, f"{image[there].sum() / truth[there].sum():.3f}",
                        f"{error_square[there].mean():.3g}", int(there.sum())]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=["steps", "error", "reach", "secant", "grazing", "points", "merge", "seen"])
    parser.add_argument("results", type=Path)
    arguments = parser.parse_args()
    if arguments.table == "seen":
        seen(arguments.results)
        return 0
    rows = runs_of(arguments.results)
    if arguments.table == "grazing":
        return print_table(grazing, rows, arguments.results)
    return print_table({"steps": steps, "error": error, "reach": reach, "secant": secant, "points": points,
                        "merge": merge}[arguments.table], rows)


if __name__ == "__main__":
    sys.exit(main())
