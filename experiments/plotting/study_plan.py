# SPDX-License-Identifier: MIT
"""The runs of a study, as its file plans them, and which of them a CSV has no row of."""

import itertools


def values_of(axis) -> list:
    """The values of a study's axis, a list or a range."""
    if isinstance(axis, list):
        return axis
    if "steps" in axis:
        return [axis["from"] + i * (axis["to"] - axis["from"]) / (axis["steps"] - 1) for i in range(axis["steps"])]
    values, value = [], axis["from"]
    while value <= axis["to"] * (1 + 1e-9):
        values.append(value)
        value = value * axis["factor"] if "factor" in axis else value + axis["step"]
    return values


def planned(study: dict) -> list[dict]:
    """The settings of each of its runs, as far as it varies them."""
    products = study.get("permute", {})
    products = products if isinstance(products, list) else [products]
    keys = {key for product in products for key in product}
    base = {key: value for key, value in study.get("base", {}).items() if key in keys}
    found = {}
    for product in products:
        for values in itertools.product(*map(values_of, product.values())):
            run = {**base, **dict(zip(product, values))}
            found.setdefault(repr(sorted(run.items(), key=str)), run)
    return list(found.values())


def key_of(value) -> str:
    """A setting as one compares it: numbers by their size, scenes by the name of their file."""
    if isinstance(value, bool):
        return str(value).lower()
    try:
        return f"{float(value):.6g}"
    except (TypeError, ValueError):
        return str(value).rsplit("/", 1)[-1]


def missing_of(study: dict, rows: tuple[dict, ...]) -> tuple[int, list[dict]]:
    """How many runs a study has, and those that no row is of. A setting that no column says is not told apart."""
    def column_of(key: str) -> str | None:
        ends = [name for name in rows[0] if name == key or name.endswith(f".{key}")]
        return key if key in rows[0] else ends[0] if len(ends) == 1 else None

    runs_of_it = planned(study)
    columns = {key: column_of(key) for run in runs_of_it for key in run}
    made: dict = {}  # what rows have in each set of columns that runs are told apart by
    missing = []
    for run in runs_of_it:
        told = tuple(key for key in run if columns[key])
        if told not in made:
            made[told] = {tuple(key_of(row[columns[key]]) for key in told) for row in rows}
        if tuple(key_of(run[key]) for key in told) not in made[told]:
            missing.append(run)
    return len(runs_of_it), missing
