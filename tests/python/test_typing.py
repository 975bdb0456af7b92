"""Tests the stubs of the package: they have all options, accept correct programs and reject wrong ones."""

import ast
import inspect
import json
import os
import pathlib
import pydoc
import re
import subprocess
import sys

import bdpt
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = pathlib.Path(bdpt.__file__).parent
FUNCTIONS = {"load": bdpt.load, "render": bdpt.render, "save": bdpt.Render.save, "run": bdpt.run}
# Options of `bdpt render` that only run() has: others express them differently, or they concern the files.
OF_JOBS = {"output", "float", "stats", "save_rates", "strategies", "strategy_depth", "part",
                  "fps", "cameras", "full_paths"}
NOT_IN_JOBS = {"allow_folder", "denoiser_library", "ktx_library", "restart"}  # no file may state them

PROGRAM = '''
import pathlib
import bdpt
import numpy as np

scene = bdpt.load("scene.glb", env=pathlib.Path("sky.exr"), env_rotation=90, from_=(1, 2.5, 3), camera=0)
scene = bdpt.load("scene.glb", spp=3)  # refused: spp
render = bdpt.render(scene, spp=64, size=(640, 480), aov=["albedo", "normal"], time="90s", noise=0.02)
render = bdpt.render(scene, spp=np.int64(64), clamp=np.float32(3), size=np.array([640, 480]), seed=None)
render = bdpt.render(scene, sppp=3)  # refused: sppp
render = bdpt.render(scene, spp="many")  # refused: spp
render = bdpt.render(scene, integrator="magic")  # refused: integrator
render = bdpt.render(scene, adaptive=3)  # refused: adaptive
render = bdpt.render(scene, progress=lambda done, total, seconds: print(done / total, seconds))
render = bdpt.render(scene, progress=lambda done: print(done))  # refused: .
render.save("out.png", tone_map="agx", denoise=True, png_bits=16)
render.save("out.exr", denoise="layer", half=True)
render.save("out.exr", denoise="yes")  # refused: denoise
render.image.mean()
render.immage  # refused: immage
render.to_srgb(exposure=1, tone_map="agx").mean()
render.to_srgb(exposed=1)  # refused: exposed
renderer = bdpt.Renderer(scene, spp=64, size=(640, 480))
renderer.render(16)
renderer += renderer.take()
bdpt.Renderer(scene, sppp=3)  # refused: sppp
paint = bdpt.Material(base_color=(1, 0, 0))
paint.sheen_color = (1, 0.5, 0.25)
paint.clearcoat_texture = np.zeros((2, 2), np.uint8)
paint.clearcoat_texture = None
paint.clearcoat = "much"  # refused: .
scene = scene.with_material("paint", paint).with_environment(None)
images = bdpt.run("scene.glb", output=["a.exr", pathlib.Path("a.png")], spp=64, denoise=True, restart=True)
samples: int = images[0].spp
bdpt.run("job.json", output="a.exr", progress=lambda now: print(now.fraction), message=lambda kind, text: print(kind + text))
bdpt.run("scene.glb", output=3)  # refused: output
bdpt.run("scene.glb", sppp=3)  # refused: sppp
code: int = bdpt.Error("").code
camera = bdpt.Camera(from_=(0, 0, 0), look_at=(0, 0, 1), fov=40)
camera = bdpt.Camera(from_=(0, 0, 0))  # refused: Camera
camera = bdpt.Camera.from_matrix(np.eye(4), fx=500, cx=320.5, size=(640, 480), convention="opencv")
camera = bdpt.Camera.from_matrix(np.eye(4), fov=40, convention="blender")  # refused: convention
camera.fov = 3  # refused: fov
for view in bdpt.dataset("models/*.glb", views=3, aov=["depth"], view_range=((-60, 60), (0, 45)), spp=4):
    print(view.layers["depth"].max(), view.camera.matrix, view.names["object"][1])
bdpt.dataset("chair.glb", views="many")  # refused: views
focal_length: np.float64 = camera.intrinsics()[0, 0]
render = bdpt.render(scene, camera=camera, spp=1)
render = bdpt.render(scene, camera=scene.camera, spp=1)
render = bdpt.render(scene, camera=object())  # refused: camera
scene = scene.moved({scene.instances[0].name: np.eye(4)}).moved({0: np.eye(4).tolist()})
distance: np.float32 = scene.raycast([[0, 0, 0]], [[0, 0, 1]]).distance[0]
corners = scene.meshes[0].positions[scene.meshes[0].triangles].mean(axis=1) + scene.bounds[0]
scene = bdpt.Scene.from_trimesh("anything", smooth=True, camera=camera)
try:
    bdpt.load("absent.glb")
except bdpt.MissingFileError as error:
    name: str = error.filename
'''


def read_stub_keywords():
    """Returns the options by function; methods are "Render.to_srgb" and the like."""
    found = {}

    def look(body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                look(node.body, node.name + ".")
            elif isinstance(node, ast.FunctionDef) and node.args.kwonlyargs and not node.name.startswith("from_"):
                found[prefix + node.name] = {argument.arg for argument in node.args.kwonlyargs} - {"progress", "format", "message"}

    look(ast.parse((PACKAGE / "_bdpt.pyi").read_text(encoding="utf-8")).body, "")
    found["save"] = found.pop("Render.save")
    return found


def test_the_package_says_that_it_has_types():
    assert (PACKAGE / "py.typed").exists() and (PACKAGE / "_bdpt.pyi").exists()


def test_stubs_have_each_option_of_the_command():
    schema = json.loads((ROOT / "docs" / "job.schema.json").read_text(encoding="utf-8"))
    options = {"from_" if name == "from" else name for name in schema["properties"] if name not in ("bdpt_job", "$schema")}
    found = read_stub_keywords()
    assert found.pop("run") == options - {"file"} | NOT_IN_JOBS
    in_others = set().union(*found.values())
    assert in_others - NOT_IN_JOBS == options - OF_JOBS - {"file"}
    assert OF_JOBS < options


def test_other_functions_have_the_keywords_of_these():
    found = read_stub_keywords()
    assert found["Renderer.__init__"] == found["render"]
    assert found["Render.to_srgb"] == found["Renderer.save"] == found["save"]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_stubs_signatures_and_help_have_the_same_keywords(name):
    function, keywords = FUNCTIONS[name], read_stub_keywords()[name]
    signature = inspect.signature(function)
    only = {key for key, value in signature.parameters.items() if value.kind is value.KEYWORD_ONLY}
    assert only - {"progress", "format", "message"} == keywords
    text = pydoc.plain(pydoc.render_doc(function))
    documented = set(re.findall(r"^ {8}(\w+): \S.*\n {12}\S", text.partition("Options:")[2], flags=re.M))
    assert documented == keywords and len(keywords) > 5


@pytest.mark.parametrize("name", FUNCTIONS)
def test_each_keyword_of_a_stub_is_taken(name, cornell_box, tmp_path):
    """Tests that bdpt reports the first unknown keyword."""
    render = bdpt.render(cornell_box, spp=1, size=(2, 2))
    first = {"load": "absent.glb", "render": cornell_box, "save": render, "run": "absent.glb"}[name]
    rest = [tmp_path / "a.exr"] if name == "save" else []
    assert read_stub_keywords()[name]
    for keyword in read_stub_keywords()[name]:
        with pytest.raises(bdpt.Error) as raised:
            FUNCTIONS[name](first, *rest, **{keyword: None if name == "run" else "\0"}, no_such_option=1)
        assert "no_such_option" in str(raised.value)


def mypy(*words, cwd):
    pytest.importorskip("mypy")
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(PACKAGE.parent)}
    return subprocess.run([sys.executable, "-m", *words], cwd=cwd, env=environment, capture_output=True, text=True, check=False)


def test_a_type_checker_accepts_what_is_right_and_refuses_what_is_wrong(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM, encoding="utf-8")
    done = mypy("mypy", "--strict", "program.py", cwd=tmp_path)
    found = {int(line): text for line, text in re.findall(r"^program\.py:(\d+): error: (.*)", done.stdout, flags=re.M)}
    expected = {number: line.partition("# refused: ")[2] for number, line in enumerate(PROGRAM.splitlines(), 1)
                if "# refused: " in line}
    assert found.keys() == expected.keys(), done.stdout + done.stderr
    assert all(re.search(word, found[number]) for number, word in expected.items()), done.stdout


def test_the_example_of_learning_has_types(tmp_path):
    done = mypy("mypy", "--strict", str(ROOT / "apps" / "python" / "learn_example.py"), cwd=tmp_path)
    assert "no issues found" in done.stdout, done.stdout + done.stderr


def test_stubs_are_those_of_the_module(tmp_path):
    done = mypy("mypy.stubtest", "bdpt", cwd=tmp_path)
    # nanobind adds these to all classes and functions; the tests above check their arguments.
    of_nanobind = re.compile(r"is a disjoint base|metaclass differs|is not a function|__init__ is inconsistent|"
                              r"stub is a staticmethod but runtime is not")
    errors = re.findall(r"^error: (.*)", done.stdout, flags=re.M)
    assert errors and "not checking" not in done.stdout, done.stdout + done.stderr
    assert [error for error in errors if not of_nanobind.search(error)] == []
