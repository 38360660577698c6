# SPDX-License-Identifier: MIT
"""Ray-traced references, and how wrong an image is."""

import json
import os
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import _kaustik
from ._experiments import run_program
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
    classes: Union[int, Sequence[str]] = 0,
    by_object: bool = False,
    progress: Optional[Callable[[float, str], Any]] = None,
    base: Union[str, "os.PathLike[str]"] = "",
) -> Reference:
    """Computes a scene's reference, or takes it from the cache (~/.cache/kaustik, $KAUSTIK_CACHE).

    It ends at so many photons, seconds of computing, or relative standard error, whatever is
    reached first; without any at 2**26 photons. Ctrl-C loses nothing: the next call goes on.
    estimator is "light" or "sppm"; time that of the scene, s; threads 0 for all. transmission_only
    and interactions leave paths of light out; caustic_view (sppm) also gives what is seen through
    specular surfaces. classes keeps classes of paths apart, as Reference.classes has them: how
    many, the brightest first (by_object: by the first specular object, too), or patterns, as
    ["TT", "inside=L T R+ T D", "S+ @ring"]. progress(share, text) is told now and then; what it raises ends the work.
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
        [] if isinstance(classes, int) else list(classes),
        classes if isinstance(classes, int) else 0,
        by_object,
        progress,
    )


def read_reference(file: Union[str, "os.PathLike[str]"]) -> Reference:
    """The reference that `kaustik reference` or Reference.save() has written. IoError for a damaged
    one."""
    return _kaustik.read_reference(file)


def census(
    scene: Union[str, "os.PathLike[str]"] = "pool",
    *,
    photons: int = 1 << 22,
    techniques: Sequence[str] = (),
    size: Tuple[int, int] = (200, 150),
    technique_photons: Tuple[int, int] = (128, 128),
    time: Optional[float] = None,
    settings: Optional[Mapping[str, Any]] = None,
    shard: str = "",
    merge: Sequence[Union[str, "os.PathLike[str]"]] = (),
    out: Union[str, "os.PathLike[str]"] = "",
) -> Dict[str, Any]:
    """The watts of each class of a scene's caustic paths, and what of them each technique forms,
    cannot form, and loses; what `kaustik census --json` prints, which does it.

    scene is a name or a file. techniques: all where none is named. settings are parameters of
    theirs. What it finds of the paths is kept, so that reports and explain() say what their
    technique cannot form. shard ("2/8") accounts for the second of eight parts of the techniques and
    writes it into the folder out, merge puts the files of all parts together, which say what they
    were asked for. Ctrl-C ends it; with out, and no shard, the next call goes on from the techniques
    that are done.
    """
    command = ["census", os.fspath(scene), "--json", "--photons", str(photons)]
    command += ["--size", f"{size[0]}x{size[1]}"]
    command += ["--technique-photons", f"{technique_photons[0]}x{technique_photons[1]}"]
    for name in techniques:
        command += ["--technique", name]
    if time is not None:
        command += ["--time", repr(float(time))]
    for key, value in (settings or {}).items():
        text = str(value).lower() if isinstance(value, bool) else str(value)
        command += ["--set", f"{key}={text}"]
    command += ["--shard", shard] if shard else []
    command += ["--merge", *map(os.fspath, merge)] if merge else []
    command += ["--out", os.fspath(out)] if os.fspath(out) else []
    found: Dict[str, Any] = json.loads(run_program(command))
    return found


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


def judge(
    scene: Scene,
    theirs: ImageLike,
    *,
    direct: str = "auto",
    glass: str = "auto",
    encoding: str = "auto",
    primaries: str = "auto",
    exposure: Optional[float] = None,
    standard_error: Optional[ImageLike] = None,
    size: Optional[Size] = None,
    photons: int = 2**24,
    seed: int = 1,
    classes: int = 6,
    causes: bool = True,
    base: Union[str, "os.PathLike[str]"] = "",
) -> Dict[str, Any]:
    """What is wrong with another renderer's picture of a scene, as `kaustik judge --json` has it,
    and also text (the report in sentences), residual (H x W x 3, W/m2/sr) and where (H x W x 3 for
    a display: red where theirs is brighter than what was found, blue where it is darker).

    theirs is an array of linear light, H x W or H x W x C, or a file (.exr, .pfm). direct is
    "with", "without" or "auto" (found out), glass "seen", "hidden" or "auto", encoding "linear",
    "srgb", "gamma2.2" or "auto", primaries "rec709", "rec2020", "p3", "acescg", "aces2065" or
    "auto". size is the reference's, that of theirs if not given; causes asks for references of what
    may be wrong too (indices, lights, normals). References are cached. ConfigError for what cannot
    be judged: another scene's picture, one for a display, no caustic.
    """
    found, text, residual, where = _kaustik.judge(
        scene,
        os.fspath(base),
        theirs,
        size,
        direct,
        glass,
        encoding,
        primaries,
        exposure,
        standard_error,
        photons,
        seed,
        classes,
        causes,
    )
    return {**found, "text": text, "residual": residual, "where": where}


def prepare_judge(
    scene: Union[str, "os.PathLike[str]"],
    size: Tuple[int, int],
    shard: str,
    *,
    photons: int = 2**24,
    seed: int = 1,
    classes: int = 6,
    causes: bool = True,
) -> None:
    """Makes a part ("2/8") of the references that judge() takes for pictures of this scene (a name or
    a file) and size, and leaves them in the cache, where judge() finds them: what `kaustik judge
    --shard` does, which does it."""
    command = ["judge", os.fspath(scene), "--size", f"{size[0]}x{size[1]}", "--shard", shard]
    command += ["--photons", str(photons), "--seed", str(seed), "--classes", str(classes)]
    command += [] if causes else ["--no-causes"]
    run_program(command)


def certify(
    scene: Scene = "pool",
    *,
    size: Size = (800, 600),
    interactions: int = 1,
    transmission_only: bool = False,
    band: float = 0.01,
    depth: int = 12,
    time: Optional[float] = None,
    threads: int = 0,
    image: Optional[ImageLike] = None,
    progress: Optional[Callable[[float, str], Any]] = None,
    shard: str = "",
    merge: Sequence[Union[str, "os.PathLike[str]"]] = (),
    out: Union[str, "os.PathLike[str]"] = "",
    base: Union[str, "os.PathLike[str]"] = "",
) -> Dict[str, Any]:
    """An interval for the caustic irradiance of every pixel, with a proof, as `kaustik certify` has
    it: lower, upper and undecided (what of upper may lie in any of many pixels), H x W x 3, W/m2,
    and its .json's entries, with energy and pixels.

    It is of paths of 1 to so many interactions. Cells are split until their places are sure within
    band pixels, at most depth times. With an image of the same size, W/m2, there are also verdict
    (how many pixels are proved wrong) and where (H x W x 3 for a display: blue proved too dark, red
    too bright, orange too bright for these paths, green undecided). ConfigError for what cannot be
    certified. progress(share, text) is told now and then; what it raises ends the work.

    shard ("2/8") makes the second of eight parts and writes it to the .shard out; then there are only
    shard, cells, seconds and file. merge puts the files of all parts of this scene together, which
    say what they were asked for. Else out, an .exr or .pfm, names what is written, as `kaustik certify`
    does it. What is interrupted with out goes on from there in the next call.
    """
    if isinstance(image, Reference):
        image = image.irradiance
    return _kaustik.certify(
        scene,
        os.fspath(base),
        size,
        time,
        interactions,
        transmission_only,
        band,
        depth,
        threads,
        image,
        progress,
        shard,
        [os.fspath(part) for part in merge],
        os.fspath(out),
    )


def export(
    scene: Scene,
    out: Union[str, "os.PathLike[str]"],
    *,
    to: str,
    size: Size = (800, 600),
    photons: int = 1_000_000,
    base: Union[str, "os.PathLike[str]"] = "",
) -> Dict[str, Any]:
    """Writes a scene and its meshes for another renderer, to "povray", "mitsuba", "gltf" or "pbrt",
    into the folder out: scene_file, render_command, and notes, a sentence for whatever the format
    cannot hold."""
    return _kaustik.export(scene, os.fspath(base), to, os.fspath(out), size, photons)


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
