# SPDX-License-Identifier: MIT
"""Real-time caustics by photon tracing in image space, from Python.

    import kaustik
    with kaustik.open("pool", size=(800, 600)) as r:
        r.set("emit.photons", (512, 512))
        r.step()
        irradiance = r.read("caustic.irradiance")   # H x W x 3, W/m2, rows from the top
        print(r.report()["energy"])

Units are SI, angles degrees, colours linear Rec.709; images are height x width x channels of
32-bit floats with their rows from the top. What goes wrong is a KaustikError with one sentence.
"""

from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import NoReturn as _Never

from ._kaustik import (
    Array,
    ConfigError,
    DeviceError,
    GraphError,
    IoError,
    KaustikError,
    Reference,
    ShaderError,
    __version__,
)
from ._experiments import merge_experiments, read_results, run_experiment
from ._names import no_attribute as _no_attribute
from ._lists import nodes, params, scenes, techniques
from ._pictures import array_html as _array_html
from ._references import (
    census,
    certify,
    compare,
    export,
    heat_map,
    judge,
    prepare_judge,
    read_reference,
    reference,
)
from ._renderer import Renderer, open

setattr(Array, "_repr_html_", _array_html)
if not _TYPE_CHECKING:

    def __getattr__(name: str) -> _Never:
        raise _no_attribute("module 'kaustik'", name, __all__)


__all__ = [
    "Array",
    "ConfigError",
    "DeviceError",
    "GraphError",
    "IoError",
    "KaustikError",
    "Reference",
    "Renderer",
    "ShaderError",
    "__version__",
    "census",
    "certify",
    "compare",
    "export",
    "heat_map",
    "judge",
    "merge_experiments",
    "nodes",
    "open",
    "params",
    "prepare_judge",
    "read_reference",
    "read_results",
    "reference",
    "run_experiment",
    "scenes",
    "techniques",
]
