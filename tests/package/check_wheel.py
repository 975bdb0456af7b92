"""Tests an installed wheel whose build folder is gone: check_wheel.py FOLDER VERSION OPENVDB PAGE FAKE_DENOISER OTHER.

FOLDER has sky.tif and scenes: cornell-box.gltf, material-layers.gltf, room-spot.gltf, smoke.vdb. OPENVDB is 1 if the
wheel was built with OpenVDB. PAGE is docs/python.md, whose programs are run. FAKE_DENOISER, if not empty, is a
library with the interface of Open Image Denoise. OTHER is the command of another build.
"""

import ast
import importlib.metadata
import os
import pathlib
import re
import shutil
import subprocess
import sys

import bdpt
import numpy as np

os.environ.pop("BDPT_DENOISER", None)  # so that the denoiser of the environment is found
COMMAND = pathlib.Path(sys.executable).with_name("bdpt")
PACKAGE = pathlib.Path(bdpt.__file__).resolve().parent
SMALL = ["--size", "12x8", "--spp", "2", "--integrator", "bdpt", "--quiet"]


def run(*words, code=0):
    done = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
    return done.stdout + done.stderr


def check_metadata(version):
    known = importlib.metadata.metadata("bdpt")
    assert known["Version"] == version and known["License-Expression"] == "Apache-2.0", known.items()
    assert known["Author"] and known["Keywords"] and known.get_all("Classifier"), known.items()
    text = known.get_payload()
    assert "import bdpt" in text and not re.search(r"\]\((?!https://)", text), "links that lead nowhere"


def check_command(box, version):
    """Tests that the command is the program, and renders the same bits as the module."""
    assert run("--version").startswith(f"bdpt {version}\n")
    module = subprocess.run([sys.executable, "-m", "bdpt", "--version"], capture_output=True, text=True, check=True).stdout
    assert module.startswith(f"bdpt {version}\n"), module
    run("render", box, *SMALL, "--part", "its.part.exr")
    ours = bdpt.render(bdpt.load(box), size=(12, 8), spp=2, integrator="bdpt")
    assert ours.image.any() and np.array_equal(ours.image, bdpt.read_part("its.part.exr").image)
    assert "absent.glb: no such file" in run("render", "absent.glb", "-o", "a.png", code=3)


def check_other_build(folder, other):
    """Tests that another build, which may be of another compiler with other optimizations, renders the same bits."""
    sky = folder / "sky.tif"
    for name, integrator, env in (("cornell-box", "bdpt", None), ("room-spot", "vcm", None), ("material-layers", "mis", sky)):
        scene = folder / f"scenes/{name}.gltf"
        subprocess.run([other, "render", scene, "--size", "48x32", "--spp", "4", "--integrator", integrator, "--quiet",
                        *(["--env", env] if env else []), "--part", f"{name}.part.exr"], check=True)
        ours = bdpt.render(bdpt.load(scene, env=env), size=(48, 32), spp=4, integrator=integrator)
        different = int((ours.image != bdpt.read_part(f"{name}.part.exr").image).sum())
        assert ours.image.any() and different == 0, (name, different)


def check_companions(folder, openvdb):
    """Tests that the wheel contains the files that are loaded or started on demand."""
    box = folder / "scenes/cornell-box.gltf"
    companions = {file.name for file in PACKAGE.iterdir()}
    assert {"libbdpt_oiio.so", "bdpt-read-ktx", "_bdpt.pyi", "py.typed"} <= companions, companions
    assert ("bdpt-read-vdb" in companions) == openvdb, companions
    files = {"env": folder / "sky.tif", **({"volume": folder / "scenes/smoke.vdb"} if openvdb else {})}
    plain = bdpt.render(bdpt.load(box), spp=2, size=(12, 8), integrator="mis")
    with_all = bdpt.render(bdpt.load(box, **files), spp=2, size=(12, 8), integrator="mis")
    assert with_all.image.mean() > 0.01 and not np.array_equal(with_all.image, plain.image)
    run("render", box, *SMALL, *(word for name, file in files.items() for word in (f"--{name}", file)), "-o", "all.png")


def check_without_companions(folder):
    """Tests that, without them, bdpt says so and names where it looked: beside itself, and nowhere else."""
    for name, options in {"libbdpt_oiio.so": {"env": folder / "sky.tif"},
                          "bdpt-read-vdb": {"volume": folder / "scenes/smoke.vdb"}}.items():
        (PACKAGE / name).unlink(missing_ok=True)
        try:
            bdpt.load(folder / "scenes/cornell-box.gltf", **options)
        except bdpt.Error as error:
            where = f"{name} not found (tried {PACKAGE / name}, {PACKAGE / 'bdpt' / name})"
            assert error.code == 5 and where in str(error), error
        else:
            raise AssertionError(f"{name} was found elsewhere")


def check_fake_denoiser(box, fake):
    """Tests that the module and the command take the denoiser of the environment; the fake one doubles an image."""
    library = PACKAGE.parent / "pyoidn/oidn/lib/libOpenImageDenoise.so.2"
    library.parent.mkdir(parents=True)
    shutil.copy(fake, library)
    program = ("import bdpt, sys, numpy as np; r = bdpt.render(bdpt.load(sys.argv[1]), size=(12, 8), spp=2);"
               "r.save('clean.exr', denoise='layer'); assert (r.to_srgb(denoise=True, exposure=0) != r.to_srgb(exposure=0)).any()")
    subprocess.run([sys.executable, "-c", program, box], check=True)
    run("render", box, *SMALL, "-o", "clean.png", "--exposure", "0", "--denoise")
    run("render", box, *SMALL, "-o", "noisy.png", "--exposure", "0")
    assert pathlib.Path("clean.png").read_bytes() != pathlib.Path("noisy.png").read_bytes()
    shutil.rmtree(PACKAGE.parent / "pyoidn")


def install_denoiser():
    """Installs Open Image Denoise, if pip can reach it."""
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--retries", "1", "--timeout", "20", "install", "-q"]
    done = subprocess.run([*pip, "--no-deps", "pyoidn"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"skipped Open Image Denoise itself: pip does not install pyoidn: {done.stderr.strip().splitlines()[-1]}")
    return done.returncode == 0


def run_page(page, denoises):
    """Runs the notebook of the page with small images, and displays like a notebook."""
    section = page.read_text(encoding="utf-8").partition("### In a notebook")[2].partition("\n### ")[0]
    cells = re.findall(r"^```python\n(.*?)^```", section, flags=re.M | re.S)
    assert len(cells) == 3 and all(word in section for word in ("volume=", "denoise=True", "base_color")), section
    names, shown = {}, []
    for cell in cells:
        small = cell.replace("size=(320, 320), spp=16", "size=(24, 24), spp=2")
        assert small != cell
        if not denoises:
            small = small.replace("denoise=True", "")
        for statement in ast.parse(small).body:
            if isinstance(statement, ast.Expr):
                value = eval(compile(ast.Expression(statement.value), page.name, "eval"), names)
                if hasattr(value, "_repr_png_"):
                    shown.append(value._repr_png_())
            else:
                exec(compile(ast.Module([statement], []), page.name, "exec"), names)
    assert len(shown) == 2 and all(png.startswith(b"\x89PNG") for png in shown) and shown[0] != shown[1], shown
    assert pathlib.Path("above.png").stat().st_size > 0


def main():
    folder, version, openvdb, page, fake, other = sys.argv[1:]
    folder, openvdb = pathlib.Path(folder).resolve(), openvdb == "1"
    box = folder / "scenes/cornell-box.gltf"
    assert bdpt.__version__ == version, bdpt.__version__
    check_metadata(version)
    check_command(box, version)
    check_other_build(folder, other)
    check_companions(folder, openvdb)
    if fake:
        check_fake_denoiser(box, fake)
    denoises = install_denoiser()
    if openvdb:
        pathlib.Path("scenes").symlink_to(folder / "scenes")
        run_page(pathlib.Path(page), denoises)
    else:
        print("skipped the notebook: it shows a volume")
    if denoises:
        run("render", box, *SMALL, "-o", "denoised.png", "--denoise")
    check_without_companions(folder)


main()
