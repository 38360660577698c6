# SPDX-License-Identifier: MIT
"""Of which sources the runs of a study's folder are, and the rows of its CSV: noted when they are made, and compared with the tree's (sources.py)."""

import json
import pathlib
import shutil
import time

from sources import SOURCES, Present, Tree, keys_noted
from speed_curves import DISTURBED


def reports_of(results: pathlib.Path) -> dict[str, pathlib.Path]:
    return {report.parent.name: report for report in results.glob("*/report.json")}


def stale(results: pathlib.Path, tree: Tree) -> list[pathlib.Path]:
    """The folders of runs that were made by other sources than the tree's now. Of a run without a key nothing is known: it stays."""
    keys = keys_noted(results)
    return [report.parent for name, report in reports_of(results).items()
            if name in keys and keys[name] != tree.key_of(json.loads(report.read_text()))]


def note_sources(results: pathlib.Path, tree: Tree, since: float) -> None:
    """Writes down the key of runs that were made since then, by the tree as it is; those of before keep theirs, or have none."""
    keys = keys_noted(results)
    keys |= {name: tree.key_of(json.loads(report.read_text())) for name, report in reports_of(results).items()
             if report.stat().st_mtime >= since}
    (results / SOURCES).write_text(json.dumps(keys, indent=0, sort_keys=True) + "\n")


def begin_of(marker: pathlib.Path, tree: Tree) -> float:
    """Since when runs are of the tree as it is: a call before this one may have been stopped before it noted their keys, and left its begin in `marker`. If sources
    have changed since, what it made keeps none."""
    before = json.loads(marker.read_text()) if marker.is_file() else {}
    begin = {"since": time.time(), "tree": tree.fingerprint()}
    if before.get("tree") == begin["tree"]:
        return before["since"]
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.write_text(json.dumps(begin) + "\n")
    return begin["since"]


def recipes_in(results: pathlib.Path, tree: Tree) -> list[dict]:
    """Of all runs that have a key."""
    keys = keys_noted(results)
    return [tree.recipe_of(json.loads(report.read_text())) for name, report in reports_of(results).items() if name in keys]


def of_tree(study: dict, row: dict, present: Present) -> bool:
    """Whether a row of a study's CSV is of the tree's sources. `study`: what its file says."""
    technique, scene = (row.get(key) or str(study.get("base", {}).get(key, "")) for key in ("technique", "scene"))
    return present.has(row.get("sources") or "", technique, scene)


def judged(study: dict, rows: list[dict], present: Present) -> dict[str, int]:
    """Of the rows of a study's CSV how many are of the tree's sources, how many of others, and how many of none that are known."""
    count = {"of the tree's sources": 0, "of others": 0, "not known": 0}
    for row in rows:
        count["not known" if not row.get("sources") else "of the tree's sources" if of_tree(study, row, present) else "of others"] += 1
    return count


def disturbed(results: pathlib.Path, since: float) -> list[pathlib.Path]:
    """The folders of runs made since then that had the machine not for themselves, by how much their frames differ; of scenes that stand still, since frames of
    others differ by themselves. A driver that still compiles in a frame that is timed disturbs a run too."""
    found = []
    for path in reports_of(results).values():
        report = json.loads(path.read_text())
        frames = report.get("frame_ms") or {}
        if (path.stat().st_mtime >= since and not report.get("time_step_s") and frames.get("mean")
                and (frames.get("stdev") or 0.0) > DISTURBED * frames["mean"]):
            found.append(path.parent)
    return found


def forget(folders: list[pathlib.Path], why: str) -> None:
    """Of runs, so that the study makes them again."""
    for folder in folders:
        shutil.rmtree(folder)
    if folders:
        print(f"{folders[0].parent.name}: {len(folders)} runs {why}", flush=True)
