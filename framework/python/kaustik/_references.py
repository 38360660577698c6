# SPDX-License-Identifier: MIT
"""Ray-traced references, and how wrong an image is."""

import os
from typing import Any, Callable, Dict, Optional, Tuple, Union

from . import _kaustik
from ._kaustik import Array, Reference
from ._renderer import Scene, Size

# An array (H x W x C, anything with buffers or DLPack on the CPU) or an image file.
ImageLike = Any


def reference(
    scene: Scene = "pool",
    *,
    size: Size = (800, 600),
    photons: Optional[int] = None,
    seconds: Optional[float] = None,
    error: Optional[float] = None,
    estimator: str = "light",
    time: Optional[float] = None,
    seed: int = 1,
    threads: int = 0,
    transmission_only: bool = False,
    interactions: int = 64,
    caustic_view: bool = False,
    progress: Optional[Callable[[float, str], Any]] = None,
    base: Union[str, "os.PathLike[str]"] = "",
) -> Reference:
    """Computes a scene's reference, or takes it from the cache (~/.cache/kaustik, $KAUSTIK_CACHE).

    It ends at so many photons, seconds of computing, or relative standard error, whatever is
    reached first; without any at 2**26 photons. Ctrl-C loses nothing: the next call goes on.
    estimator is "light" or "sppm"; time that of the scene, s; threads 0 for all. transmission_only
    and interactions leave paths of light out; caustic_view (sppm) also gives what is seen through
    specular surfaces. progress(share, text) is told now and then; what it raises ends the work.
    """
    return _kaustik.reference(
        scene,
        os.fspath(base),
        size,
        time,
        estimator,
        photons,
        seconds,
        error,
        seed,
        threads,
        transmission_only,
        interactions,
        caustic_view,
        progress,
    )


def read_reference(file: Union[str, "os.PathLike[str]"]) -> Reference:
    """The reference that `kaustik reference` or Reference.save() has written. IoError for a damaged
    one."""
    return _kaustik.read_reference(file)


def compare(
    image: ImageLike,
    reference: Union[Reference, ImageLike],
    *,
    mask: Optional[ImageLike] = None,
    standard_error: Optional[ImageLike] = None,
    area: Optional[ImageLike] = None,
    pixels_per_degree: Optional[float] = None,
) -> Dict[str, Any]:
    """How wrong an image is: rmse, mae, rel_mse, smape, ssim, flip_ldr, flip_hdr, energy_ratio
    and encircled_energy_radius_ratio, as `kaustik compare --json` has them under `error`.

    Image and reference are arrays of linear light, H x W or H x W x C, or image files; reference
    may be a Reference, whose standard error then says what its own noise would give. mask leaves
    out the pixels where it is 0; area is m2 of receiver in each pixel. ConfigError for sizes that
    do not fit, IoError for values that are no numbers.
    """
    errors, _ = _compare(image, reference, mask, standard_error, area, pixels_per_degree)
    return errors


def heat_map(image: ImageLike, reference: Union[Reference, ImageLike]) -> Array:
    """Where the image is wrong: the mean over RGB of |image - reference| as colours, H x W x 3 for
    a display, from black to brightest at the reference's typical luminance."""
    _, picture = _compare(image, reference, None, None, None, None)
    return picture


def _compare(
    image: Any, reference: Any, mask: Any, error: Any, area: Any, ppd: Optional[float]
) -> Tuple[Dict[str, Any], Array]:
    if isinstance(reference, Reference):
        error = reference.standard_error if error is None else error
        reference = reference.irradiance
    if isinstance(image, Reference):
        image = image.irradiance
    return _kaustik.compare(image, reference, mask, error, area, ppd)
