# SPDX-License-Identifier: MIT
"""Names that do not exist."""

import difflib
from typing import Iterable


def no_attribute(owner: str, name: str, names: Iterable[str]) -> AttributeError:
    """The error that says so, with the nearest that does."""
    near = difflib.get_close_matches(name, [known for known in names if known[0] != "_"], 1)
    suggestion = f"; did you mean '{near[0]}'?" if near else ""
    return AttributeError(f"{owner} has no attribute '{name}'{suggestion}")
