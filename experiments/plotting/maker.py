# SPDX-License-Identifier: MIT
"""For programs that make rows of results/ themselves: of which sources and of which day each is, and how its file is read and written."""

import csv
import datetime
import json
import sys
from pathlib import Path

from sources import ROOT, Tree


class Maker:
    """What rows say of their sources, for a program that makes them one after the other."""

    def __init__(self, kaustik: str | Path, root: Path = ROOT):
        self.tree = Tree(root)
        self.begin = self.tree.fingerprint()  # all files are read now: keys are of them as they are
        self.known = self.tree.has_built(kaustik)
        self.kaustik = kaustik

    def require(self) -> None:
        """Of what is made anew: it would be of no known sources, and made anew for ever."""
        if not self.known:
            sys.exit(f"'{self.kaustik}' is not what the sources of {self.tree.root} make now, which --anew needs; build it first")

    def sources(self, key: str) -> str:
        """The key, but none where the program is not this tree's, or sources were changed since."""
        return key if self.known and Tree(self.tree.root).fingerprint() == self.begin else ""

    def note(self, file: Path, key: str) -> None:
        """Of what is kept and tabled later: when it was made, and of which sources."""
        file.write_text(json.dumps({"date": now(), "sources": self.sources(key)}) + "\n")


def now() -> str:
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def made(*files: Path) -> dict[str, str]:
    """What `Maker.note` noted, of several the last day and the sources that all are of; nothing of what it did not."""
    notes = [json.loads(file.read_text()) if file.is_file() else {"date": "", "sources": ""} for file in files]
    keys = {note["sources"] for note in notes}
    return {"date": max(note["date"] for note in notes), "sources": keys.pop() if len(keys) == 1 else ""}


def rows_in(file: Path) -> list[dict]:
    """Of a CSV, if it is there."""
    if not file.is_file():
        return []
    with file.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def write_whole(file: Path, columns: list[str], rows: list[dict]) -> None:
    """A CSV, whole or not at all: rows of before would be lost with it. What a row does not say is blank."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with (part := file.with_suffix(".part")).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n", restval="")
        writer.writeheader()
        writer.writerows(rows)
    part.replace(file)
