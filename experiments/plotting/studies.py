# SPDX-License-Identifier: MIT
"""results/studies.md: for each file of results/ the command that makes it, how much of its study there is, of which version, device and days, and which pages
show it. Numbers in sentences link there (pages.py), so that each leads to its command.
"""

import collections
import pathlib
import re
import tomllib

from rebuild import STUDIES
from study_plan import missing_of, values_of
from views import runs

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What is made of other files than a study's runs here, by which file in experiments/.
DERIVED = {"device/h100_errors.csv": "device_errors.toml", "device/h100_times.csv": "device_times.toml", "device/second_driver.csv": "second_driver.sh", "lamps/before_after.csv": "two_builds.py", "exact_rays/h200_errors.csv": "exact_rays.toml",
           "exact_rays/h200_times.csv": "exact_rays_times.toml", "wyman2008/lens_widths.csv": "plotting/lens_widths.py", "flicker/flicker.csv": "flicker.py",
           "krueger2006/tiles.csv": "krueger2006_tiles.sh", "all_techniques/light_tracer.csv": "light_tracer.py", "all_techniques/profile.csv": "plotting/profiles.py", "all_techniques/tuned.csv": "tuned.py", "all_techniques/in_turn.csv": "against_light_tracer.py", "all_techniques/in_turn_xeon.csv": "against_light_tracer.py", "all_techniques/in_turn_screen_xeon.csv": "against_light_tracer.py",
           "reconstructions/on_a_processor.csv": "two_builds.py", "reconstructions/rays_by_processor.csv": "two_builds.py", "reconstructions/cover_by_processor.csv": "two_builds.py",
           "judge/classes.csv": "judge_povray.py", "judge/scenes.csv": "judge_povray.py",
           "gallery/gallery.csv": "plotting/gallery.py", "certified.csv": "certified.py", "proved_wrong.csv": "proved_wrong.py", "costs/passes.csv": "costs.sh", "census/classes.csv": "census.py", "census/techniques.csv": "census.py",
           **{f"all_techniques/{name}.csv": "plotting/speed_error.py" for name in ("answers", "costs", "equal_error", "goals", "in_time", "one_second", "photon_mapping", "published", "summary", "to_error",
                                                                                        "uncertainty")}}
PAGE = "studies.md"
DAYS = 3  # that are named of a study's rows


def command_of(file: str) -> str:
    """The command that makes it."""
    studies = [study for study, target in STUDIES.items() if target == file]
    if not studies and file in DERIVED:
        return f" by `experiments/{DERIVED[file]}`"
    return f" by `experiments/rebuild_results.sh {studies[0]}`" if studies else ""


def seeds_of(file: str) -> str:
    """`seed 1` where a study's runs have that, `seeds 1, 2`; nothing of what is no study's."""
    study = next((study for study, target in STUDIES.items() if target == file), None)
    if study is None:
        return ""
    described = tomllib.loads((ROOT / f"experiments/{study}.toml").read_text())
    products = described.get("permute", {})
    found = {seed for product in (products if isinstance(products, list) else [products]) for seed in values_of(product.get("seed", []))}
    # Runs have seed 1 where nothing is said (framework/app/options.h).
    found |= {described.get("base", {}).get("seed", 1)} if not found else set()
    return ("seed " if len(found) == 1 else "seeds ") + ", ".join(map(str, sorted(found)))


def anchor_of(heading: str) -> str:
    """As GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", re.sub(r"<!--.*?-->", "", heading).lower()).strip().replace(" ", "-")


def state_of(study: str, rows: tuple[dict, ...]) -> str:
    count, missing = missing_of(tomllib.loads((ROOT / f"experiments/{study}.toml").read_text()), rows)
    failed = sum(row.get("status") == "failed" for row in rows)
    text = f"all {count} runs of the study" if not missing else f"{count - len(missing)} of {count} runs of the study"
    if failed:
        text += f", {failed} of which say why they could not be made"
    if missing:
        by = collections.Counter(pathlib.PurePath(str(run.get("scene", ""))).name for run in missing)
        text += "; missing: " + ", ".join(f"`{scene}` {number}" if scene else f"{number}" for scene, number in sorted(by.items()))
    return text


def said(rows: tuple[dict, ...], key: str) -> list[str]:
    return sorted({row[key] for row in rows if row.get(key)})


def sources_of(rows: tuple[dict, ...]) -> str:
    """Of how many rows the sources are known (sources.py), and of which days, the newest first, these are. It does not say which of them are those of the tree: that
    would change with every change of it; `rebuild_results.sh --stale` does."""
    by_day: dict[str, list[str]] = collections.defaultdict(list)
    for row in rows:
        if row.get("sources"):
            by_day[row.get("date", "")[:10]].append(row["sources"])
    if not by_day:
        return "sources of no row are known"
    days = sorted(by_day, reverse=True)
    parts = [f"{len(by_day[day])} of {day or 'a day that was not kept'} ({len(set(by_day[day]))} {'key' if len(set(by_day[day])) == 1 else 'keys'})" for day in days[:DAYS]]
    if others := days[DAYS:]:
        parts.append(f"{sum(len(by_day[day]) for day in others)} of {len(others)} other {'day' if len(others) == 1 else 'days'}")
    unknown = len(rows) - sum(map(len, by_day.values()))
    return f"sources of {'all' if not unknown else len(rows) - unknown} rows are known: {', '.join(parts)}" + (f"; of {unknown} they are not" if unknown else "")


def section(results: pathlib.Path, file: str, shown: list[str]) -> str:
    rows = runs(results / file)
    study = next((study for study, target in STUDIES.items() if target == file), None)
    lines = [f"### {file}", ""]
    made = command_of(file).removeprefix(" by ")
    lines += [f"- [`{file}`]({file}), {len(rows)} {'row' if len(rows) == 1 else 'rows'}" +
              (f", by {made}" if made else "".join(f", by `{command}`" for command in said(rows, "command")))]
    if study:
        lines.append(f"- {state_of(study, rows)}")
        lines.append(f"- {sources_of(rows)}")
    dates = [date[:10] for date in said(rows, "date")]
    of = [*(f"version {version}" for version in said(rows, "version")), *said(rows, "device"), *([f"seed {seed}" for seed in said(rows, "seed")] or filter(None, [seeds_of(file)])),
          *([dates[0] if dates[0] == dates[-1] else f"{dates[0]} to {dates[-1]}"] if dates else ["of a day that was not kept"])]
    lines.append(f"- {'; '.join(of)}")
    if shown:
        lines.append("- shown on " + ", ".join(f"[{page}]({page})" for page in shown))
    return "\n".join(lines)


def page_of(results: pathlib.Path) -> str:
    files = sorted(str(file.relative_to(results)) for file in results.rglob("*.csv") if "runs" not in file.relative_to(results).parts[:-1])
    texts = {page.name: page.read_text() for page in sorted(results.glob("*.md")) if page.name != PAGE}

    def shown(file: str) -> list[str]:
        named = re.compile(rf'^file = .*"{re.escape(file)}"|<!-- = {re.escape(file)}[: ]|\(({re.escape(file)})\)', re.M)
        return [page for page, text in texts.items() if named.search(text)]

    whole, parts, absent = [], [], []
    for study, file in STUDIES.items():
        if not (results / file).is_file():
            absent.append(study)
            continue
        _, missing = missing_of(tomllib.loads((ROOT / f"experiments/{study}.toml").read_text()), runs(results / file))
        (parts if missing else whole).append((study, file))
    head = ["# Studies and their files", "",
            "By which command each file of these pages is made, how much of its study is done, of which version, device and days it is, and where it is shown; numbers in sentences lead here. Made by "
            "`experiments/plotting/pages.py` of the files and of the studies in `experiments/`. A file that ends in `_recorded.csv` is a table as it was once printed; the others have a row a run. "
            "A row's sources have a key, of the framework, its technique's nodes and its scene: those of one day and of several scenes have several. `experiments/rebuild_results.sh --stale` "
            "says which rows are of the sources as they are now.", "",
            f"Of {len(STUDIES)} studies {len(whole)} are done as a whole, {len(parts)} in part" + (": " if parts else "") +
            ", ".join(f"[{study}](#{anchor_of(file)})" for study, file in parts) + "." +
            (f" Not there yet, or only as a table that was recorded: {', '.join(absent)}." if absent else ""), ""]
    return "\n".join(head) + "\n" + "\n\n".join(section(results, file, shown(file)) for file in files) + "\n"
