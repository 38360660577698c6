# SPDX-License-Identifier: MIT
"""Folders as `kaustik run --reference` leaves them, with pictures of one value."""

import json
import pathlib

import numpy as np


def write_pfm(file: pathlib.Path, image: np.ndarray) -> None:
    height, width = image.shape[:2]
    file.write_bytes(f"PF\n{width} {height}\n-1.0\n".encode() + image[::-1].astype("<f4").tobytes())


def grey(width: int, height: int, value: float) -> np.ndarray:
    return np.full((height, width, 3), value)


def write_run(folder: pathlib.Path, caustic: np.ndarray, reference: np.ndarray, technique: str = "planar") -> None:
    folder.mkdir(parents=True)
    write_pfm(folder / "caustic.pfm", caustic)
    write_pfm(folder / "reference.pfm", reference)
    same_size = caustic.shape == reference.shape
    error = float(((caustic - reference) ** 2 / reference**2).mean()) if same_size else 1.0
    passes = [{"name": "emit.grid", "ran": True, "gpu_ms": {"median": 2.0}}, {"name": "view.around", "ran": True, "gpu_ms": {"median": 9.0}},
              {"name": "trace.march", "ran": True, "gpu_ms": {"median": 3.0}}, {"name": "media.none", "ran": False}]
    report = {"technique": technique, "as_published": False, "passes": passes, "scene": {"name": "box_1"},
              "size": [caustic.shape[1], caustic.shape[0]], "device": {"renderer": "a device"}, "version": "1",
              "error": {"caustic_irradiance": {"rel_mse": error, "formulas": {"rel_mse": {"epsilon": 0.0}}, "truth_noise": {"rel_mse": 0.0}}}}
    (folder / "report.json").write_text(json.dumps(report))
