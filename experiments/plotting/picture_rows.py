# SPDX-License-Identifier: MIT
"""Of which run each committed picture is: a CSV in its folder with a row a run, which has the picture's hash, so that another file in its place is seen."""

import csv
import hashlib
from pathlib import Path

from study import device_of
from views import PROVENANCE

# Columns that every such file has; `run` is what kaustik was told, `command` the program that asked it.
FIRST = ("picture", "sha256", "technique", "scene", "size")
LAST = ("run", "sources", *PROVENANCE)
DIGITS = 12  # of the hash
PICTURES = (".jpg", ".png")


def digest_of(picture: Path) -> str:
    return hashlib.sha256(picture.read_bytes()).hexdigest()[:DIGITS]


def row_of(report: dict, run: list[str], command: str) -> dict:
    """What a run's report says of it."""
    device = report["device"]
    return {"technique": report["technique"], "scene": report["scene"]["name"], "size": "x".join(map(str, report["size"])), "run": "kaustik " + " ".join(run),
            "command": command, "version": report["version"], "device": device_of(device | {"device": device["renderer"]}), "seed": report["seed"],
            "date": report["timing"]["date"], "other_processors": f"{report['timing'].get('other_processors', 0.0):.2g}"}


def read(file: Path) -> list[dict]:
    if not file.is_file():
        return []
    with file.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def write(file: Path, rows: list[dict], measured: tuple = ()) -> None:
    """`measured`: further columns."""
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, [*FIRST, *measured, *LAST], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def wrong(file: Path) -> list[str]:
    """A sentence for each picture that is not there, is another one than its row says, or has no row."""
    rows, found = read(file), []
    if not rows:
        return [f"{file} has no rows"]
    for name, digest in dict.fromkeys((row["picture"], row["sha256"]) for row in rows):
        picture = file.parent / name
        if not picture.is_file():
            found.append(f"{picture} is not there; {file.name} has a row of it")
        elif digest_of(picture) != digest:
            found.append(f"{picture} is another picture than the one of {file.name}")
    known = {row["picture"] for row in rows}
    found += [f"{picture} has no row in {file.name}" for picture in sorted(file.parent.iterdir()) if picture.suffix in PICTURES and picture.name not in known]
    return found
