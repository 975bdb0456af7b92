"""Tests scenes made of arrays."""

import bdpt
import numpy as np
import pytest

SQUARE = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
TRIANGLES = np.array([[0, 2, 1], [0, 3, 2]], np.uint32)
UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
FROM_ABOVE = bdpt.Camera(from_=(0, 3, 0.001), look_at=(0, 0, 0), fov=20)
WHITE_SKY = bdpt.EnvironmentLight(np.ones((1, 1, 3), np.float32))


def floor(**more):
    material = {"metallic": 0.0, "specular": 0.0, **more}
    return bdpt.Mesh(SQUARE, TRIANGLES, uvs=UVS, material=bdpt.Material(**material))


def test_a_lambertian_floor_under_a_white_sky_has_its_albedo():
    scene = bdpt.Scene([floor(base_color=(0.25, 0.5, 0.75))], [WHITE_SKY], FROM_ABOVE, (8, 8))
    image = bdpt.render(scene, spp=64).image
    assert image.mean(axis=(0, 1)) == pytest.approx([0.25, 0.5, 0.75], rel=0.02)


def test_arrays_without_light_get_that_of_files():
    scene = bdpt.Scene([floor(base_color=(0.5, 0.5, 0.5))], camera=FROM_ABOVE, size=(8, 8))
    assert scene.notes == ["no light: lit by a key and a rim light"]
    assert bdpt.render(scene, spp=8).image.mean() > 0.1
    lit = bdpt.Scene([floor()], [WHITE_SKY], FROM_ABOVE, (8, 8))
    assert lit.notes == [] and lit.lights == 1
    glowing = bdpt.Scene([floor(emission=(1, 1, 1))], camera=FROM_ABOVE, size=(8, 8))
    assert bdpt.render(glowing, spp=1).image.min() >= 1


def test_a_black_image_is_told():
    scene = bdpt.Scene([floor()], [WHITE_SKY], FROM_ABOVE, (8, 8)).with_environment(None)
    with pytest.warns(UserWarning, match="scene of arrays: the image is black"):
        bdpt.render(scene, spp=1)


def test_a_point_light_shines_by_its_distance():
    scene = bdpt.Scene([floor(base_color=(1, 1, 1))], [bdpt.PointLight(position=(0, 2, 0), intensity=(3, 3, 3))], FROM_ABOVE,
                       (9, 9))
    assert bdpt.render(scene, spp=4, integrator="mis", max_depth=2).image[4, 4] == pytest.approx(3 / 4 / np.pi, rel=0.01)


def test_textures_lie_as_texture_coordinates_say():
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 1] = 255  # top right: u = 0.75, v = 0.25, which is x = 0.5, z = -0.5
    scene = bdpt.Scene([floor(base_color_texture=texels)], [WHITE_SKY],
                       bdpt.Camera(from_=(0.5, 3, -0.499), look_at=(0.5, 0, -0.5), fov=2), (4, 4))
    assert bdpt.render(scene, spp=8).image.mean() > 0.9


def test_one_mesh_stands_in_many_places():
    places = np.stack([np.eye(4, dtype=np.float32) for _ in range(3)])
    places[:, 0, 3] = (0, 5, 10)  # translations are in the last column, as in NumPy
    mesh = bdpt.Mesh(SQUARE, TRIANGLES, transforms=places, material=bdpt.Material(unlit=True, base_color=(1, 1, 1)))
    scene = bdpt.Scene([mesh], camera=bdpt.Camera(from_=(10, 3, 0.001), look_at=(10, 0, 0), fov=10), size=(4, 4))
    assert scene.triangles == 6
    assert bdpt.render(scene, spp=1).image.mean() == pytest.approx(1.0)


def test_without_a_camera_all_is_framed():
    scene = bdpt.Scene([floor()], [WHITE_SKY], size=(16, 8))
    assert bdpt.render(scene, spp=1).image.shape == (8, 16, 3)


@pytest.mark.parametrize("make, words", [
    (lambda: bdpt.Scene([bdpt.Mesh(SQUARE, TRIANGLES + 2)]), "triangle"),
    (lambda: bdpt.Scene([floor(roughness=2.0)]), "roughness"),
    (lambda: bdpt.Scene([floor()], size=(0, 4)), r"size=\(0, 4\)"),
    (lambda: bdpt.Material(base_color_texture=np.zeros((2, 2, 3), np.int64)), "uint8"),
    (lambda: bdpt.Material(base_color=(1, 1)), "three or four"),
])
def test_bad_arrays_are_errors(make, words):
    with pytest.raises(bdpt.Error, match=words):
        make()


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.uint32, np.uint64, np.int32, np.int64])
def test_indices_are_integers_of_any_size(kind):
    mesh = bdpt.Mesh(SQUARE, TRIANGLES.astype(kind), material=bdpt.Material(unlit=True, base_color=(1, 1, 1)))
    assert bdpt.render(bdpt.Scene([mesh], camera=FROM_ABOVE, size=(4, 4)), spp=1).image.mean() == pytest.approx(1.0)


@pytest.mark.parametrize("index, kind, words", [
    (2**32, np.int64, "triangle 1 has index 4294967296"),
    (2**32, np.uint64, "triangle 1 has index 4294967296"),
    (-1, np.int64, "triangle 1 has index -1"),
    (-1, np.int32, "triangle 1 has index -1"),
    (0.9, np.float32, "expected integers"),
    (2.0**32, np.float64, "expected integers"),
])
def test_indices_that_do_not_fit_are_errors(index, kind, words):
    triangles = TRIANGLES.astype(kind)
    triangles[1, 0] = index
    with pytest.raises(bdpt.Error, match=words):
        bdpt.Mesh(SQUARE, triangles)


@pytest.mark.parametrize("shape", [(0, 1, 3), (1, 0, 3), (0, 2**32 + 1, 3)])
def test_images_without_pixels_are_errors(shape):
    texels = np.zeros(shape, np.float32)
    for make in (lambda: bdpt.Scene([floor()], [bdpt.EnvironmentLight(texels)]),
                 lambda: bdpt.Scene([floor(base_color_texture=texels)])):
        with pytest.raises(bdpt.Error, match="pixels|image"):
            make()


def test_unknown_attributes_and_shapes_are_python_errors():
    with pytest.raises(TypeError, match=r"Material\(\) got an unexpected keyword argument 'rougness'; did you mean 'roughness'\?"):
        bdpt.Material(rougness=3)
    with pytest.raises(TypeError):
        bdpt.Mesh(SQUARE[:, :2], TRIANGLES)
