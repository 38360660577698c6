#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Everything in results/ that a study makes, from one command: runs the studies, writes their CSVs, draws the figures and fills
# the pages. What is finished is not done again. Needs an idle machine for its times, and days for all of it.
#   rebuild_results.sh [STUDY...]       these studies, or all; rebuild_results.sh --list names them
#   rebuild_results.sh STUDY --only KEY=VALUE...   these runs of it; its CSV keeps the rows of the others
#   rebuild_results.sh STUDY --missing   those runs of it that its CSV has no row of
#   rebuild_results.sh --quick          each study's first run at a small size, and whether pages are what CSVs say; writes into --out alone
exec /usr/bin/python3 -B "$(dirname "${BASH_SOURCE[0]}")/plotting/rebuild.py" "$@"
