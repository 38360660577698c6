#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One table of a study: a row a run, what differs between the runs, and what was measured.

    table.py RESULTS [--csv FILE [--keep]]

RESULTS is a folder of `kaustik experiment run`, or one of its runs.csv. Prints Markdown; --csv writes the
same columns, with five digits; with --keep what FILE has of runs that RESULTS lacks stays as it is. Errors of the caustic are against all light, but those named "modelled", which are
against the paths that the run's photons can take; "not formed" is the light of all others; "too bright" and "too dark" are the shares of
pixels that are so, against those paths, by more than the reference's noise. "reference's own" is what its noise alone
would give. "scattered" is the radiance that a medium scatters to the eye, against the modelled paths, RMSE in W/m²/sr. ms: of all passes of the caustic, from emission to gather; media ms: of these, of light that a medium
scatters; and of what the eye sees through specular surfaces (view); their spread is that of whole frames, as a share. A run that failed has its message instead.
"""

import argparse
import csv
import sys
from pathlib import Path

from sources import keys_noted
from study import device_of

CAUSTIC = ("geometry.", "driver.", "emit.", "refine.", "around.", "generator.", "specular.", "light.",
           "trace.", "reconstruct.", "filter.", "gather.", "temporal.", "layers.", "media.")
ERROR = "error.caustic_irradiance."
MODELLED = "error.modelled_paths.caustic_irradiance."
VIEW = "error.view.radiance."
SCATTERED = "error.modelled_paths.in_scattered."


# What a page says of its runs (pages.py).
OF_THE_RUN = ("device", "version", "sources", "date", "other_processors")


def number(row: dict, key: str) -> float | None:
    text = row.get(key) or ""
    try:
        return float(text)
    except ValueError:
        return None


def sum_of_passes(row: dict, starts: tuple) -> float | None:
    times = [number(row, key) for key in row if key.startswith("pass:") and key[5:].startswith(starts)]
    found = [time for time in times if time is not None]
    return sum(found) if found else None


def share(row: dict, key: str) -> float | None:
    emitted, part = number(row, "energy.emitted_w"), number(row, key)
    return 100.0 * part / emitted if emitted and part is not None else None


def percent(row: dict, key: str) -> float | None:
    part = number(row, key)
    return 100.0 * part if part is not None else None


def not_formed(row: dict) -> float | None:
    """The light of paths that the run's photons cannot take, as a share of all light of the caustic."""
    of_all, of_modelled = number(row, ERROR + "energy_ratio"), number(row, MODELLED + "energy_ratio")
    if of_all is None:
        return None
    return 100.0 * (1.0 - of_all / of_modelled) if of_modelled else 0.0


def watts_not_formed(row: dict) -> float | None:
    flux, part = number(row, ERROR + "reference_flux"), not_formed(row)
    return 0.01 * part * flux if flux is not None and part is not None else None


def spread(row: dict) -> float | None:
    """The standard deviation of the frames over their mean."""
    mean, deviation = number(row, "frame_ms.mean"), number(row, "frame_ms.stdev")
    return deviation / mean if mean and deviation is not None else None


def timed(row: dict, value: float | None) -> float | None:
    """Nothing where the one frame was also measured: its passes and memory are not a picture's."""
    return None if row.get("of_measured_frame") == "true" else value


def mebibytes(row: dict) -> float | None:
    peak = number(row, "memory.peak_bytes")
    return peak / 2.0**20 if peak is not None else None


# Name, how it is printed, and how it is got from a row.
MEASURED = [
    ("emitted", ",.0f", lambda row: number(row, "photons.emitted")),
    ("traced", ",.0f", lambda row: number(row, "photons.traced")),
    ("visible right", ".4f", lambda row: number(row, "hits.agreement_visible")),
    ("hits right", ".4f", lambda row: number(row, "hits.agreement")),
    ("of seen", ".4f", lambda row: number(row, "hits.agreement_reachable")),
    ("relMSE", ".3g", lambda row: number(row, ERROR + "rel_mse")),
    ("SMAPE", ".3f", lambda row: number(row, ERROR + "smape")),
    ("HDR FLIP", ".3f", lambda row: number(row, ERROR + "flip_hdr")),
    ("energy", ".3f", lambda row: number(row, ERROR + "energy_ratio")),
    ("relMSE, modelled", ".3g", lambda row: number(row, MODELLED + "rel_mse")),
    ("SMAPE, modelled", ".3f", lambda row: number(row, MODELLED + "smape")),
    ("energy, modelled", ".3f", lambda row: number(row, MODELLED + "energy_ratio")),
    ("relMSE, reference's own", ".3g", lambda row: number(row, ERROR + "truth_noise.rel_mse")),
    ("not formed, %", ".2f", lambda row: not_formed(row)),
    ("not formed, W", ".3g", lambda row: watts_not_formed(row)),
    ("too bright, %", ".1f", lambda row: percent(row, "error.bias.too_bright")),
    ("too dark, %", ".1f", lambda row: percent(row, "error.bias.too_dark")),
    ("not followed, %", ".2f", lambda row: share(row, "energy.lost_w.untraced_branch")),
    ("view relMSE", ".3g", lambda row: number(row, VIEW + "rel_mse")),
    ("view energy", ".3f", lambda row: number(row, VIEW + "energy_ratio")),
    ("view interfaces right", ".4f", lambda row: number(row, "error.view.interfaces_right")),
    ("view lost", ".4f", lambda row: number(row, "error.view.lost")),
    ("scattered RMSE", ".3f", lambda row: number(row, SCATTERED + "rmse")),
    ("scattered energy", ".3f", lambda row: number(row, SCATTERED + "energy_ratio")),
    ("scattered RMSE, reference's own", ".3f", lambda row: number(row, SCATTERED + "truth_noise.rmse")),
    ("ms", ".0f", lambda row: timed(row, sum_of_passes(row, CAUSTIC))),
    ("media ms", ".0f", lambda row: timed(row, sum_of_passes(row, ("media.",)))),
    ("view ms", ".0f", lambda row: timed(row, sum_of_passes(row, ("view.",)))),
    ("frame, ms", ".0f", lambda row: timed(row, number(row, "frame_ms.median"))),
    ("spread", ".3f", lambda row: spread(row)),
    ("peak MiB", ".0f", lambda row: timed(row, mebibytes(row))),
]


def rounded(text: str) -> str:
    """A fraction with five digits; all else as it is."""
    try:
        value = float(text)
    except ValueError:
        return text
    return f"{value:.5g}" if "." in text and not value.is_integer() else text


def settings_of(rows: list[dict]) -> list[str]:
    """The study's settings, which stand between `message` and the times, as far as they differ."""
    keys = list(rows[0])
    own = keys[keys.index("message") + 1:keys.index("frame_ms.max")]
    return [key for key in own if len({row[key] for row in rows}) > 1]


def rows_of_others(kept: list[dict], rows: list[dict], settings: list[str]) -> list[dict]:
    """The rows of a CSV whose settings no run has that is there now. One that failed may not say all of them."""
    def is_made(row: dict) -> bool:
        blanks = row.get("status") == "failed"
        return any(all(row[key] == new[key] or (blanks and row[key] == "") for key in settings) for new in rows)

    return [row for row in kept if not is_made(row)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--csv", type=Path)
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    table = arguments.results / "runs.csv" if arguments.results.is_dir() else arguments.results
    if not table.is_file():
        print(f"table: '{table}' is not there; is '{arguments.results}' the results of "
              "'kaustik experiment run'?", file=sys.stderr)
        return 1
    with table.open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    if not rows or "message" not in rows[0] or "frame_ms.max" not in rows[0]:
        print(f"table: '{table}' has no runs of a study", file=sys.stderr)
        return 1
    sources = keys_noted(table.parent)
    for row in rows:
        row["sources"] = sources.get(row.get("folder"), "")
        row["device"] = device_of(row)
    kept, settings = [], settings_of(rows)
    if arguments.keep and arguments.csv.is_file():
        with arguments.csv.open(newline="", encoding="utf-8") as stream:
            kept = list(csv.DictReader(stream))
        settings = list(kept[0])[:list(kept[0]).index("status")] if kept else settings
        if missing := [key for key in settings if key not in rows[0]]:
            print(f"table: the rows of '{arguments.csv}' differ in {missing[0]}, which no run of '{table}' says", file=sys.stderr)
            return 1
        kept = rows_of_others(kept, rows, settings)
    rows.sort(key=lambda row: row.get("scene") or "")  # otherwise in the study's own order
    measured = [m for m in MEASURED if any(m[2](row) is not None for row in rows) or any(row.get(m[0]) for row in kept)]
    header = settings + [name for name, _, _ in measured]
    print("| " + " | ".join(f"`{key}`" if key in settings else key for key in header) + " |")
    print("| --- " * len(header) + "|")
    for row in rows:
        cells = [f"`{row[key]}`" if row[key] else "–" for key in settings]
        if row["status"] == "done":
            values = [(form, get(row)) for _, form, get in measured]
            cells += [format(value, form) if value is not None else "–" for form, value in values]
        else:
            cells += [row["message"]] + [""] * (len(measured) - 1)
        print("| " + " | ".join(cells) + " |")
    if arguments.csv:
        with arguments.csv.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(settings + ["status", "message"] + [name for name, _, _ in measured] +
                            list(OF_THE_RUN))
            for row in rows:
                writer.writerow([row[key] for key in settings] + [row["status"], row["message"]] +
                                ["" if get(row) is None else rounded(str(get(row))) for _, _, get in measured] +
                                [row.get(key, "") for key in OF_THE_RUN])
            columns = [*settings, "status", "message", *(name for name, _, _ in measured), *OF_THE_RUN]
            writer.writerows([row.get(name, "") for name in columns] for row in kept)
    return 0


if __name__ == "__main__":
    sys.exit(main())
