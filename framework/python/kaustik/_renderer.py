# SPDX-License-Identifier: MIT
"""A scene, a technique and settings that stay as they are between frames."""

import atexit
import os
import weakref
from types import TracebackType
from typing import (
    TYPE_CHECKING,
    Any,
    Dict,
    Iterable,
    List,
    Mapping,
    NoReturn,
    Optional,
    Tuple,
    Type,
    Union,
    cast,
)

from . import _kaustik
from ._kaustik import Array
from ._names import no_attribute
from ._pictures import renderer_html, title_html

# What a parameter may be given: (width, height) for one that is written WxH.
Value = Union[bool, int, float, str, Tuple[int, int]]
# A shipped scene's name, the path of a .toml, .gltf or .glb file, or what a .toml file would say.
Scene = Union[str, "os.PathLike[str]", Dict[str, Any]]
Size = Union[Tuple[int, int], str]

_open_ones: "weakref.WeakSet[Renderer]" = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    """Work ends and devices are given back while Python is still whole."""
    _kaustik.end_waits()
    for renderer in list(_open_ones):
        renderer.close()


class Renderer:
    """Renders a scene with a technique; made by kaustik.open().

    It has a thread and an OpenGL context of its own, so that any Python thread may use it, one at
    a time, and several renderers work at once. Ctrl-C ends a frame before its next pass and leaves
    the renderer as it was. Used with `with`, or closed by close(), it gives its memory back.
    """

    __slots__ = ("_session", "__weakref__")  # r.sead = 3 is an error

    def __init__(self, session: "_kaustik.Session") -> None:
        self._session = session
        _open_ones.add(self)

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the work at hand and gives device and memory back. May be called again."""
        self._session.close()

    @property
    def closed(self) -> bool:
        """Whether close() was called; everything else is then a ConfigError."""
        return self._session.is_closed

    # Settings

    def set(self, name: Union[str, Mapping[str, Value]], value: Optional[Value] = None) -> None:
        """Sets a parameter, by its full name or any shorter form that is unique.

        r.set("emit.photons", (512, 512)), r.set("trace", "lines"), or several at once, all or
        none: r.set({"trace.test": "epsilon", "trace.epsilon": 0.02}). ConfigError for an unknown
        name (the nearest is said) and for a value out of range. It is seen by the next step(),
        which also says what does not go together.
        """
        if isinstance(name, str):
            if value is None:
                raise _kaustik.ConfigError(f"set: {name} needs a value.")
            self._session.set({name: value})
        else:
            if value is not None:
                raise _kaustik.ConfigError("set: give a name and a value, or a dict alone.")
            self._session.set(dict(name))

    def get(self, name: str) -> Value:
        """The value of a parameter: bool, int, float, str, or (width, height)."""
        return _value(self._session.param(name)["value"])

    def params(self) -> List[Dict[str, Any]]:
        """All parameters: name, type, value, default (text), unit, range (text; also minimum and
        maximum, with values where it takes these alone, or choices), description, is_set."""
        found = self._session.params()
        for param in found:
            param["value"] = _value(param["value"])
        return found

    def disable(self, *passes: str) -> None:
        """Switches passes off, by full name or by its unique end ("compose.direct").

        What stands in for them is in passes(). ConfigError for a pass that is not there or cannot
        be missed; nothing has changed then.
        """
        self._session.disable(sorted({*self.disabled, *passes}))

    def enable(self, *passes: str) -> None:
        """Switches passes on again, those given by name or, without any, all."""
        kept = [name for name in self.disabled if passes and name not in passes]
        self._session.disable(kept)

    @property
    def disabled(self) -> List[str]:
        """The passes that are switched off, by full name."""
        return list(self._session.state()["disabled"])

    def edit(self, **changes: Any) -> None:
        """Changes the scene, as a scene file that `extends` it does (experiments/scenes/README.md).

        r.edit(camera={"position": [0, 3, 5], "target": [0, 0, 0]}), r.edit(time=1.5),
        r.edit(light=[{"name": "sun", "direction": [0.3, -1, 0.2]}]), water=[{...}], medium={...}.
        A whole camera or medium, lights and waters by name. ConfigError as for a scene file.
        """
        self._session.edit(changes)

    @property
    def scene(self) -> str:
        """The scene's name."""
        return str(self._session.state()["scene"])

    @property
    def technique(self) -> str:
        """The technique's name."""
        return str(self._session.state()["technique"])

    @property
    def as_published(self) -> bool:
        """Whether the technique is as its paper has it."""
        return bool(self._session.state()["as_published"])

    @property
    def device(self) -> str:
        """What renders, in the driver's words."""
        return str(self._session.state()["device"])

    @property
    def time(self) -> float:
        """Time of the scene, s."""
        return float(self._session.state()["time_s"])

    @property
    def size(self) -> Tuple[int, int]:
        """(width, height), pixels; may be set."""
        width, height = self._session.state()["size"]
        return width, height

    @size.setter
    def size(self, size: Size) -> None:
        self._session.resize(size)

    @property
    def seed(self) -> int:
        """Of everything random; equal ones give equal bits. May be set."""
        return int(self._session.state()["seed"])

    @seed.setter
    def seed(self, seed: int) -> None:
        self._session.set_seed(seed)

    # Frames

    def step(
        self,
        n: int = 1,
        *,
        time: Optional[float] = None,
        time_step: float = 0.0,
        warmup: int = 0,
    ) -> Dict[str, Any]:
        """Renders n frames and gives their times, ms, as report.json has them.

        time is that of the first of them, s; time_step is added from frame to frame, and, where no
        time is given, to that of the frame before. warmup frames come first, at the first one's
        time, and are not timed. The result has frames, frame_ms and passes, with median, mean,
        min, max, p95 and stdev each. Filters over time remember what earlier frames have found.
        """
        return self._session.step(n, time, time_step, warmup)

    def read(self, name: str, layer: Optional[int] = None) -> Array:
        """A texture of the last frame, by its name in resources(): H x W x C, rows from the top.

        A texture with layers gives layers x H x W x C, or with layer=k that one alone. Whole
        numbers become the nearest 32-bit float (exact up to 16,777,216). The outputs are always
        there: "caustic.irradiance" (W/m2) and the picture; another texture is rendered once more
        with the same frame when it is read for the first time, and is kept in all frames after.
        ConfigError before the first step(), and where something was changed after the last.
        """
        return self._session.read(name, layer)

    def report(
        self, reference: str = "none", *, reference_photons: int = 1 << 26
    ) -> Dict[str, Any]:
        """What report.json would say (framework/README.md, "The report") of the frames since
        something was changed; renders one more, for the energy ledger.

        reference is "auto", for one that is computed where there is none of as many photons, or
        the file of one; the report then has `error` and `hits`.
        """
        return self._session.report(reference, reference_photons)

    def save(
        self,
        folder: Union[str, "os.PathLike[str]"],
        resources: Iterable[str] = (),
        *,
        reference: str = "none",
        reference_photons: int = 1 << 26,
    ) -> List[str]:
        """Writes what `kaustik run --out FOLDER` writes: pictures, report.json, trace.json, and the
        textures of `resources`. All or nothing. Gives the files."""
        files = self._session.save(folder, list(resources), reference, reference_photons)
        return [str(file) for file in files]

    # What it is made of

    def passes(self) -> List[Dict[str, Any]]:
        """Every pass: name, stage, state ("runs", "bypassed", "culled", "skipped"), why."""
        return self._session.passes()

    def resources(self) -> List[Dict[str, Any]]:
        """Every texture (name, kind, width, height, channels, layers, format) and buffer (name,
        kind, bytes) of a frame."""
        return self._session.resources()

    def needs(self) -> Dict[str, Any]:
        """What the scene needs from this view, as scene.needs in report.json."""
        return self._session.needs()

    def explain(self) -> str:
        """What `kaustik explain` prints."""
        return self._session.explain()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> NoReturn:
            raise no_attribute("kaustik.Renderer", name, dir(type(self)))

    def __repr__(self) -> str:
        if self.closed:
            return "kaustik.Renderer(closed)"
        state = self._session.state()
        width, height = state["size"]
        return (
            f"kaustik.Renderer({state['scene']!r}, technique={state['technique']!r}, "
            f"size=({width}, {height}), on {state['device']})"
        )

    def _repr_html_(self) -> str:
        name = repr(self)
        if self.closed:
            return title_html(name)
        times = self._session.times()
        is_shown = times["frames"] > 0 and not times["is_stale"]
        picture = self.read(times["picture"]) if is_shown else None
        return renderer_html(name, self.passes(), times, picture)


def _value(value: Any) -> Value:
    if isinstance(value, list):
        width, height = value
        return width, height
    return cast(Value, value)


def open(
    scene: Scene = "pool",
    *,
    size: Size = (800, 600),
    technique: str = "exact_rays",
    as_published: bool = False,
    set: Optional[Mapping[str, Value]] = None,
    disable: Iterable[str] = (),
    time: Optional[float] = None,
    seed: int = 1,
    precise: bool = False,
    debug: bool = False,
    device: Union[int, str] = "",
    base: Union[str, "os.PathLike[str]"] = "",
) -> Renderer:
    """A renderer for a scene: a shipped one's name, a file, or a dict that says what a .toml would.

    size is (width, height) in pixels, technique one of techniques(), with as_published as its paper
    has it to the letter, set parameters by any unique short name, disable passes to switch off, time that of the scene in s, seed that of everything
    random. precise finishes the device around each pass instead of reading timestamps, which is
    what a software rasteriser wants; debug names the pass of an OpenGL error. device is a number or
    a UUID that `kaustik check` lists, or a part of a device's name; else the best that the job was
    given. base is the folder from which a dict's files are seen, else the current one. Raises
    ConfigError, IoError and DeviceError with the command line's sentences.
    """
    return Renderer(
        _kaustik.Session(
            scene,
            os.fspath(base),
            technique,
            size,
            dict(set or {}),
            list(disable),
            time,
            seed,
            precise,
            debug,
            str(device),
            as_published,
        )
    )
