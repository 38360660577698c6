# SPDX-License-Identifier: MIT
"""What the tests of the Python module share: small scenes, the command line beside it."""

import os
import signal
import subprocess
import tempfile
import threading
import unittest

import kaustik

PROGRAM = os.environ["KAUSTIK_BINARY"]
SOURCE = os.environ["KAUSTIK_SOURCE"]

# Sunlight on a pane of still water above a floor; needs no file.
WATER = {
    "camera": {"position": [0, 2, 2.5], "target": [0, 0, 0]},
    "light": [{"name": "sun", "type": "directional", "direction": (0.1, -1, 0), "irradiance": 1000}],
    "material": [
        {"name": "floor", "type": "lambertian", "albedo": 0.7},
        {"name": "water", "type": "dielectric", "ior": 1.33},
    ],
    "object": [
        {"name": "floor", "material": "floor", "shape": "plane", "size": [3, 3]},
        {"name": "ball", "material": "water", "shape": "sphere", "radius": 0.4, "position": [0, 0.5, 0]},
    ],
}
SMALL = {
    "size": (64, 48),
    "technique": "screen_space_photons",
    "set": {"emit.photons": (32, 32), "shadow.map.size": 64},
}


class TestCase(unittest.TestCase):
    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return folder.name

    def open(self, scene="ring", **options):
        renderer = kaustik.open(scene, **{**SMALL, **options})
        self.addCleanup(renderer.close)
        return renderer

    def assert_fails(self, kind, words, call, *arguments, **options):
        """It raises exactly this kind, with one line that has all of the words."""
        with self.assertRaises(kaustik.KaustikError) as raised:
            call(*arguments, **options)
        message = str(raised.exception)
        self.assertIs(type(raised.exception), kind, message)
        self.assertNotIn("\n", message)
        for word in words:
            self.assertIn(word, message)


def command_line(*arguments):
    """What the program says; a failure is in `returncode` and `stderr`."""
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def interrupt_after(seconds):
    """Ctrl-C, as a terminal sends it."""
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()
