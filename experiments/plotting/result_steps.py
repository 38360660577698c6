# SPDX-License-Identifier: MIT
"""What is in results/ that no study makes: each with the program that makes it, which rebuild.py calls, and what else that needs.

A step's program leaves alone what is made already as far as it can; those that take --anew make what is of other sources again (sources.py).
"""

import os
import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = (sys.executable, "-B")
KAUSTIK = "{kaustik}"  # in a command: the program that --kaustik names
FOR_NEEDS = {"povray": "POV-Ray", "Xvfb": "Xvfb", "debootstrap": "debootstrap, and to be root"}


@dataclass(frozen=True)
class Step:
    makes: str  # below results/
    commands: tuple[tuple[str, ...], ...]  # each from the root: a program below it, and its arguments
    needs: str = ""  # a program of others
    copies: tuple[str, str] | None = None  # what the last one has left, and its place below results/
    takes_anew: bool = False  # the first one
    by_name: str = ""  # why it is only made where it is named
    elsewhere: str = ""  # why it cannot be called here, and what to do


STEPS = {
    "light_tracer": Step("all_techniques/light_tracer.csv", (("experiments/light_tracer.py", "--kaustik", KAUSTIK, "--out", "results/all_techniques/light_tracer.csv"),
                                                             ("experiments/plotting/speed_error.py",)), takes_anew=True),
    "in_turn": Step("all_techniques/in_turn.csv", (("experiments/against_light_tracer.py", "--kaustik", KAUSTIK, "--out", "results/all_techniques/in_turn.csv"),)),
    "tuned": Step("all_techniques/tuned.csv", (("experiments/tuned.py", "--kaustik", KAUSTIK),)),
    "census": Step("census/*.csv", (("experiments/census.py", "--kaustik", KAUSTIK),), takes_anew=True),
    "certified": Step("certified.csv", (("experiments/certified.py",),), takes_anew=True),
    "proved_wrong": Step("proved_wrong.csv", (("experiments/proved_wrong.py", "--kaustik", KAUSTIK),
                                              ("experiments/proved_wrong.py", "--kaustik", KAUSTIK, "--techniques", "exact_rays", "--photons", "1024x1024"))),
    "judge": Step("judge/*.csv", (("experiments/judge_povray.py", "--out", "results/judge"),), needs="povray"),
    "flicker": Step("flicker/*", (("experiments/flicker.py", "--out", "results/flicker"),), takes_anew=True),
    "costs": Step("costs/passes.csv", (("experiments/costs.sh",),)),
    "numerics": Step("numerics.md", ((KAUSTIK, "experiment", "run", "experiments/numerics.toml", "--out", "results/runs/numerics"),),
                     copies=("results/runs/numerics/numerics.md", "numerics.md")),
    "tiles": Step("krueger2006/tiles.csv", (("experiments/krueger2006_tiles.sh", KAUSTIK, "results/runs/krueger2006_tiles"),),
                  copies=("results/runs/krueger2006_tiles/tiles.csv", "krueger2006/tiles.csv")),
    "peel_and_lists": Step("layers/peel_and_lists.csv", (("experiments/peel_and_lists.py",),)),
    "lens_widths": Step("wyman2008/lens_widths.csv", (("experiments/plotting/lens_widths.py",),)),
    "workbench": Step("workbench/*.csv", (("experiments/workbench.py", "--kaustik", KAUSTIK),), needs="Xvfb"),
    "second_driver": Step("device/second_driver.*", (("experiments/second_driver.sh",),), needs="debootstrap", by_name="it makes a root of Debian, of two gigabytes"),
    "gallery": Step("gallery.md", (("experiments/plotting/gallery.py", "--kaustik", KAUSTIK),)),
    "readme_pictures": Step("readme/*.png", (("experiments/plotting/readme_pictures.py", KAUSTIK),)),
    "gpu": Step("device/h100_*.csv, exact_rays/h200_*.csv", (), elsewhere="it needs a GPU: there `kaustik experiment run` of experiments/device_errors.toml, device_times.toml, exact_rays.toml and "
                "exact_rays_times.toml, then `plotting/device.py slim` and `plotting/exact_rays.py slim` (results/device.md, results/exact_rays.md)"),
}


def missing_for(step: Step, is_named: bool) -> str:
    """Why it is not made here; nothing where it can be."""
    if step.elsewhere or (step.by_name and not is_named):
        return step.elsewhere or f"{step.by_name}: name it to have it made"
    return f"it needs {FOR_NEEDS[step.needs]}" if step.needs and not shutil.which(step.needs) else ""


def described(name: str) -> str:
    step = STEPS[name]
    return f"{name:32} results/{step.makes}" + (f"; needs {FOR_NEEDS[step.needs]}" if step.needs else "") + ("; needs a GPU" if step.elsewhere else "")


def wrong_with(step: Step) -> list[str]:
    """Of its programs those that are not there, or do not know an option that they are called with; none is called."""
    found = []
    for program, *arguments in step.commands:
        if program == KAUSTIK:
            files = [argument for argument in arguments if argument.startswith("experiments/")]
            found += [f"there is no '{file}'" for file in files if not (ROOT / file).is_file()]
        elif not (ROOT / program).is_file():
            found.append(f"there is no '{program}'")
        else:
            text = (ROOT / program).read_text()
            options = [argument for argument in arguments if argument.startswith("--")] + (["--anew"] if step.takes_anew and program == step.commands[0][0] else [])
            found += [f"'{program}' has no option {option}" for option in options if f'"{option}"' not in text and f"{option})" not in text]
    return found


def command_of(words: tuple[str, ...], kaustik: pathlib.Path) -> list[str]:
    program, *arguments = (str(kaustik) if word == KAUSTIK else word for word in words)
    python = list(PYTHON) if program.endswith(".py") else []
    return [*python, program if words[0] == KAUSTIK else str(ROOT / program), *arguments]


def make(step: Step, kaustik: pathlib.Path, anew: bool) -> str:
    """Calls its programs, which may say how far they are; gives what went wrong, or nothing."""
    binaries = kaustik.parent
    environment = {**os.environ, "PATH": f"{binaries}{os.pathsep}{os.environ.get('PATH', '')}",
                   "PYTHONPATH": f"{binaries.parent / 'python'}{os.pathsep}{os.environ.get('PYTHONPATH', '')}".rstrip(os.pathsep)}
    for at, words in enumerate(step.commands):
        command = command_of(words, kaustik) + (["--anew"] if anew and step.takes_anew and at == 0 else [])
        done = subprocess.run(command, cwd=ROOT, env=environment, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            return f"'{' '.join(command)}' ended with {done.returncode}: {done.stderr.strip()}"
    if step.copies:
        shutil.copyfile(ROOT / step.copies[0], ROOT / "results" / step.copies[1])
    return ""
