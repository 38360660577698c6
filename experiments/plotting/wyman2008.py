#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of the studies of caustic maps (experiments/wyman2008_*.toml), in Markdown.

    wyman2008.py times|paper|error|reach|ringing|flicker RESULTS

times:   frames of splats of four sizes and by lens over those of fixed splats, by scene and photons,
         median over the repeats with their spread.
paper:   the same of Table 1 of Wyman and Dachsbacher 2008.
error:   relMSE and time from emission to gather of every reconstruction, and who is on the front
         of error against time.
reach:   by scene, shares of the emitted flux that caustic maps cannot reach, by cause.
ringing: RMS of what the caustic under a ball differs by from the truth, by bands of wavelength
         along the radius, in W/m².
flicker: change from frame to frame beside the truth's.
"""

import argparse
import math
import statistics
import sys
from collections import defaultdict
from pathlib import Path

from runs import causes_of, head, line, ms_of, print_table, runs_of, spread

# Frames a second: fixed splats, four sizes, thin lens (Wyman, Dachsbacher 2008, Table 1).
TABLE_1 = [
    ("Ball & Dragon, 256 k", 512, 25.1, 21.5, 19.5), ("Ball & Dragon, 256 k", 1024, 11.3, 9.5, 8.0),
    ("Beethoven, 5 k", 512, 49.4, 27.7, 38.8), ("Beethoven, 5 k", 1024, 13.4, 7.9, 11.1),
    ("Buddha, 50 k", 512, 35.1, 25.6, 26.8), ("Buddha, 50 k", 1024, 13.5, 8.6, 8.5),
    ("Bunny, 70 k", 512, 30.8, 26.4, 27.6), ("Bunny, 70 k", 1024, 12.9, 9.6, 10.3),
    ("Gargoyle, 205 k", 512, 16.3, 13.3, 14.1), ("Gargoyle, 205 k", 1024, 8.4, 6.4, 6.2)]


def row_of(report: dict) -> str:
    """Which of a technique's two rows a run took."""
    return "as published" if report.get("as_published") else "default"


def times(rows: list[dict]) -> None:
    by_cell: dict = defaultdict(dict)
    for row in rows:
        report = row["report"]
        key = (row["scene"], report["scene"]["triangles"], row["emit.photons"], row_of(report))
        by_cell[key].setdefault(row["repeat"], {})[row["technique"]] = (
            report["frame_ms"]["median"], ms_of(report))
    print(head(["scene", "triangles", "photons", "row", "fixed, ms a frame", "four sizes / fixed",
                "lens / fixed", "caustic alone: four sizes", "lens"]))
    for (scene, triangles, photons, which), repeats in sorted(by_cell.items(), key=lambda c: c[0]):
        whole = [r for r in repeats.values() if len(r) == 3]
        if not whole:
            continue
        def ratio(name: str, part: int) -> str:
            return spread([r[name][part] / r["caustic_map"][part] for r in whole])
        print(line([f"`{scene}`", triangles, photons, which,
                    f"{statistics.median(r['caustic_map'][0] for r in whole):.0f}",
                    ratio("multi_resolution", 0), ratio("lens_splats", 0),
                    ratio("multi_resolution", 1), ratio("lens_splats", 1)]))


def paper(rows: list[dict]) -> None:
    print(head(["scene", "photons", "four sizes / fixed", "lens / fixed"]))
    for scene, photons, fixed, four, lens in TABLE_1:
        print(line([scene, f"{photons}²", f"{fixed / four:.2f}", f"{fixed / lens:.2f}"]))


def name_of(row: dict) -> str:
    """What a run's reconstruction is called in tables."""
    parameters = row["report"]["parameters"]
    published = ", as published" if row["report"].get("as_published") else ""
    if row["report"]["technique"] == "screen_space_photons":
        return "screen_space_photons" + published
    name = parameters["reconstruct"] + published
    if name == "fixed" and parameters["reconstruct.fixed.diameter"] == 1:
        name = "points, blur"
    if parameters["reconstruct"] == "four_radii":
        name += ", " + parameters["filter.blend.interpolant"]
    if parameters["reconstruct"] == "levels":
        name += ", " + parameters["filter.levels.from"]
    if parameters["reconstruct"] == "lens":
        name += ", " + parameters["specular.two_interfaces.lens"]
    return name + (" @ screen" if parameters["reconstruct.space"] == "screen" else "")


def error(rows: list[dict]) -> None:
    by_scene: dict = defaultdict(list)
    for row in rows:
        judged = row["report"]["error"]
        errors = judged.get("modelled_paths", judged)["caustic_irradiance"]
        by_scene[row["scene"]].append((ms_of(row["report"]), errors["rel_mse"], errors["flip_ldr"],
                                       name_of(row), row["emit.photons"].split("x")[0]))
    for scene, found in by_scene.items():
        photons = sorted({int(one[4]) for one in found})
        print(f"\n`{scene}`: relMSE against the paths that each models, and ms from emission to gather;"
              " **bold**: nothing is both faster and better\n")
        print(head(["reconstruction"] + [f"{n}²" for n in photons]))
        front = {one for one in found
                 if not any(o[0] < one[0] and o[1] < one[1] for o in found)}
        names = sorted({one[3] for one in found})
        for name in names:
            cells = []
            for n in photons:
                cell = [one for one in found if one[3] == name and int(one[4]) == n]
                text = " ".join(f"{one[1]:.2g}, {one[0]:.0f}" for one in cell)
                cells.append(f"**{text}**" if cell and cell[0] in front else text or "–")
            print(line([name] + cells))


def reach(rows: list[dict]) -> None:
    causes = causes_of(rows, ["hidden_in_map", "outside_map", "bounce_limit", "internal_reflection_limit", "as_published",
                              "untraced_branch", "edge_on", "tracer", "unresolved"])
    print(head(["scene", "distance", "arrived in the map", *causes, "right of what the light sees",
                "relMSE", "of modelled paths"]))
    for row in rows:
        report = row["report"]
        energy = report["energy"]
        emitted = energy["emitted_w"]
        if not emitted:
            print(line([f"`{row['scene']}`", row["specular.two_interfaces.distance"],
                        "nothing is specular"] + [""] * (len(causes) + 3)))
            continue
        judged = report["error"]
        models = judged.get("modelled_paths", {}).get("caustic_irradiance")
        right = report["hits"].get("agreement_reachable")
        print(line([f"`{row['scene']}`", row["specular.two_interfaces.distance"],
                    f"{100 * energy['deposited_w'] / emitted:.2f} %"] +
                   [f"{100 * energy['lost_w'].get(cause, 0.0) / emitted:.2f} %" for cause in causes] +
                   ["–" if right is None else f"{100 * right:.2f} %",
                    f"{judged['caustic_irradiance']['rel_mse']:.3g}",
                    f"{models['rel_mse']:.3g}" if models else "–"]))


def ringing(rows: list[dict], results: Path) -> None:
    import numpy
    sys.path.insert(0, "/usr/lib/python3/dist-packages")
    import OpenImageIO

    def read(path: Path):
        return OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[:, :, :3].mean(axis=2)

    bands = [(4, 8), (8, 16), (16, 32), (32, 64)]
    print(head(["splats", "RMS, W/m²"] + [f"{low} to {high} px" for low, high in bands]))
    for row in rows:
        image = read(results / row["folder"] / "caustic.exr")
        truth = read(results / row["folder"] / "reference.exr")
        weight = truth.sum()
        ys, xs = numpy.mgrid[0:truth.shape[0], 0:truth.shape[1]]
        cy, cx = (truth * ys).sum() / weight, (truth * xs).sum() / weight
        # Along rays from the caustic's middle, outside of the focus itself.
        radii = numpy.arange(40, 168)
        spectra = []
        squares = []
        for angle in numpy.linspace(0, 2 * math.pi, 180, endpoint=False):
            px = cx + radii * math.cos(angle)
            py = cy + radii * math.sin(angle) * 0.5
            if px.min() < 1 or py.min() < 1 or px.max() > truth.shape[1] - 2 or py.max() > truth.shape[0] - 2:
                continue
            at = (py.round().astype(int), px.round().astype(int))
            difference = image[at] - truth[at]
            squares.append((difference ** 2).mean())
            windowed = difference * numpy.hanning(len(radii)) * math.sqrt(8 / 3)
            spectra.append(numpy.abs(numpy.fft.rfft(windowed)) ** 2 * 2 / len(radii) ** 2)
        power = numpy.mean(spectra, axis=0)
        wavelengths = numpy.concatenate([[numpy.inf], len(radii) / numpy.arange(1, len(power))])
        cells = [math.sqrt(power[(wavelengths >= low) & (wavelengths < high)].sum())
                 for low, high in bands]
        parameters = row["report"]["parameters"]
        which = row["report"]["technique"]
        if which == "multi_resolution":
            which += ", " + parameters["filter.blend.interpolant"]
        if which == "lens_splats":
            which += ", " + parameters["specular.two_interfaces.lens"]
        print(line([which, f"{math.sqrt(numpy.mean(squares)):.3g}"] + [f"{cell:.3g}" for cell in cells]))


def flicker(rows: list[dict]) -> None:
    print(head(["technique", "photons", "temporal", "RMS change, W/m²", "the truth's",
                "difference", "its standard error", "RMSE, W/m²", "frame, ms"]))
    several = len({row_of(row["report"]) for row in rows}) > 1
    for row in rows:
        report = row["report"]
        found = report["error"]["flicker"]
        which = f", {row_of(report)}" if several else ""
        print(line([row["technique"] + which, row["emit.photons"], row["temporal"],
                    f"{found['rms_w_m2']:.4g}", f"{found['truth_rms_w_m2']:.4g}",
                    f"{found['difference_w_m2']:+.3g}", f"{found['truth_stderr_w_m2']:.2g}",
                    f"{report['error']['caustic_irradiance']['rmse']:.4g}",
                    f"{report['frame_ms']['median']:.0f}"]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=["times", "paper", "error", "reach", "ringing", "flicker"])
    parser.add_argument("results", type=Path)
    arguments = parser.parse_args()
    rows = runs_of(arguments.results)
    if arguments.table == "ringing":
        return print_table(ringing, rows, arguments.results)
    return print_table({"times": times, "paper": paper, "error": error, "reach": reach, "flicker": flicker}[arguments.table], rows)


if __name__ == "__main__":
    sys.exit(main())
