#!/usr/bin/env python3
"""Takes screenshots of the page of `bdpt view` for docs/view.md and the README: view_pictures.py BDPT FOLDER.

Writes growing.png, wiper.png, inspected.png, noise.png, broken.png and strip.png. Needs Debian's chromium,
chromium-driver and python3-pil."""

import pathlib
import shutil
import sys
import tempfile
import time

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "view"))
from served import Server  # noqa: E402
from window import Window  # noqa: E402

SIZE = 1180, 860
SHRUNK = 0.72  # scale of noisy pictures, as noise does not compress
PANEL = 300  # [CSS pixels] width of the page's panel; all controls share its colours


def quantise(image, controls=None):
    """Reduces the image to a palette, with some colours reserved for the controls of the page."""
    def colors(part, count):
        return part.convert("RGB").quantize(count, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).getpalette()[:3 * count]

    palette = Image.new("P", (1, 1))
    palette.putpalette(colors(image, 48 if controls else 96) + (colors(controls, 48) if controls else []))
    return image.convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE)


class Photographer:
    def __init__(self, window, folder):
        self.window, self.folder = window, folder

    def scheme(self, name):
        self.window.call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": {
            "features": [{"name": "prefers-color-scheme", "value": name}]}})

    def page(self):
        """Takes a screenshot of the window."""
        self.window.drawn()
        path = self.folder / "window.png"
        self.window.screenshot(path)
        with Image.open(path) as image:
            image.load()
        path.unlink()
        return image

    def stage(self):
        """Takes a screenshot of the picture alone, with its overlays."""
        left, top, width, height = self.window.box()
        return self.page().crop((round(left), round(top), round(left + width), round(top + height)))

    def keep(self, name):
        page = self.page()
        page = page.resize([round(SHRUNK * length) for length in page.size], Image.Resampling.LANCZOS)
        controls = page.crop((page.width - round(SHRUNK * PANEL), 0, page.width, page.height))
        quantise(page, controls).save(self.folder / name, optimize=True)


def samples(window, count):
    window.wait(f"window.bdptView.seen.samples[0] >= {count} && window.bdptView.seen.grid === window.bdptView.state.size[0]", 600)


def take(bdpt, folder):
    with tempfile.TemporaryDirectory() as name, Window(*SIZE) as window:
        camera = Photographer(window, folder)
        room = pathlib.Path(name, "cornell-spheres.gltf")
        shutil.copy(ROOT / "scenes" / room.name, room)
        with Server(bdpt, room.name, "--size", "480x360", "--spp", "32", "--integrator", "bdpt", folder=name) as server:
            camera.scheme("light")
            window.show(server)
            strip = [camera.stage()]
            samples(window, 4)
            camera.keep("growing.png")
            samples(window, 16)
            strip.append(camera.stage())
            camera.scheme("dark")
            window.call("POST", "/window/rect", {"width": SIZE[0], "height": 1330})
            window.drawn()
            window.click(0.66, 0.74)
            window.wait("!document.getElementById('inspector').hidden")
            window.run("document.querySelector('#inspector table button').click();")
            window.drawn()
            camera.keep("inspected.png")
            window.press("\ue00c")
            window.call("POST", "/window/rect", {"width": SIZE[0], "height": SIZE[1]})
            camera.scheme("light")
            window.press("2")
            window.wait("window.bdptView.state.layer === 'noise' && document.querySelector('#legend .colorbar')")
            time.sleep(1)
            camera.keep("noise.png")
            window.press("1")
            window.wait("window.bdptView.state.layer === 'picture'")
            before = window.seen()
            window.drag((0.4, 0.5), (0.43, 0.5))
            window.wait_for_generation(before["generation"])
            samples(window, 16)
            strip.append(camera.stage())
            window.click(0.64, 0.72)
            window.wait("!document.getElementById('inspector').hidden")
            strip.append(camera.stage())
            window.press("\ue00c")
            room.write_text(room.read_text(encoding="utf-8")[:900], encoding="utf-8")
            window.wait("!document.getElementById('message').hidden")
            camera.keep("broken.png")
            width, height = 300, 225
            together = Image.new("RGB", (4 * width + 3 * 6, height), "white")
            for i, image in enumerate(strip):
                together.paste(image.resize((width, height), Image.Resampling.LANCZOS), (i * (width + 6), 0))
            quantise(together).save(folder / "strip.png", optimize=True)
        with Server(bdpt, "door-ajar.gltf", "--size", "480x360", "--spp", "32", "--integrator", "mis", folder=ROOT / "scenes") as server:
            camera.scheme("dark")
            window.show(server)
            window.set("integrator-b", "bdpt", "change")
            window.wait("window.bdptView.seen.samples[1] >= 16", 600)
            camera.keep("wiper.png")


def main():
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    take(sys.argv[1], folder.resolve())
    print(f"{sum(f.stat().st_size for f in folder.glob('*.png')) >> 10} KiB")


if __name__ == "__main__":
    main()
