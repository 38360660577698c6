# SPDX-License-Identifier: MIT
"""The figures of a study. Each function gives a matplotlib figure, or None where the study lacks
what it would show."""

import re
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from study import Axis, Configuration, Study, as_number, as_text, evenly

# Okabe and Ito's palette, told apart by all kinds of colour vision; yellow, which is faint on
# white, comes last.
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#F0E442"]
OTHER = "#999999"
MARKERS = "osD^vPX*"
MAX_BARS = 40  # more are not read
MAX_LABELS = 12
FRAME = "frame_ms.median"

plt.rcParams.update(
    {
        "figure.dpi": 150,
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e4e4e4",
        "legend.frameon": False,
        "svg.hashsalt": "kaustik",  # the same picture is the same file
    }
)


@dataclass
class Measure:
    """A column of errors and how to read it."""

    column: str
    label: str
    turned: bool = False  # 1 - x: so that less is better
    deviates: bool = False  # |1 - x|

    def of(self, configuration: Configuration) -> float | None:
        mean = configuration.mean(self.column)
        if mean is None:
            return None
        return abs(1.0 - mean) if self.deviates else 1.0 - mean if self.turned else mean


def error_measures(study: Study) -> list[Measure]:
    """What says how wrong a run is, the most telling first."""
    measures = []
    for metric, label in (
        ("rel_mse", "relative MSE"),
        ("smape", "SMAPE"),
        ("energy_ratio", "deviation of the energy"),
        ("rmse", "RMSE"),
        ("flip_ldr", "mean FLIP"),
    ):
        for column in study.columns_like(rf"error\..*\.{metric}"):
            if "truth_noise" in column:
                continue  # what the reference's own error would give: no property of a run
            output = column.split(".", 1)[1].rsplit(".", 1)[0]
            unit = ""
            if metric == "rmse":
                unit = " (W/m²)" if "irradiance" in output else " (W/m²/sr)"
            text = f"{label} of {output.replace('_', ' ').replace('.', ', ')}{unit}"
            measures.append(Measure(column, text, deviates=metric == "energy_ratio"))
    for column in study.columns_like(r"hits\.agreement(_visible)?"):
        which = "visible photons" if column.endswith("visible") else "all photons"
        measures.append(Measure(column, f"wrong fates of {which} (share)", turned=True))
    return measures


def spans_decades(numbers: list[float]) -> bool:
    return bool(numbers) and min(numbers) > 0.0 and max(numbers) >= 10.0 * min(numbers)


def color_axis(study: Study) -> Axis | None:
    """The first setting of few values: what colours tell apart."""
    for axis in study.axes:
        values = {as_text(c.axes.get(axis.key)) for c in study.configurations}
        if 1 < len(values) <= len(COLORS):
            return axis
    return None


def pareto_front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Those that no other beats in both time and error."""
    front: list[tuple[float, float]] = []
    for time, error in sorted(points):
        if not front or error < front[-1][1]:
            front.append((time, error))
    return front


def speed_against_error(study: Study, measure: Measure) -> Figure | None:
    shown = [
        c for c in study.configurations if c.mean(FRAME) is not None and measure.of(c) is not None
    ]
    if not shown:
        return None
    figure, axes = plt.subplots(figsize=(8.5, 4.6), layout="constrained")
    axis = color_axis(study)
    values = list(dict.fromkeys(as_text(c.axes.get(axis.key)) for c in shown)) if axis else [""]
    points = [(c.mean(FRAME), measure.of(c)) for c in shown]
    for index, value in enumerate(values):
        members = [c for c in shown if not axis or as_text(c.axes.get(axis.key)) == value]
        axes.errorbar(
            [c.mean(FRAME) for c in members],
            [measure.of(c) for c in members],
            xerr=[c.spread(FRAME) for c in members],
            yerr=[c.spread(measure.column) for c in members],
            linestyle="none",
            color=COLORS[index],
            marker=MARKERS[index],
            markersize=6,
            capsize=2,
            linewidth=1,
            label=f"{axis.key} = {value}" if axis else None,
        )
    front = pareto_front(points)
    axes.step(
        *zip(*front), where="post", color="#555555", linewidth=1, label="Pareto front", zorder=1
    )
    noise = []
    if measure.column.endswith(".rmse"):
        own = measure.column.removesuffix("rmse") + "truth_noise.rmse"
        noise = [n for c in shown for n in c.numbers(own)]
    if noise:
        axes.axhline(max(noise), color="#555555", linestyle=":", label="the reference's standard error")
    # Only the front is named, else the names hide each other; the table has them all.
    middle = 0.5 * (front[0][0] + front[-1][0])
    for configuration, point in zip(shown, points):
        if point not in front or len(front) > MAX_LABELS:
            continue
        is_left = point[0] <= middle
        axes.annotate(
            configuration.label,
            point,
            xytext=(6 if is_left else -6, 4),
            textcoords="offset points",
            horizontalalignment="left" if is_left else "right",
            fontsize=7,
            color="#444444",
        )
    if spans_decades([time for time, _ in points]):
        axes.set_xscale("log")
    if spans_decades([error for _, error in points]):
        axes.set_yscale("log")
    axes.set_xlabel("time of a frame (ms)")
    axes.set_ylabel(measure.label)
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def time_per_pass(study: Study) -> Figure | None:
    passes = study.columns_like(r"pass:.*")
    if not passes:
        return None
    shown = evenly(study.configurations, MAX_BARS)
    # Of its frame, so that the passes of a quick configuration are told apart next to a slow one.
    whole = [sum(c.mean(p) or 0.0 for p in passes) or 1.0 for c in shown]
    largest = {p: max((c.mean(p) or 0.0) / frame for c, frame in zip(shown, whole)) for p in passes}
    kept = sorted(passes, key=lambda p: -largest[p])[: 2 * len(COLORS)]
    # As high as the bars or the legend need.
    height = max(1.8 + 0.32 * len(shown), 0.9 + 0.19 * (len(kept) + 2))
    figure, axes = plt.subplots(figsize=(8.0, height))
    rows = range(len(shown))
    left = [0.0] * len(shown)
    order = [p for p in passes if p in kept]
    for index, name in enumerate(order + ["other passes"]):
        members = [name] if name in kept else [p for p in passes if p not in kept]
        widths = [sum(c.mean(p) or 0.0 for p in members) for c in shown]
        if not members or not any(widths):
            continue
        axes.barh(
            rows,
            widths,
            left=left,
            color=COLORS[index % len(COLORS)] if index < len(order) else OTHER,
            hatch="////" if len(COLORS) <= index < len(order) else None,
            edgecolor="white",
            linewidth=0.5,
            label=name.removeprefix("pass:"),
        )
        left = [a + b for a, b in zip(left, widths)]
    axes.errorbar(
        [c.mean(FRAME) or 0.0 for c in shown],
        rows,
        xerr=[c.spread(FRAME) for c in shown],
        linestyle="none",
        marker="|",
        markersize=12,
        color="#333333",
        capsize=2,
        label="whole frame",
    )
    axes.set_yticks(list(rows), [c.label for c in shown])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlim(left=0.0)
    axes.set_xlabel("time per frame (ms, median)")
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def frame_times(study: Study) -> Figure | None:
    shown = [c for c in study.configurations if any(len(s) > 1 for s in c.frame_samples_ms)]
    shown = evenly(shown, MAX_BARS)
    if not shown:
        return None
    figure, axes = plt.subplots(figsize=(8.0, 1.4 + 0.32 * len(shown)), layout="constrained")
    for row, configuration in enumerate(shown):
        repeats = configuration.frame_samples_ms
        height = 0.7 / len(repeats)
        axes.boxplot(
            repeats,
            vert=False,
            positions=[row + (i - (len(repeats) - 1) / 2) * height for i in range(len(repeats))],
            widths=0.8 * height,
            manage_ticks=False,
            medianprops={"color": COLORS[1]},
            boxprops={"color": COLORS[0]},
            whiskerprops={"color": COLORS[0]},
            capprops={"color": COLORS[0]},
            flierprops={"marker": ".", "markersize": 3, "markeredgecolor": OTHER},
        )
    axes.set_yticks(range(len(shown)), [c.label for c in shown])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    if spans_decades([t for c in shown for s in c.frame_samples_ms for t in s]):
        axes.set_xscale("log")
    axes.set_xlabel("time of a frame (ms); one box a repeat")
    return figure


def is_swept(study: Study, axis: Axis) -> bool:
    values = {as_text(c.axes.get(axis.key)) for c in study.configurations}
    numbers = [as_number(c.axes.get(axis.key)) for c in study.configurations]
    return len(values) > 1 and None not in numbers


def lines_along(study: Study, axis: Axis) -> dict[str, list[Configuration]]:
    """Configurations that differ in this setting alone, by what they share."""
    others = [other.key for other in study.axes if other.key != axis.key]
    members = [c for c in study.configurations if set(c.products) & set(axis.products)]
    varied = [key for key in others if len({as_text(c.axes.get(key)) for c in members}) > 1]
    lines: dict[str, list[Configuration]] = {}
    for configuration in members:
        name = ", ".join(f"{key} {as_text(configuration.axes.get(key))}" for key in varied)
        lines.setdefault(name, []).append(configuration)
    for line in lines.values():
        line.sort(key=lambda c: as_number(c.axes.get(axis.key)) or 0.0)
    return lines


def sweep(study: Study, axis: Axis) -> Figure | None:
    """Time, and error where it is known, along one setting."""
    measures = error_measures(study)
    panels: list[Measure] = [Measure(FRAME, "frame time (ms)")]
    for output in ("caustic_irradiance", "in_scattered"):
        for metric in ("rel_mse", "smape", "energy_ratio"):
            panels += [m for m in measures if m.column.endswith(f"{output}.{metric}")][:1]
    panels += [m for m in measures if m.column == "hits.agreement_visible"]
    figure, rows = plt.subplots(
        len(panels),
        1,
        sharex=True,
        squeeze=False,
        figsize=(7.0, 1.2 + 2.2 * len(panels)),
        layout="constrained",
    )
    lines = lines_along(study, axis)
    ticks: dict[float, str] = {}
    for panel, (axes,) in zip(panels, rows):
        heights = []
        for index, (name, line) in enumerate(lines.items()):
            line = [c for c in line if panel.of(c) is not None]
            positions = [as_number(c.axes.get(axis.key)) for c in line]
            ticks.update(zip(positions, (as_text(c.axes.get(axis.key)) for c in line)))
            heights += [panel.of(c) + (c.spread(panel.column) or 0.0) for c in line]
            few = len(lines) <= len(COLORS)
            axes.errorbar(
                positions,
                [panel.of(c) for c in line],
                yerr=[c.spread(panel.column) for c in line],
                color=COLORS[index] if few else OTHER,
                marker=MARKERS[index] if few else ".",
                markersize=5,
                linewidth=1.2,
                capsize=2,
                label=name if few and name else None,
            )
        if spans_decades(heights):
            axes.set_yscale("log")
        elif heights and min(heights) >= 0.0:
            axes.set_ylim(0.0, 1.08 * max(heights) or None)
        axes.set_ylabel(panel.label.replace(" of ", "\nof ", 1))
    last = rows[-1][0]
    if spans_decades(list(ticks)):
        last.set_xscale("log")
    if len(ticks) <= MAX_LABELS:
        last.set_xticks(list(ticks), list(ticks.values()))
        last.xaxis.set_minor_locator(NullLocator())
    last.set_xlabel(axis.label)
    if rows[0][0].get_legend_handles_labels()[1]:
        rows[0][0].legend(fontsize=8)
    return figure


def file_name(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "-", text).strip("-").lower()


def all_figures(study: Study):
    """(name of the file, caption, figure), as they are drawn; where there are several models of
    devices, for each of them."""
    if len(study.devices) == 1:
        yield from figures_of(study)
        return
    for number, device in enumerate(study.devices, start=1):
        for name, caption, figure in figures_of(study.on(device)):
            yield f"{name}-device-{number}", f"On device {number}, {device}: {caption}", figure


def figures_of(study: Study):
    """The same for one model of device, whose times may be compared."""
    repeats = (
        f"Error bars are the standard deviation between {study.repeats} processes"
        f"{f' of {study.seeds} seeds' if study.seeds > 1 else ''}."
        if study.repeats > 1
        else "One process each, so there is no spread between processes."
    )
    for measure in error_measures(study):
        yield (
            f"speed-{file_name(measure.column)}",
            f"Speed against {measure.label}. Below and left is better. {repeats}",
            speed_against_error(study, measure),
        )
    yield "passes", f"Where the time goes: each pass's median. {repeats}", time_per_pass(study)
    for axis in study.axes:
        if is_swept(study, axis):
            what = f" {axis.description.rstrip('.')}." if axis.description else ""
            yield f"sweep-{file_name(axis.key)}", f"Along {axis.key}.{what} {repeats}", sweep(
                study, axis
            )
    yield (
        "frame-times",
        "Every frame's time: median, quartiles, 1.5 interquartile ranges, and what lies beyond.",
        frame_times(study),
    )
