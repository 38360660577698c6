# SPDX-License-Identifier: MIT
"""kaustik.certify."""

import os
import tempfile
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

    def test_is_the_same_in_shards_and_goes_on_where_it_was_interrupted(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        few = {"size": SIZE, "band": 0.05}
        files = [os.path.join(folder, f"{i}.shard") for i in (1, 2)]
        for i, file in enumerate(files, 1):
            part = kaustik.certify("flat-water", shard=f"{i}/2", out=file, **few)
            self.assertEqual(part["file"], file)
            self.assertGreater(part["cells"], 0)
        merged = kaustik.certify("flat-water", merge=files, out=os.path.join(folder, "merged.exr"))
        self.assertTrue(os.path.isfile(os.path.join(folder, "merged.json")))
        self.assertTrue(os.path.isfile(os.path.join(folder, "merged.lower.exr")))

        def stop(share, text):
            raise ValueError("enough")

        out = os.path.join(folder, "whole.exr")
        with self.assertRaisesRegex(ValueError, "enough"):
            kaustik.certify("flat-water", out=out, progress=stop, **few)
        self.assertTrue(os.path.isfile(out + ".unfinished"))
        whole = kaustik.certify("flat-water", out=out, **few)
        self.assertFalse(os.path.exists(out + ".unfinished"))
        for bound in ("lower", "upper", "undecided"):
            np.testing.assert_array_equal(np.asarray(merged[bound]), np.asarray(whole[bound]))
        for wrong, words in (
            ({"merge": files[:1]}, "missing: 2"),
            ({"shard": "1/2"}, "give out"),
            ({"shard": "3/2", "out": files[0]}, "no shard 3 of 2"),
            ({"shard": "1/2", "merge": files, "out": files[0]}, "take one"),
            ({"shard": "1/2", "out": out}, "must end in .shard"),
            ({"out": files[0], **few}, "must end in .exr or .pfm"),
            ({"merge": files, "image": np.zeros((3, 4, 3), np.float32)}, "not of the certificate's size"),
        ):
            with self.assertRaisesRegex(kaustik.ConfigError, words):
                kaustik.certify("flat-water", **wrong)

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
