#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of the studies of screen-space photon tracing (experiments/krueger2006_*.toml), in Markdown.

    krueger2006.py accuracy|tracers|caustics|sprites|photons|shadows|refraction|needs RESULTS

accuracy:   what decides whether the lines find a photon's first hit (tracer_accuracy.toml), each setting varied by itself.
tracers:    ms of the stage `trace`, pyramid included, and how many times as fast as lines that is.
caustics:   the paper's Table 2: ms of caustics, of it tracing, sprites and the whole frame, by lines and by the default.
sprites:    relMSE and RMSE by the splats' shape and kernel, against the modelled paths.
photons:    ms, right hits and relMSE by the number of photons.
shadows:    pixels on the wrong side of a ray-traced shadow.
refraction: how far the eye's rays through glass are off, and what of them is lost.
needs:      ms of a frame by what it went to, – where the scene does not need the node.
"""

import argparse
import statistics
import sys
from collections import Counter, defaultdict
from pathlib import Path

from runs import error_of, head, line, ms_of, passes_of, print_table, runs_of, scene_of

TRACING = ("trace.", "layers.pyramid")
NEEDS = [("height field", ("geometry.",)), ("interface", ("eye.interface",)), ("layers", ("layers.",)), ("pyramid", ("layers.pyramid",)),
         ("emit", ("emit.",)), ("specular", ("specular.",)), ("trace", ("trace.",)), ("god rays", ("media.",)), ("sprites", ("reconstruct.",)),
         ("view", ("view.",)), ("shadow, direct", ("shadow.", "compose.direct")), ("rest", ("",))]


def frame(row: dict) -> float:
    return row["report"]["frame_ms"]["median"]


def photons_of(row: dict) -> str:
    width, height = row["emit.photons"].split("x")
    return f"{width}²" if width == height else f"{width}×{height}"


def by_photons(rows: list[dict]) -> list[str]:
    return sorted({photons_of(row) for row in rows}, key=lambda text: int(text.rstrip("²").split("×")[0]))


SWEEPS = [("trace.epsilon", "epsilon of the paper's hit test, m", {"trace.test": "epsilon"}), ("trace.test", "hit test", {}), ("layers.count", "layers", {}),
          ("trace.lines.width", "row width, texels", {}), ("emit.photons", "photons", {}), ("size", "size", {})]


def accuracy(rows: list[dict]) -> None:
    # What most runs have is what is not varied.
    usual = {key: Counter(row[key] for row in rows).most_common(1)[0][0] for key, _, _ in SWEEPS}
    print(head(["varied", "value", "agreement of visible photons", "relMSE", "frame, s", "lines + reduce, s"]))
    for key, name, where in SWEEPS:
        own = [row for row in rows if all(row[other] == where.get(other, usual[other]) for other, _, _ in SWEEPS if other != key)
               and (key != "trace.test" or row["trace.epsilon"] == usual["trace.epsilon"])]
        for value in sorted({row[key] for row in own}, key=lambda text: (len(text), text) if not text.startswith("0.") else (0, text)):
            runs = [row["report"] for row in own if row[key] == value]
            right = statistics.mean(run["hits"]["agreement_visible"] for run in runs)
            error = statistics.mean(run["error"]["caustic_irradiance"]["rel_mse"] for run in runs)
            print(line([name, f"`{value}`", f"{100 * right:.2f} %", f"{error:.3f}", f"{statistics.mean(run['frame_ms']['median'] for run in runs) / 1000:.2f}",
                        f"{statistics.mean(ms_of(run, ('trace.lines', 'trace.reduce')) for run in runs) / 1000:.2f}"]))


def tracers(rows: list[dict]) -> None:
    counts = by_photons(rows)
    found: dict = defaultdict(dict)
    for row in rows:
        node = row["trace"] + (", lines of a geometry shader" if row["trace.lines.source"] == "geometry" else "")
        node += "" if row["trace.test"] == "crossing" else f", {row['trace.test']}"
        found[node][photons_of(row)] = ms_of(row["report"], TRACING)
    print(head(["node", *(cell for count in counts for cell in (f"{count} photons, ms", "times as fast as lines"))]))
    for node, by in found.items():
        cells = [cell for count in counts for cell in
                 ((f"{by[count]:.0f}", f"{found['lines'][count] / by[count]:.2g}") if count in by else ("–", "–"))]
        print(line([f"`{node}`", *cells]))


def caustics(rows: list[dict]) -> None:
    columns = [("caustics", ("layers.", "emit.", "specular.", "trace.", "media.")), ("of it tracing", TRACING), ("sprites", ("reconstruct.",))]
    found: dict = defaultdict(dict)
    for row in rows:
        found[scene_of(row), row["specular"], photons_of(row)][row["trace"]] = row
    print("ms, by `lines` / by `hierarchical`\n")
    print(head(["scene", "branches", "photons", *(name for name, _ in columns), "frame"]))
    for (scene, specular, count), by in found.items():
        ways = [by[name] for name in ("lines", "hierarchical")]
        print(line([f"`{scene}`", f"`{specular}`", count,
                    *(" / ".join(f"{ms_of(row['report'], starts):.0f}" for row in ways) for _, starts in columns),
                    " / ".join(f"{frame(row):.0f}" for row in ways)]))


def sprites(rows: list[dict]) -> None:
    scenes = list(dict.fromkeys(scene_of(row) for row in rows))
    found: dict = defaultdict(dict)
    for row in rows:
        # Where deposits are made at all hits that is another picture.
        which = f"{row['reconstruct.sprites.shape']}, {row['reconstruct.sprites.kernel']}"
        found[which + (", `all_hits`" if row["trace"] == "all_hits" else "")][scene_of(row)] = error_of(row)
    print("relMSE / RMSE, W/m² / energy ratio\n")
    print(head(["shape, kernel", *(f"`{scene}`" for scene in scenes)]))
    for which, by in found.items():
        print(line([which, *(f"{by[scene]['rel_mse']:.2g} / {by[scene]['rmse']:.3g} / {by[scene]['energy_ratio']:.2f}" if scene in by else "–"
                             for scene in scenes)]))


def photons(rows: list[dict]) -> None:
    print(head(["photons", "emit + specular, ms", "trace", "reconstruct", "frame", "agreement of visible", "relMSE"]))
    for row in rows:
        report = row["report"]
        print(line([photons_of(row), f"{ms_of(report, ('emit.', 'specular.')):.0f}", f"{ms_of(report, ('trace.',)):.0f}", f"{ms_of(report, ('reconstruct.',)):.0f}",
                    f"{frame(row):.0f}", f"{100 * report['hits']['agreement_visible']:.2f} %", f"{report['error']['caustic_irradiance']['rel_mse']:.2g}"]))


def shadows(rows: list[dict]) -> None:
    print(head(["shadow by", "layers", "misclassified", "lit taken for shadow", "shadow taken for lit"]))
    for row in rows:
        found = row["report"]["error"]["shadow"]
        if row["shadow"] == "map":
            which, layers = f"map of {row['shadow.map.size']}²", "–"
        else:
            test = row["trace.test"]
            near = "" if test == "crossing" else f" within {float(row['trace.epsilon']):g} m"
            which, layers = f"rays, `{row['trace']}`, `{test}`{near}", row["layers.count"]
        print(line([which, layers, *(f"{100 * found[key]:.2g} %"
                                     for key in ("misclassified", "lit_taken_for_shadow", "shadow_taken_for_lit"))]))


def refraction(rows: list[dict]) -> None:
    print(head(["size", "scene", "node", "exit direction, median", "95 %", "as many interfaces", "lost", "RMSE of radiance"]))
    for row in sorted(rows, key=lambda row: (int(row["size"].split("x")[0]), scene_of(row))):
        view = row["report"]["error"]["view"]
        node = "W05" if row["view"] == "image_space" else {"all": "all layers"}.get(row["view.refraction.search"], "monotonic")
        node += ", stops by depth" if node != "W05" and row["view.refraction.stop"] == "depth" else ""
        print(line([row["size"].replace("x", "×"), f"`{scene_of(row)}`", node, f"{view['exit_direction_deg']['median']:.2g}°",
                    f"{view['exit_direction_deg']['p95']:.1f}°", f"{100 * view['interfaces_right']:.1f} %", f"{100 * view['lost']:.1f} %",
                    f"{view['radiance']['rmse']:.3f}"]))


def needs(rows: list[dict]) -> None:
    print(head(["scene", *(name for name, _ in NEEDS), "frame"]))
    for row in rows:
        times = dict.fromkeys((name for name, _ in NEEDS), 0.0)
        for name, time in passes_of(row["report"]).items():
            # The longest start that fits: the pyramid is no part of the layers.
            fits = [(len(start), what) for what, starts in NEEDS for start in starts if name.startswith(start)]
            times[max(fits)[1]] += time
        print(line([f"`{scene_of(row)}`", *(f"{time:.1f}" if 0.0 < time < 1.0 else f"{time:.0f}" if time else "–" for time in times.values()),
                    f"{frame(row):.0f}"]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    tables = {f.__name__: f for f in (accuracy, tracers, caustics, sprites, photons, shadows, refraction, needs)}
    parser.add_argument("table", choices=tables)
    parser.add_argument("results", type=Path)
    arguments = parser.parse_args()
    return print_table(tables[arguments.table], runs_of(arguments.results))


if __name__ == "__main__":
    sys.exit(main())
