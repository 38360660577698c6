#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What frames must cost at least on devices of which no more is known than how fast their memory is.

    costs.py slim RUNS... --csv FILE
    costs.py frames FILE
    costs.py passes FILE

slim: of the report.json of runs with --device-model (or their folders) what is committed, a row a pass; rows of other frames stay in the file. frames: a row a technique and scene: bytes that
the frame reads and writes, each once in a pass, the time that this takes at 500, 1000 and 4800 GB/s, and the three passes that have most of it, ms at 1000 GB/s.
passes: every pass of `pool` by default and with each technique that has it, MB. Both print Markdown.
"""

import argparse
import csv
import json
import pathlib

COLUMNS = ["scene", "technique", "size", "photons", "layers", "pass", "read_bytes", "written_bytes", "requested_read_bytes", "requested_written_bytes", "atomics",
           "threads", "work_groups", "commands", "barriers", "read_backs"]
RUN = ["version", "device", "date"]
BANDWIDTHS = (500, 1000, 4800)  # GB/s
LARGEST = 3


def slim(file: pathlib.Path) -> list[dict]:
    report = json.loads((file / "report.json" if file.is_dir() else file).read_text())
    run = {"scene": report["scene"]["name"], "technique": report["technique"], "size": "x".join(map(str, report["size"])),
           "photons": report["parameters"]["emit.photons"], "layers": report["parameters"]["layers.count"], "version": report["version"], "date": report["timing"]["date"],
           "device": "{renderer}, {cpu}, {threads} threads".format(**report["device"])}
    return [run | {"pass": one["name"]} | {key: one[key] for key in COLUMNS[6:]} for one in report["cost"]["passes"]]


def write(files: list[pathlib.Path], target: pathlib.Path) -> None:
    frames = read(target) if target.exists() else {}
    for file in files:
        rows = slim(file)
        frames[rows[0]["scene"], rows[0]["technique"]] = rows
    target.parent.mkdir(parents=True, exist_ok=True)
    with target.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS + RUN, lineterminator="\n")
        writer.writeheader()
        for frame in sorted(frames):
            writer.writerows(frames[frame])


def read(file: pathlib.Path) -> dict[tuple[str, str], list[dict]]:
    """The passes of each frame, by scene and technique."""
    frames: dict[tuple[str, str], list[dict]] = {}
    with file.open(newline="") as stream:
        for row in csv.DictReader(stream):
            frames.setdefault((row["scene"], row["technique"]), []).append(row)
    return frames


def moved(row: dict) -> int:
    return int(row["read_bytes"]) + int(row["written_bytes"])


def milliseconds(count: int, gigabytes_per_second: float) -> float:
    return 1e3 * count / (1e9 * gigabytes_per_second)


def frames(file: pathlib.Path) -> str:
    lines = ["| scene | technique | read, MB | written, MB | asked for, MB | atomics, million | " + " | ".join(f"ms at {b} GB/s" for b in BANDWIDTHS) +
             " | largest passes, ms at 1000 GB/s |", "| --- | --- |" + " ---: |" * (4 + len(BANDWIDTHS)) + " --- |"]
    for (scene, technique), passes in sorted(read(file).items(), key=lambda frame: (frame[0][0], sum(map(moved, frame[1])))):
        def total(*keys: str) -> float:
            return sum(int(one[key]) for one in passes for key in keys) * 1e-6
        largest = sorted(passes, key=moved, reverse=True)[:LARGEST]
        all_bytes = sum(map(moved, passes))
        cells = [scene, f"`{technique}`", f"{total('read_bytes'):.0f}", f"{total('written_bytes'):.0f}",
                 f"{total('requested_read_bytes', 'requested_written_bytes'):.0f}", f"{total('atomics'):.1f}",
                 *(f"{milliseconds(all_bytes, b):.2f}" for b in BANDWIDTHS), "; ".join(f"{one['pass']} {milliseconds(moved(one), 1000):.2f}" for one in largest)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def passes(file: pathlib.Path) -> str:
    known = {technique: rows for (scene, technique), rows in sorted(read(file).items()) if scene == "pool"}
    names = list(dict.fromkeys(row["pass"] for rows in known.values() for row in rows))
    lines = ["| pass | " + " | ".join(f"`{technique}`" for technique in known) + " |", "| --- |" + " ---: |" * len(known)]
    for name in names:
        cells = []
        for rows in known.values():
            found = [moved(row) for row in rows if row["pass"] == name]
            cells.append(f"{found[0] * 1e-6:.1f}" if found else "–")
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["slim", "frames", "passes"])
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    asked = parser.parse_args()
    if asked.what == "slim":
        write(asked.files, asked.csv)
    else:
        print({"frames": frames, "passes": passes}[asked.what](asked.files[0]))


if __name__ == "__main__":
    main()
