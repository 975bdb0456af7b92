"""Drives the page of `bdpt view` in a browser: performs a user's actions and reads the page."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "apps" / "tools"))
from webdriver import Browser, missing  # noqa: E402, F401

LEFT, MIDDLE = 0, 1
SHIFT = "\ue008"
STAGE = "document.querySelector('.stage')"


class Window(Browser):
    """Runs a browser as a context manager."""

    def show(self, server):
        """Opens the page and waits for the first pixels."""
        self.open(server.url)
        self.wait("document.documentElement.dataset.ready === 'true'")

    # These read the page.

    def state(self, member):
        return self.run("const value = window.bdptView.state; return value && value[arguments[0]];", member)

    def seen(self):
        """Returns what the page has received: numbers of the last move, restart and update; width of the grid."""
        return self.run("return { ...window.bdptView.seen };")

    def drawn(self):
        self.call("POST", "/execute/async", {"script": "const done = arguments[0];"
                  "requestAnimationFrame(() => requestAnimationFrame(() => done(true)));", "args": []})

    def picture(self):
        """Returns the pixels of the canvas, after all drawing is done."""
        self.drawn()
        return self.run(f"return {STAGE}.toDataURL();")

    def codes(self, slot=0, channels=3):
        """Returns the bytes of the first channels of RGBA of the picture before it is magnified."""
        self.drawn()
        return self.run("const canvas = window.bdptView.stage.slots[arguments[0]].canvas;"
                        "const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;"
                        "return [...data].filter((_, i) => i % 4 < arguments[1]);", slot, channels)

    def text(self, name):
        """Returns the text of an element; empty if it is hidden."""
        return self.run("const one = document.getElementById(arguments[0]);"
                        "return !one || one.hidden ? '' : one.textContent;", name)

    def finished(self):
        """Waits until all samples are rendered."""
        self.wait("window.bdptView.state.slots.every((slot, i) => slot.done && window.bdptView.seen.samples[i] === slot.samples) && "
                  "window.bdptView.seen.grid === window.bdptView.state.size[0]")

    def wait_for_generation(self, before):
        self.wait(f"window.bdptView.seen.generation > {before}")

    # These act like a user.

    def box(self):
        return self.run(f"const box = {STAGE}.getBoundingClientRect(); return [box.left, box.top, box.width, box.height];")

    def place(self, x, y):
        """Converts a position in the picture in [0, 1] to one in the window."""
        left, top, width, height = self.box()
        return left + x * width, top + y * height

    def pointer(self, actions):
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    @staticmethod
    def move(place, duration=0):
        return {"type": "pointerMove", "duration": duration, "x": round(place[0]), "y": round(place[1])}

    def drag(self, start, end, button=LEFT, steps=4):
        """Drags from one position in the picture to another, both in [0, 1]."""
        a, b = self.place(*start), self.place(*end)
        between = [(a[0] + (b[0] - a[0]) * i / steps, a[1] + (b[1] - a[1]) * i / steps) for i in range(1, steps + 1)]
        self.pointer([self.move(a), {"type": "pointerDown", "button": button}, *[self.move(place, 15) for place in between],
                      {"type": "pointerUp", "button": button}])

    def click(self, x, y, times=1, shift=False):
        once = [{"type": "pointerDown", "button": LEFT}, {"type": "pointerUp", "button": LEFT}]
        mouse = [self.move(self.place(x, y)), *once * times]
        if not shift:
            self.pointer(mouse)
            return
        pause = {"type": "pause", "duration": 0}
        keys = [{"type": "keyDown", "value": SHIFT}, *[pause] * len(mouse), {"type": "keyUp", "value": SHIFT}]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": keys},
                                                   {"type": "pointer", "id": "mouse", "actions": [pause, *mouse, pause]}]})

    def wheel(self, x, y, delta):
        left, top = self.place(x, y)
        action = {"type": "scroll", "x": round(left), "y": round(top), "deltaX": 0, "deltaY": delta, "duration": 0}
        self.call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [action]}]})

    def wheel_and_reset(self):
        """Turns the wheel and presses the key 0 before the page can send the move."""
        self.run(f"{STAGE}.dispatchEvent(new WheelEvent('wheel', {{ deltaY: 240, bubbles: true, cancelable: true }}));"
                 "document.dispatchEvent(new KeyboardEvent('keydown', { key: '0', bubbles: true }));")

    def set(self, name, value, event="input"):
        """Moves a slider, or chooses from a list (event: change)."""
        self.run("const one = document.getElementById(arguments[0]); one.value = arguments[1];"
                 "one.dispatchEvent(new Event(arguments[2], { bubbles: true }));", name, value, event)

    def downloads_to(self, folder):
        self.call("POST", "/goog/cdp/execute", {"cmd": "Browser.setDownloadBehavior",
                                                "params": {"behavior": "allow", "downloadPath": str(folder)}})

    # These handle tabs.

    def tab(self):
        return self.call("GET", "/window")

    def new_tab(self):
        """Opens a tab and switches to it; returns its handle."""
        name = self.call("POST", "/window/new", {"type": "tab"})["handle"]
        self.go_to(name)
        return name

    def go_to(self, tab):
        self.call("POST", "/window", {"handle": tab})

    def close_tab(self):
        self.call("DELETE", "/window")
