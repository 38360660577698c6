# SPDX-License-Identifier: MIT
"""What read() gives, as other libraries take it."""

import base64
import gc
import io
import os
import struct
import unittest

import numpy
import OpenImageIO

import kaustik
from support import TestCase


class Arrays(TestCase):
    def setUp(self):
        r = self.open()
        r.step()
        self.display = r.read("display")
        self.array = r.read("caustic.irradiance")
        self.layers = r.read("layers.depth")

    def test_share_their_memory_with_whoever_takes_them(self):
        taken = [
            numpy.asarray(self.array),
            numpy.from_dlpack(self.array),
            numpy.asarray(memoryview(self.array)),
        ]
        for one in taken:
            self.assertEqual((one.shape, one.dtype), ((48, 64, 4), numpy.float32))
        taken[0][5, 6, 1] = 12.5
        for one in taken:
            self.assertEqual(one[5, 6, 1], 12.5)
        self.assertEqual(self.array[5, 6, 1], 12.5)
        self.assertEqual(self.array.__array_interface__["shape"], (48, 64, 4))
        self.assertEqual(self.array.__dlpack_device__(), (1, 0))

    def test_live_as_long_as_somebody_has_their_memory(self):
        expected = numpy.array(self.array, copy=True)
        taken = [numpy.asarray(self.array), numpy.from_dlpack(self.array)]
        capsule = self.array.__dlpack__(copy=True)
        self.array = None
        gc.collect()
        for one in taken:
            numpy.testing.assert_array_equal(one, expected)
        del capsule, taken
        gc.collect()

    def test_know_their_shape(self):
        self.assertEqual(self.array.shape, (48, 64, 4))
        self.assertEqual((self.array.ndim, self.array.dtype, len(self.array)), (3, "float32", 48))
        self.assertEqual(self.array.nbytes, 48 * 64 * 4 * 4)
        self.assertEqual(self.layers.shape, (8, 48, 64, 4))
        self.assertEqual(self.array[-1, -1, 0], numpy.asarray(self.array)[-1, -1, 0])
        for index in [(48, 0, 0), (0, 0), (0, 0, 0, 0)]:
            with self.assertRaises(IndexError):
                self.array[index]

    def test_have_their_rows_from_the_top(self):
        # The camera looks down on the plane: what is far is at the top.
        depth = numpy.asarray(self.layers)[0, :, :, 0]
        self.assertGreater(depth[1].mean(), depth[-2].mean())

    def test_are_not_handed_to_another_device(self):
        for options in ({"stream": 1}, {"dl_device": (2, 0)}):
            with self.assertRaises(BufferError):
                self.array.__dlpack__(**options)

    def test_are_written_as_images(self):
        folder = self.folder()
        file = os.path.join(folder, "irradiance.exr")
        self.array.save(file)
        read = OpenImageIO.ImageInput.open(file).read_image("float")
        numpy.testing.assert_array_equal(read, numpy.asarray(self.array))
        self.array.save(os.path.join(folder, "irradiance.png"))
        self.assert_fails(kaustik.ConfigError, [".exr"], self.array.save, "irradiance.txt")
        self.assert_fails(kaustik.ConfigError, ["8 layers"], self.layers.save, file)
        missing = os.path.join(file, "below.exr")
        self.assert_fails(kaustik.IoError, ["irradiance.exr"], self.array.save, missing)

    def test_are_pictures_in_notebooks(self):
        shown = self.display._repr_html_()
        png = base64.b64decode(shown.split("base64,")[1].split('"')[0])
        self.assertEqual(struct.unpack(">II", png[16:24]), (64, 48))
        file = os.path.join(self.folder(), "shown.png")
        with io.open(file, "wb") as stream:
            stream.write(png)
        pixels = OpenImageIO.ImageInput.open(file).read_image("uint8")
        expected = numpy.rint(numpy.asarray(self.display)[:, :, :3] * 255)
        numpy.testing.assert_array_equal(pixels, expected)
        self.assertIn("layer 0", self.layers._repr_html_())
        self.assertIn("white at", self.array._repr_html_())


if __name__ == "__main__":
    unittest.main()
