# SPDX-License-Identifier: MIT
"""What notebooks show."""

import base64
import html
import struct
import zlib
from typing import Any, Dict, List, Optional

from . import _kaustik


def _png(width: int, height: int, rgb: bytes) -> bytes:
    """A PNG file of 8-bit RGB, without a library that every notebook would need."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    rows = b"".join(b"\0" + rgb[y * width * 3 : (y + 1) * width * 3] for y in range(height))
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


def _image_tag(array: "_kaustik.Array") -> str:
    width, height, rgb, _ = array._preview()
    data = base64.b64encode(_png(width, height, rgb)).decode("ascii")
    return f'<img src="data:image/png;base64,{data}" width="{width}" height="{height}">'


def array_html(self: "_kaustik.Array") -> str:
    """The array's first layer as a picture, with its shape and what is white in it."""
    white = self._preview()[3]
    what = f"{' x '.join(map(str, self.shape))} float32"
    if len(self.shape) == 4:
        what += ", layer 0"
    if white != 1.0:
        what += f", white at {white:.4g}"
    return f"<figure>{_image_tag(self)}<figcaption>{what}</figcaption></figure>"


def renderer_html(
    name: str,
    passes: List[Dict[str, Any]],
    times: Dict[str, Any],
    picture: Optional["_kaustik.Array"],
) -> str:
    """A renderer's name, its last picture, and its passes with their median times."""
    parts = [title_html(name)]
    if picture is not None:
        parts.append(_image_tag(picture))
    parts.append("<table><tr><th>pass</th><th>ms</th><th>why</th></tr>")
    medians = {entry["name"]: entry["gpu_ms"]["median"] for entry in times["passes"]}
    for entry in passes:
        parts.append(_row(entry, medians.get(entry["name"])))
    total = f"{times['frame_ms']['median']:.3f}" if times["frames"] > 0 else ""
    parts.append(f"<tr><th>frame</th><th>{total}</th><th>median of {times['frames']}</th></tr>")
    return "".join(parts) + "</table>"


def title_html(name: str) -> str:
    """A name alone."""
    return f"<p>{html.escape(name)}</p>"


def _row(entry: Any, median: Any) -> str:
    time = f"{median:.3f}" if median is not None and entry["state"] == "runs" else entry["state"]
    return (
        f"<tr><td>{html.escape(entry['name'])}</td><td>{time}</td>"
        f"<td>{html.escape(entry['why'])}</td></tr>"
    )
