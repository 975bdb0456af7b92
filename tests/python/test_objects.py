"""Tests objects in place of files, pickled scenes and renders, and arrays that are not NumPy's own."""

import copy
import io
import json
import pathlib
import pickle
import shutil

import bdpt
import numpy as np
import pytest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
BOX = SCENES / "cornell-box.gltf"
SMALL = {"size": (12, 8), "spp": 2, "integrator": "bdpt"}
FLOOR = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
FACES = [[0, 2, 1], [0, 3, 2]]


class Tracked(np.ndarray):
    """Imitates the arrays of trimesh."""


def render_image(mesh):
    camera = bdpt.Camera(from_=(0, 2, 3), look_at=(0, 0, 0))
    return bdpt.render(bdpt.Scene([mesh], [bdpt.PointLight(position=(0, 2, 0), intensity=(9, 9, 9))], camera), **SMALL).image


def test_a_scene_is_loaded_from_bytes_and_from_open_files():
    image = bdpt.render(bdpt.load(BOX), **SMALL).image
    content = BOX.read_bytes()
    with BOX.open("rb") as file:
        for source in (content, bytearray(content), memoryview(content), io.BytesIO(content), file):
            assert np.array_equal(bdpt.render(bdpt.load(source), **SMALL).image, image)


def test_what_is_wrong_with_bytes_is_told_without_a_file():
    with pytest.raises(bdpt.Error, match=r"^bytes: not a glTF file but a PNG image") as raised:
        bdpt.load(b"\x89PNG\r\n\x1a\n")
    assert raised.value.code == 4
    with BOX.open(encoding="utf-8") as file, pytest.raises(TypeError, match="rb"):
        bdpt.load(file)
    with pytest.raises(TypeError):
        bdpt.load(5)
    with pytest.raises(bdpt.Error, match=r"^bytes: .*away\.bin") as raised:
        bdpt.load(b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "away.bin", "byteLength": 12}],'
                  b'"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}],'
                  b'"scenes": [{"nodes": [0]}], "bufferViews": [{"buffer": 0, "byteLength": 12}],'
                  b'"accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"}]}')


def test_a_scene_on_a_map_has_the_coordinates_of_its_file():
    content = json.loads(BOX.read_bytes())
    roots = content["scenes"][0]["nodes"]
    content["nodes"].append({"children": roots, "translation": [448000, 0, -512000]})
    content["scenes"][0]["nodes"] = [len(content["nodes"]) - 1]
    near, far = bdpt.load(BOX), bdpt.load(json.dumps(content).encode())

    def seen(scene, x, z):
        lamp = bdpt.PointLight(position=(x + 0.25, 0.25, z + 0.25), intensity=(9, 9, 9))
        return bdpt.render(scene.with_lights([lamp]), from_=(x + 0.25, 0.25, z - 0.75), look_at=(x + 0.25, 0.25, z),
                           aov="position", **SMALL)

    here, there = seen(near, 0, 0), seen(far, 448000, -512000)
    assert here.image.any() and np.isclose(here.image, there.image, rtol=1e-3).mean() > 0.9
    hit = np.isfinite(here.layers["position"]).all(axis=2) & here.layers["position"].any(axis=2)
    assert np.allclose((there.layers["position"] - [448000, 0, -512000])[hit], here.layers["position"][hit], atol=0.05)


@pytest.mark.parametrize("name", ["exr", "hdr", "png", "jpg", "webp", "part.exr"])
def test_save_writes_into_objects_what_it_writes_into_files(tmp_path, name):
    render = bdpt.render(bdpt.load(BOX), **SMALL)
    file = tmp_path / f"a.{name}"
    render.save(file)
    target = io.BytesIO()
    render.save(target, format="part" if name == "part.exr" else name)
    there, here = target.getvalue(), file.read_bytes()
    assert len(there) == len(here) > 100 and there[:4] == here[:4]  # they contain the time of their creation


def test_a_renderer_writes_into_objects():
    renderer = bdpt.Renderer(bdpt.load(BOX), **SMALL)
    renderer.finish()
    target = io.BytesIO()
    renderer.save(target, format="png", png_bits=16)
    assert target.getvalue().startswith(b"\x89PNG")


def test_formats_are_for_objects_and_objects_want_formats(tmp_path):
    render = bdpt.render(bdpt.load(BOX), **SMALL)
    for target, options, message in [(io.BytesIO(), {}, 'give format="png"'), (tmp_path / "a.png", {"format": "png"}, "name"),
                                     (io.BytesIO(), {"format": "bmp"}, "format='bmp': expected exr")]:
        with pytest.raises(bdpt.Error, match=message) as raised:
            render.save(target, **options)
        assert raised.value.code == 2
    with pytest.raises(TypeError):
        render.save(5)


def test_renders_are_pickled_with_all_their_samples():
    scene = bdpt.load(BOX)
    render = bdpt.render(scene, aov="albedo", **SMALL)
    other = pickle.loads(pickle.dumps(render))
    assert np.array_equal(other.image, render.image) and other.samples == "0:2" and other.settings == render.settings
    assert np.array_equal(other.layers["albedo"], render.layers["albedo"])
    other += bdpt.render(scene, samples="2:4", aov="albedo", size=(12, 8), integrator="bdpt")
    assert other.spp == 4 and copy.deepcopy(render).spp == 2


def test_scenes_of_files_are_pickled_and_others_say_why_not(tmp_path, monkeypatch):
    monkeypatch.chdir(SCENES)
    scene = bdpt.load("cornell-box.gltf", env="none", fov=50)
    monkeypatch.chdir(tmp_path)
    other = pickle.loads(pickle.dumps(scene))
    assert np.array_equal(bdpt.render(other, **SMALL).image, bdpt.render(scene, **SMALL).image)
    for edited in (scene.with_lights([]), bdpt.load(BOX.read_bytes()), bdpt.Scene([bdpt.Mesh(FLOOR, FACES)])):
        with pytest.raises(TypeError, match="pickle what this one is made of"):
            pickle.dumps(edited)


def test_pickles_choose_no_code(tmp_path):
    scene = bdpt.load(BOX, ktx_library=tmp_path / "evil.so")
    with pytest.raises(TypeError, match="--ktx-library=.*cannot be pickled"):
        pickle.dumps(scene)
    path, words = bdpt.load(BOX, env="none").__getstate__()
    assert words == ["--env=none"]
    for bad in (["--ktx-library=evil.so"], ["--ktx-library", "evil.so"], ["--stats=x"], ["-o", "x.exr"], ["other.gltf"]):
        with pytest.raises(bdpt.Error, match="pickled scene"):
            bdpt.Scene.__new__(bdpt.Scene).__setstate__((path, bad))


# The box is open towards -z.
@pytest.mark.parametrize("loaded, options", [
    ({}, {"from_": (0.2, 0.3, -0.7), "look_at": (0.3, 0.2, 0.3), "fov": 50}),
    ({}, {"view": "back"}),
    ({"view": "back", "env": "default"}, {"from_": (0.2, 0.3, -0.7)}),
    ({"from_": (0.2, 0.3, -0.7), "look_at": (0.3, 0.2, 0.3)}, {"view": (170, 10), "ortho": True}),
    ({"focal_length": 50}, {"fov": 20}),
    ({"lens_radius": 0.05}, {"f_stop": 2, "focus_distance": 3}),
    ({"from_": (0.2, 0.3, -0.7)}, {"fov": 60}),
])
def test_a_view_belongs_to_a_render(loaded, options):
    """Tests that the view equals that of a scene loaded with it, and that the scene stays unchanged."""
    scene = bdpt.load(BOX, **loaded)
    before = bdpt.render(scene, **SMALL).image
    seen = bdpt.render(scene, **SMALL, **options).image
    replaced = {"view": "from_", "from_": "view", "fov": "focal_length", "f_stop": "lens_radius"}
    kept = {key: value for key, value in loaded.items() if key not in {replaced.get(option) for option in options}}
    kept.pop("look_at" if "view" in options else "", None)
    expected = bdpt.render(bdpt.load(BOX, **kept, **options), **SMALL).image
    assert np.array_equal(seen, expected) and not np.array_equal(seen, before) and seen.any()
    assert np.array_equal(bdpt.render(scene, **SMALL).image, before)


def test_views_of_arrays_belong_to_renders_too():
    mesh = bdpt.Mesh(FLOOR, FACES)
    lamp = bdpt.PointLight(position=(0, 2, 0), intensity=(9, 9, 9))
    scene = bdpt.Scene([mesh], [lamp], bdpt.Camera(from_=(0, 2, 3), look_at=(0, 0, 0)))
    other = bdpt.Scene([mesh], [lamp], bdpt.Camera(from_=(1, 2, 3), look_at=(0, 0, 0)))
    moved = bdpt.render(scene, from_=(1, 2, 3), look_at=(0, 0, 0), **SMALL).image
    assert np.allclose(moved, bdpt.render(other, **SMALL).image, rtol=1e-3, atol=1e-4) and moved.any()
    with pytest.raises(bdpt.Error, match='no camera "7"'):
        bdpt.render(scene, camera=7, **SMALL)


@pytest.mark.parametrize("make", [
    lambda values: values, lambda values: tuple(map(tuple, values)), np.array, lambda values: np.array(values, np.int8),
    lambda values: np.array(values, np.int16).view(Tracked), lambda values: np.asfortranarray(np.array(values)),
])
def test_meshes_are_made_of_whatever_numpy_takes_for_an_array(make):
    expected = render_image(bdpt.Mesh(np.array(FLOOR, np.float32), np.array(FACES, np.uint32)))
    assert expected.any() and np.array_equal(render_image(bdpt.Mesh(make(FLOOR), make(FACES))), expected)


def test_other_arrays_may_be_lists_too():
    mesh = bdpt.Mesh(FLOOR, FACES, normals=[[0, 1, 0]] * 4, uvs=[[0, 0]] * 4, transforms=[np.eye(4).tolist()])
    assert render_image(mesh).any()
    render = bdpt.render(bdpt.load(BOX), **SMALL)
    assert bdpt.compare(render, render.image.tolist())["relmse"] == 0.0
    assert bdpt.EnvironmentLight([[[1, 1, 1]]])


@pytest.mark.parametrize("positions", [None, "abc", [[0, 0], [1, 1]], [[0, 0, 0], [1]], [[1j, 0, 0]], 5, [["a", "b", "c"]]])
def test_what_is_no_array_is_refused(positions):
    with pytest.raises(TypeError):
        bdpt.Mesh(positions, FACES)


def test_triangles_of_lists_are_whole_numbers():
    with pytest.raises(bdpt.Error, match="triangles: expected integers"):
        bdpt.Mesh(FLOOR, [[0.0, 1.0, 2.5]])
    with pytest.raises(bdpt.Error, match="index -1"):
        bdpt.Mesh(FLOOR, [[0, 1, -1]])


def test_a_scene_is_loaded_strictly_and_from_allowed_folders(tmp_path):
    text = (SCENES / "cornell-box.gltf").read_text()
    document = json.loads(text)
    document["extensionsUsed"] = ["EXT_unheard_of"]
    (tmp_path / "scene").mkdir()
    file = tmp_path / "scene/box.gltf"
    for buffer in document["buffers"]:
        if not buffer["uri"].startswith("data:"):
            shutil.copy(SCENES / buffer["uri"], tmp_path / buffer["uri"])
            buffer["uri"] = "../" + buffer["uri"]
    document["images"] = [{"uri": "../image.png"}]
    file.write_text(json.dumps(document))
    with pytest.raises(bdpt.Error, match="outside of the scene's folder; allow_folder allows others") as refused:
        bdpt.load(file)
    assert refused.value.code == 4
    for folders in (tmp_path, [tmp_path], [tmp_path / "scene", str(tmp_path)]):
        assert any("EXT_unheard_of" in warning for warning in bdpt.load(file, allow_folder=folders).warnings)
    with pytest.raises(bdpt.Error, match="EXT_unheard_of is unknown and ignored; strict refuses this") as strict:
        bdpt.load(file, allow_folder=tmp_path, strict=True)
    assert strict.value.code == 5
