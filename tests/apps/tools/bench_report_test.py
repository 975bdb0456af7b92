#!/usr/bin/env python3
"""Tests the report of a small benchmark in Chromium: bench_report_test.py BDPT SCENE [PAGE IMAGE].

Exits with 77 if Chromium or chromedriver (Debian: chromium, chromium-driver) are not installed. With PAGE, runs no
benchmark but opens that report, and writes a screenshot of it to IMAGE."""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

from webdriver import Browser, missing

SKIPPED = 77
INTEGRATORS = ["pt", "nee", "mis", "lt", "bdpt"]
IMAGES = [*INTEGRATORS, "reference"]
STAGE = "document.querySelector('.stage')"
SIZE = 24


def expect(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")
    print(f"ok: {what}")


def make_report(bdpt, scene, folder):
    """Writes a report of two scenes: the same scene under two names."""
    second = folder / "second.gltf"
    second.write_bytes(pathlib.Path(scene).read_bytes())
    subprocess.run([bdpt, "bench", scene, str(second), "-o", str(folder / "out"), "--size", f"{SIZE}x{SIZE}", "--time",
                    "0.02s", "--reference-time", "0.1s", "--seeds", "2", "--strategy-depth", "3", "--integrators",
                    ",".join(INTEGRATORS), "--quiet"], check=True)
    return folder / "out" / "report.html"


def page_data(page):
    text = page.read_text(encoding="utf-8")
    return json.loads(re.search(r'id="bench-data">(.*?)</script>', text, re.DOTALL)[1])


def pixel(images, name, x, y):
    """Returns red, green and blue of a pixel of the page's data, decoded independently of the page."""
    planes = zlib.decompress(base64.b64decode(images["images"][name]))
    count = len(planes) // 4
    packed = sum(planes[plane * count + y * SIZE + x] << (8 * plane) for plane in range(4))
    power = 2.0 ** ((packed >> 27) - 24) / images["scale"]
    return [(packed >> shift & 511) * power for shift in (0, 9, 18)]


def image(browser, selector):
    """Returns the pixels of a canvas, after all drawing is done."""
    browser.call("POST", "/execute/async", {"script": "const done = arguments[0];"
                 "requestAnimationFrame(() => requestAnimationFrame(() => done(true)));", "args": []})
    return browser.run(f"return {selector}.toDataURL();")


def number(text):
    """Parses a number as the page writes it, "0.0123" or "1.2·10⁻³"."""
    digits = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
    return float(re.sub(f"[{digits}]", lambda found: "-0123456789"[digits.index(found[0])], text).replace("·10", "e"))


def check_loading(browser, page):
    browser.open(page.as_uri())
    ready = browser.wait("document.documentElement.dataset.ready")
    expect(ready == "true", "the page draws itself")
    messages = browser.messages()
    expect(messages == [], f"the console is empty {messages}")
    resources = browser.run("return performance.getEntriesByType('resource').map((one) => one.name)"
                            ".filter((name) => !name.startsWith('data:'));")
    expect(resources == [], "nothing is fetched")


def check_flipping(browser):
    browser.run("document.querySelector('.viewer').scrollIntoView({behavior: 'instant'});")
    shown = {}
    for number, name in enumerate(IMAGES, 1):
        browser.press(str(number))
        shown[number] = image(browser, STAGE)
        names = browser.run("return [...document.querySelectorAll('.shown-name')].map((one) => one.textContent)")
        wanted = f"{number} {name}"
        expect(names[0] == wanted, f"key {number} brings {wanted}")
    expect(len(set(shown.values())) == len(IMAGES), "each key brings another image")
    browser.press("1")
    expect(image(browser, STAGE) == shown[1], "flipping back brings the first one back")
    browser.press("9")
    expect(image(browser, STAGE) == shown[1], "a key without an image changes nothing")
    browser.run("document.querySelectorAll('.tile-name')[4].click();")
    expect(image(browser, STAGE) == shown[5], "so does a click on its name")


def check_display(browser):
    seen = {"picture": image(browser, STAGE)}
    for key, mode in (("e", "error"), ("v", "variance")):
        browser.press(key)
        seen[mode] = image(browser, STAGE)
        expect(browser.run("return document.querySelectorAll('.viewer .colorbar').length") >= 1, f"{mode} has a colour bar")
    expect(len(set(seen.values())) == 3, "image, error and variance differ")
    browser.press("p")
    for name, change in (("exposure", "slider.value = 2"), ("gamma", "slider.value = 1.5")):
        browser.run(f"const slider = document.getElementById('{name}'); {change};"
                    "slider.dispatchEvent(new Event('input'));")
        expect(image(browser, STAGE) != seen["picture"], f"{name} changes the image")
        browser.run("document.getElementById('reset').click();")
        expect(image(browser, STAGE) == seen["picture"], "reset brings it back")
    browser.run("const curve = document.getElementById('curve'); curve.value = 'none';"
                "curve.dispatchEvent(new Event('change'));")
    expect(image(browser, STAGE) != seen["picture"], "the tone curve changes the image")


def check_zoom(browser):
    tiles = [f"document.querySelectorAll('.tile canvas')[{i}]" for i in range(len(IMAGES))]
    before = [image(browser, tile) for tile in tiles]
    browser.run("document.querySelector('.zoom button').click();")
    zoomed = [image(browser, tile) for tile in tiles]
    expect(all(a != b for a, b in zip(before, zoomed)), "zoom goes for all images")
    browser.run(f"{STAGE}.focus();")
    browser.press("\ue014")  # arrow right
    panned = [image(browser, tile) for tile in tiles]
    expect(all(a != b for a, b in zip(zoomed, panned)), "so does panning by keys")
    browser.press("0")
    expect([image(browser, tile) for tile in tiles] == before, "0 shows the whole again")


def check_values(browser, data):
    x, y = 7, 15
    box = browser.run(f"const box = {STAGE}.getBoundingClientRect(); return [box.left, box.top, box.width, box.height];")
    browser.move_to(box[0] + (x + 0.5) / SIZE * box[2], box[1] + (y + 0.5) / SIZE * box[3])
    image(browser, STAGE)
    rows = browser.run("return [...document.querySelectorAll('.viewer')[0].querySelectorAll('.readout tbody tr')]"
                       ".map((row) => [...row.querySelectorAll('td.number')].map((cell) => cell.textContent));")
    images = data["scenes"][0]["pictures"]
    reference = pixel(images, "reference", x, y)
    for name, row in zip(IMAGES, rows):
        wanted = pixel(images, name, x, y)
        read = [number(text) for text in row[:3]]
        expect(all(abs(a - b) <= 6e-3 * abs(b) for a, b in zip(read, wanted)), f"the value of {name} under the pointer")
        if name != "reference":
            error = sum((v - r)**2 / (r * r + images["epsilon"]) for v, r in zip(wanted, reference)) / 3
            expect(abs(number(row[3]) - error) <= 0.06 * error + 1e-12, "its error")


def check_figures(browser, data):
    for index, scene in enumerate(data["scenes"]):
        count = browser.run("""
            const scene = document.querySelectorAll('.scene')[arguments[0]];
            const plots = [...scene.querySelectorAll('svg.plot:not(.bars)')].filter((one) => one.querySelector('polyline'));
            const inside = plots.every((plot) => [...plot.querySelectorAll('polyline.line')].every((line) => {
              const a = line.getBBox(), b = plot.viewBox.baseVal;
              return a.width > 20 && a.x >= 0 && a.y >= 0 && a.x + a.width <= b.width && a.y + a.height <= b.height; }));
            return { plots: plots.length, inside, lines: scene.querySelectorAll('polyline.line').length,
              bands: scene.querySelectorAll('polygon.band').length, slopes: scene.querySelectorAll('line.slope').length,
              markers: scene.querySelectorAll('.marker').length, bars: scene.querySelectorAll('.bars .bar').length,
              cells: scene.querySelectorAll('.pyramid li').length, maps: scene.querySelectorAll('canvas.map').length,
              rows: scene.querySelectorAll('table tbody tr').length };""", index)
        points = sum(len(one["curve"]) for one in scene["integrators"])
        name = scene["name"]
        expect(count["plots"] == 2 and count["lines"] == count["bands"] == 2 * len(INTEGRATORS),
               f"{name}: two plots with a line for each integrator")
        expect(count["inside"], f"{name}: the lines are inside of them")
        expect(count["markers"] == 2 * points, f"{name}: with all points")
        expect(count["slopes"] >= 4, f"{name}: slope guides")
        expect(count["bars"] == len(INTEGRATORS), f"{name}: bars of speed-up")
        expect(count["cells"] == 2 * len(scene["strategies"]["strategies"]) > 0, f"{name}: both pyramids")
        expect(count["maps"] == 1, f"{name}: a map of path lengths")
        expect(count["rows"] == len(IMAGES) + points + len(INTEGRATORS), f"{name}: tables")
    expect(browser.run("return document.querySelectorAll('.overview tbody tr').length") == len(data["scenes"]),
           "the overview has all scenes")


def check_access(browser):
    unnamed = browser.run("""
        const named = (one) => one.getAttribute('aria-label') || one.textContent.trim() || one.labels?.length;
        return [...document.querySelectorAll('button, select, input, canvas[role], svg.plot, table')]
          .filter((one) => !named(one)).map((one) => one.outerHTML.slice(0, 80));""")
    expect(unnamed == [], f"all controls, images and plots have a name {unnamed}")
    expect(browser.run("return document.documentElement.lang") == "en", "the page says its language")
    dark = []
    for _ in range(2):
        browser.run("document.getElementById('theme').click();")
        dark.append(browser.run("return getComputedStyle(document.body).backgroundColor;"))
    expect(len(set(dark)) == 2, "light and dark differ")


def check_narrow(browser):
    browser.call("POST", "/window/rect", {"width": 520, "height": 900})
    over = browser.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth;")
    expect(over <= 0, f"a narrow window does not scroll sideways ({over})")


def check(page):
    with Browser() as browser:
        data = page_data(page)
        check_loading(browser, page)
        check_flipping(browser)
        check_display(browser)
        check_zoom(browser)
        check_values(browser, data)
        check_figures(browser, data)
        check_access(browser)
        check_narrow(browser)
        messages = browser.messages()
        expect(messages == [], f"the console is still empty {messages}")


def photograph(page, target):
    with Browser(1320, 1500) as browser:
        browser.open(page.as_uri())
        browser.wait("document.documentElement.dataset.ready")
        browser.press("5")
        image(browser, STAGE)
        browser.screenshot(target)


def main():
    lacking = missing()
    if lacking:
        print(f"skipped: {lacking} is not installed (Debian: chromium, chromium-driver)")
        sys.exit(SKIPPED)
    if len(sys.argv) > 4:
        photograph(pathlib.Path(sys.argv[3]).resolve(), sys.argv[4])
        return
    with tempfile.TemporaryDirectory() as folder:
        check(make_report(sys.argv[1], sys.argv[2], pathlib.Path(folder)))


if __name__ == "__main__":
    main()
