"""Tests that the thumbnailer of file managers makes a picture: thumbnailer_test.py BDPT THUMBNAILER SCENE."""

import configparser
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile


def main():
    bdpt, entry, scene = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    file = configparser.ConfigParser(interpolation=None)
    file.optionxform = str
    file.read(entry)
    thumbnailer = file["Thumbnailer Entry"]
    assert thumbnailer["TryExec"] == "bdpt"
    assert "model/gltf-binary" in thumbnailer["MimeType"].split(";")
    with tempfile.TemporaryDirectory() as name:
        # File managers pass output names without an extension, and input names with shell characters.
        model = pathlib.Path(name) / "a model's $HOME.gltf"
        model.write_bytes(scene.read_bytes())
        picture = pathlib.Path(name) / "picture"
        values = {"%i": str(model), "%o": str(picture), "%s": "96"}
        words = [values.get(word, word) for word in shlex.split(thumbnailer["Exec"])]
        environment = dict(os.environ, PATH=f"{bdpt.parent}:{os.environ['PATH']}")
        ran = subprocess.run(words, env=environment, capture_output=True, timeout=120, check=False)
        assert ran.returncode == 0 and not ran.stderr, ran
        png = picture.read_bytes()
        assert png.startswith(b"\x89PNG\r\n\x1a\n"), png[:20]
        assert int.from_bytes(png[16:20], "big") == 96 and int.from_bytes(png[20:24], "big") == 96
        assert png[25] == 6, "it is not transparent"
    print("the thumbnailer makes pictures")


if __name__ == "__main__":
    main()
