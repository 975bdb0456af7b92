#!/usr/bin/env python3
"""Tests the page of `bdpt view` in Chromium as its users use it: page_test.py BDPT SCENE.

Exits with 77 if Chromium or chromedriver (Debian: chromium, chromium-driver) are not installed."""

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

from served import SKIPPED, Server, expect, wait_for
from window import MIDDLE, Window, missing

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "apps" / "ids"))
from exr_file import ExrFile  # noqa: E402

SAMPLES = 16
CURVES = ("filmic", "pbr-neutral", "agx", "none")
OPTIONS = ("--size", "96x72", "--spp", str(SAMPLES), "--integrator", "bdpt")


def check_loading(window, server):
    window.show(server)
    expect(len(set(window.codes())) > 20, "a picture appears")
    messages = window.messages()
    expect(messages == [], f"the console is empty {messages}")
    outside = window.run("return performance.getEntriesByType('resource').map((one) => one.name)"
                         ".filter((name) => !name.startsWith('data:') && !name.startsWith(location.origin.replace('http', 'ws')));")
    expect(outside == [], f"nothing else is fetched {outside}")
    window.finished()
    expect(window.state("slots")[0]["samples"] == SAMPLES, "it grows to all samples")


def check_camera(window):
    for name, act in (("a drag", lambda: window.drag((0.4, 0.4), (0.6, 0.5))),
                      ("a drag with the middle button", lambda: window.drag((0.4, 0.4), (0.6, 0.5), MIDDLE)),
                      ("the wheel", lambda: window.wheel(0.5, 0.5, 240)),
                      ("an arrow key", lambda: window.press("\ue012")), ("Page Up", lambda: window.press("\ue00e")),
                      ("the key 0", lambda: window.press("0")),
                      ("a double click", lambda: window.click(0.5, 0.6, times=2)), ("another one", lambda: window.press("0"))):
        before, picture, camera = window.seen(), window.picture(), window.state("camera")
        act()
        window.wait_for_generation(before["generation"])
        window.finished()
        expect(window.picture() != picture, f"{name} changes the picture")
        expect(window.state("camera") != camera, "and the camera")


def check_reset(window):
    start = window.state("camera")
    for what, reset in (("the key 0", lambda: window.press("0")),
                        ("the key 0, while a move waits to be sent,", window.wheel_and_reset)):
        before = window.seen()
        window.drag((0.2, 0.5), (0.5, 0.5))
        window.wait_for_generation(before["generation"])
        window.finished()
        turned = window.state("camera")
        expect(turned["from"] != start["from"] and turned["look_at"] == start["look_at"], "a drag turns around the target")
        before = window.seen()
        reset()
        window.wait_for_generation(before["generation"])
        window.drawn()
        window.finished()
        wait_for(lambda: window.state("camera") == start, f"{what} brings the camera of the start back")
        window.finished()
        expect(window.state("camera") == start, "and it stays there")


def check_look(window):
    window.finished()
    before, picture = window.seen(), window.picture()
    window.set("exposure", -3)
    darker = window.picture()
    expect(darker != picture, "the exposure changes the picture")
    window.set("curve", "agx", "change")
    other = window.picture()
    expect(other not in (darker, picture), "so does the tone curve")
    window.wait("window.bdptView.state.curve === 'agx' && window.bdptView.state.exposure === -3")
    window.run("document.getElementById('exposure-auto').click();")
    window.set("curve", "filmic", "change")
    window.wait("window.bdptView.state.curve === 'filmic' && window.bdptView.state.exposure_is_auto")
    expect(window.picture() == picture, "automatic exposure and the first curve bring it back")
    after = window.seen()
    expect(all(after[key] == before[key] for key in ("generation", "updates")), "without a new render, and without new pixels")


def check_view(window):
    """Tests controls of lens, background and ground, and the reset of the lens."""
    window.finished()
    start = window.codes()
    for name, value, event, key in (("fov", 30, "input", "fov"), ("aperture", 20, "input", "f_stop"), ("background", "#ffffff", "change", None),
                                    ("ground", "shadow", "change", None)):
        before, picture = window.seen(), window.codes()
        window.set(name, value, event)
        window.wait_for_generation(before["generation"])
        window.finished()
        expect(window.codes() != picture, f"{name} changes the picture")
        if key:
            expect(window.state("camera")[key], f"and the camera has {window.state('camera')[key]}")
    camera, before = window.state("camera"), window.seen()
    window.click(0.5, 0.6, shift=True)
    window.wait_for_generation(before["generation"])
    window.finished()
    expect("--focus-distance" in window.state("command") and window.state("camera") == camera, "Shift + click focuses without turning")
    window.set("background", "color", "change")
    window.wait("!document.getElementById('background-color').hidden && window.bdptView.state.background.startsWith('#')")
    window.set("background", "", "change")
    window.set("ground", "", "change")
    before = window.seen()
    window.press("0")
    window.wait_for_generation(before["generation"])
    window.wait("window.bdptView.state.camera.f_stop === null && !window.bdptView.state.ground && !window.bdptView.state.background")
    window.finished()
    expect(window.codes() == start, "environment, no ground and reset bring the first picture back")


def check_drop(window):
    """Tests that a file that is dropped on the page lights the scene."""
    drop = """
        const files = new DataTransfer();
        files.items.add(new File([new Uint8Array(arguments[1])], arguments[0]));
        document.querySelector('.stage').dispatchEvent(new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true }));"""
    sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + bytes([200, 100, 50, 130] * 8)
    window.finished()
    before, picture = window.seen(), window.codes()
    window.run(drop, "green sky.hdr", list(sky))
    window.wait_for_generation(before["generation"])
    window.wait("document.getElementById('environment').value === 'green sky.hdr'")
    window.finished()
    expect(window.codes() != picture, "a file that is dropped lights the scene")
    picture = window.codes()
    window.run(drop, "broken.hdr", list(sky[:40]))
    window.wait("document.getElementById('message').textContent.includes('broken.hdr')")
    window.finished()
    expect(window.codes() == picture, "a broken one is told, and the picture comes back")
    window.messages()
    before = window.seen()
    window.set("environment", "studio", "change")
    window.wait_for_generation(before["generation"])
    window.finished()


def check_fullscreen(window):
    window.press("m")
    window.wait("document.fullscreenElement !== null")
    window.drawn()
    left, top, width, height = window.box()
    size = window.run("return [innerWidth, innerHeight];")
    expect(left >= -1 and top >= -1 and width <= size[0] + 1 and height <= size[1] + 1 and (width > size[0] - 2 or height > size[1] - 2),
           f"M fills the screen {size} with the whole picture {[round(x) for x in (left, top, width, height)]}")
    window.press("m")
    window.wait("document.fullscreenElement === null")


def check_file_choices(window, bdpt, folder):
    """Tests the controls of the file's variants, animations and cameras."""
    scene = folder / "choices.gltf"
    write_choices(scene)
    with Server(bdpt, scene, "--size", "48x36", "--spp", "2", "--env", "studio") as server:
        window.show(server)
        window.finished()
        shown = window.run("return ['camera', 'variant', 'animation', 'time'].map((id) => !document.getElementById(id).closest('label').hidden);")
        expect(shown == [True, True, False, True], f"the page has controls for what the file has {shown}")
        for name, value, event in (("variant", "red", "change"), ("time", 1.5, "input"), ("camera", "auto", "change")):
            before, picture = window.seen(), window.codes()
            window.set(name, value, event)
            window.wait_for_generation(before["generation"])
            window.finished()
            expect(window.codes() != picture, f"{name} changes the picture")
        command = window.state("command")
        expect(all(word in command for word in ("--variant=red", "--frame-time=1.5", "--camera=auto")), f"and the command {command[-150:]}")


def write_choices(file):
    """Writes a triangle that slides to the right for two seconds, with a variant and a camera."""
    import base64
    import struct
    values = [0, 2, 0, 0, 0, 1, 0, 0, -1, -1, 0, 1, -1, 0, 0, 1, 0]
    data = base64.b64encode(struct.pack(f"<{len(values)}f", *values)).decode()
    floats = {"bufferView": 0, "componentType": 5126}
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5], "name": "near"}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "material": 0,
                                    "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}}}]}],
        "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": color}} for color in ([1, 1, 1, 1], [1, 0, 0, 1])],
        "extensionsUsed": ["KHR_materials_variants"], "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}]}},
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 0, "output": 1}]}],
        "accessors": [{**floats, "count": 2, "type": "SCALAR", "min": [0], "max": [2]}, {**floats, "byteOffset": 8, "count": 2, "type": "VEC3"},
                      {**floats, "byteOffset": 32, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 4 * len(values)}],
        "buffers": [{"byteLength": 4 * len(values), "uri": "data:application/octet-stream;base64," + data}]}), encoding="utf-8")


def check_denoising(window, bdpt, scene):
    """Tests the denoised preview with Open Image Denoise, where it is there."""
    library = os.environ.get("BDPT_TEST_DENOISER")
    if not library:
        expect(window.run("return document.getElementById('denoise').disabled;"), "without Open Image Denoise the page denoises nothing")
        return
    with Server(bdpt, scene, *OPTIONS, "--denoiser-library", library) as server:
        window.show(server)
        window.finished()
        expect(window.seen()["denoised"][0] and window.text("denoised") == "denoised preview", "the picture is denoised, and marked")
        clean = window.codes()
        window.press("d")
        window.wait("!window.bdptView.seen.denoised[0]")
        expect(window.text("denoised") == "" and window.codes() != clean, "D shows it as it is")
        window.press("d")
        window.wait("window.bdptView.seen.denoised[0]")
        expect(window.codes() == clean, "and again denoised")


def check_light(window):
    for name, value, event in (("environment", "studio", "change"), ("rotation", 90, "input"), ("intensity", 1, "input")):
        before, picture = window.seen(), window.codes()
        window.set(name, value, event)
        window.wait_for_generation(before["generation"])
        window.finished()
        expect(window.codes() != picture, f"{name} changes the picture")
    expect(window.state("environment") == "studio" and window.state("rotation") == 90 and window.state("intensity") == 2,
           "the server has what was chosen")


def read_command_words(window, bdpt):
    """Returns the words of the command for what is seen, with the program under test."""
    window.press("v")
    words = shlex.split(window.run("return window.bdptView.state.command;"))
    expect(words[:2] == ["bdpt", "render"], f"the page shows a command: {' '.join(words)[:150]}")
    return [bdpt, *words[1:]]


def check_equality(window, bdpt, folder):
    """Tests that saved files equal the command's output, and that the canvas equals its picture. Returns the job and
    the picture."""
    window.finished()
    window.downloads_to(folder)
    window.press("e")
    saved = wait_for(lambda: next((f for f in folder.glob("*.exr") if f.stat().st_size), None), "the key E saves an EXR")
    shown = window.codes()
    window.press("j")
    job = wait_for(lambda: next((f for f in folder.glob("*.json") if f.stat().st_size), None), "the key J saves a job")
    words = read_command_words(window, bdpt)
    rendered, by_job = folder / "command" / "rendered.exr", folder / "command" / "job.exr"
    rendered.parent.mkdir()
    subprocess.run([*remove_outputs(words), "-o", str(rendered), "--quiet"], check=True, cwd=folder)
    subprocess.run([bdpt, "render", str(job), "-o", str(by_job), "--quiet"], check=True, cwd=folder)
    files = [ExrFile(file) for file in (saved, rendered, by_job)]
    values = [{name: [bytes(memoryview(row)) for row in rows] for name, rows in one.values.items()} for one in files]
    expect(set(values[0]) >= {"R", "G", "B"} and values[0] == values[1], "the saved EXR is what the copied command writes, to the bit")
    expect(values[0] == values[2], "and what the saved job writes")
    for curve in CURVES:
        window.set("curve", curve, "change")
        window.wait(f"window.bdptView.state.curve === '{curve}' && document.getElementById('command').value.includes('{curve}')"
                    if curve != "filmic" else "window.bdptView.state.curve === 'filmic'")
        picture = folder / "command" / f"{curve}.png"
        subprocess.run([*remove_outputs(read_command_words(window, bdpt)), "-o", str(picture), "--quiet"], check=True, cwd=folder)
        wanted, there = read_codes(window, picture), window.codes()
        worst = max(abs(a - b) for a, b in zip(wanted, there))
        expect(len(wanted) == len(there) and worst <= 1, f"{curve}: the page shows the command's PNG (differs by {worst} of 255)")
        expect(len(set(wanted)) > 20, "which is no empty picture")
    window.press("s")
    png = wait_for(lambda: next((f for f in folder.glob("*.png") if f.stat().st_size), None), "the key S saves a PNG")
    expect(read_codes(window, png) == read_codes(window, picture), "the saved PNG is the command's")
    window.set("curve", "filmic", "change")
    return job, shown


def remove_outputs(words):
    """Returns a command without its -o FILE."""
    result, rest = [], list(words)
    while rest:
        word = rest.pop(0)
        if word in ("-o", "--output"):
            rest.pop(0)
        else:
            result.append(word)
    return result


def premultiplied(codes):
    """Returns RGBA bytes with colours times alpha. A canvas holds them like this, so its colours of pixels that are
    hardly covered are read inexactly."""
    return [codes[i] if i % 4 == 3 else round(codes[i] * codes[i - i % 4 + 3] / 255) for i in range(len(codes))]


def read_codes(window, file, channels=3):
    """Returns the bytes of a PNG file's first channels of RGBA, as the browser decodes it."""
    import base64
    url = "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode()
    return window.call("POST", "/execute/async", {"script": """
        const [url, channels, done] = arguments;
        const image = new Image();
        image.onload = () => {
          const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
          const context = canvas.getContext("2d");
          context.drawImage(image, 0, 0);
          done([...context.getImageData(0, 0, image.width, image.height).data].filter((_, i) => i % 4 < channels));
        };
        image.onerror = () => done([]);
        image.src = url;""", "args": [url, channels]})


def check_inspecting(window):
    window.click(0.5, 0.6)
    window.wait("!document.getElementById('inspector').hidden")
    found = window.run("""
        return { caption: document.querySelector('#inspector h2').textContent,
          vertices: document.querySelectorAll('#inspector table')[1].querySelectorAll('tbody tr').length,
          strategies: document.querySelectorAll('#inspector table')[0].querySelectorAll('tbody tr').length,
          circles: document.querySelectorAll('#overlay circle.path-camera').length,
          mark: document.querySelector('#overlay .pixel-mark').getBoundingClientRect().toJSON(),
          first: document.querySelector('#overlay circle.path-camera').getBoundingClientRect().toJSON() };""")
    expect(found["caption"].startswith("Pixel 48, 43"), f"a click inspects its pixel: {found['caption']}")
    expect(found["vertices"] >= 2 and found["strategies"] >= 1, f"with its vertices and strategies {found}")
    expect(found["circles"] >= 1, "its path is drawn")
    mark, first = found["mark"], found["first"]
    expect(abs(mark["x"] + mark["width"] / 2 - first["x"] - first["width"] / 2) < 12
           and abs(mark["y"] + mark["height"] / 2 - first["y"] - first["height"] / 2) < 12, "from the pixel that was clicked")
    window.press("n")
    window.wait("document.querySelector('#inspector h2').textContent.endsWith('sample 1')")
    window.press("\ue00c")
    expect(window.text("inspector") == "" and window.run("return document.querySelectorAll('#overlay *').length") == 0, "Escape closes it")


def check_pair(window):
    before = window.seen()
    window.set("integrator-b", "mis", "change")
    window.wait("window.bdptView.state.slots.length === 2 && !window.bdptView.stage.slots[1].empty")
    window.finished()
    expect(window.codes(0) != window.codes(1), "two integrators are side by side")
    middle = window.picture()
    window.run("document.getElementById('wiper').focus();")
    for _ in range(5):
        window.press("\ue014")
    expect(window.picture() != middle, "the wiper moves by keys")
    box = window.run("const box = document.getElementById('wiper').getBoundingClientRect(); return [box.left + box.width / 2, box.top + 20];")
    left = window.place(0.2, 0.1)
    window.pointer([window.move(box), {"type": "pointerDown", "button": 0}, window.move((left[0], box[1]), 20), {"type": "pointerUp", "button": 0}])
    expect(abs(window.run("return window.bdptView.stage.wiper;") - 0.2) < 0.02, "and by the mouse")
    expect(window.state("camera") is not None and window.seen()["sequence"] >= before["sequence"], "the camera stays")
    window.set("integrator-b", "", "change")
    window.wait("window.bdptView.state.slots.length === 1")


def check_layers(window):
    window.finished()
    picture = window.codes()
    layers = window.state("layers")
    expect("noise" in layers and "strategy" in layers, f"there are layers {layers}")
    for number, layer in enumerate(layers, 1):
        if layer == "picture":
            continue
        before = window.seen()
        window.press(str(number))
        window.wait(f"window.bdptView.state.layer === '{layer}' && window.bdptView.seen.updates > {before['updates']}")
        if layer == "strategy":
            window.wait("window.bdptView.state.strategies.length > 1")
        window.wait(f"window.bdptView.seen.grid === window.bdptView.state.size[0]")
        expect(window.codes() != picture, f"{layer} looks otherwise")
        bars = window.run("return document.querySelectorAll('#legend .colorbar').length")
        expect(bars == (1 if layer in ("noise", "rates") else 0), "with its scale")
    before = window.seen()
    window.press("1")
    window.wait(f"window.bdptView.state.layer === 'picture' && window.bdptView.seen.updates > {before['updates']}")
    window.finished()
    expect(window.codes() == picture, "the picture comes back")


def check_pause(window):
    window.press(" ")
    window.wait("window.bdptView.state.paused")
    before = window.seen()
    window.press("\ue012")
    window.wait_for_generation(before["generation"])
    window.press(" ")
    window.wait("!window.bdptView.state.paused")
    window.finished()
    expect(True, "space pauses and continues")


def check_keys(window):
    window.press("?")
    expect(window.run("return document.getElementById('keys').open && document.querySelectorAll('#keys kbd').length > 10;"), "? lists the keys")
    window.press("\ue00c")
    window.wait("!document.getElementById('keys').open")


def check_access(window):
    unnamed = window.run("""
        const named = (one) => one.getAttribute('aria-label') || one.textContent.trim() || one.labels?.length;
        return [...document.querySelectorAll('button, select, input, textarea, canvas[role], table, [role=slider]')]
          .filter((one) => !named(one)).map((one) => one.outerHTML.slice(0, 80));""")
    expect(unnamed == [], f"all controls have a name {unnamed}")
    colors = []
    for scheme in ("light", "dark"):
        window.call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": {
            "features": [{"name": "prefers-color-scheme", "value": scheme}]}})
        colors.append(window.run("return getComputedStyle(document.body).backgroundColor;"))
    expect(colors[0] != colors[1], "light and dark differ, as the system says")


def check_file(window, scene):
    """Tests that the scene is reloaded when it changes; a broken file keeps the picture."""
    window.finished()
    text = scene.read_text(encoding="utf-8")
    before, picture = window.seen(), window.codes()
    model = json.loads(text)
    for material in model["materials"]:
        color = material.setdefault("pbrMetallicRoughness", {}).setdefault("baseColorFactor", [1, 1, 1, 1])
        color[:3] = [0.2 * color[0], 0.9 * color[1], 0.2 * color[2]]
    scene.write_text(json.dumps(model), encoding="utf-8")
    window.wait_for_generation(before["generation"])
    window.finished()
    changed = window.codes()
    expect(changed != picture, "a change of the file is seen")
    scene.write_text(json.dumps(model)[:500], encoding="utf-8")
    window.wait(f"document.getElementById('message').textContent.includes('{scene.name}')")
    message = window.text("message")
    expect(message and "\n" not in message.strip(), f"a broken file is told in one line: {message}")
    expect(window.codes() == changed, "and the picture stays")
    before = window.seen()
    scene.write_text(text, encoding="utf-8")
    window.wait_for_generation(before["generation"])
    window.finished()
    expect(scene.name not in window.text("message"), "the message goes when the file is whole again")
    expect(window.codes() == picture, "and the first picture is back, to the bit")


def check_two_tabs(window, server):
    first = window.tab()
    second = window.new_tab()
    window.show(server)
    window.finished()
    expect(window.state("camera") is not None, "a second tab shows the picture")
    camera = window.state("camera")
    window.drag((0.4, 0.5), (0.6, 0.5))
    wait_for(lambda: window.state("camera") != camera, "a drag in the second tab turns the camera")
    turned = window.state("camera")
    window.drag((0.4, 0.5), (0.5, 0.5))
    window.close_tab()  # closes the tab during a render
    window.go_to(first)
    window.finished()
    expect(window.state("camera") not in (camera, None) and turned != camera, "what one tab turns, the other sees")
    before = window.seen()
    window.drag((0.5, 0.5), (0.4, 0.5))
    window.wait_for_generation(before["generation"])
    window.finished()
    expect(server.alive and second != first, "a tab that is closed in the middle disturbs nobody")


def check_connection(window, server):
    window.messages()
    window.run("window.bdptView.connection.socket.close();")
    window.wait("document.documentElement.dataset.connection === 'lost'")
    window.wait("document.documentElement.dataset.connection === 'open'")
    expect(window.text("gone") == "", "a connection that is lost is made again")
    before = window.seen()
    window.drag((0.4, 0.5), (0.5, 0.5))
    window.wait_for_generation(before["generation"])
    picture = window.codes()
    server.kill()
    window.wait("document.documentElement.dataset.connection === 'lost'")
    expect("Connection lost" in window.text("gone"), f"a server that was killed is told: {window.text('gone')}")
    expect(len(set(window.codes())) > 20 and len(picture) > 0, "and the last picture stays")


def check_job(window, bdpt, job, picture):
    """Tests that a saved job resumes with the same view, light and samples."""
    with Server(bdpt, job) as server:
        window.show(server)
        window.finished()
        expect(window.state("slots")[0]["samples"] == SAMPLES, "bdpt view JOB has the samples of the job")
        expect(window.codes() == picture, "and shows what was saved")
    with Server(bdpt, job, "--spp", "2") as server:
        window.show(server)
        window.finished()
        expect(window.state("slots")[0]["samples"] == 2, "the command line overrides the job")


def check_rates(window, bdpt, scene):
    """Tests that adaptive sampling adds a layer."""
    with Server(bdpt, scene, "--size", "32x24", "--spp", "32", "--integrator", "mis", "--adaptive") as server:
        window.show(server)
        window.finished()
        expect("rates" in window.state("layers"), "with --adaptive there are rates")
        check_layers(window)


def check_background(window, bdpt, scene):
    """Tests that the picture over a background equals the command's PNG, including the shadow on the ground."""
    picture = scene.parent / "over.png"
    for background in ("#3060a0", "transparent"):
        words = ("--size", "48x36", "--spp", "4", "--integrator", "mis", "--background", background, "--ground", "shadow", "--margin", "0.2")
        subprocess.run([bdpt, "render", str(scene), "-o", str(picture), "--quiet", *words], check=True)
        with Server(bdpt, scene, *words) as server:
            window.show(server)
            window.finished()
            wanted = premultiplied(read_codes(window, picture, channels=4))
            shown = premultiplied(window.codes(channels=4))
            worst = max(abs(a - b) for a, b in zip(wanted, shown))
            expect(len(wanted) == len(shown) and worst <= 1 and len(set(wanted)) > 20,
                   f"over {background} the page shows the command's PNG (differs by {worst} of 255)")


def check_memory(window, bdpt, scene):
    """Tests that the page reports insufficient memory and keeps the picture."""
    text = scene.read_text(encoding="utf-8")
    with Server(bdpt, scene, "--size", "32x24", "--spp", "1", "--max-memory", "64M") as server:
        window.show(server)
        window.finished()
        picture = window.codes()
        model = json.loads(text)
        zeros = 512 << 20
        model["buffers"].append({"byteLength": zeros, "uri": "large.bin"})
        with open(scene.parent / "large.bin", "wb") as file:
            file.truncate(zeros)
        scene.write_text(json.dumps(model), encoding="utf-8")
        window.wait("document.getElementById('message').textContent.includes('memory')")
        message = window.text("message")
        expect("--max-memory" in message and "\n" not in message.strip(), f"a scene that does not fit is told in one line: {message}")
        expect(window.codes() == picture and server.alive, "and the picture stays")
    scene.write_text(text, encoding="utf-8")


def main():
    lacking = missing()
    if lacking:
        print(f"skipped: {lacking} is not installed (Debian: chromium, chromium-driver)")
        sys.exit(SKIPPED)
    bdpt, original = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = folder / "room.gltf"
        shutil.copy(original, scene)
        for other in pathlib.Path(original).parent.glob("*.bin"):
            shutil.copy(other, folder)
        with Server(bdpt, scene, *OPTIONS, folder=folder) as server, Window(1280, 900) as window:
            check_loading(window, server)
            check_reset(window)
            check_look(window)
            check_view(window)
            check_inspecting(window)
            job, picture = check_equality(window, bdpt, folder)
            check_camera(window)
            check_light(window)
            check_drop(window)
            check_fullscreen(window)
            check_pair(window)
            check_layers(window)
            check_pause(window)
            check_keys(window)
            check_access(window)
            check_file(window, scene)
            check_two_tabs(window, server)
            messages = window.messages()
            expect(messages == [], f"the console is still empty {messages}")
            check_connection(window, server)
            check_job(window, bdpt, job, picture)
            check_rates(window, bdpt, scene)
            check_background(window, bdpt, scene)
            check_file_choices(window, bdpt, folder)
            check_denoising(window, bdpt, scene)
            check_memory(window, bdpt, scene)


if __name__ == "__main__":
    main()
