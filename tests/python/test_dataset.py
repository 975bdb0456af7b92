"""Tests bdpt.dataset(): the views of the command, as arrays."""

import json
import pathlib
import resource
import struct
import subprocess
import sys

import bdpt
import numpy as np
import pytest

from conftest import SCENES

sys.path.insert(0, str(SCENES.parent / "tests" / "apps" / "ids"))
from exr_file import ExrFile

SMALL = {"views": 2, "size": (32, 24), "spp": 2, "integrator": "pt", "seed": 5}
MODELS = [SCENES / "cornell-box.gltf", SCENES / "room-spot.gltf"]
LAYERS = ["depth", "distance", "normal", "camera-normal", "uv", "position", "mask", "flow"]


def read_png(file):
    """Returns the compressed pixels of a PNG file, without its metadata, which have times."""
    data, at, pixels = file.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        pixels += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    return pixels


def read_exr(file, channels):
    image = ExrFile(file)
    return np.stack([np.array(image.values[channel], np.float32) for channel in channels], axis=2)


def test_views_are_those_of_the_command(command, tmp_path):
    command("dataset", *MODELS, "-o", tmp_path, "--views", 2, "--size", "32x24", "--spp", 2, "--integrator", "pt", "--seed", 5,
            "--image", "exr", "--aov", ",".join(LAYERS), "--quiet")
    seen = []
    for view in bdpt.dataset(MODELS, aov=LAYERS, **SMALL):
        seen.append((view.model, view.index))
        folder = tmp_path / view.model
        poses = json.loads((folder / "transforms.json").read_text())
        frame = poses["frames"][view.index]
        assert np.abs(np.array(frame["transform_matrix"]) - view.camera.matrix).max() < 1e-6
        assert view.camera.intrinsics()[0, 0] == pytest.approx(poses["fl_x"], rel=1e-6)
        assert np.array_equal(read_exr(folder / frame["file_path"], "RGB"), view.image)
        stem = folder / f"{view.index:04}"
        for layer, channels in {"depth": "Z", "distance": "Z", "normal": "RGB", "uv": "RG", "position": "RGB"}.items():
            assert np.array_equal(read_exr(stem.with_suffix(f".{layer}.exr"), channels).squeeze(), view.layers[layer]), layer
        names = json.loads((folder / "masks.json").read_text())
        assert view.names == names
    assert seen == [("cornell-box", 0), ("cornell-box", 1), ("room-spot", 0), ("room-spot", 1)]


def test_pictures_are_those_of_the_command(command, tmp_path):
    """The views of a model have one exposure, that of the first one."""
    command("dataset", MODELS[0], "-o", tmp_path, "--views", 3, "--size", "32x24", "--spp", 2, "--integrator", "pt", "--seed", 5,
            "--image", "png", "--env", "studio", "--denoise=false", "--quiet")
    exposures = set()
    for view in bdpt.dataset(MODELS[0], env="studio", **{**SMALL, "views": 3}):
        view.render.save(tmp_path / "ours.png", exposure=view.exposure, denoise=False)
        assert read_png(tmp_path / "ours.png") == read_png(tmp_path / "cornell-box" / f"{view.index:04}.png")
        exposures.add(view.exposure)
    assert len(exposures) == 1 and exposures.pop() is not None


def test_sizes_are_those_of_poses(command, tmp_path):
    command("dataset", MODELS[0], "-o", tmp_path, "--views", 1, "--size", "20x30", "--spp", 1, "--integrator", "pt", "--quiet")
    (view,) = bdpt.dataset(MODELS[0], poses=tmp_path / "cornell-box" / "transforms.json", spp=1, integrator="pt")
    assert view.image.shape == (30, 20, 3)
    (view,) = bdpt.dataset(MODELS[0], 1, spp=1, integrator="pt")
    assert view.image.shape == (512, 512, 3)
    (view,) = bdpt.dataset(MODELS[0], 1, spp=1, integrator="pt", size=16)
    assert view.image.shape == (16, 16, 3)


def test_lenses_blur():
    model, lenses = SCENES / "cornell-spheres.gltf", ({}, {"lens_radius": 1, "focus_distance": 2})
    sharp, blurred = (next(bdpt.dataset(model, env="studio", **lens, **{**SMALL, "integrator": "mis", "spp": 64})) for lens in lenses)
    contrast = [np.abs(np.diff(view.image, axis=0)).mean() for view in (sharp, blurred)]
    assert contrast[1] < 0.8 * contrast[0]


def test_layers_agree_with_each_other():
    (first, last) = bdpt.dataset(MODELS[0], aov=",".join(LAYERS), **SMALL)
    layers = first.layers
    hit = np.isfinite(layers["depth"])
    assert hit.any() and layers["depth"].shape == (24, 32) and layers["position"].shape == (24, 32, 3) and layers["uv"].shape == (24, 32, 2)
    k, pose = first.camera.intrinsics(), first.camera.matrix
    local = (layers["position"][hit] - pose[:3, 3]) @ pose[:3, :3] * (1, -1, -1)
    assert np.abs(local[:, 2] - layers["depth"][hit]).max() < 1e-4
    assert np.abs(np.linalg.norm(local, axis=1) - layers["distance"][hit]).max() < 1e-4
    pixels = (local / local[:, 2:]) @ k.T
    rows, columns = np.nonzero(hit)
    assert np.abs(pixels[:, 0] - columns - 0.5).max() < 0.01 and np.abs(pixels[:, 1] - rows - 0.5).max() < 0.01
    assert np.abs(layers["normal"] @ pose[:3, :3] - layers["camera-normal"]).max() < 1e-5
    for kind in ("object", "instance", "material"):
        assert layers[kind].dtype == np.uint32 and ((layers[kind] > 0) == hit).all() and layers[kind].max() < len(first.names[kind])
    assert layers["flow"].shape == (24, 32, 2) and layers["flow_visible"].dtype == bool and "flow" not in last.layers
    assert first.rgb.dtype == np.uint8 and first.rgb.shape == (24, 32, 3)


def test_options_are_those_of_load_and_render():
    bright, dark = (next(bdpt.dataset(MODELS[0], env=env, max_depth=2, **SMALL)) for env in ("studio", "none"))
    assert bright.image.mean() > dark.image.mean()
    assert "integrator" in bright.render.settings and "View 0 of cornell-box: image" in repr(bright)
    narrow, wide = (next(bdpt.dataset(MODELS[0], fov=fov, **SMALL)) for fov in (20, 60))
    assert narrow.camera.intrinsics()[1, 1] > wide.camera.intrinsics()[1, 1]
    ranges = {"view_range": ((-30, 30), (10, 40)), "distance": (1, 2), "fov_range": (30, 40)}
    for view in bdpt.dataset(MODELS[0], **ranges, **SMALL):
        assert 0.17 < view.camera.matrix[1, 2] < 0.65


def test_broken_models_are_warned_of(tmp_path):
    (tmp_path / "broken.gltf").write_text("{")
    files = [tmp_path / "broken.gltf", MODELS[0]]
    with pytest.warns(UserWarning, match="broken.gltf"):
        assert len(list(bdpt.dataset(files, **SMALL))) == 2
    with pytest.raises(bdpt.Error):
        list(bdpt.dataset(files, on_error="raise", **SMALL))


def test_wrong_calls_raise_at_once(tmp_path):
    with pytest.raises(TypeError, match="sppp"):
        bdpt.dataset(MODELS[0], sppp=3)
    with pytest.raises(ValueError, match="views"):
        bdpt.dataset(MODELS[0], views=0)
    with pytest.raises(FileNotFoundError):
        bdpt.dataset(tmp_path / "*.glb")


@pytest.mark.parametrize("wrong, error", [({"views": 0}, "views"), ({"aov": "color"}, "aov"), ({"sppp": 3}, "sppp"),
                                          ({"on_error": "stop"}, "on_error"), ({"distance": -1}, "distance"),
                                          ({"view_range": "all"}, "view-range")])
def test_wrong_values_raise(wrong, error):
    with pytest.raises((ValueError, TypeError), match=error):
        list(bdpt.dataset(MODELS[0], **{**SMALL, **wrong}))


def test_patterns_and_names(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "model.gltf").write_bytes(MODELS[0].read_bytes())
    views = list(bdpt.dataset(tmp_path / "*" / "model.gltf", root=tmp_path, **{**SMALL, "views": 1}))
    assert [view.model for view in views] == ["a/model", "b/model"]
    assert not np.array_equal(views[0].camera.matrix, views[1].camera.matrix)
    with pytest.raises(FileNotFoundError, match="no file matches"):
        list(bdpt.dataset(tmp_path / "*.glb"))


def test_many_models_take_no_more_memory():
    options = {**SMALL, "views": 1, "size": (8, 8), "spp": 1, "aov": "depth,mask"}
    for _ in bdpt.dataset(20 * MODELS, **options):
        pass
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in bdpt.dataset(100 * MODELS, **options):
        pass
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < 1.02 * before


def test_the_example_learns(tmp_path):
    example = pathlib.Path(__file__).resolve().parents[2] / "apps" / "python" / "learn_example.py"
    assert len(example.read_text().splitlines()) <= 40
    output = subprocess.run([sys.executable, example, *MODELS], check=True, capture_output=True, text=True).stdout
    assert float(output.split()[1]) >= 75, output
