"""Tests cameras by pose: what they render projects to the pixels where it was rendered."""

import copy
import json
import pickle

import bdpt
import numpy as np
import pytest

from conftest import SCENES

SIZE = (48, 32)
TO_OPENCV = np.diag([1.0, -1, -1, 1])
LAMP = bdpt.EnvironmentLight(np.ones((1, 1, 3), np.float32))


def make_pose(place=(3, -2, 5)):
    """Returns a pose that is rotated about all axes."""
    rotation, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation * np.linalg.det(rotation), place
    return pose


def make_wall(pose):
    """Returns a tilted quad that fills the views of these tests."""
    corners = np.array([[-20, -20, -6, 1], [20, -20, -8, 1], [20, 20, -8, 1], [-20, 20, -6, 1]])
    return bdpt.Mesh(corners @ pose.T[:, :3], [[0, 1, 2], [0, 2, 3]])


def project(points, pose, intrinsics, perspective=True):
    """Returns pixels by the matrix of a camera with the axes of OpenCV, as users of OpenCV do."""
    local = (points - pose[:3, 3]) @ pose[:3, :3]
    assert (local[..., 2] > 0).all()
    return ((local / local[..., 2:] if perspective else local * (1, 1, 0) + (0, 0, 1)) @ intrinsics.T)[..., :2]


def pixel_middles(size):
    return np.stack(np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5), axis=-1)


@pytest.mark.parametrize("convention", ["opengl", "opencv"])
@pytest.mark.parametrize("lens", [
    {"fov": 50}, {"fx": 60, "size": SIZE}, {"fy": 40, "size": SIZE}, {"fx": 70, "fy": 40, "cx": 10, "cy": 25.5, "size": SIZE},
    {"fov": 40, "cx": 40, "size": SIZE}, {"vertical_extent": 3}, {"vertical_extent": 4, "cx": 30, "cy": 9, "size": SIZE}])
def test_rendered_places_project_to_their_pixels(convention, lens):
    pose = make_pose()
    axes = TO_OPENCV if convention == "opencv" else np.eye(4)
    camera = bdpt.Camera.from_matrix((pose @ axes).tolist(), convention=convention, **lens)
    scene = bdpt.Scene([make_wall(pose)], [LAMP])
    render = bdpt.render(scene, camera=camera, size=SIZE, spp=16, aov="position", integrator="pt", max_depth=1)
    intrinsics = camera.intrinsics(SIZE)
    assert np.allclose(camera.matrix, pose, atol=1e-6)
    pixels = project(render.layers["position"].astype(np.float64), camera.matrix @ TO_OPENCV, intrinsics, "vertical_extent" not in lens)
    assert np.abs(pixels - pixel_middles(SIZE)).max() < 0.5
    for name, index in {"fx": (0, 0), "fy": (1, 1), "cx": (0, 2), "cy": (1, 2)}.items():
        if name in lens:
            assert intrinsics[index] == pytest.approx(lens[name], rel=1e-5)


def test_a_camera_states_the_size_of_its_image():
    pose = make_pose()
    scene = bdpt.Scene([make_wall(pose)], [LAMP], size=(10, 10))
    camera = bdpt.Camera.from_matrix(pose, fx=60, size=SIZE)
    quick = {"camera": camera, "spp": 1, "integrator": "pt", "max_depth": 1}
    assert bdpt.render(scene, **quick).image.shape == (32, 48, 3)
    assert bdpt.render(scene, size=(24, 16), **quick).image.shape == (16, 24, 3)
    assert bdpt.render(scene, spp=1, camera=bdpt.Camera.from_matrix(pose, fov=40)).image.shape == (10, 10, 3)
    assert bdpt.Scene([make_wall(pose)], camera=camera).size == SIZE
    assert bdpt.Scene([make_wall(pose)], camera=camera, size=(8, 8)).size == (8, 8)
    assert np.allclose(camera.intrinsics(), [[60, 0, 24], [0, 60, 16], [0, 0, 1]], rtol=1e-6)
    assert np.allclose(camera.intrinsics((24, 16)), [[30, 0, 12], [0, 30, 8], [0, 0, 1]], rtol=1e-6)


def test_the_camera_of_a_scene_renders_the_same_bits(cornell_box):
    options = {"spp": 2, "size": (24, 16), "integrator": "bdpt"}
    expected = bdpt.render(cornell_box, **options).image
    camera = cornell_box.camera
    assert np.array_equal(bdpt.render(cornell_box, camera=camera, **options).image, expected)
    again = bdpt.Camera.from_matrix(camera.matrix, fov=camera.fov)
    assert np.allclose(bdpt.render(cornell_box, camera=again, **options).image, expected, rtol=1e-4, atol=1e-4)
    moved = bdpt.load(SCENES / "cornell-box.gltf", from_=(0.2, 0.3, -0.7), env="studio")
    assert np.array_equal(bdpt.render(moved, camera=camera, exposure="light", **options).image.shape, expected.shape)
    behind = bdpt.load(SCENES / "cornell-box.gltf", view="back")
    assert np.array_equal(bdpt.render(behind, camera=camera, **options).image, expected)
    renderer = bdpt.Renderer(cornell_box, camera=camera, **options)
    renderer.finish()
    assert np.array_equal(renderer.image, expected)
    view = next(bdpt.orbit(behind, 2, camera=camera, **options))
    own, other = next(bdpt.orbit(cornell_box, 2, **options)), next(bdpt.orbit(behind, 2, **options))
    assert np.array_equal(view.image, own.image) and not np.array_equal(view.image, other.image)


def test_poses_are_in_coordinates_of_the_file(cornell_box):
    content = json.loads((SCENES / "cornell-box.gltf").read_bytes())
    roots = content["scenes"][0]["nodes"]
    content["nodes"].append({"children": roots, "translation": [448000, 0, -512000]})
    content["scenes"][0]["nodes"] = [len(content["nodes"]) - 1]
    far = bdpt.load(json.dumps(content).encode())
    pose = far.camera.matrix
    assert np.allclose(pose[:3, 3] - cornell_box.camera.matrix[:3, 3], [448000, 0, -512000], atol=1e-3)
    assert np.allclose(far.bounds - cornell_box.bounds, [448000, 0, -512000], atol=1e-3)
    options = {"spp": 2, "size": (24, 16), "integrator": "bdpt"}
    expected = bdpt.render(cornell_box, **options).image
    seen = bdpt.render(far, camera=bdpt.Camera.from_matrix(pose, fov=far.camera.fov), **options).image
    assert np.isclose(seen, expected, rtol=1e-3).mean() > 0.9
    eye = bdpt.Camera(from_=pose[:3, 3], look_at=pose[:3, 3] - pose[:3, 2], fov=far.camera.fov)
    assert np.isclose(bdpt.render(far, camera=eye, **options).image, expected, rtol=1e-3).mean() > 0.9


def test_a_camera_refuses_changes_and_says_what_it_is():
    camera = bdpt.Camera(from_=(0, 2, 3), look_at=(0, 0, 0), fov=40)
    assert repr(camera) == "Camera(from_=(0, 2, 3), look_at=(0, 0, 0), fov=40)"
    assert repr(bdpt.Camera.from_matrix(make_pose(), fov=30)) == "Camera.from_matrix(<float64 (4, 4)>, fov=30)"
    assert camera.fov == pytest.approx(40) and camera.size is None and camera.vertical_extent is None
    assert bdpt.Camera.from_matrix(np.eye(4), vertical_extent=3).vertical_extent == 3
    for name in ("fov", "matrix", "size"):
        with pytest.raises(AttributeError):
            setattr(camera, name, 1)


def test_cameras_are_pickled():
    pose = make_pose((448000.25, 3, -512000))
    for camera in (bdpt.Camera.from_matrix(pose, fx=70, fy=40, cx=10, cy=25.5, size=SIZE, lens_radius=0.5),
                   bdpt.Camera.from_matrix(pose, vertical_extent=3), bdpt.Camera(from_=(0, 2, 3), look_at=(0, 0, 0))):
        other = pickle.loads(pickle.dumps(camera))
        assert np.array_equal(other.matrix, camera.matrix) and np.array_equal(other.intrinsics(SIZE), camera.intrinsics(SIZE))
        assert repr(copy.copy(camera)) == repr(camera) == repr(other)


def sheared(pose):
    pose[:3, 1] = (pose[:3, 1] + 0.1 * pose[:3, 0]) / np.hypot(1, 0.1)
    return pose


@pytest.mark.parametrize("make, kind, message", [
    (lambda: bdpt.Camera.from_matrix(np.eye(3), fov=40), ValueError, r"^pose: expected a matrix of shape \(4, 4\), not \(3, 3\)$"),
    (lambda: bdpt.Camera.from_matrix(make_pose().T, fov=40), ValueError, "last row .*transposed"),
    (lambda: bdpt.Camera.from_matrix(np.diag([1, 2, 1, 1]), fov=40), ValueError, "column 1 has the length 2, not 1"),
    (lambda: bdpt.Camera.from_matrix(np.diag([1, 1, -1, 1]), fov=40), ValueError, "mirrors"),
    (lambda: bdpt.Camera.from_matrix(sheared(make_pose()), fov=40), ValueError, "columns 0 and 1 are not perpendicular"),
    (lambda: bdpt.Camera.from_matrix(np.full((4, 4), np.nan), fov=40), ValueError, "nan is not a finite number"),
    (lambda: bdpt.Camera.from_matrix("here", fov=40), TypeError, "^pose='here': expected an array of numbers"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4)), TypeError, "one of fov, fx with fy, and vertical_extent"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fov=40, fx=3, size=SIZE), TypeError, "one of"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fx=40), TypeError, "needs size"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fx=0, size=SIZE), ValueError, "^fx=0: expected a number above 0"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fx=9, cx=1e5, size=SIZE), ValueError, r"^shift: .* \(-100 to 100\)"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fx=9, size=(0, 4)), ValueError, r"^size=\(0, 4\)"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fov=180), ValueError, "^fov=180: expected degrees"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fov=40, convention="blender"), ValueError, "^convention='blender': expected opengl or opencv$"),
    (lambda: bdpt.Camera(from_=(0, 0, 0), look_at=(0, 0, 0)), ValueError, "from_ and look_at must differ"),
    (lambda: bdpt.Camera(from_=(0, 0, 0), look_at=(0, 0, 1), fov=-1), ValueError, "^fov=-1"),
    (lambda: bdpt.Camera.from_matrix(np.eye(4), fov=40).intrinsics(), TypeError, "needs size"),
    (lambda: bdpt.render(bdpt.load(SCENES / "cornell-box.gltf"), camera=bdpt.Camera.from_matrix(np.eye(4), fov=40), fov=30), ValueError,
     "^camera: "),
])
def test_wrong_cameras_are_errors(make, kind, message):
    with pytest.raises(kind, match=message) as raised:
        make()
    assert isinstance(raised.value, bdpt.Error)
