# SPDX-License-Identifier: MIT
"""Prints what the sidecar of a reference says, but for its time and its files' names: the images are
in it by their fingerprints.

    facts.py REFERENCE.json
"""

import json
import sys
from pathlib import Path

facts = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
del facts["compute_s"]
for image in facts["images"].values():
    del image["file"]
print(json.dumps(facts, indent=1, sort_keys=True))
