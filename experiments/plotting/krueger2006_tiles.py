# SPDX-License-Identifier: MIT
"""Counts of what each tile of the screen took (experiments/krueger2006_tiles.sh), from its folder or from the tiles.csv that it has left.

Reads the heads of the tiles' files, SCENE-TRACER-N.tiles/round-R-tile-K-of-N.hits, writes them to
tiles.csv and prints, for each number of tiles, by how much the slowest tile has less to do than
the whole screen. Tiles wait for each other after each round: of steps and squares the largest
count of each round is summed, of fragments, which are the same in each round, one is taken.
"""

import csv
import json
import pathlib
import re
import sys

FOLDER = re.compile(r"(.+)-(hierarchical|lines)-(\d+)\.tiles")
FILE = re.compile(r"round-(\d+)-tile-(\d+)-of-\d+\.hits")
COUNTS = ["own_pixels", "shown_pixels", "fragments", "photons", "steps", "squares"]


def head_of(file):
    with open(file, "rb") as stream:
        stream.readline()
        return json.loads(stream.readline())


def rows_of(folder):
    scene, tracer, tiles = FOLDER.fullmatch(folder.name).groups()
    rows = []
    for file in folder.iterdir():
        match = FILE.fullmatch(file.name)
        if not match:
            continue
        head = head_of(file)
        lists = head["lists"]
        rows.append({
            "scene": scene, "tracer": tracer, "size": head["subject"]["size"],
            "tiles": int(tiles),
            "round": int(match[1]), "tile": int(match[2]),
            **{name: head["cost"][name] for name in COUNTS},
            "traced": sum(one["photons"] for one in lists),
            "hits": sum(one["hits"] for one in lists),
            "hit_bytes": sum(one["hits"] * (76 if one["shapes"] else 60) for one in lists)})
    return sorted(rows, key=lambda row: (row["round"], row["tile"]))


def summary_of(rows):
    """Sums over all tiles, and what the slowest tile of each round does."""
    rounds = sorted({row["round"] for row in rows})

    def over_rounds(name, choose):
        return sum(choose(row[name] for row in rows if row["round"] == number)
                   for number in rounds)

    first = [row["fragments"] for row in rows if row["round"] == rounds[0]]
    work = {name: (over_rounds(name, sum), over_rounds(name, max)) for name in ("steps", "squares")}
    work["fragments"] = (sum(first), max(first))
    return work, len(rounds), sum(row["hit_bytes"] for row in rows)


def rows_of_csv(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return [{key: int(text) if text.isdecimal() else text for key, text in row.items()} for row in csv.DictReader(stream)]


def rows_of_folders(out):
    folders = [folder for folder in pathlib.Path(out).iterdir() if FOLDER.fullmatch(folder.name)]
    all_rows = sorted((row for folder in folders for row in rows_of(folder)),
                      key=lambda row: (row["scene"], row["tracer"], row["tiles"]))
    with open(pathlib.Path(out) / "tiles.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, all_rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(all_rows)
    return all_rows


def main(out):
    all_rows = rows_of_csv(out) if pathlib.Path(out).is_file() else rows_of_folders(out)
    print("| scene | tracer | tiles | rounds | fragments, all | largest | steps, all | largest |"
          " squares, all | largest | hits exchanged, MB |")
    print("|---|---|" + "---:|" * 9)
    for scene, tracer in sorted({(row["scene"], row["tracer"]) for row in all_rows}):
        own = [row for row in all_rows if (row["scene"], row["tracer"]) == (scene, tracer)]
        whole = summary_of([row for row in own if row["tiles"] == 1])[0]
        for tiles in sorted({row["tiles"] for row in own} - {1}):
            work, rounds, size = summary_of([row for row in own if row["tiles"] == tiles])
            cells = [f"`{scene}`", f"`{tracer}`", str(tiles), str(rounds)]
            for name in ("fragments", "steps", "squares"):
                total, slowest = work[name]
                if whole[name][0] == 0:
                    cells += ["–", "–"]
                    continue
                cells += [f"{total / whole[name][0]:.2f}", f"1/{whole[name][1] / slowest:.2f}"]
            print("| " + " | ".join(cells + [f"{size / 1e6:.1f}"]) + " |")


if __name__ == "__main__":
    main(sys.argv[1])
