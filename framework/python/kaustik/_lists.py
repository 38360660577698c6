# SPDX-License-Identifier: MIT
"""What there is to choose from."""

from typing import Any, Dict, List

from . import _kaustik


def scenes() -> List[Dict[str, Any]]:
    """The shipped scenes: name, description, file."""
    return _kaustik.scenes()


def techniques() -> List[Dict[str, Any]]:
    """The techniques: name, description, source (the paper), defaults (parameter: text),
    as_published (what the paper's own row has in their place)."""
    return _kaustik.techniques()


def nodes(technique: str = "", as_published: bool = False) -> List[Dict[str, Any]]:
    """The nodes, or those that a technique chooses: name, stage, description, source,
    limits."""
    return _kaustik.nodes(technique, as_published)


def params(technique: str = "", as_published: bool = False) -> List[Dict[str, Any]]:
    """The parameters, or those of a technique's nodes with its own defaults, or its paper's: name, type, default,
    unit, range (text; also minimum and maximum, with values where it takes these alone, or choices), description."""
    return _kaustik.params(technique, as_published)
