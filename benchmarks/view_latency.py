#!/usr/bin/env python3
"""Measures `bdpt view` through a browser: view_latency.py BDPT SCENE... [--size 640x480] [--moves 60] [BDPT options].

Prints for each scene: the time from the page's start to the first pixels; the time from a move of the mouse to the
first pixels on the screen that show it (median and 95th percentile); pictures per second while the mouse turns the
camera; and the server's CPU time when all is done and nothing moves. Needs Debian's chromium and chromium-driver. The
browser shares the CPU, and draws on it where there is no GPU.
"""

import argparse
import os
import pathlib
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "view"))
from served import Server  # noqa: E402
from window import STAGE, Window, missing  # noqa: E402

# The page measures the time of moves: from the event to the end of the frame that draws pixels with its number.
MOVES = """
const [count, pause, done] = arguments;
const stage = document.querySelector('.stage');
const view = window.bdptView;
const box = stage.getBoundingClientRect();
const at = (type, x, buttons) => stage.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, isPrimary: true, button: 0,
  buttons, clientX: x, clientY: box.top + box.height / 2 }));
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
stage.setPointerCapture = () => {};
(async () => {
  const times = [];
  let x = box.left + box.width / 2;
  at('pointerdown', x, 1);
  for (let i = 0; i < count; ++i) {
    x += i % 20 < 10 ? 8 : -8;
    const generation = view.seen.generation;
    const start = performance.now();
    at('pointermove', x, 1);
    while (view.seen.generation === generation && performance.now() - start < 30000) {
      await frame();
    }
    await frame();
    times.push(performance.now() - start);
    await sleep(pause);
  }
  at('pointerup', x, 0);
  done(times);
})();
"""

TURNING = """
const [seconds, done] = arguments;
const stage = document.querySelector('.stage');
const view = window.bdptView;
const box = stage.getBoundingClientRect();
const at = (type, x, buttons) => stage.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, isPrimary: true, button: 0,
  buttons, clientX: x, clientY: box.top + box.height / 2 }));
let x = box.left + box.width / 2;
at('pointerdown', x, 1);
const start = performance.now();
let pictures = 0;
let generation = view.seen.generation;
const step = () => {
  if (view.seen.generation !== generation) {
    generation = view.seen.generation;
    pictures += 1;
  }
  if (performance.now() - start < 1000 * seconds) {
    x += Math.floor((performance.now() - start) / 1000) % 2 ? -4 : 4;
    at('pointermove', x, 1);
    requestAnimationFrame(step);
  } else {
    at('pointerup', x, 0);
    done(pictures / seconds);
  }
};
step();
"""

FIRST_PIXELS = """
const done = arguments[0];
const wait = () => window.bdptView && document.documentElement.dataset.ready === 'true'
  ? done([performance.now(), performance.getEntriesByType('navigation')[0].responseEnd]) : setTimeout(wait, 1);
wait();
"""


def cpu_seconds(server):
    cells = pathlib.Path(f"/proc/{server.process.pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(cells[11]) + int(cells[12])) / os.sysconf("SC_CLK_TCK")


def script(window, text, *arguments):
    return window.call("POST", "/execute/async", {"script": text, "args": list(arguments)})


def measure(options, scene):
    words = ["--size", options.size, "--spp", str(options.spp), *options.words]
    with Server(options.bdpt, scene, *words) as server, Window(1280, 900) as window:
        window.call("POST", "/timeouts", {"script": 600000})
        window.open("about:blank")
        window.open(server.url)
        first, page = script(window, FIRST_PIXELS)
        print(f"\n{scene}\n  first pixels after {first:.0f} ms (the page was there after {page:.0f} ms); that includes loading the scene")
        window.open("about:blank")
        window.open(server.url)
        first, _ = script(window, FIRST_PIXELS)
        print(f"  again, with the scene loaded: {first:.0f} ms")
        script(window, MOVES, 5, 50)
        times = sorted(script(window, MOVES, options.moves, 100))
        print(f"  from a move to changed pixels: median {statistics.median(times):.0f} ms, "
              f"95 % below {times[int(0.95 * (len(times) - 1))]:.0f} ms, {len(times)} moves")
        times = sorted(script(window, MOVES, options.moves // 2, 600))
        print(f"  from a move after a rest of 0.6 s, in which a render begins: median {statistics.median(times):.0f} ms, "
              f"95 % below {times[int(0.95 * (len(times) - 1))]:.0f} ms")
        print(f"  pictures a second while turning: {script(window, TURNING, 5):.1f}")
        print(f"  width of the first picture after a move: {window.seen()['grid']} or less of {window.run(f'return {STAGE}.width')}")
        if options.idle:
            window.wait("window.bdptView.state.slots.every((slot) => slot.done)", 3600)
            time.sleep(1)
            before = cpu_seconds(server)
            time.sleep(options.idle)
            print(f"  processor time of the server, all done: {cpu_seconds(server) - before:.2f} s in {options.idle:.0f} s")
        print(f"  memory of the server: {server.memory():.0f} MiB, {server.threads()} threads")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bdpt")
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--spp", type=int, default=8, help="samples after which the server is idle")
    parser.add_argument("--moves", type=int, default=60)
    parser.add_argument("--idle", type=float, default=10, help="[s] for which the idle server is watched; 0: not")
    options, options.words = parser.parse_known_args()
    if missing():
        sys.exit(f"{missing()} is not installed (Debian: chromium, chromium-driver)")
    for scene in options.scenes:
        measure(options, scene)


if __name__ == "__main__":
    main()
