# SPDX-License-Identifier: MIT
# Written by choose.py: what `tests/run.sh --quick` leaves out. ctest reads it.
