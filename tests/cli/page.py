#!/usr/bin/env python3
"""Looks through a report of `argand validate` in a headless Chromium, by WebDriver.

page.py PAGE [FOLDER]: exit code 1 and a sentence where something is not as it should be.
FOLDER gets screenshots.
"""
import base64
import json
import os
import re
import subprocess
import sys
import tempfile
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # WebDriver, 12.1
KEYS = {"left": "\ue012", "right": "\ue014", "shift": "\ue008", "space": " "}


class Browser:
    def __init__(self):
        self.base = None
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE,
                                       text=True)
        port = None
        while not port:
            line = self.driver.stdout.readline()
            check(line, "chromedriver did not start")
            port = re.search(r"successfully on port (\d+)", line)
        self.server = f"http://127.0.0.1:{port[1]}"

    def begin(self, profile):
        arguments = ["--headless=new", "--disable-gpu", "--window-size=1280,1000",
                     "--user-data-dir=" + profile]
        if os.geteuid() == 0:
            arguments.append("--no-sandbox")
        session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": {
            "goog:chromeOptions": {"args": arguments},
            "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
        self.base = "/session/" + session["sessionId"]

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        url = self.server + (self.base or "") + path
        request = urllib.request.Request(url, data, method=method)
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def run(self, script):
        return self.call("POST", "/execute/sync", {"script": script, "args": []})

    def open(self, url):
        self.call("POST", "/url", {"url": url})

    def press(self, *keys):
        actions = [{"type": kind, "value": KEYS.get(key, key)}
                   for key in keys for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys",
                                                    "actions": actions}]})

    def drag(self, start, end):
        def to(place):
            return {"type": "pointerMove", "duration": 0, "origin": "viewport",
                    "x": round(place[0]), "y": round(place[1])}
        steps = [to(start), {"type": "pointerDown", "button": 0}, to(end),
                 {"type": "pointerUp", "button": 0}]
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse",
                                                    "actions": steps}]})

    def click(self, selector):
        found = self.call("POST", "/element", {"using": "css selector", "value": selector})
        self.call("POST", f"/element/{found[ELEMENT]}/click", {})

    def shoot(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("GET", "/screenshot")))

    def log(self, kind):
        return self.call("POST", "/se/log", {"type": kind})

    def close(self):
        if self.base:
            self.call("DELETE", "")
        self.driver.terminate()
        self.driver.wait()


def check(fact, sentence):
    if not fact:
        sys.exit("page.py: " + sentence)


def shown(browser):
    """What a person sees of the comparison."""
    return browser.run("""
        const real = document.getElementById("real"), style = getComputedStyle(real);
        return { at: Number(document.getElementById("compare").getAttribute("aria-valuenow")),
                 clip: style.clipPath, real: style.display, source: real.src,
                 heat: getComputedStyle(document.getElementById("heat")).display,
                 name: document.getElementById("name").textContent };""")


def check_pictures(browser, name):
    broken = browser.run("""
        const images = [...document.images];
        return Promise.all(images.map(i => i.decode().then(() => null, () => i.alt))).then(failed =>
            [images.length, ...failed.filter(x => x),
             ...images.filter(i => !i.complete || !i.naturalWidth).map(i => i.alt)]);""")
    check(broken[0] >= 5, f"{name} has but {broken[0]} pictures")
    check(len(broken) == 1, f"{name} has pictures that do not load: {broken[1:]}")


def check_slider(browser):
    box = browser.run("const b = document.getElementById('compare').getBoundingClientRect();"
                      "return [b.left, b.top, b.width, b.height];")
    middle = (box[0] + box[2] / 2, box[1] + 20)
    before = shown(browser)
    check(before["at"] == 50 and "50%" in before["clip"], f"the slider starts at {before}")
    browser.drag(middle, (box[0] + box[2] * 0.8, middle[1]))
    mouse = shown(browser)
    check(abs(mouse["at"] - 80) <= 1, f"the mouse drags the slider to {mouse['at']}, not 80")
    check(mouse["clip"] != before["clip"], "the mouse does not change the clip")
    browser.press("left", "left", "left")
    keys = shown(browser)
    check(keys["at"] == mouse["at"] - 3, f"three keys move the slider to {keys['at']}")
    check(keys["clip"] != mouse["clip"], "the keyboard does not change the clip")
    browser.press("right")
    check(shown(browser)["at"] == keys["at"] + 1, "the right arrow does not move the slider")


def check_modes(browser):
    check(shown(browser)["heat"] == "none", "the error map covers the pictures")
    browser.press("h")
    check(shown(browser)["heat"] != "none", "h does not show the error map")
    browser.press("h", "space")
    check(shown(browser)["real"] == "none", "space does not flip to the reference")
    browser.press("space")
    back = shown(browser)
    check(back["real"] != "none" and back["at"] == 100, "space does not flip back")
    browser.press("n")
    part = shown(browser)
    check(part["source"] != back["source"], "n shows no part of the light")
    browser.press("p")
    check(shown(browser)["source"] == back["source"], "p does not go back to the whole")
    browser.press("?")
    check(browser.run("return document.getElementById('keys').open;"), "? does not help")
    browser.press("?")
    check(not browser.run("return document.getElementById('keys').open;"), "help stays open")


def check_scenes(browser, count):
    first = shown(browser)["name"]
    browser.press("j")
    check(count == 1 or shown(browser)["name"] != first, "j does not show the next scene")
    check_pictures(browser, shown(browser)["name"])
    browser.press("k")
    check(shown(browser)["name"] == first, "k does not go back")
    browser.press(str(count))
    check(count == 1 or shown(browser)["name"] != first, f"{count} does not show that scene")
    browser.press("1")
    check(shown(browser)["name"] == first, "1 does not show the first scene")


def check_themes(browser, folder):
    paper = "return getComputedStyle(document.body).backgroundColor;"
    colors = [browser.run(paper)]
    if folder:
        browser.shoot(folder + "/light.png")
    browser.click("#theme")
    colors.append(browser.run(paper))
    if folder:
        browser.shoot(folder + "/dark.png")
    check(colors[0] != colors[1], f"light and dark are both {colors[0]}")
    browser.press("t")
    check(browser.run(paper) == colors[0], "t does not toggle back")
    browser.call("POST", "/goog/cdp/execute", {
        "cmd": "Emulation.setEmulatedMedia",
        "params": {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}})
    browser.run("delete document.documentElement.dataset.theme;")
    check(browser.run(paper) == colors[1], "the system's dark scheme is not followed")


def check_names(browser):
    nameless = browser.run("""
        return [...document.querySelectorAll("button, img, [role=slider]")].filter(e =>
            !(e.ariaLabel || e.alt || e.textContent.trim())).map(e => e.outerHTML.slice(0, 99));""")
    check(not nameless, f"these have no name for a screen reader: {nameless}")


def check_quiet(browser):
    said = [entry for entry in browser.log("browser") if entry["level"] in ("SEVERE", "WARNING")]
    check(not said, f"the console says: {said}")
    for entry in browser.log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            check(not re.match("(http|ws)s?:", url), f"the page asks the network for {url}")


def look(browser, page, folder):
    browser.open("file://" + os.path.abspath(page))
    count = browser.run("return data.scenes.length;")
    check(count >= 1, "the page has no scene")
    check_pictures(browser, "the first scene")
    check_names(browser)
    check_slider(browser)
    check_modes(browser)
    check_scenes(browser, count)
    check_themes(browser, folder)
    check_quiet(browser)


def main(page, folder=None):
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser()
        try:
            browser.begin(profile)
            look(browser, page, folder)
        finally:
            browser.close()


main(*sys.argv[1:])
