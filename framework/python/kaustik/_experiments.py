# SPDX-License-Identifier: MIT
"""Studies of many runs. Each run is a process of its own, as on the command line."""

import csv
import json
import os
import signal
import subprocess
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _kaustik

Path = Union[str, "os.PathLike[str]"]


def run_experiment(
    spec: Union[Path, Mapping[str, Any]], out: Path = "", *, resume: bool = False, shard: str = ""
) -> List[Dict[str, Any]]:
    """Does the runs of a study and gives read_results() of them.

    spec is a .toml file, or a dict with the same keys (name, repeats, base, permute), whose files
    are seen from the current folder: {"name": "layers", "base": {"scene": "ring"}, "permute":
    {"layers.count": [1, 4]}}. out is the folder of results, by default
    results/runs/experiments/NAME; resume goes on with those that are there. shard, "2/8", does
    the second eighth of the runs alone and gives none: merge_experiments() does once all are there.
    Ctrl-C keeps what is finished. Raises ConfigError for a spec that makes no sense and
    KaustikError when runs fail.
    """
    with tempfile.TemporaryDirectory(prefix="kaustik-") as folder:
        if isinstance(spec, Mapping):
            file = os.path.join(folder, "spec.toml")
            with open(file, "w", encoding="utf-8") as stream:
                stream.writelines(f"{_entry(key, value)}\n" for key, value in spec.items())
        else:
            file = os.fspath(spec)
        command = ["experiment", "run", file]
        if os.fspath(out):
            command += ["--out", os.fspath(out)]
        if resume:
            command.append("--resume")
        if shard:
            command += ["--shard", shard]
        return _results_of(run_program(command))


def merge_experiments(
    folders: Union[Path, Sequence[Path]], out: Path = "", *, incomplete: bool = False
) -> List[Dict[str, Any]]:
    """Puts the shards of a study together, and gives read_results() of all.

    folders are those of run_experiment(shard=…), one or several, in any order; out is the folder of
    results, by default the only one of folders. A run that is there twice counts once. Raises
    ConfigError for shards of different studies, and for missing ones unless incomplete is true;
    KaustikError when runs have failed.
    """
    several = [folders] if isinstance(folders, (str, os.PathLike)) else list(folders)
    command = ["experiment", "merge", *map(os.fspath, several)]
    if os.fspath(out):
        command += ["--out", os.fspath(out)]
    if incomplete:
        command.append("--incomplete")
    return _results_of(run_program(command))


def read_results(folder: Path) -> List[Dict[str, Any]]:
    """The runs of a study, one dict each: the columns of its runs.csv, numbers as int or float and
    empty cells as None. IoError where the folder has no runs.csv."""
    file = os.path.join(os.fspath(folder), "runs.csv")
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
    except OSError as error:
        raise _kaustik.IoError(
            f"{file} cannot be read: {error.strerror}; kaustik.run_experiment() makes one."
        ) from None
    return [{key: _cell(text) for key, text in row.items()} for row in rows]


def _results_of(printed: str) -> List[Dict[str, Any]]:
    """What a command says that it has written; a shard writes no tables."""
    written = [line[6:] for line in printed.splitlines() if line.startswith("wrote ")]
    return read_results(os.path.dirname(written[0])) if written else []


def _cell(text: Optional[str]) -> Union[int, float, str, None]:
    if not text:
        return None
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text


def _entry(key: Any, value: Any) -> str:
    return f"{json.dumps(str(key), ensure_ascii=False)} = {_toml(key, value)}"


def _toml(key: str, value: Any) -> str:
    """A value as TOML writes it in one line; a file is named from where we are."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(_entry(inner, element) for inner, element in value.items()) + "}"
    if isinstance(value, (list, range)):
        return "[" + ", ".join(_toml(key, element) for element in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple) and len(value) == 2:
        return json.dumps(f"{value[0]}x{value[1]}")
    if isinstance(value, (int, float)):
        return repr(value)
    if not isinstance(value, (str, os.PathLike)):
        raise _kaustik.ConfigError(f"The study's '{key}' cannot be {value!r}.")
    text = os.fspath(value)
    if key in ("scene", "reference") and os.path.splitext(text)[1]:
        text = os.path.abspath(text)
    return json.dumps(text, ensure_ascii=False)


def run_program(arguments: List[str]) -> str:
    """Runs the program `kaustik`, and raises what it says."""
    program = _kaustik.program()
    try:
        process = subprocess.Popen(
            [program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
    except OSError as error:
        raise _kaustik.IoError(
            f"{program} cannot be started ({error.strerror}); it does studies and censuses."
        ) from None
    try:
        printed, said = process.communicate()
    except KeyboardInterrupt:
        process.send_signal(signal.SIGINT)  # it seals what is finished
        process.communicate()
        raise
    if process.returncode != 0:
        # Progress comes before the error, a line each.
        message = (said.strip().splitlines() or [f"{program} ended with {process.returncode}."])[-1]
        kind = _kaustik.ConfigError if process.returncode == 2 else _kaustik.KaustikError
        raise kind(message.removeprefix("kaustik: "))
    return printed
