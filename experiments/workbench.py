#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the workbench costs while it renders: `kaustik gui pool` under Xvfb at 1600x1000, used by mouse (XTEST).

    experiments/workbench.py [--kaustik build/release/bin/kaustik] [--scene pool] [--size 1600x1000] [--out FILE.csv]

Starts it once so that all programs are compiled, then measures from a new start: the time to the first, quick picture and to the first whole one;
what a frame of the interface takes while frames are rendered and while the camera is turned (status.interface_ms of --describe, which has the window
drawn 60 times a second); and, without --describe, what a frame takes when nobody touches the window (the panel Passes, saved as CSV by its button)
next to `kaustik run --precise` of the same. Frames are sums of their passes' medians. A row a quantity: quantity, value, unit, device, command.
Needs Xvfb and libXtst; on a machine that nobody else uses.
"""

import argparse
import csv
import ctypes
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent


class Desktop:
    """An X server of its own, with a mouse."""

    def __init__(self, size):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size[0]}x{size[1]}x24"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        self.name = ":" + os.read(read, 16).decode().strip()
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

    def close(self):
        self.x11.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait()


class Workbench:
    def __init__(self, options, desktop, folder, describes):
        self.file = folder / "screen.json"
        self.file.unlink(missing_ok=True)
        environment = dict(os.environ, DISPLAY=desktop.name, XDG_CONFIG_HOME=str(folder / "config"))
        environment.pop("WAYLAND_DISPLAY", None)
        words = [options.kaustik, "gui", options.scene] + (["--describe", str(self.file)] if describes else [])
        self.begin = time.monotonic()
        self.process = subprocess.Popen(words, env=environment, cwd=folder)

    def screen(self):
        try:
            return json.loads(self.file.read_text())
        except (OSError, ValueError):
            return None

    def until(self, is_so, seconds=600):
        while time.monotonic() - self.begin < seconds:
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kaustik", default=str(PROJECT / "build/release/bin/kaustik"))
    parser.add_argument("--scene", default="pool")
    parser.add_argument("--size", default="1600x1000")
    parser.add_argument("--out", default="")
    options = parser.parse_args()
    options.kaustik = str(Path(options.kaustik).resolve())
    size = [int(side) for side in options.size.split("x")]
    results = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        settings = folder / "config/kaustik/workbench.json"
        settings.parent.mkdir(parents=True)
        settings.write_text(json.dumps({"window": {"width": size[0], "height": size[1], "x": 0, "y": 0}}))
        desktop = Desktop(size)
        try:
            warm = Workbench(options, desktop, folder, True)
            screen, _ = warm.until(is_settled)
            device = screen["status"]["device"]
            csv_button = middle_of(screen["controls"]["table.csv.passes"])
            warm.close()

            bench = Workbench(options, desktop, folder, True)
            screen, seconds = bench.until(lambda s: s["controls"].get("picture", {}).get("value") in ("preview", "whole"))
            results.append(("first picture", seconds, "s"))
            results.append(("first picture is said to be quick", int(screen["controls"]["shown"]["value"] == "preview"), ""))
            _, seconds = bench.until(lambda s: s["controls"].get("picture", {}).get("value") == "whole")
            results.append(("first whole picture", seconds, "s"))
            screen, _ = bench.until(is_settled)
            median, worst = interface(screen)
            results += [("interface while frames are rendered, median", median, "ms"),
                        ("interface while frames are rendered, 99 %", worst, "ms")]
            for kind in ("pane", "pixels"):
                control = screen["controls"]["picture.pane" if kind == "pane" else "picture"]
                results.append((f"{kind} of the picture", 100 * control["w"] * control["h"] / (size[0] * size[1]), "%"))
            x, y = middle_of(screen["controls"]["picture"])
            desktop.move(x, y)
            desktop.button(True)
            for step in range(600):
                desktop.move(x + step % 200, y)
                time.sleep(1 / 60)
            median, worst = interface(bench.screen())
            desktop.button(False)
            results += [("interface while the camera is turned, median", median, "ms"),
                        ("interface while the camera is turned, 99 %", worst, "ms")]
            bench.close()

            settings.write_text(json.dumps({"window": {"width": size[0], "height": size[1], "x": 0, "y": 0},
                                            "panels": {"record_folder": str(folder / "tables")}}))
            quiet = Workbench(options, desktop, folder, False)
            time.sleep(60)
            desktop.move(*csv_button)
            time.sleep(0.5)
            desktop.button(True)
            time.sleep(0.5)
            desktop.button(False)
            time.sleep(2)
            quiet.close()
            table = next((folder / "tables").glob("*.csv"))
            with open(table, newline="", encoding="utf-8") as file:
                frame = pass_sum(list(csv.DictReader(file)))
        finally:
            desktop.close()
        subprocess.run([options.kaustik, "run", options.scene, "--precise", "--frames", "3", "--warmup", "1",
                        "--out", str(folder / "run")], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads((folder / "run/report.json").read_text())
        alone = sum(p["gpu_ms"]["median"] for p in report["passes"] if p.get("gpu_ms"))
    results += [("frame in the workbench", frame, "ms"), ("frame of kaustik run", alone, "ms"), ("their ratio", frame / alone, "")]
    rows = [["quantity", "value", "unit", "device", "command"]]
    rows += [[what, f"{value:.4g}", unit, device, f"experiments/workbench.py --scene {options.scene} --size {options.size}"]
             for what, value, unit in results]
    for what, value, unit in results:
        print(f"{what}: {value:.4g} {unit}")
    if options.out:
        with open(options.out, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(rows)


if __name__ == "__main__":
    main()
