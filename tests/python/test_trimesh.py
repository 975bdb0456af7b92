"""Tests scenes of trimesh and pyrender, where these are installed."""

import types

import bdpt
import numpy as np
import pytest

QUICK = {"spp": 4, "size": (16, 12), "integrator": "pt"}
SKY = bdpt.EnvironmentLight(np.ones((1, 1, 3), np.float32))


@pytest.fixture
def trimesh():
    return pytest.importorskip("trimesh", reason="trimesh is not installed")


def place(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


def test_a_scene_of_trimesh_keeps_names_places_and_camera(trimesh):
    box = trimesh.creation.box((1, 2, 3))
    source = trimesh.Scene()
    source.add_geometry(box, node_name="a", geom_name="box", transform=place(5, 0, 0))
    source.graph.update(frame_to="b", geometry="box", matrix=place(-5, 0, 0))
    source.add_geometry(trimesh.PointCloud([[0, 0, 0]]), geom_name="points")
    scene = bdpt.Scene.from_trimesh(source)
    assert scene.triangles == 24 and {item.name for item in scene.instances} == {"box"}
    assert sorted(item.matrix[0, 3] for item in scene.instances) == [-5, 5]
    assert np.allclose(scene.bounds, [[-5.5, -1, -1.5], [5.5, 1, 1.5]]) and scene.size == (1280, 720)
    source.camera = trimesh.scene.Camera(resolution=(64, 48), fov=(60, 45))
    source.camera_transform = place(1, 2, 30)
    camera = bdpt.Scene.from_trimesh(source).camera
    assert np.allclose(camera.matrix, place(1, 2, 30)) and np.allclose(camera.intrinsics(), source.camera.K) and camera.size == (64, 48)


def test_a_mesh_of_trimesh_has_its_colors(trimesh):
    ball = trimesh.creation.icosphere(3)
    looks_at_it = bdpt.Camera(from_=(0, 0, 4), look_at=(0, 0, 0), fov=20)

    def shade(mesh):
        scene = bdpt.Scene.from_trimesh(mesh, lights=[SKY], camera=looks_at_it)
        return bdpt.render(scene, max_depth=2, **QUICK).image.mean(axis=(0, 1))

    ball.visual.face_colors = [255, 0, 0, 255]
    by_face = shade(ball)
    ball.visual.vertex_colors = [255, 0, 0, 255]
    assert np.allclose(by_face, shade(ball), rtol=0.05) and by_face[0] > 3 * by_face[1]
    assert np.ptp(shade(trimesh.creation.icosphere(3))) < 0.01  # grey


def test_materials_and_textures_of_trimesh_arrive(trimesh):
    image = pytest.importorskip("PIL.Image", reason="PIL is not installed")
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 1] = (255, 255, 255)  # top right: u = 0.75, v = 0.75 in trimesh, where it points up
    material = trimesh.visual.material.PBRMaterial(
        name="paint", baseColorFactor=[128, 255, 255, 255], metallicFactor=0.25, roughnessFactor=0.5, emissiveFactor=[0, 0, 0.5],
        baseColorTexture=image.fromarray(texels).convert("P"), alphaMode="MASK", doubleSided=True)
    quad = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], process=False,
                           visual=trimesh.visual.TextureVisuals(uv=[[0, 0], [1, 0], [1, 1], [0, 1]], material=material))
    scene = bdpt.Scene.from_trimesh(quad, lights=[SKY])
    paint = scene.material("paint")
    assert paint.base_color == pytest.approx((128 / 255, 1, 1, 1)) and (paint.metallic, paint.roughness) == (0.25, 0.5)
    assert paint.alpha_mode == "mask" and paint.double_sided and paint.emission == (0, 0, 0.5)
    paint.unlit = True
    seen = bdpt.render(scene.with_material("paint", paint), camera=bdpt.Camera.from_matrix(place(0.5, 0.5, 1), vertical_extent=1),
                       spp=4, size=(8, 8)).image[..., 1]
    assert seen[1, 6] > 0.6 and max(seen[6, 6], seen[1, 1], seen[6, 1]) < 0.3
    simple = trimesh.visual.material.SimpleMaterial(diffuse=[0, 255, 0, 255])
    quad.visual = trimesh.visual.TextureVisuals(uv=quad.visual.uv, material=simple)
    green = bdpt.Scene.from_trimesh(quad).material(0)
    assert green.base_color == (0, 1, 0, 1) and green.metallic == 0


def test_other_objects_are_refused():
    with pytest.raises(TypeError, match="scene or a mesh of trimesh or pyrender, not int"):
        bdpt.Scene.from_trimesh(5)


def make_pyrender():
    """Returns a scene with the attributes of one of pyrender, which needs OpenGL to be imported."""
    material = types.SimpleNamespace(name="red", baseColorFactor=np.array([1, 0, 0, 1.0]), metallicFactor=0.0, roughnessFactor=0.5,
                                     emissiveFactor=np.zeros(3), alphaMode="OPAQUE", alphaCutoff=None, doubleSided=False, baseColorTexture=None)
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    shape = types.SimpleNamespace(mode=4, positions=corners, normals=None, texcoord_0=None, color_0=None,
                                  indices=np.array([[0, 1, 2], [0, 2, 3]]), poses=np.stack([np.eye(4), place(3, 0, 0)]), material=material)
    mesh_node = types.SimpleNamespace(name="n", mesh=types.SimpleNamespace(name="quad", primitives=[shape]))
    light = types.SimpleNamespace(light=types.SimpleNamespace(color=np.ones(3), intensity=3.0))
    camera = types.SimpleNamespace(camera=types.SimpleNamespace(yfov=np.radians(50)))
    poses = {id(mesh_node): place(0, 1, 0), id(light): np.eye(4), id(camera): place(0, 1, 5)}
    return types.SimpleNamespace(mesh_nodes=[mesh_node], light_nodes=[light], main_camera_node=camera, get_pose=lambda node: poses[id(node)])


def test_a_scene_of_pyrender_has_its_meshes_lights_and_camera():
    scene = bdpt.Scene.from_trimesh(make_pyrender(), size=(16, 12))
    assert [item.matrix[:2, 3].tolist() for item in scene.instances] == [[0, 1], [3, 1]] and scene.materials == ["red"]
    assert scene.lights == 1 and np.allclose(scene.camera.matrix, place(0, 1, 5)) and scene.camera.fov == pytest.approx(50)
    middle = bdpt.render(scene, **QUICK).image[6, 8]
    assert middle[0] == pytest.approx(3 / np.pi, rel=0.2) and middle[1] < 0.2 * middle[0]


def test_pyrender_itself_is_understood(trimesh):
    try:
        import pyrender
    except Exception as error:  # it needs OpenGL, and an old NumPy
        pytest.skip(f"pyrender cannot be imported: {error}")
    source = pyrender.Scene.from_trimesh_scene(trimesh.Scene(trimesh.creation.box((1, 2, 3))))
    source.add(pyrender.PerspectiveCamera(yfov=0.8), pose=place(0, 0, 9))
    scene = bdpt.Scene.from_trimesh(source)
    assert scene.triangles == 12 and scene.camera.fov == pytest.approx(np.degrees(0.8))
