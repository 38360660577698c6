#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The normal map waves.png of this folder's scenes: a surface of waves that repeats, as 16-bit PNG.

    make_waves.py waves.png [--side 96] [--seed 7]

Each wave has whole numbers of crests along both sides, so that copies fit together, and less slope the shorter it is.
"""

import argparse
import math
import pathlib
import random
import struct
import zlib

WAVES, MOST_CRESTS, SLOPE = 24, 6, 0.35


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def normal_at(u: float, v: float, waves: list) -> tuple:
    along_u = along_v = 0.0
    for across, up, slope, phase in waves:
        rise = slope * math.sin(2.0 * math.pi * (across * u + up * v) + phase) / math.hypot(across, up)
        along_u += rise * across
        along_v += rise * up
    length = math.sqrt(along_u**2 + along_v**2 + 1.0)
    return along_u / length, along_v / length, 1.0 / length


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--side", type=int, default=96)
    parser.add_argument("--seed", type=int, default=7)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    waves = []
    while len(waves) < WAVES:
        across, up = chance.randint(-MOST_CRESTS, MOST_CRESTS), chance.randint(-MOST_CRESTS, MOST_CRESTS)
        if across or up:
            waves.append((across, up, SLOPE / (1.0 + math.hypot(across, up)), chance.uniform(0.0, 2.0 * math.pi)))
    side, rows = arguments.side, []
    for row in range(side):  # from the top, where v is 1
        normals = [normal_at((column + 0.5) / side, 1.0 - (row + 0.5) / side, waves) for column in range(side)]
        rows.append(b"\0" + b"".join(struct.pack(">3H", *(round((0.5 + 0.5 * x) * 65535) for x in normal)) for normal in normals))
    head = struct.pack(">IIBBBBB", side, side, 16, 2, 0, 0, 0)
    arguments.file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
