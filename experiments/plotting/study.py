# SPDX-License-Identifier: MIT
"""The results of `kaustik experiment run`: its runs.csv, experiment.json and samples.json.

A configuration is one choice of all settings but the seed; its repeats are separate processes, of one
seed or of several. What is said of a configuration is the mean over its repeats, and its spread is
the standard deviation between them. Times of different models of devices are never averaged nor drawn
together: a configuration that ran on several is one configuration on each.
"""

import csv
import json
import math
import re
import statistics
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

Value = str | float | None

SEED = "seed"


class StudyError(Exception):
    """What is wrong with the folder, in a sentence for the user."""


def as_value(text: str) -> Value:
    """A cell of runs.csv: a number where it is one, None where it is empty."""
    if text == "":
        return None
    try:
        number = float(text)
    except ValueError:
        return text
    return number if math.isfinite(number) else None


def as_number(value: Value) -> float | None:
    """Numbers, and sizes such as 256x128 as their area; None for words."""
    if isinstance(value, float):
        return value
    size = re.fullmatch(r"(\d+)x(\d+)", value or "")
    return float(size[1]) * float(size[2]) if size else None


def as_text(value: Value) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def evenly(items: list, maximum: int) -> list:
    """At most that many, spread through the list, its ends included."""
    if len(items) <= maximum:
        return items
    return [items[round(i * (len(items) - 1) / (maximum - 1))] for i in range(maximum)]


def device_of(row: dict) -> str:
    """The model that the times of a row are of: on a software rasteriser it is the processor."""
    threads = row.get("threads")
    parts = [row.get("device"), row.get("cpu"), f"{as_text(as_value(str(threads)))} threads" if threads else None]
    return ", ".join(str(part) for part in parts if part)


def devices_of_scenes(rows: list[dict]) -> dict[str, list[str]]:
    of: dict = {}
    for row in rows:
        of.setdefault(row["scene"], set()).add(device_of(row))
    return {scene: sorted(devices) for scene, devices in of.items()}


def require_one_device(rows: list[dict], results: Path, a_scene: bool = False) -> None:
    """For tables that compare times of all rows, or (`a_scene`) of those of a scene; ends the program where they are of several models."""
    for scene, devices in (devices_of_scenes(rows) if a_scene else {"": sorted({device_of(row) for row in rows})}).items():
        if len(devices) > 1:
            sys.exit(
                f"{results} holds times{' of ' + scene if scene else ''} of {len(devices)} models of devices, which cannot be compared: "
                f"{'; '.join(devices)}. 'kaustik experiment report' keeps them apart."
            )


@dataclass
class Axis:
    """A setting that the study varies."""

    key: str
    unit: str
    description: str
    products: list[int]

    @property
    def label(self) -> str:
        return f"{self.key} ({self.unit})" if self.unit else self.key


@dataclass
class Configuration:
    """All repeats of one choice of settings on one model of device, whatever their seeds."""

    hash: str  # of the first seed
    axes: dict[str, Value]
    products: list[int]
    device: str = ""
    label: str = ""
    rows: list[dict[str, Value]] = field(default_factory=list)  # finished repeats
    folders: list[Path] = field(default_factory=list)
    frame_samples_ms: list[list[float]] = field(default_factory=list)

    def numbers(self, column: str) -> list[float]:
        return [row[column] for row in self.rows if isinstance(row.get(column), float)]

    def mean(self, column: str) -> float | None:
        numbers = self.numbers(column)
        return statistics.fmean(numbers) if numbers else None

    def spread(self, column: str) -> float:
        """Between repeats; 0 for one."""
        numbers = self.numbers(column)
        return statistics.stdev(numbers) if len(numbers) > 1 else 0.0


@dataclass
class Study:
    folder: Path
    name: str
    description: str
    version: str
    repeats: int  # of a configuration, over all its seeds
    seeds: int
    planned: int
    axes: list[Axis]
    configurations: list[Configuration]  # with at least one finished repeat
    failures: list[dict[str, Value]]
    columns: list[str]

    def columns_like(self, pattern: str) -> list[str]:
        """Columns with at least one number, in the order of the table."""
        return [
            column
            for column in self.columns
            if re.fullmatch(pattern, column)
            and any(c.numbers(column) for c in self.configurations)
        ]

    @property
    def devices(self) -> list[str]:
        return sorted({c.device for c in self.configurations})

    def on(self, device: str) -> "Study":
        """What of it ran on that model."""
        return replace(self, configurations=[c for c in self.configurations if c.device == device])


def read_json(path: Path) -> dict:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise StudyError(f"{path} cannot be read: {error.strerror}.") from error
    except ValueError as error:
        raise StudyError(f"{path} is not valid JSON ({error}).") from error


def short_names(keys: list[str]) -> dict[str, str]:
    """The last two parts of each dotted key, where no other ends in the same."""
    last = [".".join(key.split(".")[-2:]) for key in keys]
    return {key: part if last.count(part) == 1 else key for key, part in zip(keys, last)}


def label_all(configurations: list[Configuration], axes: list[Axis]) -> None:
    """Names every configuration by what sets it apart."""
    varied = [
        axis.key
        for axis in axes
        if len({as_text(c.axes.get(axis.key)) for c in configurations}) > 1
    ]
    names = short_names(varied)
    devices = sorted({c.device for c in configurations})
    for configuration in configurations:
        parts = [f"{names[key]} {as_text(configuration.axes.get(key))}" for key in varied]
        if len(devices) > 1:
            parts.append(f"device {devices.index(configuration.device) + 1}")
        configuration.label = ", ".join(parts) or "all runs"


def read_configurations(runs: list[dict]) -> dict[str, Configuration]:
    """By the hash of a run; those that differ in nothing but their seed share one."""
    by_axes = {}
    by_hash = {}
    for run in runs:
        axes = {
            key: float(value)
            if isinstance(value, (int, float)) and not isinstance(value, bool)
            else str(value)
            for key, value in run["axes"].items()
            if key != SEED
        }
        alike = by_axes.setdefault(tuple(axes.items()), Configuration(run["hash"], axes, []))
        alike.products = sorted({*alike.products, *run["products"]})
        by_hash[run["hash"]] = alike
    return by_hash


def read_study(folder: Path) -> Study:
    described = read_json(folder / "experiment.json")
    if described.get("schema") != "kaustik.experiment/1":
        raise StudyError(f"{folder / 'experiment.json'} is not a kaustik.experiment/1.")
    axes = [
        Axis(axis["key"], axis["unit"], axis["description"], axis["products"])
        for axis in described["axes"]
        if axis["key"] != SEED
    ]
    by_hash = read_configurations(described["runs"])
    samples = {}
    if (folder / "samples.json").exists():
        for run in read_json(folder / "samples.json").get("runs", []):
            samples[run["hash"], run["repeat"]] = run["frame_samples_ms"]
    on_devices = {}
    seeds = len({run["axes"].get(SEED) for run in described["runs"]})
    failures = []
    try:
        with open(folder / "runs.csv", encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            columns = list(reader.fieldnames or [])
            for cells in reader:
                row = {key: as_value(text or "") for key, text in cells.items() if key}
                configuration = by_hash.get(cells["hash"])
                if row.get("status") == "failed":
                    failures.append(row)
                elif configuration is not None:
                    device = device_of(row)
                    own = on_devices.setdefault(
                        (id(configuration), device),
                        replace(configuration, device=device, rows=[], folders=[], frame_samples_ms=[]),
                    )
                    own.rows.append(row)
                    own.folders.append(folder / cells["folder"])
                    if (cells["hash"], row["repeat"]) in samples:
                        own.frame_samples_ms.append(samples[cells["hash"], row["repeat"]])
    except OSError as error:
        raise StudyError(f"{folder / 'runs.csv'} cannot be read: {error.strerror}.") from error
    except KeyError as error:
        raise StudyError(f"{folder / 'runs.csv'} has no column {error}.") from error
    # In the order of their first runs.
    order = {id(c): index for index, c in reversed(list(enumerate(by_hash.values())))}
    configurations = [
        c for (of, _), c in sorted(on_devices.items(), key=lambda item: (order[item[0][0]], item[0][1]))
    ]
    if not configurations:
        raise StudyError(f"{folder / 'runs.csv'} has no finished run, so there is nothing to draw.")
    label_all(configurations, axes)
    return Study(
        folder,
        described["name"],
        described["description"],
        described["version"],
        described["repeats"] * seeds,
        seeds,
        len(by_hash) * described["repeats"],
        axes,
        configurations,
        failures,
        columns,
    )
