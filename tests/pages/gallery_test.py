# SPDX-License-Identifier: MIT
"""The pictures of the gallery and of the README are those of the runs that their files name, and the gallery's numbers are the study's."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

from PIL import Image

from run_folders import grey, write_run

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLOTTING = ROOT / "experiments/plotting"
sys.path.insert(0, str(PLOTTING))

import gallery  # noqa: E402
import picture_rows  # noqa: E402
import readme_pictures  # noqa: E402

FILES = (("results/gallery.md", "results/gallery/gallery.csv"), ("README.md", "results/readme/pictures.csv"))
# What kaustik would write is copied, with the names of what was asked for.
PROGRAM = """#!/bin/sh
if [ "$1" = list ]; then echo '[{"name": "planar", "source": "P 1"}, {"name": "exact_rays", "source": ""}]'; exit; fi
for folder; do :; done
cp "$(dirname "$0")"/run/* "$folder"
sed -i "s/TECHNIQUE/$4/; s/SCENE/$2/" "$folder/report.json"
"""
PAGE = '<!-- table\nfile = "gallery/gallery.csv"\nby = "gallery.py --table"\n-->\n<!-- end -->\n'
STUDY_RUNS = ("as_published,emit.photons,refine.finest,scene,technique,status,relMSE,SMAPE,ms,device\n"
              "true,256x256,4096,pool,planar,done,0.9,0.9,9,a\nfalse,512x512,4096,pool,planar,done,0.8,0.8,8,a\nfalse,256x256,4096,pool,planar,done,{},0.25,77,a\n")


class OfTheProject(unittest.TestCase):
    def test_pictures_are_those_that_their_files_name(self):
        for page, file in FILES:
            self.assertEqual(picture_rows.wrong(ROOT / file), [], file)
            folder = (ROOT / file).parent
            shown = {(ROOT / page).parent / name for name in re.findall(r"!\[[^\]]*\]\(([^)]*)\)", (ROOT / page).read_text())}
            named = {folder / row["picture"] for row in picture_rows.read(ROOT / file)}
            self.assertGreater(len(named), 1)
            self.assertEqual({picture for picture in shown if picture.parent == folder}, named, page)

    def test_rows_name_scenes_and_papers_that_are_there(self):
        for _, file in FILES:
            for row in picture_rows.read(ROOT / file):
                self.assertTrue((ROOT / f"experiments/scenes/{row['scene']}.toml").is_file(), row["scene"])
                text = re.sub(r'"\s+"', "", (ROOT / f"techniques/{row['technique']}.cpp").read_text())
                self.assertIn(f'"{row.get("paper", row["technique"])}"', text)

    def test_runs_are_those_that_the_study_has_first(self):
        commands = {technique: " ".join(gallery.command_of(technique, scene, "8x6", "4")) for technique, scene in readme_pictures.SCENES.items()}
        base = tomllib.loads((ROOT / "experiments/all_techniques.toml").read_text())["base"]
        self.assertEqual(commands["planar"], f"run pool --technique planar --size 8x6 --frames {base['frames']} --warmup {base['warmup']} --precise --reference auto "
                         "--reference-photons 4 --set emit.photons=256x256")
        self.assertTrue(commands["adaptive_caustic_map"].endswith("--set refine.finest=1024"))
        self.assertNotIn("--set", commands["vertex_caustics"])


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.results, self.program = folder / "results", folder / "kaustik"
        write_run(folder / "run", grey(48, 36, 1.1), grey(48, 36, 1.0), "TECHNIQUE")
        report = json.loads((folder / "run/report.json").read_text())
        report |= {"scene": {"name": "SCENE"}, "size": [400, 300], "seed": 1, "device": {"renderer": "a device", "cpu": "a processor", "threads": 2},
                   "timing": {"date": "2026-11-30T10:00:00Z", "other_processors": 0.01}, "parameters": {"emit.photons": "256x256", "refine.finest": 4096}}
        report["error"]["caustic_irradiance"]["smape"] = 0.123456
        (folder / "run/report.json").write_text(json.dumps(report))
        Image.new("RGB", (8, 6), "red").save(folder / "run/beauty.png")
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)
        self.file = self.results / "gallery/gallery.csv"

    def call(self, program, *arguments):
        return subprocess.run([sys.executable, "-B", PLOTTING / program, *map(str, arguments)], capture_output=True, text=True)

    def render(self, *techniques):
        done = self.call("gallery.py", "--kaustik", self.program, "--out", self.results, *techniques)
        self.assertEqual(done.returncode, 0, done.stderr)

    def pages(self, *options):
        return self.call("pages.py", "--results", self.results, *options)

    def study(self, error):
        (self.results / "all_techniques").mkdir(exist_ok=True)
        (self.results / "all_techniques/runs.csv").write_text(STUDY_RUNS.format(error))

    def test_are_written_with_their_rows_and_those_not_asked_for_stay(self):
        self.render("planar")
        first = (self.results / "gallery/planar.jpg").read_bytes()
        self.render("exact_rays")
        rays, planar = picture_rows.read(self.file)  # in the gallery's order
        self.assertEqual((rays["technique"], rays["scene"], rays["paper"]), ("exact_rays", "concave-glass", ""))
        self.assertEqual({key: planar[key] for key in ("picture", "technique", "scene", "size", "paper", "emit.photons", "ms", "relMSE", "SMAPE", "device", "seed", "date")},
                         {"picture": "planar.jpg", "technique": "planar", "scene": "pool", "size": "400x300", "paper": "P 1", "emit.photons": "256x256", "ms": "5.0",
                          "relMSE": "0.01", "SMAPE": "0.12346", "device": "a device, a processor, 2 threads", "seed": "1", "date": "2026-11-30T10:00:00Z"})
        self.assertEqual(planar["run"], "kaustik " + " ".join(gallery.command_of("planar", "pool", "400x300", planar["reference_photons"])))
        self.assertRegex(planar["sources"], r"^[0-9a-f]{12}$")
        self.assertEqual((self.results / "gallery/planar.jpg").read_bytes(), first)
        self.assertEqual(picture_rows.wrong(self.file), [])

    def test_that_are_missing_or_others_are_found_by_the_check_of_the_pages(self):
        self.render("planar", "exact_rays")
        (self.results / "gallery.md").write_text(PAGE)
        self.assertEqual(self.pages().returncode, 0)
        self.assertEqual(self.pages("--check").returncode, 0)
        picture = self.results / "gallery/planar.jpg"
        data = picture.read_bytes()
        for change, says in ((lambda: picture.write_bytes(data + b" "), "planar.jpg is another picture than the one of gallery.csv"),
                             (picture.unlink, "planar.jpg is not there"),
                             (lambda: (picture.parent / "old.jpg").write_bytes(data), "old.jpg has no row in gallery.csv")):
            change()
            done = self.pages("--check")
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, done.stderr)
            picture.write_bytes(data)
        self.assertIn("has no rows", picture_rows.wrong(self.results / "none.csv")[0])

    def test_have_the_numbers_of_the_same_run_of_the_study(self):
        self.render("planar", "exact_rays")
        (self.results / "gallery.md").write_text(PAGE)
        for error, own in (("0.010001", False), ("0.02", True)):
            self.study(error)
            self.assertEqual(self.pages().returncode, 0)
            rows = {row.split("`")[1]: re.sub(r"<!--.*?-->", "", row) for row in (self.results / "gallery.md").read_text().splitlines() if row.startswith("| **")}
            ends = ", relMSE of this picture 0.01 |" if own else " |"
            self.assertIn(f"<br>P 1<br>77 ms, relMSE {float(error):.2g}, SMAPE 0.25{ends}", rows["planar"])
            self.assertIn("<br>–<br>5 ms, relMSE 0.01, SMAPE 0.12 |", rows["exact_rays"])
            self.assertIn("![planar on pool](gallery/planar.jpg)<br>`kaustik run pool --technique planar", rows["planar"])
            self.assertEqual(self.pages("--check").returncode, 0)
        self.study("0.03")
        self.assertEqual(self.pages("--check").returncode, 1)
        (self.file).write_text(self.file.read_text().replace("400x300,P", "80x60,P"))  # another run than the study's
        self.assertEqual(self.pages().returncode, 0)
        self.assertIn(" ms, relMSE <!-- = gallery/gallery.csv: relMSE .2g; technique=planar", (self.results / "gallery.md").read_text())

    def test_of_the_readme_say_their_runs(self):
        out = self.results / "readme"
        done = self.call("readme_pictures.py", self.program, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        file = out / "pictures.csv"
        self.assertEqual(picture_rows.wrong(file), [])
        rows = picture_rows.read(file)
        self.assertEqual([row["scene"] for row in rows if row["picture"] == "strip.png"], list(readme_pictures.STRIP))
        self.assertEqual({row["technique"]: row["scene"] for row in rows if row["picture"] != "strip.png"}, readme_pictures.SCENES)
        (out / "strip.png").unlink()
        self.assertIn("strip.png is not there", " ".join(picture_rows.wrong(file)))


if __name__ == "__main__":
    unittest.main()
