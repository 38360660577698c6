#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Everything in results/ that a command makes, from one: runs the studies, writes their CSVs, draws the figures, calls the programs
# of what no study makes (censuses, certificates, pictures) and fills the pages. What is finished is not done again. Needs an idle
# machine for its times, and days for all of it; what needs POV-Ray or a GPU is left out where there is none, and says so.
#   rebuild_results.sh [STUDY | STEP]...   these studies and steps, or all; rebuild_results.sh --list names them
#   rebuild_results.sh STUDY --only KEY=VALUE...   these runs of it; its CSV keeps the rows of the others
#   rebuild_results.sh STUDY --missing   those runs of it that its CSV has no row of; with --anew too, no row of the sources as they are
#   rebuild_results.sh --stale [STUDY...]   how many rows are of the sources as they are; also where nothing was run or built
#   rebuild_results.sh --quick          each study's first run at a small size, and whether pages are what CSVs say; writes into --out alone
exec /usr/bin/python3 -B "$(dirname "${BASH_SOURCE[0]}")/plotting/rebuild.py" "$@"
