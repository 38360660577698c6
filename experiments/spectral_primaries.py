#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the table of framework/scene/spectrum.inc with its last column anew: the smoothest spectra
of the three primaries of Rec.709 that are nowhere negative, add up to 1 at every wavelength, and
have the primaries' colors in the light of D65 (Mallett and Yuksel 2019, "Spectral Primary
Decomposition for Rendering with sRGB Reflectance"). Needs numpy and scipy.

    /usr/bin/python3 experiments/spectral_primaries.py
"""

import pathlib
import re

import numpy as np
import scipy.optimize

TABLE = pathlib.Path(__file__).parent.parent / "framework" / "scene" / "spectrum.inc"
CHROMATICITIES = [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)]  # ITU-R BT.709


def read_table():
    """Wavelengths in nm, the observer's three functions, and D65: by row."""
    rows = []
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if line.lstrip().startswith("{"):
            rows.append([float(n) for n in re.findall(r"[0-9.]+(?:e-?[0-9]+)?", line)][:5])
    table = np.array(rows)
    return table[:, 0], table[:, 1:4], table[:, 4]


def rec709_of_spectra(observer, daylight):
    """Maps a spectrum's share of D65, by row of the table, to linear Rec.709: 3 x rows."""
    weights = np.ones(len(daylight))
    weights[0] = weights[-1] = 0.5
    xyz = (observer * (weights * daylight)[:, None]).T
    xyz /= xyz[1].sum()
    primaries = np.array([[x / y, 1.0, (1.0 - x - y) / y] for x, y in CHROMATICITIES]).T
    matrix = primaries * np.linalg.solve(primaries, xyz.sum(axis=1))
    return np.linalg.solve(matrix, xyz)


def smoothest_primaries(rec709):
    """Rows x 3. Red and blue are unknown; green is what they leave."""
    count = rec709.shape[1]
    slope = np.diff(np.eye(count), axis=0)

    def roughness(unknown):
        red, blue = unknown[:count], unknown[count:]
        steps = [slope @ s for s in (red, 1.0 - red - blue, blue)]
        down = [2.0 * slope.T @ s for s in steps]
        return sum(s @ s for s in steps), np.concatenate([down[0] - down[1], down[2] - down[1]])

    none = np.zeros((3, count))
    colors = np.block([[rec709, none], [none, rec709]])
    wanted = np.array([1.0, 0, 0, 0, 0, 1.0])
    together = np.hstack([np.eye(count), np.eye(count)])
    found = scipy.optimize.minimize(
        roughness,
        np.concatenate([np.linspace(0, 1, count), np.linspace(1, 0, count)]) / 2.0,
        jac=True,
        method="SLSQP",
        bounds=[(0.0, 1.0)] * (2 * count),
        constraints=[
            {"type": "eq", "fun": lambda u: colors @ u - wanted, "jac": lambda u: colors},
            {"type": "ineq", "fun": lambda u: 1.0 - together @ u, "jac": lambda u: -together},
        ],
        options={"maxiter": 1000, "ftol": 1e-12},
    )
    if not found.success:
        raise SystemExit(found.message)
    red, blue = found.x[:count], found.x[count:]
    return np.stack([red, 1.0 - red - blue, blue], axis=1).clip(0.0, 1.0)


def main():
    nanometers, observer, daylight = read_table()
    primaries = smoothest_primaries(rec709_of_spectra(observer, daylight))
    for nm, eye, light, share in zip(nanometers, observer, daylight, primaries):
        print(
            f"    {{{nm:g}, {{{', '.join(f'{n:g}' for n in eye)}}}, {light:g}, "
            f"{{{', '.join(f'{n:.9g}' for n in share)}}}}},"
        )


if __name__ == "__main__":
    main()
