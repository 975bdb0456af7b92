"""Tests renders from Python: equal bits with the command, adding parts, progress and interrupts."""

import base64
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import threading

import bdpt
import numpy as np
import pytest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
SMALL = {"size": (24, 16), "integrator": "bdpt"}


def test_an_image_is_an_array_of_floats(cornell_box):
    render = bdpt.render(cornell_box, spp=2, **SMALL)
    assert render.image.shape == (16, 24, 3) and render.image.dtype == np.float32
    assert render.image.mean() > 0.01 and render.spp == 2 and render.samples == "0:2"
    assert not render.image.flags.owndata  # refers to the renderer's own memory


@pytest.mark.parametrize("options, words", [
    ({"spp": 4}, ["--spp", "4"]),
    ({"spp": 2, "integrator": "mis", "seed": 7, "max_depth": 3},
     ["--spp", "2", "--integrator", "mis", "--seed", "7", "--max-depth", "3"]),
    ({"spp": 2, "crop": (2, 3, 20, 12), "aov": ["albedo", "depth"]},
     ["--spp", "2", "--crop", "2,3,20,12", "--aov", "albedo,depth"]),
])
def test_images_are_those_of_the_command_to_the_bit(command, cornell_box, tmp_path, options, words):
    parts = {name: tmp_path / f"{name}.part.exr" for name in ("ours", "its")}
    bdpt.render(cornell_box, size=(24, 16), **options).save(parts["ours"])
    command("render", SCENES / "cornell-box.gltf", "--size", "24x16", *words, "--part", parts["its"], "--quiet")
    ours, its = (bdpt.read_part(part) for part in parts.values())
    assert np.array_equal(ours.image, its.image) and ours.image.any()
    assert all(np.array_equal(ours.layers[name], its.layers[name]) for name in its.layers)
    ours_twice = bdpt.read_part(parts["ours"])
    with pytest.raises(bdpt.Error, match="sample"):
        ours_twice += its  # adding the same render fails, because it has these samples already


def test_a_scene_without_a_camera_is_framed_as_by_the_command(command, tmp_path):
    file = SCENES / "cornell-box.gltf"
    scene = bdpt.load(file, camera="auto", env="default")
    part, its = tmp_path / "a.part.exr", tmp_path / "b.part.exr"
    bdpt.render(scene, spp=1, size=(30, 10)).save(part)
    command("render", file, "--camera", "auto", "--env", "default", "--spp", "1", "--size", "30x10", "--part", its, "-q")
    assert np.array_equal(bdpt.read_part(part).image, bdpt.read_part(its).image)


def test_the_size_of_one_render_is_not_that_of_the_next(cornell_box):
    bdpt.render(cornell_box, spp=1, size=(4, 4))
    assert cornell_box.size == (720, 720)


@pytest.mark.parametrize("loaded, own, words", [
    ({}, {"view": "back"}, ["--view", "back"]),
    ({}, {"view": (170, 15), "margin": 5, "focal_length": 85}, ["--view", "170,15", "--margin", "5", "--focal-length", "85"]),
    ({"view": "back"}, {"from_": (0.3, 0.3, -0.6), "look_at": (0.3, 0.2, 0)}, ["--from", "0.3,0.3,-0.6", "--look-at", "0.3,0.2,0"]),
    ({"from_": (0.3, 0.3, -0.6)}, {"view": "back", "ortho": True}, ["--view", "back", "--ortho"]),
    ({"fov": 20}, {"focal_length": 24}, ["--focal-length", "24"]),
    ({"camera": "auto"}, {"camera": "camera", "fov": 30}, ["--camera", "camera", "--fov", "30"]),
    ({"fov": 20}, {"lens_radius": 0.01}, ["--fov", "20", "--lens-radius", "0.01"]),
])
def test_a_render_has_a_view_of_its_own(command, tmp_path, loaded, own, words):
    file = SCENES / "cornell-box.gltf"
    scene = bdpt.load(file, **loaded)
    before = bdpt.render(scene, spp=1, **SMALL).image.copy()
    ours, its = tmp_path / "a.part.exr", tmp_path / "b.part.exr"
    render = bdpt.render(scene, spp=1, **SMALL, **own)
    render.save(ours)
    command("render", file, "--size", "24x16", "--integrator", "bdpt", "--spp", "1", *words, "--part", its, "-q")
    assert np.array_equal(bdpt.read_part(ours).image, bdpt.read_part(its).image)
    assert render.image.any() and not np.array_equal(render.image, before)
    assert np.array_equal(bdpt.render(scene, spp=1, **SMALL).image, before)  # the scene's own view stays
    render += bdpt.render(scene, samples="1:2", **SMALL, **own)
    with pytest.raises(bdpt.Error):
        render += bdpt.render(scene, samples="2:3", **SMALL)  # has another view


def test_the_size_of_a_view_is_that_of_the_command(command, tmp_path):
    """Tests that, without size, the chosen camera determines it."""
    file, its = SCENES / "cornell-box.gltf", tmp_path / "its.part.exr"
    command("render", file, "--view", "front", "--spp", "1", "--integrator", "pt", "--max-depth", "1", "--part", its, "-q")
    ours = bdpt.render(bdpt.load(file), view="front", spp=1, integrator="pt", max_depth=1)
    assert ours.image.shape == bdpt.read_part(its).image.shape


@pytest.mark.parametrize("options, word", [
    ({"view": "sideways"}, "view"), ({"camera": "main"}, "main"), ({"view": "front", "from_": (1, 2, 3)}, "combined"),
    ({"orbit": 4}, "frames=1"), ({"orbit": 4, "frames": 5}, "views from 1 to 4"), ({"orbit": 0, "frames": 1}, "orbit"),
    ({"frames": 1}, "orbit"), ({"turn": "object"}, "orbit")])
def test_wrong_views_are_errors(cornell_box, options, word):
    with pytest.raises(bdpt.Error, match=word):
        bdpt.render(cornell_box, spp=1, **SMALL, **options)


def test_scenes_of_arrays_have_other_views():
    floor = bdpt.Mesh(np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32), np.array([[0, 2, 1], [0, 3, 2]]))
    camera = bdpt.Camera(from_=(0, 2, 3), look_at=(0, 0, 0), fov=40)
    scene = bdpt.Scene([floor], [bdpt.PointLight(position=(0, 2, 0), intensity=(10, 10, 10))], camera, size=(24, 16))
    own, moved = bdpt.render(scene, spp=1), bdpt.render(scene, spp=1, from_=(0, 3, 1))
    assert moved.image.shape == own.image.shape and not np.array_equal(moved.image, own.image)
    again = bdpt.render(scene, spp=1, from_=(0, 2, 3), look_at=(0, 0, 0))
    assert np.array_equal(again.image, own.image)
    with pytest.raises(bdpt.Error, match="scene of arrays.*main"):
        bdpt.render(scene, spp=1, camera="main")


@pytest.mark.parametrize("load, own, words", [
    ({}, {}, []), ({"camera": "auto", "env": "studio"}, {"turn": "object"}, ["--camera", "auto", "--env", "studio", "--turn", "object"]),
    ({}, {"view": "back", "same_noise": True}, ["--view", "back", "--same-noise"])])
def test_a_turntable_is_that_of_the_command(command, tmp_path, load, own, words):
    file = SCENES / "cornell-spheres.gltf"
    command("render", file, "--orbit", "3", "--size", "24x16", "--integrator", "bdpt", "--spp", "1", *words, "--part",
            tmp_path / "#.part.exr", "-o", tmp_path / "#.png", "-q")
    renders = list(bdpt.orbit(bdpt.load(file, **load), 3, spp=1, **SMALL, **own))
    assert len(renders) == 3
    for number, render in enumerate(renders, 1):
        its = bdpt.read_part(tmp_path / f"{number}.part.exr")
        assert np.array_equal(render.image, its.image), number
        render.save(tmp_path / "ours.png", exposure="light")
        assert read_png_pixels(tmp_path / "ours.png") == read_png_pixels(tmp_path / f"{number}.png")
    assert not np.array_equal(renders[0].image, renders[1].image)


def read_png_pixels(file):
    """Returns the bytes of its IDAT chunks: all but metadata."""
    data, at, pixels = pathlib.Path(file).read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        pixels += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    return pixels


def test_a_renderer_has_a_view_of_its_own_too(cornell_box):
    renderer = bdpt.Renderer(cornell_box, spp=2, view="back", **SMALL)
    renderer.finish()
    assert renderer.image.any() and np.array_equal(renderer.image, bdpt.render(cornell_box, spp=2, view="back", **SMALL).image)
    turned = bdpt.Renderer(bdpt.load(SCENES / "cornell-spheres.gltf", env="studio"), spp=2, orbit=3, frames=2, turn="object", **SMALL)
    turned.finish()
    assert turned.image.mean() > 0


@pytest.mark.parametrize("size", ["6x4", (6, 4), [6, 4], np.array([6, 4]), (np.int64(6), np.uint8(4)), range(6, 2, -2)])
def test_values_are_texts_or_numbers_or_anything_that_has_them(cornell_box, size):
    assert bdpt.render(cornell_box, size=size, spp=np.int64(1), clamp=np.float32(0.5)).image.shape == (4, 6, 3)


def test_paths_may_be_objects(tmp_path, cornell_box):
    bdpt.render(cornell_box, spp=1, size=(8, 4)).save(tmp_path / "a.exr")
    assert bdpt.load(SCENES / "cornell-box.gltf", env=tmp_path / "a.exr").lights == cornell_box.lights + 1


def test_parts_add_up_to_the_whole(cornell_box):
    whole = bdpt.render(cornell_box, spp=4, **SMALL)
    parts = bdpt.render(cornell_box, samples="3:4", spp=4, **SMALL)
    parts += bdpt.render(cornell_box, samples="0:3", spp=4, **SMALL)
    assert np.array_equal(parts.image, whole.image) and parts.samples == "0:4"


def test_parts_of_other_renders_are_refused(cornell_box):
    render = bdpt.render(cornell_box, samples="0:2", **SMALL)
    with pytest.raises(bdpt.Error, match="seed") as raised:
        render += bdpt.render(cornell_box, samples="2:4", seed=3, **SMALL)
    assert raised.value.code == 4


def test_progress_is_told_and_may_end_the_render(cornell_box):
    told = []
    bdpt.render(cornell_box, spp=8, progress=lambda done, total, seconds: told.append((done, total)), **SMALL)
    assert told[-1] == (8, 8) and told == sorted(told)

    def enough(done, total, seconds):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        bdpt.render(cornell_box, spp=8, progress=enough, **SMALL)


def test_other_threads_run_while_it_renders(cornell_box):
    """Renders one pass, so that only the render itself can release the lock."""
    done, counts = threading.Event(), [0]

    def count():
        while not done.is_set():
            counts[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    before = counts[0]
    bdpt.render(cornell_box, spp=1, size=(256, 256))
    after = counts[0]
    done.set()
    counter.join()
    assert after - before > 1000


def test_threads_render_views_of_one_scene():
    """Each call sees its own camera, size and turn alone, in its pilot too."""
    scene = bdpt.load(SCENES / "instances.gltf", env="studio")
    views = [{"orbit": 4, "turn": turn, "frames": view, "size": (160 + 16 * view, 128)}
             for turn in ("object", "camera") for view in (2, 3, 4)]
    render = lambda view: bdpt.render(scene, spp=4, **view).image.copy()
    alone = [render(view) for view in views]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        images = list(pool.map(render, views))
    assert [np.array_equal(image, expected) for image, expected in zip(images, alone)] == 6 * [True]
    assert len({image.tobytes() for image in alone}) == 6


def test_control_c_ends_a_render():
    script = ("import bdpt, os, signal, threading\n"
              f"scene = bdpt.load({str(SCENES / 'cornell-box.gltf')!r})\n"
              "told = lambda done, total, seconds: os.kill(os.getpid(), signal.SIGINT)\n"
              "try:\n"
              "    bdpt.render(scene, spp=1000000, size=(64, 64), progress=told)\n"
              "except KeyboardInterrupt:\n"
              "    print('stopped')\n")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert done.stdout == "stopped\n", done.stderr


@pytest.mark.parametrize("progress", ["told", "lambda *numbers: (told(), time.sleep(0.01))", "None"])
def test_a_daemon_thread_does_not_disturb_the_end_of_python(progress):
    """Tests that Python can end while the thread renders without its lock, and while the thread is in a callback."""
    script = ("import bdpt, threading, time\n"
              f"scene = bdpt.load({str(SCENES / 'cornell-box.gltf')!r})\n"
              "renders = threading.Event()\n"
              "told = lambda *numbers: renders.set()\n"
              f"options = dict(spp=1000000, size=(16, 16), progress={progress})\n"
              "threading.Thread(target=lambda: bdpt.render(scene, **options), daemon=True).start()\n"
              "renders.wait(timeout=0.5)\n")
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("call, code, words", [
    (lambda scene: bdpt.load("absent.glb"), 3, "absent.glb"),
    (lambda scene: bdpt.load("absent.glb", spp=3), 2, "render"),
    (lambda scene: bdpt.render(scene, env="none"), 2, "load"),
    (lambda scene: bdpt.render(scene, intregator="mis"), 2, "did you mean 'integrator'"),
    (lambda scene: bdpt.render(scene, spp=-1), 2, "-1"),
    (lambda scene: bdpt.render(scene, spp=True), 2, "^spp=True: expected"),
    (lambda scene: bdpt.render(scene, seed=False), 2, "^seed=False: expected"),
    (lambda scene: bdpt.render(scene, spp=1, aov=[]), 2, r"^aov=\[\]:"),
    (lambda scene: bdpt.render(scene, spp=1, integrator=""), 2, "^integrator='':"),
    (lambda scene: bdpt.render(scene, spp=2**32), 2, "4294967296"),
    (lambda scene: bdpt.render(scene, spp=1, size=(2**32, 1)), 2, "4294967296"),
    (lambda scene: bdpt.render(scene, spp=1, size=(2, 2)).save("out.bmp"), 2, "out.bmp"),
    (lambda scene: bdpt.render(scene, spp=1, size=(2, 2)).save("absent/out.exr"), 6, "absent"),
    (lambda scene: bdpt.read_part("absent.part.exr"), 3, "absent.part.exr"),
])
def test_bad_input_is_one_error_with_its_code(cornell_box, call, code, words):
    with pytest.raises(bdpt.Error, match=words) as raised:
        call(cornell_box)
    assert raised.value.code == code and "\n" not in str(raised.value)


def test_images_are_saved_as_the_command_saves_them(command, cornell_box, tmp_path):
    render = bdpt.render(cornell_box, spp=1, background="transparent", ground="shadow", **SMALL)
    assert render.layers["shadow"].max() > 0
    render.save(tmp_path / "ours.png", tone_map="pbr-neutral", exposure=0, png_bits=16)
    command("render", SCENES / "cornell-box.gltf", "--spp", "1", "--size", "24x16", "--integrator", "bdpt", "--background",
            "transparent", "--ground", "shadow", "--tone-map", "pbr-neutral", "--exposure", "0", "--png-bits", "16",
            "-o", tmp_path / "its.png", "-q")
    difference = subprocess.run(["idiff", "-a", "-fail", "0", tmp_path / "ours.png", tmp_path / "its.png"],
                                capture_output=True, text=True)
    assert difference.returncode == 0, difference.stdout


def test_a_photograph_lies_behind_renders(cornell_box, tmp_path):
    photo = tmp_path / "photo.png"
    look = dict(exposure=0, tone_map="none")
    bdpt.render(cornell_box, spp=1, **SMALL).save(photo, **look)
    view = dict(spp=1, from_=(0, 1, 12), look_at=(0, 1, 0), **SMALL)
    plain = bdpt.render(cornell_box, background="transparent", **view)
    expected = plain.to_srgb(background=photo, **look)
    is_open = plain.layers["alpha"][..., 0] == 0
    assert is_open.any() and not is_open.all()
    own = bdpt.render(cornell_box, spp=1, **SMALL).to_srgb(**look)
    assert (expected[is_open] == own[is_open]).all()
    assert (bdpt.render(cornell_box, background=photo, **view).to_srgb(**look) == expected).all()
    for render in bdpt.orbit(cornell_box, 2, background=photo, **view):
        assert (render.to_srgb(**look)[0, 0] == own[0, 0]).all()


def test_a_photograph_that_is_not_there_is_missed_before_the_render(cornell_box):
    for begin in (bdpt.render, bdpt.Renderer):
        with pytest.raises(bdpt.Error, match="absent.png: no such file") as raised:
            begin(cornell_box, background="absent.png", **SMALL)
        assert raised.value.code == 3


def test_an_image_is_not_saved_over_what_its_scene_is_made_of(tmp_path):
    scene = json.loads((SCENES / "cornell-box.gltf").read_text())
    data = base64.b64decode(scene["buffers"][0]["uri"].partition("base64,")[2])
    scene["buffers"][0]["uri"] = "buffer.exr"
    (tmp_path / "buffer.exr").write_bytes(data)
    (tmp_path / "scene.gltf").write_text(json.dumps(scene))
    (tmp_path / "link.part.exr").hardlink_to(tmp_path / "buffer.exr")
    render = bdpt.render(bdpt.load(tmp_path / "scene.gltf"), spp=1, **SMALL)
    for name in ("buffer.exr", "link.part.exr"):
        with pytest.raises(bdpt.Error, match="both an input and an output") as raised:
            render.save(tmp_path / name)
        assert raised.value.code == 2
    assert (tmp_path / "buffer.exr").read_bytes() == data


def test_errors_of_images():
    black, white = (np.full((4, 5, 3), value, np.float32) for value in (0, 1))
    errors = bdpt.compare(black, white, metrics=["mse", "relmse"])
    assert errors["mse"] == pytest.approx(1.0) and errors["relmse"] == pytest.approx(1.0 / 1.01)
    with pytest.raises(bdpt.Error, match="ssim"):
        bdpt.compare(black, white, metrics=["ssim"])


@pytest.mark.parametrize("image, reference, words", [
    (np.zeros((3, 5, 3)), np.zeros((4, 5, 3)), "the image: has 5 x 3 pixels, but the reference has 5 x 4"),
    (np.zeros((0, 5, 3)), np.zeros((0, 5, 3)), "the reference: has no pixels"),
    (np.zeros((4, 0, 3)), np.zeros((4, 0, 3)), "the reference: has no pixels"),
    (np.full((4, 5, 3), np.nan), np.zeros((4, 5, 3)), "the image: pixel (0, 0) has nan in channel red"),
    (np.zeros((4, 5, 3)), np.full((4, 5, 3), np.inf), "the reference: pixel (0, 0) has inf in channel red"),
    (np.full((4, 5, 3), -np.inf, np.float32), np.zeros((4, 5, 3)), "the image: pixel (0, 0) has -inf in channel red"),
])
@pytest.mark.parametrize("metric", ["mse", "flip", "flip_ldr", "relmse_scales"])
def test_images_that_cannot_be_compared_are_errors(image, reference, words, metric):
    """Tests that errors are those of the command."""
    with pytest.raises(bdpt.Error) as raised:
        bdpt.compare(image, reference, metrics=[metric])
    assert raised.value.code == 4 and str(raised.value) == words


def test_layers_of_ids_have_names(tmp_path):
    quad = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    card = bdpt.Mesh(quad, triangles, material=bdpt.Material(name="paper"), name="card")
    scene = bdpt.Scene([card], [bdpt.EnvironmentLight(np.ones((1, 1, 3), np.float32))],
                       bdpt.Camera(from_=(0, 0, 5), look_at=(0, 0, 0)), size=(8, 8))
    render = bdpt.render(scene, spp=4, aov=["object", "material", "alpha"])
    assert set(render.ids) == {"CryptoObject", "CryptoMaterial"} and render.ids["CryptoObject"].keys() == {"card"}
    for layer, name in (("CryptoObject", "card"), ("CryptoMaterial", "paper")):
        ids = render.layers[layer + "00"]
        assert ids.shape == (8, 8, 4) and ids[4, 4, 1] == 1 and ids[0, 0, 1] == 0
        assert ids[4, 4, :1].view(np.uint32) == render.ids[layer][name]
        assert np.array_equal(ids[..., 1:2], render.layers["alpha"])
    render.save(tmp_path / "a.part.exr")
    part = bdpt.read_part(tmp_path / "a.part.exr")
    assert part.ids == render.ids and np.array_equal(part.layers["CryptoObject00"], render.layers["CryptoObject00"])


def test_masks_are_integers_with_names(tmp_path):
    cards = [bdpt.Mesh(np.array([[x - 1, -1, 0], [x + 1, -1, 0], [x + 1, 1, 0], [x - 1, 1, 0]], np.float32),
                       np.array([[0, 1, 2], [0, 2, 3]], np.uint32), material=bdpt.Material(name="paper"), name="card")
             for x in (-1, 1)]
    scene = bdpt.Scene(cards, [bdpt.EnvironmentLight(np.ones((1, 1, 3), np.float32))],
                       bdpt.Camera(from_=(0, 0, 5), look_at=(0, 0, 0)), size=(9, 6))
    render = bdpt.render(scene, spp=4, aov=["object", "instance"])
    masks = render.masks
    assert set(masks) == set(masks.keys()) == {"object", "instance"} and len(masks) == 2
    assert repr(masks) == "<bdpt.Masks instance, object>"
    assert masks.names == {"object": ["", "card"], "instance": ["", "card.1", "card.2"]}
    for kind, right in (("object", 1), ("instance", 2)):
        assert masks[kind].shape == (6, 9) and masks[kind].dtype == np.uint32
        assert masks[kind][3, 3] == 1 and masks[kind][3, 5] == right and masks[kind][0, 0] == 0
    with pytest.raises(KeyError, match='material: the render has no aov="material"'):
        masks["material"]
    render.save(tmp_path / "a.part.exr")
    part = bdpt.read_part(tmp_path / "a.part.exr")
    assert np.array_equal(part.masks["instance"], masks["instance"]) and part.masks.names == masks.names


def test_a_renderer_grows_to_the_bits_of_one_render(cornell_box, tmp_path):
    options = {"size": (24, 18), "integrator": "bdpt", "spp": 12}
    renderer = bdpt.Renderer(cornell_box, **options)
    assert renderer.spp == 0 and renderer.noise == float("inf") and not renderer.image.any()
    renderer.render(4)
    noise = renderer.noise
    first = renderer.image.copy()
    assert renderer.spp == 4 and first.any()
    png = renderer._repr_png_()
    renderer.save(tmp_path / "so-far.exr")
    assert (bdpt.Renderer(cornell_box, **options).image == 0).all()
    renderer.finish()
    whole = bdpt.render(cornell_box, **options)
    assert renderer.spp == 12 and (renderer.image == whole.image).all() and renderer.noise < noise
    assert png.startswith(b"\x89PNG") and (tmp_path / "so-far.exr").stat().st_size > 0
    taken = renderer.take()
    assert (taken.image == whole.image).all() and renderer.spp == 0
    renderer += taken
    assert renderer.spp == 12
    with pytest.raises(bdpt.Error, match="samples"):
        renderer += taken


def test_a_renderer_keeps_what_it_has_when_progress_raises(cornell_box):
    renderer = bdpt.Renderer(cornell_box, size=(16, 16), integrator="mis")
    renderer.render(2)

    def stop(*_):
        raise KeyError("enough")

    with pytest.raises(KeyError):
        renderer.render(1000, progress=stop)
    assert renderer.spp >= 2


def test_pictures_in_notebooks_are_those_of_save(cornell_box, tmp_path):
    render = bdpt.render(cornell_box, spp=4, size=(20, 10), integrator="mis")
    render.save(tmp_path / "a.png")
    png = render._repr_png_()
    assert png.startswith(b"\x89PNG\r\n") and len(png) > 100
    srgb = render.to_srgb(exposure=1, tone_map="agx")
    assert srgb.dtype == np.uint8 and srgb.shape == (10, 20, 3)
    assert render.to_srgb(exposure=2).mean() > render.to_srgb(exposure=0).mean()
    assert render.to_srgb(png_bits=16).dtype == np.uint16
    assert (np.asarray(render) == render.image).all() and np.asarray(render, dtype=np.float64).dtype == np.float64


def test_adaptive_renders_have_the_bits_of_the_command(command, tmp_path):
    scene = SCENES / "cornell-box.gltf"
    command("render", scene, "-o", tmp_path / "a.exr", "--part", tmp_path / "a.part.exr", "--spp", 16, "--size", "32x32",
            "--integrator", "mis", "--adaptive", "--quiet")
    render = bdpt.render(bdpt.load(scene), spp=16, size=(32, 32), integrator="mis", adaptive=True)
    assert (render.image == bdpt.read_part(tmp_path / "a.part.exr").image).all()
    plain = bdpt.render(bdpt.load(scene), spp=16, size=(32, 32), integrator="mis")
    assert (render.image != plain.image).any()


def test_every_door_leads_to_the_default_image(command, tmp_path):
    file, options = SCENES / "alpha.gltf", {"size": (128, 128), "spp": 16}
    words = ("render", file, "--size", "128x128", "--spp", "16", "-q", "--part")
    command(*words, tmp_path / "its.part.exr")
    its = bdpt.read_part(tmp_path / "its.part.exr")
    bdpt.run(file, part=tmp_path / "job.part.exr", **options)
    scene = bdpt.load(file)
    ours = bdpt.render(scene, **options)
    renderer = bdpt.Renderer(scene, **options)
    renderer.finish()
    for image in (bdpt.read_part(tmp_path / "job.part.exr").image, ours.image, renderer.image):
        assert np.array_equal(image, its.image)
    settings = json.loads(ours.settings)
    assert settings["rates"]["greatest"] > 1 and settings["chosen_by"] == "auto"
    even = bdpt.render(scene, adaptive=False, **options)
    command(*words, tmp_path / "even.part.exr", "--adaptive=false")
    assert np.array_equal(even.image, bdpt.read_part(tmp_path / "even.part.exr").image)
    assert not np.array_equal(even.image, its.image)


def test_an_exposure_by_light_needs_a_render_that_metered_it(cornell_box, tmp_path):
    metered = bdpt.render(cornell_box, spp=1, exposure="light", **SMALL)
    metered.save(tmp_path / "a.png", exposure="light-0.5")
    with pytest.raises(bdpt.Error, match="was not metered"):
        bdpt.render(cornell_box, spp=1, **SMALL).save(tmp_path / "b.png", exposure="light")
    assert not (tmp_path / "b.png").exists()
