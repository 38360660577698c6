#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of the studies of adaptive caustic maps (experiments/wyman_nichols2009_*.toml), in Markdown.

    wyman_nichols2009.py photons|times|deferred|buffers|batches|starts|error|god_rays|cascades RESULTS

photons:  photons that each method stores, and their share of the dense grid (Table 1).
times:    ms from emission to gather over the number of photons, median over the repeats with their
          spread, and over the dense grid's.
deferred: ms of the lights' fronts and backs, drawn once and twice, over the number of triangles.
buffers:  relMSE by what is met in the buffers, over their size.
batches:  ms from emission to gather over the memory, and over that of one batch.
starts:   flux that is missed, by the start of the traversal and the mask.
error:    relMSE and time, and who is on the front of error against time.
god_rays: relMSE of the in-scattered light and time of the medium with its photons.
cascades: relMSE and time over the size and the number of each light's maps.
"""

import argparse
import statistics
import sys
from collections import defaultdict
from pathlib import Path

from runs import error_of, head, line, maps_of, ms_of, print_table, runs_of, scene_of, spread, value

STAGES = ("geometry.", "driver.", "emit.", "refine.", "specular.", "light.", "trace.", "reconstruct.",
          "filter.", "gather.", "layers.", "media.")
# Photons of the Buddha by grid (Wyman, Nichols 2009, Table 1): hierarchical, traversal, error.
TABLE_1 = {256: (4803, 5092, 4556), 512: (19861, 20160, 19380), 1024: (78538, 81268, 78320),
           2048: (286298, 326896, 266768), 4096: (947559, 1312524, 816888), 8192: (None, 5210492, 2182704),
           16384: (None, 12582912, 5398900)}


def cells_of(row: dict) -> int:
    if value(row, "driver") == "adaptive":
        return int(value(row, "refine.finest"))
    return int(str(row["emit.photons"]).split("x")[0])


def method_of(row: dict) -> str:
    driver = value(row, "driver")
    if driver == "adaptive":
        return f"adaptive, {value(row, 'refine.metric')}"
    return "hierarchical" if driver == "hierarchical" else f"dense, emit={value(row, 'emit')}"


def share(photons: float, cells: int) -> str:
    return f"{photons:,.0f} ({100 * photons / cells ** 2:.2f} %)"


def photons(rows: list[dict]) -> None:
    sizes = sorted({cells_of(row) for row in rows})
    print(head(["scene", "view", "method"] + [f"{n}²" for n in sizes]))
    found: dict = defaultdict(dict)
    for row in rows:
        key = (scene_of(row), value(row, "emit.deferred.frame"))
        counts = row["report"]["cells"]
        found[key + (method_of(row),)][cells_of(row)] = counts["photons"]
        if value(row, "driver") == "hierarchical":
            found[key + ("dense, that arrive",)][cells_of(row)] = counts["probes"]
    for key in sorted(found):
        print(line([f"`{key[0]}`", *key[1:]] +
                   [share(found[key][n], n) if n in found[key] else "–" for n in sizes]))
    for i, name in enumerate(("hierarchical", "traversal", "error")):
        print(line(["the paper's Buddha", "loose", name] +
                   [share(TABLE_1[n][i], n) if n in TABLE_1 and TABLE_1[n][i] else "–" for n in sizes]))


def times(rows: list[dict]) -> None:
    sizes = sorted({cells_of(row) for row in rows})
    print(head(["scene", "triangles", "method"] + [f"{n}²" for n in sizes]))
    found: dict = defaultdict(lambda: defaultdict(dict))
    for row in rows:
        key = (scene_of(row), row["report"]["scene"]["triangles"], method_of(row))
        found[key][cells_of(row)][row["repeat"]] = ms_of(row["report"], STAGES)
    for key in sorted(found):
        cells = []
        for n in sizes:
            own = found[key].get(n)
            if not own:
                cells.append("–")
                continue
            dense = found[key[:2] + ("dense, emit=grid",)].get(n) or {}
            ratios = [own[r] / dense[r] for r in own if r in dense]
            cells.append(f"{statistics.median(own.values()):.0f}" + (f"; {spread(ratios)}" if ratios else ""))
        print(line([f"`{key[0]}`", *key[1:]] + cells))


def deferred(rows: list[dict]) -> None:
    print(head(["scene", "triangles", "once, ms", "twice, ms", "once / twice"]))
    found: dict = defaultdict(lambda: defaultdict(dict))
    for row in rows:
        key = (row["report"]["scene"]["triangles"], scene_of(row))
        found[key][value(row, "emit.deferred.geometry")][row["repeat"]] = ms_of(
            row["report"], ("emit.deferred_buffers", "refine.emit.deferred_buffers"))
    for (triangles, scene), ways in sorted(found.items()):
        once, twice = ways["once"], ways["twice"]
        print(line([f"`{scene}`", triangles, f"{statistics.median(once.values()):.1f}",
                    f"{statistics.median(twice.values()):.1f}", spread([once[r] / twice[r] for r in once])]))


def buffers(rows: list[dict]) -> None:
    found: dict = defaultdict(dict)
    for row in rows:
        key = (scene_of(row), value(row, "emit.deferred.lookup"))
        found[key][value(row, "emit.deferred.size")] = error_of(row)["rel_mse"]
    sizes = sorted({size for errors in found.values() for size in errors})
    print(head(["scene", "a photon meets", *(f"{size}²" for size in sizes)]))
    for (scene, lookup), errors in sorted(found.items()):
        print(line([f"`{scene}`", lookup, *(f"{errors[size]:.3g}" if size in errors else "–" for size in sizes)]))


def batches(rows: list[dict]) -> None:
    print(head(["scene", "memory, MiB", "batches", "rounds", "ms", "over one batch"]))
    found: dict = defaultdict(dict)
    counts = {}
    for row in rows:
        key = (scene_of(row), -value(row, "refine.memory"))
        found[key][row["repeat"]] = ms_of(row["report"], STAGES)
        counts[key] = row["report"]["cells"]
    for key in sorted(found):
        maximum = found[min(k for k in found if k[0] == key[0])]
        print(line([f"`{key[0]}`", -key[1], counts[key]["batches"], counts[key]["rounds"],
                    f"{statistics.median(found[key].values()):.0f}",
                    spread([found[key][r] / maximum[r] for r in found[key]])]))


def starts(rows: list[dict]) -> None:
    print(head(["first cells", "mask", "texels of the light's view", "photons", "probes",
                "emission_sampling, of what light emits"]))
    for row in rows:
        energy, counts = row["report"]["energy"], row["report"]["cells"]
        missed = energy["lost_w"].get("emission_sampling", 0.0)
        print(line([f"{value(row, 'refine.start')}²", value(row, "refine.mask"), value(row, "emit.deferred.size"),
                    counts["photons"], counts["probes"], f"{100 * missed / energy['emitted_w']:.2f} %"]))


def error_name(row: dict) -> str:
    technique = row["report"]["technique"]
    kept = value(row, "reconstruct")
    if row["report"].get("as_published"):
        return f"{technique}, as published"
    if technique == "screen_space_photons":
        return f"{kept} @ screen" + (", adaptive, eye" if value(row, "driver") == "adaptive" else "")
    return "splats @ light, " + (f"adaptive, {value(row, 'refine.metric')}"
                                 if technique == "adaptive_caustic_map" else "dense")


def error(rows: list[dict]) -> None:
    by_scene: dict = defaultdict(list)
    for row in rows:
        # A CSV of before it had `cells` has what those photons were.
        counts = row["report"].get("cells") or ({"photons": row["report"]["photons"]["emitted"]} if "adaptive" in error_name(row) else None)
        by_scene[scene_of(row)].append((ms_of(row["report"], STAGES), error_of(row)["rel_mse"],
                                        row["report"]["error"]["caustic_irradiance"]["rel_mse"],
                                        error_name(row), cells_of(row), counts["photons"] if counts else None))
    print("relMSE against the paths that the photons model (against all light); ms from emission to gather; "
          "adaptive: photons in thousands; **bold**: nothing is both faster and better")
    for scene, found in by_scene.items():
        sizes = sorted({one[4] for one in found})
        print(f"\n`{scene}`\n")
        print(head(["photons"] + [f"{n}²" for n in sizes]))
        front = [one for one in found if not any(o[0] < one[0] and o[1] < one[1] for o in found)]
        for name in sorted({one[3] for one in found}):
            cells = []
            for n in sizes:
                cell = [one for one in found if one[3] == name and one[4] == n]
                text = "; ".join(f"{one[1]:.2g} ({one[2]:.2g}); {one[0]:.0f}" +
                                 (f"; {one[5] / 1000:.0f} k" if one[5] is not None else "") for one in cell)
                cells.append(f"**{text}**" if cell and cell[0] in front else text or "–")
            print(line([name] + cells))


def god_rays(rows: list[dict]) -> None:
    print(head(["photons", "`refine.medium`, px", "relMSE of the in-scattered light", "energy ratio",
                "ms of the medium and its photons"]))
    found: dict = defaultdict(list)
    for row in rows:
        adaptive = value(row, "driver") == "adaptive"
        key = ((1, value(row, "refine.medium"), "adaptive") if adaptive else
               (0, 0, f"dense, {cells_of(row)}²"))
        judged = row["report"]["error"]
        scattered = judged.get("modelled_paths", judged)["in_scattered"]
        own = adaptive and value(row, "refine.medium") > 0
        stages = ("media.", "emit.deferred_buffers") if own else (
            "media.", "driver.", "emit.", "refine.", "specular.", "trace.")
        found[key + (cells_of(row),)].append((scattered["rel_mse"], scattered["energy_ratio"],
                                              ms_of(row["report"], stages)))
    for key in sorted(found):
        runs = found[key]
        print(line([key[2], key[1] if key[0] else "–", f"{runs[0][0]:.5f}", f"{runs[0][1]:.4f}",
                    spread([run[2] for run in runs])]))


def cascades(rows: list[dict]) -> None:
    print(head(["scene", "stored by", "in", "maps", "texels", "relMSE", "ms"]))
    for row in rows:
        maps, side, texels = maps_of(row)
        print(line([f"`{scene_of(row)}`", value(row, "reconstruct"),
                    f"{side}²" if maps else "the eye's pixels", maps or "–",
                    f"{texels / 1e6:.2f} M" if maps else "–",
                    f"{error_of(row)['rel_mse']:.3g}", f"{ms_of(row['report'], STAGES):.0f}"]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    tables = {f.__name__: f for f in (photons, times, deferred, buffers, batches, starts, error, god_rays, cascades)}
    parser.add_argument("table", choices=tables)
    parser.add_argument("results", type=Path)
    arguments = parser.parse_args()
    rows = runs_of(arguments.results)
    return print_table(tables[arguments.table], rows)


if __name__ == "__main__":
    sys.exit(main())
