# SPDX-License-Identifier: MIT
"""kaustik.certify."""

import unittest

import numpy as np

import kaustik

SIZE = (32, 24)


class Certify(unittest.TestCase):
    def test_encloses_the_irradiance_under_still_water_and_judges_by_it(self):
        told = []
        found = kaustik.certify("flat-water", size=SIZE, band=0.05, progress=lambda share, text: told.append(share))
        lower, upper = np.asarray(found["lower"]), np.asarray(found["upper"])
        self.assertEqual(lower.shape, (24, 32, 3))
        through = 1000.0 * (1.0 - (0.333 / 2.333) ** 2)
        self.assertLess(lower[12, 16, 0], through)
        self.assertGreater(upper[12, 16, 0], through)
        self.assertGreater(found["pixels"]["lit"], 200)
        self.assertTrue(told)
        self.assertNotIn("verdict", found)
        picture = 0.5 * (lower + upper)
        picture[12, 16] = 1.1 * through
        picture[12, 17] = 0.9 * through
        verdict = kaustik.certify("flat-water", size=SIZE, band=0.05, image=picture)
        self.assertEqual(verdict["verdict"]["proved_too_bright"], 1)
        self.assertEqual(verdict["verdict"]["proved_too_dark"], 1)
        self.assertEqual(np.asarray(verdict["where"]).shape, (24, 32, 3))

    def test_says_what_it_cannot_do_and_ends_when_it_is_told_to(self):
        with self.assertRaisesRegex(kaustik.ConfigError, "--interactions: 0 is not from 1 to 8"):
            kaustik.certify("flat-water", size=SIZE, interactions=0)
        with self.assertRaisesRegex(kaustik.ConfigError, "not of the certificate's size"):
            kaustik.certify("flat-water", size=SIZE, image=np.zeros((3, 4, 3), np.float32))

        def stop(share, text):
            raise ValueError("enough")

        with self.assertRaisesRegex(ValueError, "enough"):
            kaustik.certify("flat-water", size=SIZE, progress=stop)


if __name__ == "__main__":
    unittest.main()
