"""An installed wheel, whose build is gone: check_wheel.py FOLDER VERSION OPENVDB.

FOLDER has cornell-box.gltf, smoke.vdb and sky.tif. OPENVDB is 1 where the wheel was built with OpenVDB.
"""

import pathlib
import sys

import bdpt
import numpy as np


def main():
    folder, version, openvdb = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3] == "1"
    assert bdpt.__version__ == version, bdpt.__version__
    box = bdpt.load(folder / "cornell-box.gltf")
    render = bdpt.render(box, spp=2, size=(12, 8), integrator="bdpt")
    assert render.image.shape == (8, 12, 3) and render.image.mean() > 0.01, render.image
    render.save("out.exr")
    render.save("out.png")
    assert pathlib.Path("out.exr").stat().st_size > 0 and pathlib.Path("out.png").stat().st_size > 0

    # What is loaded or started when it is needed is in the wheel.
    companions = {file.name for file in pathlib.Path(bdpt.__file__).parent.iterdir()}
    assert {"libbdpt_oiio.so", "bdpt-read-ktx", "_bdpt.pyi", "py.typed"} <= companions, companions
    assert ("bdpt-read-vdb" in companions) == openvdb, companions
    files = {"env": folder / "sky.tif", **({"volume": folder / "smoke.vdb"} if openvdb else {})}
    with_all = bdpt.render(bdpt.load(folder / "cornell-box.gltf", **files), spp=2, size=(12, 8), integrator="mis")
    assert with_all.image.mean() > 0.01 and not np.array_equal(with_all.image, render.image)

    # Without them it says so, and where it looked: beside itself, and nowhere else.
    package = pathlib.Path(bdpt.__file__).resolve().parent
    for name, options in {"libbdpt_oiio.so": {"env": files["env"]}, "bdpt-read-vdb": {"volume": folder / "smoke.vdb"}}.items():
        (package / name).unlink(missing_ok=True)
        try:
            bdpt.load(folder / "cornell-box.gltf", **options)
        except bdpt.Error as error:
            where = f"{name} is not there (tried {package / name}, {package / 'bdpt' / name})"
            assert error.code == 5 and where in str(error), error
        else:
            raise AssertionError(f"{name} was found elsewhere")


main()
