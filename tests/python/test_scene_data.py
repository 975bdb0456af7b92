"""Tests what is in a scene, as arrays; moved instances; rays."""

import gc
import threading

import bdpt
import numpy as np
import pytest

from conftest import SCENES

FLOOR = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
FACES = np.array([[0, 2, 1], [0, 3, 2]], np.uint32)
UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)


def place(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


def make_scene(**more):
    chairs = bdpt.Mesh(FLOOR, FACES, uvs=UVS, name="chair", transforms=np.stack([place(0, 0, 0), place(10, 1, 0)]))
    table = bdpt.Mesh(FLOOR * 2, FACES, name="table", normals=[[0, 1, 0]] * 4, transforms=[place(0, -1, 0)], **more)
    return bdpt.Scene([chairs, table], [bdpt.PointLight(position=(0, 5, 0))], bdpt.Camera(from_=(0, 9, 0.1), look_at=(0, 0, 0)))


def test_a_scene_tells_what_is_in_it():
    scene = make_scene()
    assert scene.bounds.tolist() == [[-2, -1, -2], [11, 1, 2]]
    assert [(item.name, item.mesh, item.material) for item in scene.instances] == [("chair", 0, 0), ("chair", 0, 0), ("table", 1, 1)]
    assert np.array_equal(scene.instances[1].matrix, place(10, 1, 0)) and "'chair' of mesh 0" in repr(scene.instances[0])
    chair, table = scene.meshes
    assert (chair.name, table.name) == ("chair", "table")
    assert np.array_equal(table.positions, FLOOR * 2) and np.array_equal(table.triangles, FACES) and np.array_equal(chair.uvs, UVS)
    assert chair.normals.shape == (0, 3) and table.normals.dtype == np.float32 and table.triangles.dtype == np.uint32


def test_arrays_are_views_that_keep_the_scene_and_cannot_be_written():
    scene = make_scene()
    one, other = scene.meshes[0].positions, scene.meshes[0].positions
    assert np.shares_memory(one, other) and not one.flags.writeable
    with pytest.raises(ValueError):
        one[0] = 1
    del scene
    gc.collect()
    assert np.array_equal(one, FLOOR)
    again = bdpt.Mesh(FLOOR, FACES).positions
    assert np.array_equal(again, FLOOR)


def test_moved_instances_render_like_a_new_scene():
    scene = make_scene()
    ours = scene.moved({"table": place(0, 1, 0), 1: place(3, 0, 0)})
    assert [item.matrix[0, 3] for item in ours.instances] == [0, 3, 0] and ours.instances[2].matrix[1, 3] == 1
    assert scene.instances[1].matrix[0, 3] == 10  # unchanged
    assert np.shares_memory(scene.meshes[0].positions, ours.meshes[0].positions)
    chairs = bdpt.Mesh(FLOOR, FACES, uvs=UVS, name="chair", transforms=np.stack([place(0, 0, 0), place(3, 0, 0)]))
    table = bdpt.Mesh(FLOOR * 2, FACES, name="table", normals=[[0, 1, 0]] * 4, transforms=[place(0, 1, 0)])
    new = bdpt.Scene([chairs, table], [bdpt.PointLight(position=(0, 5, 0))], bdpt.Camera(from_=(0, 9, 0.1), look_at=(0, 0, 0)))
    options = {"spp": 2, "size": (16, 12), "integrator": "bdpt"}
    expected = bdpt.render(new, **options).image
    assert np.array_equal(bdpt.render(ours, **options).image, expected) and expected.any()
    both = scene.moved({"chair": place(0, 2, 0)})
    assert [item.matrix[1, 3] for item in both.instances] == [2, 2, -1]
    each = scene.moved({"chair": np.stack([place(0, 2, 0), place(0, 3, 0)])})
    assert [item.matrix[1, 3] for item in each.instances] == [2, 3, -1]


@pytest.mark.parametrize("transforms, kind, message", [
    ({"chairs": np.eye(4)}, ValueError, r'^no instance "chairs" \(did you mean "chair"\?\)$'),
    ({3: np.eye(4)}, ValueError, "^no instance 3: the scene has 3$"), ({None: np.eye(4)}, TypeError, "name or the index"),
    ({"chair": np.eye(3)}, ValueError, r"^'chair': expected a matrix of shape \(4, 4\), not \(3, 3\)"),
    ({"chair": np.stack([np.eye(4)] * 3)}, ValueError, "3 matrices for 2 instances"),
    ({"table": np.zeros((4, 4))}, ValueError, 'instance 2 "table"'), ({"table": np.full((4, 4), np.inf)}, ValueError, "finite"),
    ({"table": "there"}, TypeError, "expected an array")])
def test_what_cannot_move_is_an_error(transforms, kind, message):
    with pytest.raises(kind, match=message) as raised:
        make_scene().moved(transforms)
    assert isinstance(raised.value, bdpt.Error)


def test_rays_hit_what_is_first():
    scene = make_scene()
    hits = scene.raycast([[0.5, 3, 0.25], [10.5, 3, 0.25], [1.5, 3, 0], [50, 3, 0]], [[0, -2, 0]] * 4)
    assert hits.distance.tolist() == [3, 2, 4, np.inf] and hits.instance.tolist() == [0, 1, 2, -1]
    assert hits.position[:3].tolist() == [[0.5, 0, 0.25], [10.5, 1, 0.25], [1.5, -1, 0]] and np.isnan(hits.position[3]).all()
    assert np.allclose(hits.normal[:3], [0, 1, 0]) and np.allclose(hits.geometric_normal[:3], [0, 1, 0]) and np.isnan(hits.normal[3]).all()
    assert np.allclose(hits.uv[:2], [0.75, 0.625]) and hits.triangle[3] == -1 and "4 rays" in repr(hits)
    for ray in range(3):  # the weights give the place on the triangle
        item = scene.instances[hits.instance[ray]]
        mesh = scene.meshes[item.mesh]
        corners = mesh.positions[mesh.triangles[hits.triangle[ray]]]
        assert np.allclose(hits.barycentrics[ray] @ corners + item.matrix[:3, 3], hits.position[ray], atol=1e-6)


def test_rays_keep_their_shape_and_may_be_many():
    scene = bdpt.load(SCENES / "cornell-box.gltf")
    eye = scene.camera.matrix[:3, 3]
    directions = np.random.default_rng(1).normal(size=(100, 300, 3)) + (0, 0, 3)
    hits = scene.raycast(np.broadcast_to(eye, directions.shape), directions)
    assert hits.distance.shape == (100, 300) and hits.position.shape == (100, 300, 3) and hits.uv.shape == (100, 300, 2)
    one = scene.raycast(eye, directions[70, 123])
    assert one.distance == hits.distance[70, 123] and one.distance.shape == () and np.array_equal(one.normal, hits.normal[70, 123], equal_nan=True)
    hit = np.isfinite(hits.distance)
    places = eye + (hits.distance[..., None] * directions / np.linalg.norm(directions, axis=-1, keepdims=True))[hit]
    assert 0.1 < hit.mean() < 1 and np.allclose(places, hits.position[hit], atol=1e-5)
    assert scene.raycast(np.zeros((0, 3)), np.zeros((0, 3))).distance.shape == (0,)


def test_other_threads_run_while_rays_are_traced():
    scene, done, counts = make_scene(), threading.Event(), [0]

    def count():
        while not done.is_set():
            counts[0] += 1

    counter = threading.Thread(target=count)
    rays = np.zeros((300000, 3)) + (0, 3, 0)
    counter.start()
    before = counts[0]
    scene.raycast(rays, rays - (0.1, 6, 0.1))
    after = counts[0]
    done.set()
    counter.join()
    assert after > before


@pytest.mark.parametrize("origins, directions, kind, message", [
    ([0, 0], [0, 0, 1], ValueError, r"^origins: expected the shape \(\.\.\., 3\)"), ([0, 0, 0], 5, ValueError, "^directions: expected the shape"),
    ([[0, 0, 0]], [0, 0, 1], ValueError, "different shapes"), ("up", [0, 0, 1], TypeError, "^origins='up': expected an array"),
    ([[0, 3, 0], [0, 3, 0]], [[0, 1, 0], [0, 0, 0]], ValueError, "^ray 1: .*direction"), ([0, np.nan, 0], [0, 0, 1], ValueError, "^ray 0: .*finite")])
def test_wrong_rays_are_errors(origins, directions, kind, message):
    with pytest.raises(kind, match=message) as raised:
        make_scene().raycast(origins, directions)
    assert isinstance(raised.value, bdpt.Error)


def test_vertices_have_colors():
    red = np.tile(np.float32([0.5, 0, 0, 1]), (4, 1))
    mesh = bdpt.Mesh(FLOOR, FACES, colors=red, material=bdpt.Material(unlit=True))
    assert np.array_equal(mesh.colors, red) and "colors=<float32 (4, 4)>" in repr(mesh)
    scene = bdpt.Scene([mesh], [], bdpt.Camera(from_=(0, 3, 0.1), look_at=(0, 0, 0), fov=10), (4, 4))
    assert np.allclose(bdpt.render(scene, spp=1).image, [0.5, 0, 0])
    with pytest.raises(ValueError, match="colors for 4 positions: 3"):
        bdpt.Mesh(FLOOR, FACES, colors=red[:3])
