# SPDX-License-Identifier: MIT
"""Speed against error compared with a light tracer, on runs whose factors are known: its relMSE is 1000 over its photons, each takes 1 us."""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "experiments/plotting/speed_error.py"

NOISE = 0.0005
RUNS = f"""scene,technique,as_published,emit.photons,refine.finest,status,ms,relMSE,"relMSE, reference's own",emitted,peak MiB,"not formed, %","not formed, W",device,version
ring,a,false,1x1,4096,done,10,{0.1 + NOISE},{NOISE},1000,2,7,0.7,d,1
ring,a,false,2x2,4096,done,100,{0.01 + NOISE},{NOISE},4000,5,6,0.6,d,1
ring,a,true,2x2,4096,done,50,{0.01 + NOISE},{NOISE},4000,5,,,d,1
ring,b,false,2x2,4096,done,1000,{0.0001 + NOISE},{NOISE},4000,5,,,d,1
ring,c,false,2x2,4096,failed,,,,,,,,d,1
"""
LIGHT_TRACER = f"""scene,estimator,photons,seconds,relMSE,"relMSE, reference's own"
ring,light,100000,0.3,{0.01 + NOISE},{NOISE}
ring,light,1000000,1.2,{0.001 + NOISE},{NOISE}
ring,sppm,1000000,9,0.5,{NOISE}
tree,light,0,0,,
"""


# Of another time: a default with two numbers of photons, and what is known of times: frames that differ by a tenth; in turn half the time; the light tracer's three runs on one line with errors of a
# tenth around one law.
TIMED = """scene,technique,as_published,emit.photons,refine.finest,status,ms,media ms,spread,relMSE,"relMSE, reference's own",device,version
pond,exact_rays,false,128x128,4096,done,100,,0.1,0.04,,d,1
pond,exact_rays,false,256x256,4096,done,400,,0.1,0.01,,d,1
pond,planar,false,128x128,4096,done,200,,0.5,0.02,,d,1
cave,exact_rays,false,128x128,4096,done,300,200,0.1,0.002,,d,1
cave,planar,false,128x128,4096,done,10,,0.1,0.001,,d,1
"""
TRACED = """scene,estimator,photons,seconds,relMSE,"relMSE, reference's own"
pond,light,100000,0.2,{0},
pond,light,200000,0.3,{1},
pond,light,400000,0.5,{2},
pond,sppm,100000,1,0.08,
pond,sppm,200000,2,0.04,
pond,sppm,400000,4,0.02,
cave,light,100000,0.2,0.2,
cave,light,200000,0.3,0.1,
cave,light,400000,0.5,0.05,
"""
IN_TURN = """scene,technique,status,ms,us a photon,device
pond,exact_rays,done,200,1,d
cave,exact_rays,failed,,,d
"""
MIXTURES = """scene,emit.photons,status,ms,spread,relMSE,"relMSE, reference's own",device,version
pond,128x128,done,400,0.1,0.04,,d,1
pond,256x256,done,200,0.1,0.01,,d,1
"""
PLOTTING = PROGRAM.parent


class Intervals(unittest.TestCase):
    """On runs whose scatter is known."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        of = [0.02 * math.exp(0.1), 0.01 * math.exp(-0.1), 0.005]
        for name, text in (("runs", TIMED), ("light_tracer", TRACED.format(*of)), ("turn", IN_TURN), ("best_mixtures", MIXTURES)):
            (cls.folder / f"{name}.csv").write_text(text)
        subprocess.run([sys.executable, "-B", PROGRAM, "--results", cls.folder, "--in-turn", cls.folder / "turn.csv"], check=True)

    def rows(self, name):
        with (self.folder / name).open(newline="") as stream:
            return list(csv.DictReader(stream))

    def row(self, name, **settings):
        row, = (row for row in self.rows(name) if all(row[key] == value for key, value in settings.items()))
        return row

    def printed(self, table, file=None):
        done = subprocess.run([sys.executable, "-B", PLOTTING / "speed_error_tables.py", table, file or self.folder / f"{table}.csv"], capture_output=True, text=True, check=True)
        return done.stdout

    def test_are_made_of_what_scatters(self):
        of = {row["what"]: row for row in self.rows("uncertainty.csv")}
        self.assertAlmostEqual(float(of["default's time at another hour"]["standard deviation"]), math.log(2.0), places=3)
        self.assertEqual((of["default's time at another hour"]["scenes"], of["default's time at another hour"]["median"]), ("1", "2"))
        self.assertAlmostEqual(float(of["light tracer's time at another hour"]["standard deviation"]), 0.0, places=6)
        # Logarithms 0.1, -0.1 and 0 in one scene of two.
        self.assertAlmostEqual(float(of["light tracer's error"]["standard deviation"]), math.sqrt(0.01 / 2.0), places=4)
        for what in ("light tracer's time a photon", "photon mapping's error", "photon mapping's time"):  # on lines
            self.assertAlmostEqual(float(of[what]["standard deviation"]), 0.0, places=6)

    def test_of_a_factor_add_up_in_squares(self):
        row = next(row for row in self.rows("equal_error.csv") if (row["scene"], row["technique"], row["emit.photons"]) == ("pond", "exact_rays", "256x256"))
        self.assertAlmostEqual(float(row["factor"]), 0.2 / 0.4, places=3)  # 200,000 photons of 1 us
        sd = math.hypot(0.1, math.log(2.0), math.sqrt(0.01 / 2.0))
        self.assertAlmostEqual(float(row["low"]) / float(row["factor"]), math.exp(-sd), places=3)
        self.assertAlmostEqual(float(row["high"]) / float(row["factor"]), math.exp(sd), places=2)

    def test_of_frames_with_a_medium_are_of_what_is_left_without_it(self):
        row, = (row for row in self.rows("equal_error.csv") if row["scene"] == "cave")  # and `planar`, whose medium was not told apart, is in no table
        self.assertEqual((row["technique"], row["ms"]), ("exact_rays", "100"))
        sd = math.hypot(0.3, math.log(2.0), math.sqrt(0.01 / 2.0))
        self.assertAlmostEqual(float(row["low"]) / float(row["factor"]), math.exp(-sd), places=3)

    def test_to_an_error_are_of_the_curve_shifted_by_its_times(self):
        row = self.row("to_error.csv", scene="pond", relMSE="0.01")
        self.assertEqual((row["first"], row["second"], row["at_most"], row["disturbed"]), ("best mixture", "light tracer", "false", "false"))
        sd = math.hypot(0.1, math.log(2.0))
        for end, sign in (("low", -1.0), ("high", 1.0)):
            self.assertAlmostEqual(float(row[end]) / 200.0, math.exp(sign * sd), places=2)
        both = math.hypot(sd, math.sqrt(0.01 / 2.0))
        self.assertAlmostEqual(float(row["times low"]) / float(row["times"]), math.exp(-both), places=3)
        self.assertIn("| `best mixture` 256²: 200 (99 to 403)<br>`light tracer` ≈ |", self.printed("to_error"))

    def test_say_the_photons_between_runs(self):
        row = self.row("to_error.csv", scene="pond", relMSE="0.03")  # the light tracer has it with 66,667 photons
        self.assertEqual([row[key] for key in ("first", "photons", "second", "second at_most")], ["light tracer", "6.667e+04", "exact_rays", "false"])
        self.assertIn("| `light tracer` 67k: 67 (62 to 72)<br>`exact_rays` 148² ≈ |", self.printed("to_error"))  # 128² and a fifth of the way to 256²
        self.assertIn("| `light tracer` 20k: 20 (19 to 21)<br>`exact_rays` ≤ 128² ×5 |", self.printed("to_error"))  # to 0.1
        done = subprocess.run([sys.executable, "-B", "-c", "import sys; sys.path.insert(0, sys.argv[1]); from speed_curves import Point, found_on;"
                               "curve = [Point(100.0, 0.04, photons=128.0), Point(400.0, 0.01, photons=512.0)];"
                               "print(*(round(found_on(curve, at, by_error=True).photons) for at in (0.02, 0.01, 0.1)))", PLOTTING], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.split(), ["256", "512", "128"])

    def test_of_an_adaptive_map_are_its_finest_cells_and_of_vertices_nothing(self):
        file = self.folder / "named.csv"
        head = "scene,relMSE,first,value,low,high,at_most,disturbed,photons,second,times,times low,times high,second at_most,second photons\n"
        file.write_text(head + "pond,0.1,adaptive_caustic_map,10,10,10,false,false,1024,,,,,,\npond,0.3,vertex_caustics,10,10,10,true,false,,,,,,,\n"
                        "pond,1,light tracer,0.1,0.1,0.1,true,false,146,,,,,,\n")
        self.assertEqual(self.printed("to_error", file).splitlines()[2],
                         "| `pond` | `adaptive_caustic_map` cells of 1024²: 10 | `vertex_caustics`: ≤ 10 | `light tracer`: ≤ 0.1<br>no technique |")

    def test_by_the_defaults_photons_are_its_rows(self):
        self.assertEqual(self.printed("counts", self.folder / "equal_error.csv").splitlines(),
                         ["| scene | ms, 128² | ms, 256² | relMSE, net, 128² | relMSE, net, 256² | times as fast, 128² | times as fast, 256² |", "| --- | --- | --- | --- | --- | --- | --- |",
                          "| `cave` | 100 | – | 0.002 | – | 100 | – |", "| `pond` | 100 | 400 | 0.04 | 0.01 | 0.5 | 0.5 |"])

    def test_within_a_time_beyond_the_last_run_are_bounds(self):
        row = self.row("in_time.csv", scene="cave", ms="2000")
        self.assertEqual([row[key] for key in ("first", "value", "low", "high", "at_most", "second")], ["exact_rays", "0.002", "0.002", "0.002", "true", "light tracer"])
        row = self.row("in_time.csv", scene="cave", ms="50")
        self.assertEqual((row["first"], row["at_most"], row["second"]), ("light tracer", "false", ""))  # the default is not there yet
        row = self.row("to_error.csv", scene="cave", relMSE="0.1")
        self.assertEqual((row["first"], row["value"], row["at_most"]), ("exact_rays", "100", "true"))

    def test_by_photon_mapping_are_bounds_where_it_ends_before(self):
        rows = {(row["scene"], row["emit.photons"]): row for row in self.rows("photon_mapping.csv")}
        self.assertEqual(set(rows), {("pond", "128x128"), ("pond", "256x256")})  # none has run in the cave
        self.assertEqual([rows["pond", "128x128"][key] for key in ("bound", "photon mapping's ms", "factor")], ["", "2000", "20"])
        self.assertEqual([rows["pond", "256x256"][key] for key in ("bound", "photon mapping's ms", "factor")], ["≥", "4000", "10"])
        self.assertIn("| `pond` | 20 (9.9 to 40) | ≥ 10 (5 to 20) |", self.printed("photon_mapping"))

    def test_after_one_second_say_whether_it_is_reached(self):
        row = self.row("one_second.csv", scene="pond")  # 0.002 with a million photons
        self.assertEqual([row[key] for key in ("relMSE", "default's least relMSE", "emit.photons", "part", "reached", "times")], ["0.002", "0.01", "256x256", "5", "false", ""])
        row = self.row("one_second.csv", scene="cave")
        self.assertEqual([row[key] for key in ("relMSE", "part", "reached", "ms to it", "at_most", "times")], ["0.02", "0.1", "true", "100", "true", "10"])
        self.assertIn("| `pond` | 0.002 | 0.01 | `256x256` | 400 | 5 | not reached | – |", self.printed("one_second"))
        self.assertIn("| `128x128` | 100 | 0.1 | ≤ 100 (47 to 213) | ≥ 10 (4.7 to 21) |", self.printed("one_second"))

    def test_the_default_is_compared_with_the_best_mixture_at_each_number_of_photons(self):
        row = self.row("summary.csv", who="default over best mixture")
        self.assertEqual([row[key] for key in ("scenes", "faster", "slower", "least", "largest", "clearly faster")], ["2", "1", "1", "0.5", "4", "1"])

    def test_of_disturbed_runs_are_marked(self):
        file = self.folder / "marked.csv"
        file.write_text("scene,relMSE,first,value,low,high,at_most,disturbed,photons,second,times,times low,times high,second at_most,second photons\n"
                        "pond,0.1,planar,10,9,11,true,true,128,light tracer,3,2,4,false,1000\ntree,0.1,nothing,,,,,,,,,,,,\n")
        self.assertEqual(self.printed("to_error", file).splitlines()[2:], ["| `pond` | `planar`\\* 128²: ≤ 10 (9 to 11)<br>`light tracer` ×3 |", "| `tree` | – |"])

    def test_have_a_circle_around_disturbed_runs_where_they_are_drawn(self):
        circled = [scene for scene in ("pond", "cave") if "#cc0000" in (self.folder / f"{scene}.svg").read_text()]
        self.assertEqual(circled, ["pond"])

    def test_of_another_device_are_without_what_is_in_turn_here(self):
        turn = self.folder / "elsewhere.csv"
        turn.write_text(IN_TURN.replace(",d", ",other"))
        before = (self.folder / "uncertainty.csv").read_text()
        subprocess.run([sys.executable, "-B", PROGRAM, "--tables", "--results", self.folder, "--in-turn", turn], check=True)
        row = self.row("uncertainty.csv", what="default's time at another hour")
        self.assertEqual((row["scenes"], row["standard deviation"]), ("0", "0"))
        subprocess.run([sys.executable, "-B", PROGRAM, "--tables", "--results", self.folder, "--in-turn", self.folder / "turn.csv"], check=True)
        self.assertEqual((self.folder / "uncertainty.csv").read_text(), before)


class Machines(unittest.TestCase):
    """A study whose scenes were made on two of them."""

    RUNS = """scene,technique,as_published,emit.photons,refine.finest,status,emitted,ms,media ms,spread,relMSE,"relMSE, reference's own",device,version
pond,planar,false,128x128,4096,done,1000,10,,0.1,0.04,,d,1
pond,planar,false,256x256,4096,done,4000,40,,0.1,0.01,,d,1
well,planar,false,128x128,4096,done,1000,10,,0.1,0.04,,d,1
well,planar,false,256x256,4096,done,4000,40,,0.1,0.01,,d,1
cave,planar,false,128x128,4096,done,1000,200,,0.1,0.002,,"l, e",1
cave,planar,false,256x256,4096,done,4000,800,,0.1,0.001,,"{}",1
"""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write("runs", self.RUNS.format("l, e"))
        head, *rows = TRACED.format(0.02, 0.01, 0.005).splitlines()
        self.write("light_tracer", "\n".join([head + ",device", *(row + (",d" if row.startswith("pond") else ",e") for row in rows)]) + "\n")
        self.write("best_mixtures", MIXTURES)
        self.write("turn", IN_TURN)

    def write(self, name, text):
        (self.folder / f"{name}.csv").write_text(text)

    def run_program(self):
        return subprocess.run([sys.executable, "-B", PROGRAM, "--tables", "--results", self.folder, "--in-turn", self.folder / "turn.csv"], capture_output=True, text=True)

    def rows(self, name):
        with (self.folder / f"{name}.csv").open(newline="") as stream:
            return list(csv.DictReader(stream))

    def test_of_one_scene_are_an_error_that_names_it(self):
        self.write("runs", self.RUNS.format("d"))
        done = self.run_program()
        self.assertIn("times of cave of 2 models of devices", done.stderr)
        self.assertEqual(done.returncode, 1)

    def test_of_a_scene_each_are_told_apart_and_costs_are_those_of_most_scenes(self):
        done = self.run_program()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual({row["scene"]: row["device"] for row in self.rows("equal_error")}, {"pond": "d", "cave": "l, e"})
        planar, = (row for row in self.rows("costs") if row["technique"] == "planar")
        self.assertEqual((planar["scenes"], planar["ns a photon"], planar["most ns a photon"]), ("2", "1e+04", "1e+04"))

    def test_that_only_the_light_tracer_or_mixtures_are_of_leave_their_scene_without_a_factor(self):
        self.write("runs", self.RUNS.format("other").replace(",d,1", ",other,1").replace('"l, e"', "other"))
        done = self.run_program()
        self.assertEqual(done.returncode, 0)
        self.assertIn("of pond the mixtures are of another machine than the runs, and left out", done.stderr)
        self.assertIn("of cave, pond the light tracer is of another machine than the runs, and left out", done.stderr)
        self.assertEqual(self.rows("equal_error"), [])


class Goals(unittest.TestCase):
    """By thirteen scenes that were named beforehand."""

    def goals(self, study, turn):
        done = subprocess.run([sys.executable, "-B", "-c", "import csv, json, sys; sys.path.insert(0, sys.argv[1]); from speed_error import *; study, turn = json.loads(sys.argv[2]);"
                               "rows = [{'scene': scene, 'technique': DEFAULT, 'status': 'done', 'factor': str(factor)} for scene, factor in turn.items()];"
                               "csv.writer(sys.stdout).writerows([GOALS, *goals([{'scene': scene, 'factor': factor} for scene, factor in study.items()], rows)]);"
                               "print(json.dumps(GOAL_SCENES), file=sys.stderr)", PLOTTING, json.dumps([study, turn])], capture_output=True, text=True, check=True)
        return list(csv.DictReader(done.stdout.splitlines())), json.loads(done.stderr)

    def test_of_other_scenes_count_nothing_and_scenes_without_a_row_are_named(self):
        _, scenes = self.goals({}, {})
        self.assertEqual((len(scenes), len(set(scenes)), "room_of_water" in scenes, {"blocker", "glass-dragon", "god-rays", "tree"} & set(scenes)), (13, 13, True, set()))
        factors = {scene: float(place) for place, scene in enumerate(scenes, 1)}  # 1 to 13: the room, the last, has 13
        study, turn = self.goals({**{scene: factor for scene, factor in factors.items() if scene != "room_of_water"}, "blocker": 100.0}, factors | {"glass-dragon": 100.0})[0]
        self.assertEqual([study[key] for key in ("by", "of", "scenes", "missing", "above 3", "slower", "least", "median", "largest", "median least", "median most")],
                         ["study", "13", "12", "room_of_water", "10", "1", "1.0", "6.5", "12.0", "6.0", "7.0"])
        self.assertEqual([turn[key] for key in ("by", "scenes", "missing", "above 3", "median", "median least", "median most")], ["in turn", "13", "", "11", "7.0", "7.0", "7.0"])

    def test_are_said_with_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "goals.csv"
            file.write_text("by,of,scenes,missing,above 3,slower,least,median,largest,median least,median most\nstudy,13,12,room_of_water,10,1,0.9,6.5,12,6,7\nin turn,13,13,,11,1,1,7,13,7,7\n")
            done = subprocess.run([sys.executable, "-B", PLOTTING / "speed_error_tables.py", "goals", file], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.splitlines()[2:], ["| study | 12 of 13 | `room_of_water` | 10 | 1 | 0.9 | 6.5 (with it 6 to 7) | 12 |", "| in turn | 13 of 13 | – | 11 | 1 | 1 | 7 | 13 |"])


class SpeedError(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "runs.csv").write_text(RUNS)
        (cls.folder / "light_tracer.csv").write_text(LIGHT_TRACER)
        subprocess.run([sys.executable, "-B", PROGRAM, "--results", cls.folder], check=True)

    def rows(self, name):
        with (self.folder / name).open(newline="") as stream:
            return list(csv.DictReader(stream))

    def test_at_equal_error_is_the_ratio_of_times_net_of_noise(self):
        rows = {(row["technique"], row["as_published"], row["emit.photons"]): row for row in self.rows("equal_error.csv")}
        self.assertEqual(set(rows), {("a", "false", "1x1"), ("a", "false", "2x2"), ("a", "true", "2x2"), ("b", "false", "2x2")})
        for key, photons, factor in [(("a", "false", "1x1"), 1e4, 1.0), (("a", "false", "2x2"), 1e5, 1.0),
                                     (("a", "true", "2x2"), 1e5, 2.0)]:
            self.assertAlmostEqual(float(rows[key]["light tracer's photons"]) / photons, 1.0, places=3)
            self.assertAlmostEqual(float(rows[key]["factor"]), factor, places=3)
            self.assertEqual(rows[key]["at_least"], "false")

    def test_below_the_references_noise_is_a_bound(self):
        row = next(row for row in self.rows("equal_error.csv") if row["technique"] == "b")
        self.assertEqual(row["at_least"], "true")
        self.assertAlmostEqual(float(row["light tracer's photons"]), 1000.0 / NOISE, delta=1.0)

    def test_to_an_error_takes_the_first_there_and_interpolates(self):
        rows = {float(row["relMSE"]): row for row in self.rows("to_error.csv")}
        self.assertEqual(rows[0.01]["first"], "a, as published")
        self.assertAlmostEqual(float(rows[0.01]["value"]), 50.0, places=2)
        # Half way between two runs of `a` in the logarithms: 10 to 100 ms; the light tracer has 33.3 ms for 0.03.
        self.assertAlmostEqual(float(rows[0.03]["value"]), 10.0 * 10.0 ** 0.5228787, delta=0.05)
        self.assertEqual(rows[0.001]["first"], "light tracer")

    def test_in_a_time_takes_the_least_error(self):
        rows = {float(row["ms"]): row for row in self.rows("in_time.csv")}
        self.assertEqual(rows[50.0]["first"], "a, as published")
        self.assertAlmostEqual(float(rows[50.0]["value"]), 0.01, places=5)
        self.assertEqual(rows[1000.0]["first"], "b")

    def test_of_photon_mapping_are_its_own_runs(self):
        done = subprocess.run([sys.executable, "-B", "-c", "import sys; sys.path.insert(0, sys.argv[1]);"
                               "from speed_error import *; f = pathlib.Path(sys.argv[2]);"
                               "of = curves(rows_of(f / 'runs.csv'), rows_of(f / 'light_tracer.csv'))['ring'];"
                               "print(of[PHOTON_MAPPING])", PROGRAM.parent, self.folder], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), f"[(9000.0, {0.5 - NOISE})]")

    def test_costs_are_slopes_between_few_and_many_photons(self):
        rows = {(row["technique"], row["as_published"]): row for row in self.rows("costs.csv")}
        self.assertEqual(set(rows), {("a", "false"), ("a", "true"), ("b", "false")})
        row = rows["a", "false"]
        self.assertEqual([float(row[key]) for key in ("ns a photon", "ms at none", "bytes a photon", "MiB at none")],
                         [90e6 / 3000, -20.0, 1049.0, 1.0])
        self.assertEqual((row["least ns a photon"], row["most ns a photon"]), (row["ns a photon"],) * 2)  # one scene
        self.assertEqual((row["most not formed, %"], row["most not formed, W"], row["on"]), ("7", "0.7", "ring"))
        self.assertEqual((rows["b", "false"]["scenes"], rows["b", "false"]["ns a photon"]), ("0", ""))

    def test_answers_are_of_the_middle_runs_by_default(self):
        row, = self.rows("answers.csv")
        # Of `a` by default the run with fewer photons of two; `b` has one.
        self.assertEqual((row["scene"], row["factor"], row["best"], row["best's at_least"]), ("ring", "", "b", "true"))
        self.assertTrue((self.folder / "headline.svg").is_file())

    def test_published_are_pairs_of_one_scene_and_size(self):
        row, = self.rows("published.csv")  # of `a` with 2x2; `b` has no row as published
        self.assertEqual((row["technique"], row["scenes"], row["least on"]), ("a", "1", "ring"))
        self.assertEqual([round(float(row[key]), 3) for key in ("ms", "least ms", "largest ms", "relMSE", "largest relMSE", "gain", "least gain", "largest gain")],
                         [2.0, 2.0, 2.0, 1.0, 1.0, 0.5, 0.5, 0.5])

    def test_draws_each_scene_that_has_a_caustic(self):
        self.assertTrue((self.folder / "ring.svg").is_file())
        self.assertFalse((self.folder / "tree.svg").exists())


if __name__ == "__main__":
    unittest.main()
