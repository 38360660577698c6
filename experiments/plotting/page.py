# SPDX-License-Identifier: MIT
"""One HTML page that holds everything a study has to show: it asks for nothing from the network,
which its content security policy forbids besides."""

import base64
import json
from html import escape
from pathlib import Path
from string import Template

from pictures import Picture, as_data_uri, as_numbers
from study import Study

TEMPLATE = Path(__file__).with_name("page.html")


def figure_html(name: str, caption: str, svg: Path) -> str:
    data = base64.b64encode(svg.read_bytes()).decode("ascii")
    return (
        f'<figure id="figure-{escape(name)}">\n<img alt="{escape(caption)}" '
        f'src="data:image/svg+xml;base64,{data}">\n'
        f"<figcaption>{escape(caption)}</figcaption>\n</figure>"
    )


def table_html(header: list[str], rows: list[list[str]], caption: str) -> str:
    def line(cells: list[str], tag: str, scope: str = "") -> str:
        return "<tr>" + "".join(f"<{tag}{scope}>{escape(c)}</{tag}>" for c in cells) + "</tr>"

    lines = [line(header, "th", ' scope="col"')] + [line(row, "td") for row in rows]
    return (
        f'<div class="scroll" tabindex="0"><table><caption>{escape(caption)}</caption>\n'
        + "\n".join(lines)
        + "\n</table></div>"
    )


def failures_html(study: Study) -> str:
    if not study.failures:
        return ""
    items = "\n".join(
        f"<li>{escape(str(row['folder']))}: {escape(str(row['message']))}</li>"
        for row in study.failures
    )
    return f'<div class="failures"><p>Runs that failed:</p>\n<ul>\n{items}\n</ul></div>'


def facts(study: Study) -> str:
    finished = sum(len(c.rows) for c in study.configurations)
    devices = f"Device: {study.devices[0]}."
    if len(study.devices) > 1:
        listed = "; ".join(f"{number}: {d}" for number, d in enumerate(study.devices, start=1))
        devices = f"Devices, whose times are never averaged nor drawn together: {listed}."
    return (
        f"{finished} of {study.planned} runs: {len(study.configurations)} configurations, each "
        f"repeated in up to {study.repeats} processes. {devices} Kaustik {study.version}."
    )


def make_page(
    study: Study,
    figures: list[tuple[str, str, Path]],
    pictures: list[Picture],
    table: tuple[list[str], list[list[str]], str],
) -> str:
    sources = [
        {"label": p.label, "kind": p.kind, "unit": p.unit, "source": as_data_uri(p.pixels)} | as_numbers(p)
        for p in pictures
    ]
    return Template(TEMPLATE.read_text(encoding="utf-8")).substitute(
        title=escape(f"{study.name} · Kaustik"),
        description=escape(study.description),
        facts=escape(facts(study)),
        failures=failures_html(study),
        figures="\n".join(figure_html(*figure) for figure in figures),
        table=table_html(*table),
        # A closing tag within the data must not close the script.
        pictures=json.dumps(sources).replace("</", "<\\/"),
    )
