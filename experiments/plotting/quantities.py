# SPDX-License-Identifier: MIT
"""The numbers in a page's sentences, by name.

    <!-- = FILE [TABLE]: WHAT FORMAT; WHERE [/ WHERE] [by KEY, ...] -->0.0123<!-- / -->

FILE is a CSV below results/ or a page there (its tables' rows; `under` is a row's heading); with TABLE, what the program of the CSV's folder prints of it
(views.py). WHERE are conditions `column=value`, `column!=value`, `column above 3` or `column below 3` between commas, alternatives of one column between ` or ` (a bar would end a table's cell); what has commas itself stands in quotes; `-` is all rows.
WHAT is a column, or a sum, difference, product or quotient of `{column}`s; `{column}[2]` is the second number of a cell that has several, as `0.72 (0.68 to
0.77)`; `{column}'` is of the row of the second WHERE, which is one row or, by KEY, the one whose KEY is the same. Before it may stand min, max, median, sum,
count (of rows) or range (`0.68 to 0.77`, of the least and the largest), where several rows fit; without one of these only one row may.
FORMAT is Python's; `.2%` of a share is a percentage with its sign apart, `s` a word as it stands.
"""

import ast
import operator
import pathlib
import re
import statistics

from views import PageError, column, is_recorded, plain, recorded_of, view

NUMBER = re.compile(r"<!-- = ([\w./-]+)(?: ([\w-]+))?: ([^;>]+?) (\S+); ([^>]*?) -->(.*?)<!-- / -->", re.S)
CELL = re.compile(r"\{([^}]+)\}(?:\[(-?\d+)\])?('?)")
SUPERSCRIPT = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
IN_CELL = re.compile(r"(?<![\w.])[+−-]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[+-]?\d+|·10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)?")
REDUCE = {"min": min, "max": max, "median": statistics.median, "sum": sum}
ARITHMETIC = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}


class NoRow(PageError):
    """Conditions that no row has."""


def formatted(text: str, style: str) -> str:
    """A cell's number as Python's format says; `.2%` of a share is a percentage with its sign apart; `s` is a word as it stands."""
    if text in ("", "nan"):
        return "–"
    if style == "s":
        return f"`{text}`"
    number = float(text)
    if style.endswith("%"):
        return f"{100.0 * number:{style[:-1]}f} %"
    return re.sub(r"e([+-])0?(\d)", r"e\1\2", f"{number:{style}}")


def numbers_in(cell: str) -> list[float]:
    found = []
    for text in IN_CELL.findall(plain(cell)):
        mantissa, _, exponent = text.replace(",", "").replace("−", "-").partition("·10")
        found.append(float(f"{mantissa}e{exponent.translate(SUPERSCRIPT)}" if exponent else mantissa))
    return found


def number_of(row: dict, name: str, which: int) -> float:
    found = numbers_in(column(row, name))
    if not found or not -len(found) <= which - (which > 0) < len(found):
        raise PageError(f"'{column(row, name)}' of '{name}' has no number {which}")
    return found[which - (which > 0)]


def calculated(expression: str) -> float:
    def of(node) -> float:
        if isinstance(node, ast.Expression):
            return of(node.body)
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return float(node.value)
        if isinstance(node, ast.BinOp) and type(node.op) in ARITHMETIC:
            return ARITHMETIC[type(node.op)](of(node.left), of(node.right))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -of(node.operand)
        raise PageError(f"'{expression}' is no sum, difference, product or quotient of columns")

    try:
        return of(ast.parse(expression, mode="eval"))
    except (SyntaxError, ZeroDivisionError) as error:
        raise PageError(f"'{expression}': {error}") from error


def conditions_of(text: str) -> list[tuple[str, str, list[str]]]:
    """Columns, how they are compared, and with what."""
    conditions: list[tuple[str, str, list[str]]] = []
    if text.strip() in ("", "-"):
        return conditions
    for part in re.findall(r'(?:"[^"]*"|[^,"])+', text):
        match = re.fullmatch(r'\s*(?:"([^"]*)"|([^=]+?))(!?=| above | below )(.*)', part, re.S)
        if not match:
            raise PageError(f"'{part.strip()}' is not column=value")
        conditions.append((match[1] or match[2], match[3].strip(), [value.strip().strip('"') for value in re.split(" or ", match[4])]))
    return conditions


def has(row: dict, key: str, comparison: str, values: list[str]) -> bool:
    cell = plain(column(row, key))
    if comparison in ("=", "!="):
        return (cell in values) == (comparison == "=")
    found = numbers_in(cell)
    return bool(found) and (found[0] > float(values[0]) if comparison == "above" else found[0] < float(values[0]))


def columns_of(what: str) -> set[str]:
    """Those that a quantity is made of, of either row."""
    if "{" in what:
        return {name for name, _, _ in CELL.findall(what)}
    first, _, rest = what.partition(" ")
    return {rest if first == "range" or first in REDUCE else what} - {"count"}


def fitting(rows: tuple[dict, ...], what: str, text: str) -> list[dict]:
    conditions = conditions_of(text)
    if rows and "under" in rows[0]:  # of tables with other columns each
        needed = {key for key, _, _ in conditions} | columns_of(what)
        rows = tuple(row for row in rows if row.keys() >= needed)
        if not rows:
            raise PageError(f"no table has the columns {', '.join(sorted(needed))}")
    found = [row for row in rows if all(has(row, *condition) for condition in conditions)]
    if not found:
        raise NoRow(f"no row has {text}")
    return found


def value_of(what: str, row: dict, other: dict | None) -> float:
    def cell(match: re.Match) -> str:
        if match[3] and other is None:
            raise PageError(f"'{match[0]}' is of a second row, which is not named")
        return repr(number_of(other if match[3] else row, match[1], int(match[2] or 1)))

    return calculated(CELL.sub(cell, what) if "{" in what else repr(number_of(row, what, 1)))


def cells_of_pair(what: str, pair: tuple[dict, dict | None]) -> list[str]:
    """The cells that a quantity takes of each of the two rows."""
    asked = [(name, bool(prime)) for name, _, prime in CELL.findall(what)] if "{" in what else [(name, False) for name in columns_of(what)]
    return [column(row, name) for name, is_second in asked if (row := pair[is_second])]


def divided_at(word: str, text: str) -> tuple[str, str, str]:
    """As partition does, but not within quotes."""
    match = re.match(rf'((?:"[^"]*"|[^"])*?)({re.escape(word)})(.*)', text, re.S)
    return (match[1], match[2], match[3]) if match else (text, "", "")


def pairs_of(rows: tuple[dict, ...], what: str, where: str) -> list[tuple[dict, dict | None]]:
    """The rows that fit the first condition, each with the one of the second that it is compared with."""
    where, _, keys = divided_at(" by ", where)
    first, divided, second = divided_at(" / ", where)
    found = fitting(rows, what, first)
    if not divided:
        return [(row, None) for row in found]
    others = fitting(rows, what, second)
    if not keys:
        if len(others) > 1:
            raise PageError(f"{len(others)} rows have {second}: 'by KEY' says which belongs to which")
        return [(row, others[0]) for row in found]
    names = [(quoted or bare).strip() for quoted, bare in re.findall(r'"([^"]*)"|([^,"]+)', keys) if quoted or bare.strip()]
    by_key = {tuple(column(row, name) for name in names): row for row in others}
    pairs = [(row, by_key.get(tuple(column(row, name) for name in names))) for row in found]
    return [pair for pair in pairs if pair[1] is not None]


def source_of(match: re.Match, results: pathlib.Path) -> str:
    """The file that a quantity is of: where a table can't be made of its own, the recorded one."""
    file, table = match[1], match[2] or ""
    return recorded_of(file) if table and is_recorded(results, file, table) else file


def text_of(match: re.Match, results: pathlib.Path) -> str:
    file, table, what, style, where, _ = match.groups()
    rows = view(results, file, table or "")
    if not table and not file.endswith(".md") and "{" not in what and rows and what in rows[0]:  # a cell as it stands, words too
        found = fitting(rows, what, where)
        if len(found) > 1:
            raise PageError(f"{len(found)} rows have {where}")
        if found[0].get("status", "done") != "done":
            return found[0]["status"]
        if style == "s" or not column(found[0], what) or re.fullmatch(r"[-+.\de]+|nan", column(found[0], what)):
            return formatted(column(found[0], what), style)
    first, _, rest = what.partition(" ")
    if what == "count":
        try:
            return formatted(str(len(pairs_of(rows, what, where))), style)
        except NoRow:
            return formatted("0", style)
    pairs = pairs_of(rows, what, where)
    if first != "range" and first not in REDUCE:
        if len(pairs) > 1:
            raise PageError(f"{len(pairs)} rows have {where}; say min, max, median, sum, count or range")
        if style == "s":
            return column(pairs[0][0], what)
        return formatted(repr(value_of(what, *pairs[0])), style)
    if not pairs:
        raise PageError(f"no row of the first condition has one of the second: {where}")
    # What has no figure in a row is in no range.
    values = [value_of(rest, *pair) for pair in pairs if all(plain(cell) not in ("", "–") for cell in cells_of_pair(rest, pair))]
    if not values:
        raise PageError(f"no row with {where} has a number of '{rest}'")
    if first != "range":
        return formatted(repr(REDUCE[first](values)), style)
    low, high = formatted(repr(min(values)), style), formatted(repr(max(values)), style)
    return low if low == high else f"{low.removesuffix(' %') if style.endswith('%') else low} to {high}"
