"""Tests exceptions: each is a bdpt.Error and the one that Python has for it, and speaks of keywords."""

import pickle

import bdpt
import numpy as np
import pytest

from conftest import SCENES

BOX = SCENES / "cornell-box.gltf"
TINY = {"spp": 1, "size": (2, 2)}


@pytest.mark.parametrize("call, kind, message", [
    (lambda box: bdpt.load("absent.glb"), FileNotFoundError, "absent.glb: no such file"),
    (lambda box: bdpt.load(BOX, env="absent.exr"), FileNotFoundError, "absent.exr"),
    (lambda box: bdpt.load(BOX, camera="zoom"), ValueError, 'no camera "zoom"'),
    (lambda box: bdpt.render(box, camera="zoom"), ValueError, 'no camera "zoom"'),
    (lambda box: bdpt.run("absent.glb", output="a.exr"), FileNotFoundError, "absent.glb"),
    (lambda box: bdpt.read_part("absent.part.exr"), FileNotFoundError, "absent.part.exr"),
    (lambda box: bdpt.load(b"glTF"), ValueError, "^bytes: "),
    (lambda box: bdpt.render(box, **TINY).save("absent/a.exr"), OSError, "absent"),
    (lambda box: bdpt.render(box, spp=4.0), TypeError, r"^spp=4\.0: expected a whole number from 1"),
    (lambda box: bdpt.render(box, spp=np.float32(4)), TypeError, "^spp=.*4.0.*: expected a whole number"),
    (lambda box: bdpt.render(box, spp=True), TypeError, "^spp=True: expected"),
    (lambda box: bdpt.render(box, spp="many"), ValueError, "^spp='many': expected"),
    (lambda box: bdpt.render(box, size=(0, 10)), ValueError, r"^size=\(0, 10\): expected"),
    (lambda box: bdpt.render(box, size=np.zeros((50, 50))), ValueError, "^size=<ndarray>: expected"),
    (lambda box: bdpt.render(box, clamp=object()), TypeError, "^clamp=<object"),
    (lambda box: bdpt.render(box, camera=object()), TypeError, "^camera=<object"),
    (lambda box: bdpt.render(box, integrator="path"), ValueError, r"^integrator='path': expected .*\(did you mean 'mis'\?\)"),
    (lambda box: bdpt.render(box, sppp=3), TypeError, r"^render\(\) got an unexpected keyword argument 'sppp'; did you mean 'spp'\?$"),
    (lambda box: bdpt.render(box, samples_per_pixel=3), TypeError, "'samples_per_pixel'; did you mean 'spp'"),
    (lambda box: bdpt.load(BOX, envmap="a.exr"), TypeError, "'envmap'; did you mean 'env'"),
    (lambda box: bdpt.render(box, env="none"), TypeError, r"'env': it is an option of load\(\)$"),
    (lambda box: bdpt.load(BOX, zzz=1), TypeError, r"^load\(\) got an unexpected keyword argument 'zzz'$"),
    (lambda box: bdpt.render(box, view="front", from_=(1, 2, 3)), ValueError, "^view cannot be combined with from_$"),
    (lambda box: bdpt.render(box, orbit=4, frames=5), ValueError, '^frames="5": expected views from 1 to 4 of orbit'),
    (lambda box: bdpt.run(BOX, spp=4.5), TypeError, r"^spp=4\.5: expected a whole number"),
    (lambda box: bdpt.run(BOX, spp=0), ValueError, "^spp=0: expected a whole number"),
    (lambda box: bdpt.compare(box, box), TypeError, ""),
])
def test_an_error_is_the_one_of_python(cornell_box, call, kind, message):
    with pytest.raises(kind, match=message) as raised:
        call(cornell_box)
    if message:
        assert isinstance(raised.value, bdpt.Error) and "--" not in str(raised.value)
        assert raised.value.code in (2, 3, 4, 6) and "\n" not in str(raised.value)


@pytest.mark.parametrize("call, name", [
    (lambda: bdpt.load("absent.glb"), "absent.glb"), (lambda: bdpt.load(BOX, env="absent.exr"), "absent.exr"),
    (lambda: bdpt.run(BOX, output="a.exr", env="absent.exr"), "absent.exr")])
def test_a_missing_file_has_a_name(call, name):
    with pytest.raises(FileNotFoundError) as raised:
        call()
    other = pickle.loads(pickle.dumps(raised.value))
    assert raised.value.filename == other.filename == name
    assert type(other) is bdpt.MissingFileError and str(other) == str(raised.value) and other.code == 3


@pytest.mark.parametrize("kind, base", [
    (bdpt.InvalidValueError, ValueError), (bdpt.InvalidCallError, TypeError), (bdpt.MissingFileError, FileNotFoundError),
    (bdpt.OutputError, OSError), (bdpt.OutOfMemoryError, MemoryError)])
def test_both_bases_catch_an_error(kind, base):
    for caught in (bdpt.Error, base, RuntimeError):
        with pytest.raises(caught, match="^one line$"):
            raise kind("one line")
    error = kind("one line")
    error.code = 7
    other = pickle.loads(pickle.dumps(error))
    assert type(other) is kind and other.code == 7 and str(other) == "one line"


def test_the_names_of_paths_stay_as_they_are(cornell_box, tmp_path):
    with pytest.raises(OSError, match="/--spp/a.exr"):
        bdpt.render(cornell_box, **TINY).save(tmp_path / "--spp" / "a.exr")
