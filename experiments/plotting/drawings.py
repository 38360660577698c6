# SPDX-License-Identifier: MIT
"""What a drawing of results/ was made of, written into it, so that one of older rows is seen without drawing it again (another version of matplotlib draws other bytes)."""

import hashlib
import pathlib
import re

# By folder below results/: what its drawings are made of, and by which command.
DRAWN = {"all_techniques": (("runs.csv", "best_mixtures.csv", "light_tracer.csv", "in_turn.csv"), "experiments/plotting/speed_error.py"),
         "error_parts": (("parts.csv",), "experiments/rebuild_results.sh error_parts"), "flicker": (("flicker.csv",), "experiments/flicker.py")}


def description(files: list[pathlib.Path]) -> str:
    return "Drawn of " + ", ".join(f"{file.name} {hashlib.sha256(file.read_bytes()).hexdigest()[:12]}" for file in files if file.is_file())


def metadata(files: list[pathlib.Path]) -> dict:
    """For savefig: no date, so that the same picture is the same file, and what it is of."""
    return {"Date": None, "Description": description(files)}


def outdated(results: pathlib.Path) -> list[str]:
    """A sentence for each drawing that is of other rows than its files have now: of those above, and of all others that say what they are of."""
    found = []
    for drawing in sorted(results.glob("*/*.svg")):
        of = re.search(r"<dc:description>Drawn of (.*?)</dc:description>", drawing.read_text()[:4000], re.S)
        known, command = DRAWN.get(drawing.parent.name, ((), ""))
        files = known or [part.split(" ")[0] for part in of[1].split(", ")] if known or of else []
        if files and (not of or f"Drawn of {of[1]}" != description([drawing.parent / file for file in files])):
            found.append(f"{drawing}: drawn of other rows than {' and '.join(files)} have now" + (f"; '{command}' draws it anew" if command else ""))
    return found
