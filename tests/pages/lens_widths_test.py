# SPDX-License-Identifier: MIT
"""How wide beams through a ball are: by the difference of rays, and by Coddington's equations for both surfaces."""

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "experiments/plotting"))
import lens_widths  # noqa: E402


class LensWidths(unittest.TestCase):
    def rows(self):
        return [dict(zip(lens_widths.COLUMNS, lens_widths.row_at(place))) for place in lens_widths.PLACES]

    def test_of_rays_are_those_of_coddingtons_equations(self):
        for row in self.rows():
            self.assertLess(abs(row["Coddington"] / row["beam"] - 1.0), 1e-4, row)
            self.assertLess(abs(row["oblique"] / row["sagittal"] - 1.0), 1e-4, row)

    def test_on_the_axis_are_those_of_a_thick_lens(self):
        row = dict(zip(lens_widths.COLUMNS, lens_widths.row_at(0.01)))
        self.assertLess(abs(row["thick of beam"] - 1.0), 1e-3)
        # The lamp's image is as far behind the ball as the lens maker's equation says: f = n R / (2 (n - 1)).
        focal = lens_widths.IOR * lens_widths.RADIUS / (2.0 * (lens_widths.IOR - 1.0))
        image = 1.0 / (1.0 / focal - 1.0 / lens_widths.LAMP)
        self.assertTrue(math.isclose(row["beam"], lens_widths.LAMP / image * (image - lens_widths.SCREEN), rel_tol=2e-3), row)


if __name__ == "__main__":
    unittest.main()
