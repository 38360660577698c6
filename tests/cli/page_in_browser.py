#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Opens a report.html in headless Chromium as a reader would, and uses it with the keyboard.

    page_in_browser.py PAGE.html [SCREENSHOT.png]

Prints what is wrong, one line each, and exits with 1; with 0 when nothing is. Needs Debian's
chromium and chromium-driver, and speaks to the driver in plain W3C WebDriver.
"""

import base64
import json
import re
import subprocess
import sys
import tempfile
import urllib.error
import urllib.request
from pathlib import Path

ARROW_LEFT, HOME, END, PAGE_UP, ESCAPE = "\ue012", "\ue011", "\ue010", "\ue00e", "\ue00c"
SECONDS_FOR_AN_ANSWER = 60

# The driver is on this machine, whatever proxy the environment names.
DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


class Browser:
    """One window of a headless Chromium without a network."""

    def __init__(self, profile: str):
        self.driver = subprocess.Popen(
            ["chromedriver", "--port=0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        port = None
        for line in self.driver.stdout:
            started = re.search(r"started successfully on port (\d+)", line)
            if started:
                port = started[1]
                break
        self.url = f"http://127.0.0.1:{port}/session"
        flags = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run
            --disable-background-networking --disable-component-update --disable-sync
            --disable-dev-shm-usage --disable-extensions"""
        # Every name and address but this machine's own leads nowhere.
        flags = flags.split() + [
            "--host-resolver-rules=MAP * ~NOTFOUND",
            f"--user-data-dir={profile}",
            "--window-size=1280,1600",
        ]
        options = {"goog:chromeOptions": {"args": flags}, "goog:loggingPrefs": {"browser": "ALL"}}
        session = self.ask("POST", "", {"capabilities": {"alwaysMatch": options}})
        self.url += "/" + session["sessionId"]

    def ask(self, method: str, path: str, body: dict | None = None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(
            self.url + path, data, {"Content-Type": "application/json"}, method=method
        )
        try:
            with DIRECT.open(request, timeout=SECONDS_FOR_AN_ANSWER) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from error

    def run(self, script: str):
        return self.ask("POST", "/execute/sync", {"script": script, "args": []})

    def press(self, element: str, keys: str) -> None:
        """Keys on the element with that id, as a keyboard sends them."""
        self.run(f"document.getElementById('{element}').focus()")
        strokes = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        keyboard = {"type": "key", "id": "keyboard", "actions": strokes}
        self.ask("POST", "/actions", {"actions": [keyboard]})

    def click(self, element: str, across: float) -> None:
        """With the mouse, half way down and that share of the width from the left."""
        left, top, width, height = self.run(
            f"""const element = document.getElementById('{element}');
            element.scrollIntoView({{block: 'nearest'}});
            const box = element.getBoundingClientRect();
            return [box.left, box.top, box.width, box.height];"""
        )
        x, y = round(left + across * width), round(top + 0.5 * height)
        strokes = [
            {"type": "pointerMove", "duration": 0, "x": x, "y": y},
            {"type": "pointerDown", "button": 0},
            {"type": "pointerUp", "button": 0},
        ]
        mouse = {"type": "pointer", "id": "mouse", "actions": strokes}
        self.ask("POST", "/actions", {"actions": [mouse]})

    def close(self) -> None:
        try:
            self.ask("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()


VALUES = "return document.getElementById('values').textContent"
CLIPPED = "return document.getElementById('left-image').style.clipPath"
IMAGES = "return ['left', 'right'].map(s => document.getElementById(s + '-image').alt)"
BROKEN = "return [...document.images].filter(i => !i.complete || i.naturalWidth === 0).length"
FETCHED = """return performance.getEntriesByType('resource').map(e => e.name)
             .filter(name => !name.startsWith('data:'))"""
OVERFLOW = "return document.documentElement.scrollWidth - document.documentElement.clientWidth"


def problems_of(browser: Browser, page: Path, screenshot: Path | None):
    """Uses the page; yields what is wrong with it."""

    def expect(what: str, found, wanted):
        if found != wanted:
            yield f"{what}: {found!r} and not {wanted!r}"

    browser.ask("POST", "/url", {"url": page.resolve().as_uri()})
    yield from expect("images that do not load", browser.run(BROKEN), 0)
    yield from expect("the divider at first", browser.run(CLIPPED), "inset(0px 50% 0px 0px)")
    browser.press("divider", ARROW_LEFT * 5)
    yield from expect("the divider after 5 arrows", browser.run(CLIPPED), "inset(0px 55% 0px 0px)")
    browser.press("divider", PAGE_UP)
    yield from expect("the divider a page on", browser.run(CLIPPED), "inset(0px 45% 0px 0px)")
    browser.press("divider", HOME)
    yield from expect("the divider at its home", browser.run(CLIPPED), "inset(0px 100% 0px 0px)")
    browser.press("divider", END)
    yield from expect("the divider at its end", browser.run(CLIPPED), "inset(0px 0% 0px 0px)")
    browser.click("divider", 0.25)
    percent = float(browser.run("return document.getElementById('divider').value"))
    if abs(percent - 25.0) > 2.0:  # the thumb is as wide as a percent or two of the picture
        yield f"a click at a quarter of the picture puts the divider at {percent:g} percent"
    before = browser.run(IMAGES)
    if before[0] == before[1]:
        yield f"both sides show {before[0]}"
    spoken = browser.run("return document.getElementById('divider').getAttribute('aria-valuetext')")
    if before[0] not in (spoken or ""):
        yield f"a screen reader hears '{spoken}'"
    browser.press("right", END)
    if browser.run(IMAGES)[1] == before[1]:
        yield "choosing another image on the right changes nothing"
    browser.press("divider", "2")
    second = browser.run("return document.getElementById('right').options[1].text")
    yield from expect("the image alone after key 2", browser.run(IMAGES)[0], second)
    yield from expect("the divider after key 2", browser.run(CLIPPED), "inset(0px 0% 0px 0px)")
    browser.press("divider", ESCAPE)
    yield from expect("the divider after Escape", browser.run(CLIPPED), "inset(0px 50% 0px 0px)")
    browser.click("divider", 0.25)
    values = browser.run(VALUES)
    # As "reference (3, 4): 1.000, 2.500e-7, 0.000 W/m²", for both sides.
    if not re.fullmatch(r"(.*\(\d+, \d+\): (-?[\d.]+(e[-+]\d+)?(, )?){3}( \S+)?( · )?){2}", values):
        yield f"the values under the mouse are '{values}'"
    browser.press("divider", HOME + PAGE_UP * 5)
    if screenshot:
        screenshot.write_bytes(base64.b64decode(browser.ask("GET", "/screenshot")))
    # Headless windows are no narrower than 500 pixels.
    browser.ask("POST", "/window/rect", {"width": 500, "height": 800})
    yield from expect("pixels too wide for a narrow window", browser.run(OVERFLOW), 0)
    yield from expect("files that the page asks for", browser.run(FETCHED), [])
    logged = browser.ask("POST", "/se/log", {"type": "browser"})
    yield from expect("messages on the console", [entry["message"] for entry in logged], [])


def main() -> int:
    page = Path(sys.argv[1])
    screenshot = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        try:
            browser = Browser(profile)
        except FileNotFoundError:
            print("chromedriver is not there; install the packages chromium and chromium-driver")
            return 1
        try:
            count = 0
            for count, problem in enumerate(problems_of(browser, page, screenshot), 1):
                print(problem, flush=True)
            return 1 if count else 0
        finally:
            browser.close()


if __name__ == "__main__":
    sys.exit(main())
