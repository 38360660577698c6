# SPDX-License-Identifier: MIT
"""Numbers in a page's sentences that look measured and that nothing says the origin of: pages.py refuses them.

What looks measured has a unit of a measurement (`38 ms`, `3 %`, `1.5 times`), stands behind a measure's name (`relMSE 0.0055`), is a decimal fraction (`0.72 of the time`),
has an exponent, or is a count (`3 of 16`, `1,024`, `66 thousand`). Fine are numbers by name (quantities.py), what stands in code, sizes (`400×300`, `256²`), lengths and
angles, millions of photons, versions, sections, and what a comment says the origin of:

    <!-- typed: KIND -->2 %<!-- / -->
    <!-- typed: KIND; REMARK -->up to 3 ms<!-- / -->

    setting      what was asked for, or a property of a scene, a format or a device
    closed form  by a formula that stands there
    paper        what a publication says
    test         a limit that a test holds, or what it prints; the test is named there or in the remark
    once         measured once, by the command that stands there or in the remark
"""

import re

from quantities import NUMBER

KINDS = ("setting", "closed form", "paper", "test", "once")
# Not the comment before a table, which is a line of its own (pages.py).
TYPED = re.compile(r"<!-- typed: ([^;>]+?)(?:; ([^>]*?))? -->(?!\n)((?:(?!<!--).)*)<!-- / -->", re.S)
NAMED = "\x00"    # stands for a number by name
NOTHING = "\x01"  # for what is not looked at
DIGITS = r"[+−-]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[+-]?\d+|·10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)?"
FRACTIONAL = r"[+−-]?(?:[\d,]*\d\.\d+(?:e[+-]?\d+|·10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)?|\d+(?:e[+-]?\d+|·10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)|10⁻[⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
BEFORE = r"(?<![\w.\x01²×/])(?<!\d[-,–])"
# `43 and 60 ms` is one thing; so is what is named but for a part.
CHAIN = rf"(?:(?:{DIGITS}|{NAMED})(?: ?%)?(?:,? (?:to|and|or|against|instead of|for) |, |; | → | ?/ ?|–))*"
UNIT = r"(?:ms|µs|ns|s|seconds?|minutes?|hours?|%|percent|times|dB|[kMGT]i?B|Hz|fps)"
MEASURE = r"(?:relMSE|RMSE|MSE|SMAPE|PSNR|SSIM|FLIP|correlation|energy|[Ee]rrors?|bias|noise|flux)"
OF_A_SCENE = r"(?:m|cm|mm|µm|nm|km|m²|cm²|°|rad|sr|W|GB/s|million photons|million)"
PATTERNS = (
    re.compile(rf"{BEFORE}({CHAIN}(?:{DIGITS}|{NAMED}))(?= ?{UNIT}(?![\w/²]))"),
    re.compile(rf"(?<!\w){MEASURE}(?: of| is| by| at| below| under| above| to| from|:)* ({CHAIN}{DIGITS})(?![\d²×]|\.\d)"),
    re.compile(rf"{BEFORE}({CHAIN}{FRACTIONAL})(?! ?{OF_A_SCENE}(?!\w))(?![\d.]*\d)"),
    re.compile(rf"{BEFORE}(\d{{1,3}}(?:,\d{{3}})+|\d+ of (?:the )?\d+|\d+ thousand)(?![\w²×]|[.,]\d)"),
)
VERSIONS = re.compile(r"\b(?:OpenGL|GLSL|GCC|Clang|Mesa|LLVM|Python|CUDA|POV-Ray|Mitsuba|Debian|[Vv]ersions?|GL) \d+(?:\.\d+)*|\b\d+\.\d+\.\d+\b|[Ss]ections? [\d.]*\d|§ ?[\d.]*\d|"
                      r"(?:Eqs?|Figs?|Tables?)\.? \(?[\d.]*\d")


def blank(match: re.Match) -> str:
    return NOTHING + "\n" * match[0].count("\n")


def sentences_of(page: str) -> str:
    """The page's sentences, on the lines where they stand, without what may hold any number."""
    bare = re.sub(r"^```.*?^```", blank, page, flags=re.M | re.S)
    bare = NUMBER.sub(lambda match: NAMED + "\n" * match[0].count("\n"), TYPED.sub(blank, bare))
    bare = re.sub(r"<!--.*?-->", lambda match: "\n" * match[0].count("\n"), bare, flags=re.S)
    bare = re.sub(r"`(?:[^`\n]|\n(?!\n))*`", blank, bare)  # within a paragraph
    bare = VERSIONS.sub(blank, re.sub(r"\]\([^)]*\)", "]", bare))
    bare = bare.replace(f"[{NAMED}]", NAMED).replace("**", "")
    return "\n".join("" if line.startswith(("|", "#")) else line for line in bare.split("\n"))


def unnamed(page: str) -> list[tuple[int, str]]:
    """What is wrong in a page without its tables, each with its line: numbers that nothing says the origin of, and origins of no known kind."""
    found = {match.start(): (page.count("\n", 0, match.start()) + 1, f"a number is typed as '{match[1]}'; kinds are {', '.join(KINDS)}")
             for match in TYPED.finditer(page) if match[1] not in KINDS}
    sentences = sentences_of(page)
    joined = re.sub(r"\n(?=\S)", " ", sentences)  # they go on over lines
    taken: list[tuple[int, int]] = []
    for match in (match for pattern in PATTERNS for match in pattern.finditer(joined)):
        number = re.search(r"[+−-]?\d", match[1])
        if not number:  # all of it by name
            continue
        at = match.start(1) + number.start()
        if any(first < match.end(1) and at < last for first, last in taken):
            continue
        taken.append((at, match.end(1)))
        around = re.sub(r"\s+", " ", joined[max(0, at - 30):match.end(1) + 15]).replace(NAMED, "…").replace(NOTHING, "`…`").strip()
        found[len(page) + at] = (sentences.count("\n", 0, at) + 1, f"a sentence says '{joined[at:match.end(1)].replace(NAMED, '…')}' (\"{around}\"), and nothing where it is from")
    return sorted(found.values())
