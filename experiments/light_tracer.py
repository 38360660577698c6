#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a user would pick instead: exact light tracing and progressive photon mapping, their error and time.

    light_tracer.py --out FILE [--kaustik build/release/bin/kaustik] [--scenes NAME...] [--size 400x300]
                    [--reference-photons 16777216] [--photons 524288 1048576 4194304] [--threads 0] [--anew]

For each scene `kaustik reference` is run with few photons and a seed of its own, by both estimators (every photon
straight into its pixel; photons gathered where the eye's rays end, `sppm`), and compared with the reference that
all_techniques.toml uses. Writes a CSV: scene, estimator, photons, seconds (tracing alone, on `threads`
processors), relMSE, what of it is the reference's own noise, SMAPE, HDR FLIP, energy, version; and the day, the
processor, how many others were busy meanwhile, and the key of the sources (plotting/sources.py: the framework and
the scene). A row that is in FILE already is not run again, so that it can be interrupted; with --anew those are
that are of other sources than the tree's, or of none that are known. Times need an idle machine.
"""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "experiments/plotting"))
from maker import Maker, now, rows_in, write_whole  # noqa: E402
from study import device_of  # noqa: E402

SEED = 7  # not that of the references, whose photons would be the same
COLUMNS = ["scene", "estimator", "size", "photons", "seconds", "relMSE", "relMSE, reference's own", "SMAPE", "HDR FLIP",
           "energy", "version", "asked", "date", "device", "other_processors", "sources"]
SETTINGS = ("scene", "estimator", "asked")


def kaustik(program: pathlib.Path, *arguments, cache: pathlib.Path | None = None) -> str:
    environment = dict(os.environ, **({"KAUSTIK_CACHE": str(cache)} if cache else {}))
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=environment)
    if done.returncode:
        sys.exit(f"light_tracer: 'kaustik {' '.join(map(str, arguments))}' ended with {done.returncode}: {done.stderr}")
    return done.stdout


class Load:
    """How many processors other work keeps busy, as the program measures it for a run (framework/core/machine.cpp)."""

    def __init__(self):
        self.begin = self.times()

    @staticmethod
    def times() -> tuple[float, float, float]:
        """Of the machine and of this process and its children, s of processors; and the clock's."""
        user, nice, system, _, _, interrupts, soft, stolen = map(int, pathlib.Path("/proc/stat").read_text().split()[1:9])
        own = sum(use.ru_utime + use.ru_stime for use in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))
        return (user + nice + system + interrupts + soft + stolen) / os.sysconf("SC_CLK_TCK"), own, time.monotonic()

    def others(self) -> float:
        machine, own, clock = (now - then for now, then in zip(self.times(), self.begin))
        return max(machine - own, 0.0) / max(clock, 1e-9)


def processor(threads: int) -> str:
    """What its times are of, with as many threads as are asked for (0: all)."""
    names = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    return device_of({"cpu": names[0] if names else "unknown", "threads": threads or os.cpu_count()})


def measure(options, scene: str, estimator: str, photons: int, folder: pathlib.Path) -> dict:
    reference, image = folder / f"{pathlib.PurePath(scene).stem}.exr", folder / "image.exr"
    if not reference.exists():
        kaustik(options.kaustik, "reference", scene, "--size", options.size, "--photons", options.reference_photons,
                "--out", reference)
    # Out of an empty cache: what is there already is not traced, and so has no time.
    load, begin = Load(), now()
    with tempfile.TemporaryDirectory() as cache:
        kaustik(options.kaustik, "reference", scene, "--size", options.size, "--photons", photons, "--seed", SEED,
                "--estimator", estimator, "--threads", options.threads, "--out", image, cache=pathlib.Path(cache))
    others = load.others()
    traced = json.loads(image.with_suffix(".json").read_text())
    error = json.loads(kaustik(options.kaustik, "compare", "--json", "--stderr",
                               reference.with_suffix(".stderr.exr"), image, reference))["error"]
    return {"scene": scene, "estimator": estimator, "size": options.size, "photons": traced["photons"],
            "seconds": traced["compute_s"], "relMSE": error["rel_mse"],
            "relMSE, reference's own": error["truth_noise"]["rel_mse"], "SMAPE": error["smape"],
            "HDR FLIP": error["flip_hdr"], "energy": error["energy_ratio"], "version": traced["version"],
            "date": begin, "device": processor(options.threads), "other_processors": f"{others:.3g}"}


def identity(row: dict) -> tuple[str, ...]:
    return tuple(str(row[key]) for key in SETTINGS)


def wanted(scenes: list[str], photons: list[int], rows: list[dict], device: str, key_of=None) -> list[tuple[str, str, int]]:
    """Scene, estimator and photons of the rows that are not there, or, with `key_of` of a scene, are not of its key and of this device."""
    done = {identity(row) for row in rows if key_of is None or (row.get("sources"), row.get("device")) == (key_of(row["scene"]), device)}
    return [(scene, estimator, count) for scene in scenes for estimator in ("light", "sppm") for count in photons
            if (scene, estimator, str(count)) not in done]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--kaustik", type=pathlib.Path, default=ROOT / "build/release/bin/kaustik")
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--reference-photons", type=int, default=16777216)
    parser.add_argument("--photons", type=int, nargs="+", default=[524288, 1048576, 4194304])
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--anew", action="store_true")
    options = parser.parse_args()
    scenes = options.scenes or [line.split()[0] for line in kaustik(options.kaustik, "list", "scenes").splitlines()]

    maker, rows = Maker(options.kaustik), rows_in(options.out)
    if options.anew:
        maker.require()
    device = processor(options.threads)
    missing = wanted(scenes, options.photons, rows, device, maker.tree.key_without_technique if options.anew else None)
    # Of the scenes that are measured now: another's rows may be of another machine, all of them.
    measured, replaced = {scene for scene, *_ in missing}, {tuple(map(str, one)) for one in missing}
    others = {row["device"] for row in rows if row.get("device") and row["scene"] in measured and identity(row) not in replaced} - {device}
    if missing and others:
        sys.exit(f"light_tracer: '{options.out}' has times of {' and '.join(sorted(others))}, and this is {device}: what a photon costs is a difference of rows. "
                 "Make all anew, or another file")
    with tempfile.TemporaryDirectory() as folder:
        for scene, estimator, photons in missing:
            row = measure(options, scene, estimator, photons, pathlib.Path(folder)) | {
                "asked": photons, "sources": maker.sources(maker.tree.key_without_technique(scene))}
            at = next((i for i, old in enumerate(rows) if identity(old) == identity(row)), len(rows))
            rows[at:at + 1] = [row]
            write_whole(options.out, COLUMNS, rows)
            said = "no caustic" if row["relMSE"] is None else f"relMSE {row['relMSE']:.3g}"
            print(f"{scene}, {estimator}, {row['photons']} photons: {row['seconds']:.2f} s, {said}", flush=True)


if __name__ == "__main__":
    main()
