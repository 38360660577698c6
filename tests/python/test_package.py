# SPDX-License-Identifier: MIT
"""The package as a whole: the documents' examples, stubs, several renderers, the end of the process."""

import ast
import inspect
import os
import re
import subprocess
import sys
import textwrap
import threading
import unittest

import kaustik
from kaustik import _kaustik
from support import SMALL, SOURCE, TestCase


def run_python(code, **options):
    return subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, **options
    )


class Documents(TestCase):
    def test_their_examples_run(self):
        for document in ("README.md", "framework/python/README.md"):
            with self.subTest(document=document):
                self.run_example(os.path.join(SOURCE, document))

    def run_example(self, document):
        with open(document, encoding="utf-8") as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        self.assertEqual(len(blocks), 1)
        # The same in seconds on a processor.
        code, sizes = re.subn(r"size=\(\d+, \d+\)", "size=(64, 48)", blocks[0])
        code, grids = re.subn(r"\(512, 512\)", "(32, 32)", code)
        code, photons = re.subn(r"photons=\d+_\d+_\d+", "photons=300_000", code)
        self.assertTrue(sizes and grids)
        self.assertEqual(photons, code.count("kaustik.reference("))
        folder = self.folder()
        done = run_python(code, cwd=folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        saved = re.findall(r"save\(\"([^\"]+)\"", code)
        self.assertTrue(saved)
        for file in saved:
            self.assertTrue(os.path.exists(os.path.join(folder, file)), file)


class Names(TestCase):
    def test_are_all_documented(self):
        for name in kaustik.__all__:
            value = getattr(kaustik, name)
            if name == "__version__":
                self.assertRegex(value, r"^\d+\.\d+\.\d+$")
                continue
            self.assertTrue(inspect.getdoc(value), name)
            if not inspect.isclass(value):
                continue
            for member, defined in vars(value).items():
                if not member.startswith("_"):
                    self.assertTrue(inspect.getdoc(defined), f"{name}.{member}")

    def test_are_the_stubs(self):
        folder = os.path.dirname(kaustik.__file__)
        self.assertTrue(os.path.exists(os.path.join(folder, "py.typed")))
        with open(os.path.join(folder, "_kaustik.pyi"), encoding="utf-8") as file:
            stubs = ast.parse(file.read()).body

        def public(names):
            return {name for name in names if not name.startswith("_")}

        def stubbed(body):
            return {node.name: node for node in body if hasattr(node, "name")}

        self.assertEqual(public(stubbed(stubs)), public(vars(_kaustik)))
        for name, node in stubbed(stubs).items():
            native = getattr(_kaustik, name)
            if isinstance(node, ast.ClassDef):
                members = stubbed(node.body)
                self.assertEqual(public(members), public(vars(native)), name)
                for member in members:
                    self.assertTrue(hasattr(native, member), f"{name}.{member}")
            # pybind11 writes the arguments into the first line of the docstring.
            methods = stubbed(node.body).items() if isinstance(node, ast.ClassDef) else [("", node)]
            for member, function in methods:
                signature = inspect.getdoc(getattr(native, member) if member else native) or ""
                match = re.match(r"\w+\((.*)\) ->", signature)
                if not isinstance(function, ast.FunctionDef) or match is None:
                    continue
                arguments = re.findall(r"(?:^|, )(\w+): ", match[1])
                written = [a.arg for a in function.args.args + function.args.kwonlyargs]
                if not any(a.startswith("arg") and a[3:].isdigit() for a in arguments):
                    self.assertEqual(arguments, written, f"{name}.{member}")

    def test_that_do_not_exist_are_said_with_the_nearest(self):
        with self.assertRaisesRegex(AttributeError, "'opne'; did you mean 'open'?"):
            kaustik.opne("pool")
        r = self.open()
        with self.assertRaisesRegex(AttributeError, "'resd'; did you mean 'read'?"):
            r.resd("display")
        with self.assertRaisesRegex(AttributeError, "sead"):
            r.sead = 3
        self.assertFalse(hasattr(kaustik, "nothing"))


class Several(TestCase):
    def test_renderers_work_at_once_and_give_the_same_bits(self):
        renderers = [self.open() for _ in range(3)]
        pictures = {}

        def work(number):
            renderers[number].step(2)
            pictures[number] = bytes(memoryview(renderers[number].read("caustic.irradiance")))

        threads = [threading.Thread(target=work, args=(number,)) for number in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[2])
        renderers[1].close()
        renderers[0].step()  # one that is closed takes nothing from the others
        self.assertEqual(bytes(memoryview(renderers[0].read("caustic.irradiance"))), pictures[0])

    def test_threads_take_turns_with_one_renderer(self):
        r = self.open()
        threads = [threading.Thread(target=r.step, args=(3,)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(r.report()["frames"], 9)

    def test_closing_ends_what_another_thread_waits_for(self):
        r = self.open()
        r.step()
        raised = []

        def work():
            try:
                r.step(1000000)
            except kaustik.KaustikError as error:
                raised.append(error)

        thread = threading.Thread(target=work)
        thread.start()
        r.close()
        thread.join()
        self.assertIn("closed", str(raised[0]))


class End(TestCase):
    def test_of_the_process_is_clean_with_renderers_open(self):
        done = run_python(
            f"""
            import kaustik
            r = kaustik.open("ring", **{SMALL!r})
            r.step()
            kept = memoryview(r.read("display"))
            """
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_of_the_process_ends_what_threads_still_do(self):
        done = run_python(
            f"""
            import kaustik, threading
            r = kaustik.open("ring", **{SMALL!r})
            r.step()
            begun = threading.Event()
            options = {{"size": (32, 24), "photons": 10**12, "progress": lambda *news: begun.set()}}
            for work in (lambda: r.step(10**6), lambda: kaustik.reference("ring", **options)):
                threading.Thread(target=work, daemon=True).start()
            begun.wait()
            """,
            env={**os.environ, "KAUSTIK_CACHE": self.folder()},
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_of_a_forked_process_leaves_the_first_one_alone(self):
        done = run_python(
            f"""
            import os, sys, warnings, kaustik
            # Python 3.12 and later warn of what is tested here: a fork beside threads.
            warnings.filterwarnings("ignore", "This process .* multi-threaded", DeprecationWarning)
            r = kaustik.open("ring", **{SMALL!r})
            r.step()
            child = os.fork()
            if child == 0:
                try:
                    r.step()
                except kaustik.DeviceError as error:
                    print(error, flush=True)
                sys.exit(3)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
            r.step()
            """
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("forked", done.stdout)


if __name__ == "__main__":
    unittest.main()
