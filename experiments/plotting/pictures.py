# SPDX-License-Identifier: MIT
"""Pictures of the runs: read, brought to the exposure of their reference, and compared with it."""

import base64
import io
import json
import re
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from study import Configuration, evenly

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # Rec. 709
MAX_ROWS = 6  # of pictures next to each other
MAX_PIXEL_WIDTH = 1280  # of a picture on the page


def read_netpbm(path: Path) -> np.ndarray:
    """PFM (little- or big-endian) and binary PPM."""
    data = path.read_bytes()
    header = re.match(rb"(P[Ff6])\s+(\d+)\s+(\d+)\s+(\S+)\s", data)
    if header is None:
        raise ValueError(f"{path} is neither PFM nor PPM")
    kind, width, height, scale = header[1], int(header[2]), int(header[3]), float(header[4])
    channels = 1 if kind == b"Pf" else 3
    dtype = np.uint8 if kind == b"P6" else np.dtype("<f4" if scale < 0 else ">f4")
    values = np.frombuffer(data, dtype, width * height * channels, header.end())
    image = values.reshape(height, width, channels)
    return image / scale if kind == b"P6" else image[::-1].astype(np.float32)


def read_image(path: Path) -> np.ndarray:
    """Height x width x 3, top row first."""
    if path.suffix in (".pfm", ".ppm"):
        image = read_netpbm(path)
    elif path.suffix == ".png":
        image = plt.imread(path)
    else:
        import OpenImageIO as oiio

        source = oiio.ImageInput.open(str(path))
        if source is None:
            raise ValueError(f"{path} cannot be read: {oiio.geterror()}")
        image = np.asarray(source.read_image(oiio.FLOAT))
        source.close()
    if image.ndim == 2:
        image = image[:, :, np.newaxis]
    return np.repeat(image, 3, axis=2) if image.shape[2] == 1 else image[:, :, :3]


def find_image(folder: Path, name: str, suffixes: tuple[str, ...]) -> Path | None:
    return next((p for s in suffixes if (p := folder / f"{name}{s}").is_file()), None)


@dataclass(frozen=True)
class Output:
    """What runs are judged by, and the files of it."""

    file: str
    reference: str
    kind: str  # for people
    unit: str


CAUSTIC = Output("caustic", "reference", "caustic irradiance", "W/m²")
IN_SCATTERED = Output(
    "in_scattered", "reference_in_scattered", "in-scattered radiance", "W/m²/sr"
)


def find_reference(configuration: Configuration, output: Output) -> Path | None:
    """The reference picture of a configuration: beside its report, or where that says it is."""
    for folder in configuration.folders:
        neighbour = find_image(folder, output.reference, (".exr", ".pfm"))
        if neighbour:
            return neighbour
        if output is not CAUSTIC:
            continue  # what the report names is the caustic's
        try:
            report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
        named = report.get("error", {}).get("reference")
        if isinstance(named, str) and Path(named).suffix in (".exr", ".pfm"):
            for path in (folder / named, Path(named)):
                if path.is_file():
                    return path
    return None


@dataclass
class Picture:
    label: str
    kind: str  # what it shows, for the page: an output's kind, or "picture"
    pixels: np.ndarray  # for a display: height x width x 3 in [0, 1]
    values: np.ndarray  # what it measures, of the same shape
    unit: str  # of the values; "" for a display's


def displayed(image: np.ndarray, white: float) -> np.ndarray:
    """Linear light to sRGB with `white` as the brightest; what is not a number shows magenta."""
    wrong = ~np.isfinite(image).all(axis=2)
    linear = np.clip(np.nan_to_num(image) / white, 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    encoded[wrong] = (1.0, 0.0, 1.0)
    return encoded


def white_of(image: np.ndarray) -> float:
    bright = np.nan_to_num(image).max(axis=2)
    lit = bright[bright > 0.0]
    return float(np.percentile(lit, 99.0)) if lit.size else 1.0


class Pictures:
    """One output of some configurations and their references, each with the exposure of its reference."""

    def __init__(self, configurations: list[Configuration], output: Output):
        self.output = output
        self.images: list[tuple[Configuration, np.ndarray]] = []
        self.references: dict[str, np.ndarray] = {}  # by configuration
        self.problems: list[str] = []
        self.beauties: list[Picture] = []
        for configuration in configurations:
            try:
                self._read(configuration)
            except ImportError:
                self.problems.append(
                    "OpenEXR pictures need the package python3-openimageio, so none are shown."
                )
                return
            except (OSError, ValueError) as error:
                self.problems.append(f"{error}.")
        self.common_white = max((white_of(image) for _, image in self.images), default=1.0)

    def white(self, configuration: Configuration) -> float:
        """What is white in its picture: of its reference, or of all pictures where there is none. Scenes differ by
        orders of magnitude."""
        reference = self.references.get(configuration.hash)
        return white_of(reference) if reference is not None else self.common_white

    def _read(self, configuration: Configuration) -> None:
        folder = configuration.folders[0]
        beauty = find_image(folder, "beauty", (".png", ".ppm"))
        if beauty and self.output is CAUSTIC:
            pixels = read_image(beauty)
            self.beauties.append(Picture(configuration.label, "picture", pixels, pixels, ""))
        file = find_image(folder, self.output.file, (".exr", ".pfm"))
        if not file:
            return
        image = read_image(file)
        self.images.append((configuration, image))
        reference = find_reference(configuration, self.output)
        if reference:
            true_image = read_image(reference)
            if true_image.shape == image.shape:
                self.references[configuration.hash] = true_image
            else:
                self.problems.append(f"{reference} is of another size than {file}.")

    def for_page(self) -> list[Picture]:
        """The references first, each once."""
        pictures: list[Picture] = []
        seen: list[np.ndarray] = []
        for configuration, _ in self.images:
            reference = self.references.get(configuration.hash)
            if reference is None or any(reference.shape == s.shape and (reference == s).all() for s in seen):
                continue
            seen.append(reference)
            label = "reference" if len(seen) == 1 else f"reference of {configuration.label}"
            pictures.append(self._picture(label, reference, self.white(configuration)))
        pictures += [self._picture(configuration.label, image, self.white(configuration))
                     for configuration, image in self.images]
        return pictures + self.beauties

    def _picture(self, label: str, image: np.ndarray, white: float) -> Picture:
        return Picture(label, self.output.kind, displayed(image, white), image, self.output.unit)


def side_by_side(pictures: Pictures) -> Figure | None:
    """One row a configuration: the reference, the technique and where it is wrong."""
    shown = [(c, image) for c, image in pictures.images if c.hash in pictures.references]
    if not shown:
        return None
    height, width = shown[0][1].shape[:2]
    shown = evenly(shown, MAX_ROWS)
    errors = []
    for configuration, image in shown:
        difference = np.abs(image - pictures.references[configuration.hash])
        errors.append(np.nan_to_num(difference, nan=np.inf) @ LUMINANCE)
    finite = np.concatenate([e[np.isfinite(e)] for e in errors])
    largest = float(np.percentile(finite, 99.0)) if finite.size else 1.0
    figure, rows = plt.subplots(
        len(shown),
        3,
        squeeze=False,
        figsize=(9.0, 0.5 + (2.8 * height / width + 0.25) * len(shown)),
        layout="constrained",
    )
    for (configuration, image), error, row in zip(shown, errors, rows):
        white = pictures.white(configuration)
        row[0].imshow(displayed(pictures.references[configuration.hash], white))
        row[1].imshow(displayed(image, white))
        shade = row[2].imshow(error, cmap="cividis", vmin=0.0, vmax=largest or 1.0)
        row[1].set_title(configuration.label, fontsize=8)
        for axes in row:
            axes.set_xticks([])
            axes.set_yticks([])
            axes.grid(False)
    rows[0][0].set_title("reference", fontsize=8)
    rows[0][2].set_title("error", fontsize=8)
    output = pictures.output
    figure.colorbar(
        shade, ax=rows[:, 2].tolist(), label=f"|difference| of {output.kind} ({output.unit})"
    )
    return figure


def gallery(pictures: Pictures) -> Figure | None:
    """The images alone, where there is no reference to set them beside."""
    if not pictures.images or pictures.references:
        return None
    count = len(pictures.images)
    across = min(count, 3)
    down = -(-count // across)
    height, width = pictures.images[0][1].shape[:2]
    figure, rows = plt.subplots(
        down,
        across,
        squeeze=False,
        figsize=(3.0 * across, (3.0 * height / width + 0.3) * down),
        layout="constrained",
    )
    for axes in rows.flat:
        axes.axis("off")
    for axes, (configuration, image) in zip(rows.flat, pictures.images):
        axes.imshow(displayed(image, pictures.common_white))
        axes.set_title(configuration.label, fontsize=8)
    return figure


def for_page_sized(image: np.ndarray) -> np.ndarray:
    step = -(-image.shape[1] // MAX_PIXEL_WIDTH)
    return np.ascontiguousarray(image[::step, ::step])


def as_numbers(picture: Picture) -> dict:
    """Its values for the page: half floats of them over `scale`, so that the largest is no infinity."""
    values = for_page_sized(picture.values)
    largest = float(np.nan_to_num(np.abs(values), posinf=0.0).max(initial=0.0))
    scale = largest / 60000.0 if largest > 0.0 else 1.0
    halves = (values / scale).astype("<f2")
    return {
        "width": values.shape[1],
        "height": values.shape[0],
        "scale": scale,
        "values": base64.b64encode(halves.tobytes()).decode("ascii"),
    }


def as_data_uri(pixels: np.ndarray) -> str:
    buffer = io.BytesIO()
    plt.imsave(buffer, for_page_sized(pixels), format="png")
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")
