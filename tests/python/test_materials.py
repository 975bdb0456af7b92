"""Tests materials made in Python, and edits of scenes."""

import copy
import re

import bdpt
import numpy as np
import pytest

from conftest import SCENES
from test_arrays import FROM_ABOVE, UVS, WHITE_SKY, floor

HEADER = SCENES.parent / "lib" / "include" / "bdpt" / "material_desc.h"


def render_image(**material):
    scene = bdpt.Scene([floor(base_color=(0.5, 0.5, 0.5), **material)], [WHITE_SKY], FROM_ABOVE, (8, 8))
    return bdpt.render(scene, spp=64).image.mean()


def test_all_fields_of_the_library_are_attributes():
    """Compares the attributes with the fields in the header."""
    lists = HEADER.read_text(encoding="utf-8").split("// Fields of")
    fields = sum(len(re.findall(r"(?:Number|Field)\{", text)) for text in lists if "TextureRef> =" not in text)
    layers = 9
    attributes = [name for name in dir(bdpt.Material) if not name.startswith("_")]
    assert len(attributes) == fields - layers > 50


@pytest.mark.parametrize("name, value", [
    ("name", "paint"), ("alpha_mode", "blend"), ("alpha_cutoff", 0.25), ("unlit", True), ("ior", 1.75), ("clearcoat", 0.5),
    ("clearcoat_roughness", 0.25), ("sheen_color", [1.0, 0.5, 0.25]), ("anisotropy_strength", 0.5), ("iridescence_ior", 1.5),
    ("iridescence_thickness_minimum", 50.0), ("iridescence_thickness_maximum", 500.0), ("diffuse_transmission_color", [0.0, 1.0, 0.5]),
    ("multi_scatter_color", [0.5, 0.5, 1.0]), ("scatter_anisotropy", -0.5), ("specular_color", [2.0, 1.0, 0.5]),
])
def test_attributes_keep_their_values(name, value):
    kept = getattr(bdpt.Material(**{name: value}), name)
    assert kept == (tuple(value) if isinstance(value, list) else value)


def test_defaults_are_those_of_gltf():
    material = bdpt.Material()
    assert (material.metallic, material.roughness, material.ior, material.iridescence_ior) == (1, 1, 1.5, pytest.approx(1.3))
    assert material.alpha_mode == "opaque" and material.attenuation_distance == np.inf


def test_layers_do_what_they_say():
    plain = render_image()
    assert plain == pytest.approx(0.5, rel=0.02)
    clear = np.array([[[255, 255, 255, 0]]], np.uint8)
    assert render_image(alpha_mode="mask", base_color_texture=clear) == pytest.approx(1.0)  # shows the sky below
    black = {"base_color_texture": np.zeros((1, 1, 3), np.uint8)}
    assert render_image(**black) < 1e-4
    assert 0.03 < render_image(clearcoat=1.0, **black) < 0.06  # 4 % of the white sky, seen from above
    assert render_image(sheen_color=(1, 1, 1), sheen_roughness=0.5, **black) > 0.01
    # Half of the diffuse light is transmitted, and as much comes from the equally white sky below.
    assert render_image(diffuse_transmission=0.5, diffuse_transmission_color=(0.5, 0.5, 0.5)) == pytest.approx(0.5, rel=0.03)
    assert render_image(diffuse_transmission=1.0, diffuse_transmission_color=(0.1, 0.1, 0.1)) == pytest.approx(0.1, rel=0.03)


@pytest.mark.parametrize("texels", [np.array([[0, 1], [2, 3]], np.uint8), np.ones((3, 2, 4), np.float32),
                                    np.full((1, 5, 3), 1000, np.uint16)])
def test_textures_are_read_as_they_were_set(texels):
    material = bdpt.Material(clearcoat_texture=texels, sheen_color_texture=texels)
    back = material.clearcoat_texture
    assert back.dtype == texels.dtype and (back.squeeze() == texels.squeeze()).all()
    material.clearcoat_texture = None
    assert material.clearcoat_texture is None and material.sheen_color_texture is not None


def test_textures_of_layers_reach_the_surface():
    black_left = np.zeros((1, 32), np.uint8)
    black_left[0, 16:] = 255
    scene = bdpt.Scene([floor(base_color=(0, 0, 0), clearcoat=1.0, clearcoat_texture=black_left)], [WHITE_SKY], FROM_ABOVE, (8, 8))
    image = bdpt.render(scene, spp=32).image.mean(axis=(0, 2))
    assert image[1] < 1e-3 and image[6] == pytest.approx(0.04, abs=0.005)
    assert UVS[0][0] == 0  # left is u = 0


@pytest.mark.parametrize("make, words", [
    (lambda: bdpt.Material(alpha_mode="glass"), "expected opaque, mask or blend"),
    (lambda: bdpt.Material(sheen_texture=1), "sheen_texture"),
    (lambda: bdpt.Scene([floor(iridescence_thickness_minimum=-1.0)]), r"iridescence_thickness_minimum=-1\.0: -1 is out of range \(at least 0\)"),
    (lambda: bdpt.Material(clearcoat_texture=np.zeros((2, 2, 5), np.uint8)), "1 to 4"),
])
def test_bad_materials_are_errors(make, words):
    with pytest.raises((bdpt.Error, AttributeError), match=words):
        make()


# Checks and texts


@pytest.mark.parametrize("make, kind, message", [
    (lambda: bdpt.Material(base_color=(2, 0, 0)), ValueError, r"^base_color=\(2, 0, 0\): 2 is out of range \(0 to 1\)$"),
    (lambda: bdpt.Material(sheen_color=np.array([0, -1, 0])), ValueError, "^sheen_color=array.*: -1 is out of range"),
    (lambda: bdpt.Material(metallic=float("nan")), ValueError, "^metallic=nan: nan is not a finite number$"),
    (lambda: bdpt.Material(attenuation_distance=0), ValueError, "above 0"),
    (lambda: bdpt.Material(roughness="low"), TypeError, "^roughness='low': expected a number$"),
    (lambda: bdpt.Material(base_color="red"), TypeError, "^base_color='red': expected numbers$"),
    (lambda: bdpt.Material(unlit=2), TypeError, "^unlit=2: expected True or False$"),
    (lambda: bdpt.Material(name=3), TypeError, "^name=3: expected a text$"),
    (lambda: bdpt.PointLight(position=(0, np.inf, 0)), ValueError, "^position=.*not a finite number$"),
    (lambda: bdpt.SpotLight(intensity=(-1, 0, 0)), ValueError, r"^intensity=\(-1, 0, 0\): -1 is out of range \(at least 0\)$"),
    (lambda: bdpt.DirectionalLight(direction=(1, 2)), ValueError, "expected three numbers"),
    (lambda: bdpt.PointLight(intenstiy=(1, 1, 1)), TypeError, "did you mean 'intensity'"),
])
def test_values_are_checked_where_they_are_given(make, kind, message):
    with pytest.raises(kind, match=message) as raised:
        make()
    assert isinstance(raised.value, bdpt.Error) and raised.value.code == 2
    assert bdpt.Material(attenuation_distance=np.inf).attenuation_distance == np.inf


@pytest.mark.parametrize("text", [
    "Material()", "Material(name='it\\'s', base_color=(0.8, 0.1, 0.1, 1), alpha_mode='blend', metallic=0, sheen_color=(0.5, 0, 0))",
    "PointLight(position=(0, 2, 0), intensity=(10, 10, 10), radius=0.1)", "SpotLight(direction=(0, -1, 0), outer_cone_angle=0.5)",
    "DirectionalLight(name='sun', illuminance=(3, 3, 3))"])
def test_texts_of_objects_construct_them(text):
    made = eval("bdpt." + text)
    assert repr(made).replace('"', "'").replace("it's", "it\\'s") == text


def test_texts_of_arrays_are_short():
    material = bdpt.Material(base_color_texture=np.zeros((4, 5, 3), np.uint8), metallic=0.5)
    assert repr(material) == "Material(metallic=0.5, base_color_texture=<uint8 (4, 5, 3)>)"
    assert repr(floor()) == ("Mesh(positions=<float32 (4, 3)>, triangles=<uint32 (2, 3)>, uvs=<float32 (4, 2)>, "
                             "material=Material(metallic=0, specular=0))")
    assert repr(WHITE_SKY) == "EnvironmentLight(radiance=<float32 (1, 1, 3)>)"
    assert repr(bdpt.Scene([floor()])) == "<bdpt.Scene of arrays, 2 triangles>"


def test_what_a_scene_was_made_of_refuses_changes():
    mesh, paint, lamp = floor(), bdpt.Material(), bdpt.PointLight()
    paint.base_color = (0.5, 0, 0)  # no scene yet
    scene = bdpt.Scene([mesh, bdpt.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], material=paint)], [lamp])
    for change in (lambda: setattr(paint, "base_color", (0, 0, 1)), lambda: setattr(lamp, "radius", 1), lambda: setattr(scene, "size", (1, 1)),
                   lambda: setattr(paint, "base_color_texture", None), lambda: setattr(paint, "colour", 1)):
        with pytest.raises(AttributeError, match="copy.copy|no setter|no attribute"):
            change()
    with pytest.raises(TypeError):
        paint.base_color[0] = 1  # a part of a value is no attribute
    for other in (copy.copy(paint), copy.deepcopy(paint), scene.material(1)):
        other.base_color = (0, 0, 1)
        assert other.base_color == (0, 0, 1, 1) and paint.base_color == (0.5, 0, 0, 1)


# Edits


def test_a_changed_material_renders_like_a_new_scene():
    scene = bdpt.Scene([floor(name="floor", base_color=(0.5, 0.5, 0.5))], [WHITE_SKY], FROM_ABOVE, (8, 8))
    assert scene.materials == ["floor"]
    red = scene.material("floor")
    red.base_color = (0.5, 0.1, 0.1)
    new = bdpt.Scene([floor(name="floor", base_color=(0.5, 0.1, 0.1))], [WHITE_SKY], FROM_ABOVE, (8, 8))
    for edited in (scene.with_material("floor", red), scene.with_material(0, red)):
        assert (bdpt.render(edited, spp=4).image == bdpt.render(new, spp=4).image).all()
    assert bdpt.render(scene, spp=4).image[..., 1].mean() == pytest.approx(0.5, rel=0.05)  # unchanged


def test_an_edited_texture_is_seen_and_others_stay():
    texels = np.full((1, 1, 3), 255, np.uint8)
    scene = bdpt.Scene([floor(name="floor", base_color_texture=texels)], [WHITE_SKY], FROM_ABOVE, (8, 8))
    dark = scene.material("floor")
    dark.roughness = 0.5
    assert bdpt.render(scene.with_material("floor", dark), spp=16).image.mean() == pytest.approx(1.0, rel=0.03)
    dark.base_color_texture = texels // 255
    assert bdpt.render(scene.with_material("floor", dark), spp=16).image.mean() < 0.01


def test_lights_and_environment_are_replaced():
    scene = bdpt.load(SCENES / "room-environment.gltf", size=(8, 6), env="none")
    assert bdpt.render(scene, spp=1).image.max() == 0
    grey = bdpt.EnvironmentLight(np.full((1, 1, 3), 0.5, np.float32))
    lit = scene.with_environment(grey)
    half, whole = (bdpt.render(s, spp=4).image for s in (lit, scene.with_environment(WHITE_SKY)))
    assert half.mean() > 0 and (2 * half == whole).all()
    assert bdpt.render(lit.with_environment(None), spp=1).image.max() == 0
    lamp = bdpt.PointLight(position=(0, 1, 0), intensity=(5, 5, 5))
    assert bdpt.render(scene.with_lights([lamp]), spp=4).image.max() > 0


@pytest.mark.parametrize("name", ["nothing", 99])
def test_a_material_that_is_not_there_is_an_error(cornell_box, name):
    with pytest.raises(bdpt.Error, match="no material"):
        cornell_box.material(name)
