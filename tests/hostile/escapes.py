"""Makes scenes that try to read a file outside of their folders, and lists the files that a process has opened."""

import json
import pathlib
import re
import struct
import sys
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from png import png_file


def png():
    return png_file(1, 1, 2, zlib.compress(b"\0\xff\0\0"))


def scene(buffer_uri, image_uri):
    """Returns a triangle that needs both files."""
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": image_uri}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
                      {"bufferView": 0, "componentType": 5126, "type": "VEC2", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": buffer_uri}]}


def plant(folder):
    """Writes `folder`/canary.{bin,png} and scenes below `folder`/scene that try to reach them. Yields (file, whether it
    must be refused)."""
    inside = folder / "scene"
    inside.mkdir(parents=True)
    triangle = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    for place in (folder / "canary", inside / "inside"):
        place.with_suffix(".bin").write_bytes(triangle)
        place.with_suffix(".png").write_bytes(png())
    (inside / "link.bin").symlink_to(folder / "canary.bin")
    (inside / "link.png").symlink_to(folder / "canary.png")
    (inside / "up").symlink_to(folder)
    (folder / "scene-beside").mkdir()  # its name begins like that of the scene's folder
    (folder / "scene-beside" / "canary.bin").write_bytes(triangle)
    (folder / "scene-beside" / "canary.png").write_bytes(png())
    top = folder.resolve().as_posix()
    ways = {
        "parent": "../canary", "there-and-back": "x/../../canary", "percent": "%2e%2e/canary", "percent-slash": "..%2fcanary",
        "twice": "%252e%252e/canary", "dot": "./.././canary", "backslash": "..\\canary", "absolute": f"{top}/canary",
        "percent-absolute": "%2f" + f"{top}/canary"[1:], "file": f"file://{top}/canary", "file-short": f"file:{top}/canary",
        "upper": f"FILE://localhost{top}/canary", "host": f"//localhost{top}/canary", "link": "link",
        "link-folder": "up/canary", "beside": "../scene-beside/canary", "query": "../canary?x=/inside",
        "zero": "inside%00/../../canary", "home": "~/canary", "http": "http://127.0.0.1:9/canary",
        "proc": "/proc/self/root" + f"{top}/canary"}
    for name, way in ways.items():
        for part, uris in {"buffer": (way + ".bin", "inside.png"), "image": ("inside.bin", way + ".png")}.items():
            file = inside / f"{name}-{part}.gltf"
            file.write_text(json.dumps(scene(*uris)))
            # Names that only look like escapes are names of missing files: an image may be missing.
            yield file, part == "buffer" or name not in {"twice", "backslash", "home", "query"}
    file = inside / "sound.gltf"
    file.write_text(json.dumps(scene("inside.bin", "inside.png")))
    yield file, False


OPENED = re.compile(r'(?:open|openat|openat2|creat)\((?:AT_FDCWD, |\d+(?:<[^>]*>)?, )?"((?:[^"\\]|\\.)*)"[^=\n]*= (\d+)')


def opened_files(trace):
    """Returns the paths that were opened successfully, from the output of strace."""
    return {pathlib.PurePosixPath(path) for path, _ in OPENED.findall(trace)}


def outside(paths, usual, folders):
    """Returns the paths that are neither usual nor below one of `folders`. A process's own files in /proc, /sys and
    /dev are harmless."""
    own = re.compile(r"/proc/(self|\d+)/(?!root|cwd|fd)|/sys/|/dev/(null|shm|urandom)|/proc/(meminfo|cpuinfo|filesystems|stat)")

    def is_fine(path):
        resolved = pathlib.Path(path).resolve()
        return (str(path) in usual or own.match(str(path)) or
                any(resolved.is_relative_to(folder) for folder in folders))

    return sorted(str(path) for path in paths if not is_fine(path))
