"""Tests that the thumbnailer of file managers makes a picture, or leaves nothing within limits: thumbnailer_test.py
BDPT THUMBNAILER SCENE."""

import configparser
import json
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

        def make(program_folder):
            environment = dict(os.environ, PATH=f"{program_folder}:{os.environ['PATH']}")
            return subprocess.run(words, env=environment, capture_output=True, timeout=100, check=False)

        ran = make(bdpt.parent)
        assert ran.returncode == 0 and not ran.stderr, ran
        png = picture.read_bytes()
        assert png.startswith(b"\x89PNG\r\n\x1a\n"), png[:20]
        assert int.from_bytes(png[16:20], "big") == 96 and int.from_bytes(png[20:24], "big") == 96
        assert png[25] == 6, "it is not transparent"

        def leaves_nothing(ran):
            return ran.returncode != 0 and not picture.exists()

        model.write_text("no scene")
        assert leaves_nothing(make(bdpt.parent)), "a broken file leaves a picture"
        # Vertices in no buffer are zeros: 2.4 GB of a short file.
        model.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "accessors": [{"componentType": 5126, "count": 200_000_000, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]}))
        refused = make(bdpt.parent)
        assert leaves_nothing(refused) and b"(--max-memory)" in refused.stderr, refused
        endless = pathlib.Path(name) / "bdpt"
        endless.write_text("#!/bin/sh\nexec sleep 1000\n")
        endless.chmod(0o755)
        assert leaves_nothing(make(name)), "an endless program leaves a picture"
    print("the thumbnailer makes pictures")


if __name__ == "__main__":
    main()
