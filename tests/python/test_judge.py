# SPDX-License-Identifier: MIT
"""kaustik.export and kaustik.judge."""

import os
import tempfile
import unittest

import numpy as np

import kaustik

SIZE = (64, 48)


class Judge(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def judge(self, theirs, **more):
        return kaustik.judge("ring", theirs, photons=2**20, causes=False, **more)

    def test_finds_the_exposure_of_caustics_alone_and_refuses_what_is_no_light(self):
        # On paper of one albedo radiance is irradiance times that over pi.
        caustic = np.asarray(kaustik.reference("ring", size=SIZE, photons=2**20, seed=5).irradiance)
        theirs = 3.0 * caustic * np.array([0.78, 0.77, 0.74], np.float32) / np.pi
        verdict = self.judge(theirs, direct="without")
        self.assertAlmostEqual(verdict["exposure"], 3.0, delta=0.1)
        self.assertEqual(verdict["exposure_by"], "R")
        self.assertEqual(verdict["classes"][0]["verdict"], "there")
        self.assertEqual(np.asarray(verdict["where"]).shape, (48, 64, 3))
        self.assertEqual(np.asarray(verdict["residual"]).shape, (48, 64, 3))
        self.assertIn("caustics alone", verdict["text"])
        theirs[3, 4, 1] = np.nan
        with self.assertRaisesRegex(kaustik.KaustikError, "no numbers"):
            self.judge(theirs)
        with self.assertRaisesRegex(kaustik.ConfigError, "glass: 'maybe'"):
            self.judge(caustic, glass="maybe")

    def test_takes_a_picture_in_the_primaries_that_are_asked_for(self):
        caustic = np.asarray(kaustik.reference("ring", size=SIZE, photons=2**20, seed=5).irradiance)
        radiance = caustic * np.array([0.78, 0.77, 0.74], np.float32) / np.pi
        # Rec. ITU-R BT.2087-0.
        to_rec2020 = np.array([[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]])
        theirs = (3.0 * radiance @ to_rec2020.T).astype(np.float32)
        verdict = self.judge(theirs, direct="without", primaries="rec2020")
        self.assertEqual(verdict["primaries"], "rec2020")
        self.assertAlmostEqual(verdict["exposure"], 3.0, delta=0.1)
        self.assertNotIn("channels", [finding["name"] for finding in verdict["findings"]])
        # Gold's light on paper is of one colour.
        found = self.judge(theirs, direct="without")
        self.assertEqual(found["primaries"], "rec709")
        self.assertIn("rec2020", found["other_primaries"])
        self.assertIn("channels", [finding["name"] for finding in found["findings"]])
        with self.assertRaisesRegex(kaustik.ConfigError, "primaries: 'ntsc'"):
            self.judge(caustic, primaries="ntsc")

    def test_exports_for_others_and_says_what_is_left_out(self):
        written = kaustik.export("ring", self.folder, to="pbrt", size=SIZE)
        self.assertTrue(os.path.isfile(written["scene_file"]))
        self.assertTrue(any("ambient_irradiance" in note for note in written["notes"]))
        with self.assertRaisesRegex(kaustik.ConfigError, "blender"):
            kaustik.export("ring", self.folder, to="blender")


if __name__ == "__main__":
    unittest.main()
