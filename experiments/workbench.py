#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the workbench costs while it renders, and what of its window the picture has: `kaustik gui pool` under Xvfb, used by mouse (XTEST).

    experiments/workbench.py [--kaustik build/release/bin/kaustik] [--scene pool] [--out results/workbench]

At 1600x1000. Starts it once so that all programs are compiled, then measures from a new start: the time until the window is drawn, to the first, quick picture
and to the first whole one; what a frame of the interface takes while the camera is turned and, the mouse moving over the picture, while frames are rendered
(status.interface_ms of --describe). Frames are the default's, and, so that one takes about three seconds, some of 1280x1280 photons. Of both:
what a frame takes when nobody touches the window (the panel Passes, saved as CSV by its button) next to `kaustik run --precise` of the same.
Frames are sums of their passes' medians. Then how much of the window the picture has as the workbench first starts, at two sizes.
Writes OUT/interface.csv, a row a quantity, and OUT/layout.csv. Needs Xvfb and libXtst; on a machine that nobody else uses (cpu time of others is in the rows).
"""

import argparse
import csv
import ctypes
import itertools
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SIZE = (1600, 1000)
SMALL = (1024, 768)
LONG_FRAME = {"emit.photons": "1280x1280"}
PROJECT = Path(__file__).resolve().parent.parent


class Desktop:
    """An X server of its own, with a mouse."""

    def __init__(self, size):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size[0]}x{size[1]}x24"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):  # it comes in parts
            number += os.read(read, 16)
        self.name = ":" + number.decode().strip()
        os.close(read)
        self.x11 = ctypes.CDLL("libX11.so.6")
        self.xtst = ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(self.name.encode()))

    def move(self, x, y):
        self.xtst.XTestFakeMotionEvent(self.display, -1, int(x), int(y), 0)
        self.x11.XFlush(self.display)

    def button(self, down):
        self.xtst.XTestFakeButtonEvent(self.display, 1, int(down), 0)
        self.x11.XFlush(self.display)

    def key(self, name):
        """To the window under the mouse: nothing manages windows here."""
        self.x11.XSetInputFocus(self.display, ctypes.c_ulong(1), 1, ctypes.c_ulong(0))
        self.x11.XStringToKeysym.restype = ctypes.c_ulong
        self.x11.XKeysymToKeycode.argtypes = [ctypes.c_void_p, ctypes.c_ulong]
        code = self.x11.XKeysymToKeycode(self.display, self.x11.XStringToKeysym(name.encode()))
        for is_down in (1, 0):
            self.xtst.XTestFakeKeyEvent(self.display, code, is_down, 0)
            self.x11.XFlush(self.display)
            time.sleep(0.1)

    def close(self):
        self.x11.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait()


class Workbench:
    """The program with new settings: only the window's size, a document's settings and a folder for tables."""

    def __init__(self, options, desktop, folder, size=SIZE, assignments=None):
        self.file = folder / "screen.json"
        self.file.unlink(missing_ok=True)
        settings = folder / "config/kaustik/workbench.json"
        settings.parent.mkdir(parents=True, exist_ok=True)
        kept = {"window": {"width": size[0], "height": size[1], "x": 0, "y": 0}, "panels": {"record_folder": str(folder / "tables")}}
        if assignments:
            kept["document"] = {"scene": options.scene, "edits": {}, "size": [800, 600],
                                "variant": {"technique": "exact_rays", "set": assignments, "disable": []}}
        settings.write_text(json.dumps(kept))
        environment = dict(os.environ, DISPLAY=desktop.name, XDG_CONFIG_HOME=str(folder / "config"))
        environment.pop("WAYLAND_DISPLAY", None)
        words = [options.kaustik, "gui", options.scene, "--describe", str(self.file)]
        self.begin = time.monotonic()
        self.process = subprocess.Popen(words, env=environment, cwd=folder)

    def screen(self):
        try:
            return json.loads(self.file.read_text())
        except (OSError, ValueError):
            return None

    def until(self, is_so, seconds=600, meanwhile=lambda: None):
        while time.monotonic() - self.begin < seconds:
            meanwhile()
            if self.process.poll() is not None:
                sys.exit("workbench.py: the workbench has ended")
            screen = self.screen()
            if screen and is_so(screen):
                return screen, time.monotonic() - self.begin
            time.sleep(0.01)
        sys.exit("workbench.py: the workbench never came so far")

    def close(self):
        self.process.terminate()
        self.process.wait()


def middle_of(control):
    return control["x"] + control["w"] / 2, control["y"] + control["h"] / 2


def is_settled(screen):
    return screen["status"]["settled"]


def interface(screen):
    times = sorted(screen["status"]["interface_ms"])
    return statistics.median(times), times[int(0.99 * (len(times) - 1))]


def pass_sum(rows):
    """The sum of a table's column of medians."""
    column = next(name for name in rows[0] if "median" in name)
    return sum(float(row[column]) for row in rows if row[column] not in ("", "–"))


def has_bar(screen):
    return "picture.bar" in screen["controls"]


def share_of(screen, control, size):
    area = screen["controls"][control]
    return 100 * area["w"] * area["h"] / (size[0] * size[1])


def start(options, desktop, folder):
    """From a start with all programs compiled."""
    bench = Workbench(options, desktop, folder)
    _, window = bench.until(lambda screen: True)
    screen, quick = bench.until(lambda s: s["controls"].get("picture", {}).get("value") in ("preview", "whole"))
    if screen["controls"]["shown"]["value"] != "preview":
        sys.exit("workbench.py: the first picture is not said to be a quick one")
    _, whole = bench.until(lambda s: s["controls"].get("picture", {}).get("value") == "whole")
    screen, _ = bench.until(is_settled)
    x, y = middle_of(screen["controls"]["picture"])
    desktop.move(x, y)
    desktop.button(True)
    for step in range(600):
        desktop.move(x + step % 200, y)
        time.sleep(1 / 60)
    turned = interface(bench.screen())
    desktop.button(False)
    bench.close()
    return [("start: window", window, "s"), ("start: quick picture", quick, "s"), ("start: whole picture", whole, "s"),
            ("interface while the camera is turned, median", turned[0], "ms"), ("interface while the camera is turned, 99 %", turned[1], "ms")]


def frames(options, desktop, folder, what, assignments):
    """Of frames with these settings: the interface meanwhile, and what they take next to `kaustik run`."""
    bench = Workbench(options, desktop, folder, assignments=assignments)
    screen, _ = bench.until(lambda s: "picture" in s["controls"])
    x, y = middle_of(screen["controls"]["picture"])
    steps = itertools.count()
    screen, _ = bench.until(is_settled, meanwhile=lambda: desktop.move(x + next(steps) % 200, y))
    if screen["status"]["document"]["variant"]["set"] != assignments:
        sys.exit("workbench.py: the workbench has not taken the settings over")
    median, worst = interface(screen)
    bench.close()
    quiet = Workbench(options, desktop, folder, assignments=assignments)
    screen, _ = quiet.until(is_settled)
    desktop.move(*middle_of(screen["controls"]["table.csv.passes"]))
    time.sleep(0.5)
    desktop.button(True)
    time.sleep(0.5)
    desktop.button(False)
    time.sleep(2)
    quiet.close()
    tables = list((folder / "tables").glob("*.csv"))
    if not tables:
        sys.exit(f"workbench.py, {what}: the button CSV of the panel Passes has saved nothing")
    with open(tables[0], newline="", encoding="utf-8") as file:
        here = pass_sum(list(csv.DictReader(file)))
    tables[0].unlink()
    words = [word for key, value in assignments.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([options.kaustik, "run", options.scene, "--precise", "--frames", "3", "--warmup", "1", "--out", str(folder / what), *words],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    report = json.loads((folder / what / "report.json").read_text())
    alone = sum(p["gpu_ms"]["median"] for p in report["passes"] if p.get("gpu_ms"))
    return [(f"interface during {what}, median", median, "ms"), (f"interface during {what}, 99 %", worst, "ms"), (f"{what}, in the workbench", here, "ms"),
            (f"{what}, by kaustik run", alone, "ms"), (f"{what}, ratio", here / alone, "")], report


def layout(options, desktop, folder, size):
    bench = Workbench(options, desktop, folder, size)
    screen, _ = bench.until(is_settled)
    shares = [share_of(screen, "picture.pane", size), share_of(screen, "picture", size)]
    desktop.move(*middle_of(screen["controls"]["picture"]))
    time.sleep(0.5)
    desktop.key("f")
    screen, _ = bench.until(has_bar)
    shares.append(share_of(screen, "picture", size))
    bench.close()
    return [f"{size[0]}×{size[1]}", *(f"{share:.1f}" for share in shares)]


def write(file, columns, rows, provenance):
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([*columns, "command", "version", "device", "seed", "date", "other_processors"])
        writer.writerows([*row, *provenance] for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kaustik", default=str(PROJECT / "build/release/bin/kaustik"))
    parser.add_argument("--scene", default="pool")
    parser.add_argument("--out", type=Path, default=PROJECT / "results/workbench")
    options = parser.parse_args()
    options.kaustik = str(Path(options.kaustik).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        desktop = Desktop(SIZE)
        try:
            warm = Workbench(options, desktop, folder)
            warm.until(is_settled)
            warm.close()
            results = start(options, desktop, folder)
            usual, report = frames(options, desktop, folder, "a frame", {})
            long, other = frames(options, desktop, folder, "a long frame", LONG_FRAME)
            results += usual + long
            layouts = [layout(options, desktop, folder, size) for size in (SMALL, SIZE)]
        finally:
            desktop.close()
    load = max(one["timing"].get("other_processors", 0.0) for one in (report, other))
    device = report["device"]
    provenance = [f"experiments/workbench.py --scene {options.scene}", report["version"],
                  f"{device['renderer']}, {device['cpu']}, {device['threads']} threads", "", report["timing"]["date"][:10], f"{load:.2f}"]
    for what, value, unit in results:
        print(f"{what}: {value:.4g} {unit}")
    for row in layouts:
        print(*row)
    options.out.mkdir(parents=True, exist_ok=True)
    write(options.out / "interface.csv", ["quantity", "value", "unit"], [[what, f"{value:.4g}", unit] for what, value, unit in results], provenance)
    write(options.out / "layout.csv", ["window", "pane, %", "pixels alone, %", "pixels next to a colour bar, %"], layouts, provenance)


if __name__ == "__main__":
    main()
