#!/usr/bin/env python3
"""Writes the seeds of the fuzzers: make_seeds.py FOLDER [BDPT]. Needs oiiotool for JPEG and WebP, and BDPT for parts of
renders, plans and rates.

FOLDER/scene holds scenes that cover the loader; those of tests/data/compressed belong to them.
FOLDER/image holds an image of each format.
FOLDER/part holds parts of renders, and their JSON metadata.
FOLDER/plan holds plans of renders, FOLDER/rates rates of samples.
"""

import base64
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from png import png_file

CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def png(width, height, color_type=6):
    """Returns a PNG whose pixels all differ in colour. Type 0 is grey, 2 RGB, 6 RGB with alpha."""
    channels = {0: 1, 2: 3, 6: 4}[color_type]
    rows = b"".join(b"\0" + bytes((37 * (x + y * width) + 60 * c) % 256 for x in range(width) for c in range(channels))
                    for y in range(height))
    return png_file(width, height, color_type, zlib.compress(rows))


def exr(width, height):
    """Returns an OpenEXR file: scan lines of half R, G, B, uncompressed."""
    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(data)) + data

    channels = b"".join(name + b"\0" + struct.pack("<IIII", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = struct.pack("<II", 20000630, 2)
    head += attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = struct.pack(f"<{3 * width}e", *([0.25] * width + [0.5] * width + [1.0] * width))
    lines = [struct.pack("<iI", y, len(line)) + line for y in range(height)]
    first = len(head) + 8 * height
    table = b"".join(struct.pack("<Q", first + y * len(lines[0])) for y in range(height))
    return head + table + b"".join(lines)


def hdr(resolution, *scanlines, lines=""):
    """Returns a Radiance HDR file; scan lines are flat or run-length encoded."""
    head = f"#?RADIANCE\n{lines}FORMAT=32-bit_rle_rgbe\n\n{resolution}\n".encode()
    return head + b"".join(map(bytes, scanlines))


def environments():
    """Returns Radiance HDR files in all encodings and with all header fields that change pixels."""
    pixel = [128, 64, 32, 129]
    newer = [2, 2, 0, 10, *[138, 7], *[3, 200, 201, 202, 135, 9], *[10, *range(10)], *[138, 130]]
    return {"flat.hdr": hdr("-Y 2 +X 4", 8 * pixel),
            "runs.hdr": hdr("+X 2 -Y 10", newer, newer, lines="EXPOSURE=2.5\nCOLORCORR=1 0.5 2\n"),
            "repeats.hdr": hdr("-Y 2 -X 300", [*pixel, 1, 1, 1, 43, 1, 1, 1, 1], [*pixel, 1, 1, 1, 0, 1, 1, 1, 1, *(43 * pixel)])}


class Document:
    """Builds a glTF document with one buffer."""

    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "extensionsUsed": []}

    def view(self, data):
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, component, kind, values, **more):
        view = self.view(struct.pack(f"<{len(values)}{CODES[component]}", *values))
        self.json["accessors"].append({"bufferView": view, "componentType": component, "type": kind,
                                       "count": len(values) // WIDTHS[kind], **more})
        return len(self.json["accessors"]) - 1

    def floats(self, kind, *values):
        return self.accessor(5126, kind, values)

    def sparse(self, count, indices, values):
        """Adds displacements of a few vertices; all others are zero."""
        place = {"bufferView": self.view(bytes(indices)), "componentType": 5121}
        value_view = self.view(struct.pack(f"<{len(values)}f", *values))
        self.json["accessors"].append({"componentType": 5126, "type": "VEC3", "count": count, "sparse": {
            "count": len(indices), "indices": place, "values": {"bufferView": value_view}}})
        return len(self.json["accessors"]) - 1

    def node(self, **node):
        self.json["nodes"].append(node)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def use(self, *extensions):
        self.json["extensionsUsed"] += extensions

    def glb(self):
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps({key: value for key, value in self.json.items() if value}, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.bytes), 0x4E4942)
        return struct.pack("<III", 0x46546C67, 2, 12 + len(body) + len(self.bytes)) + body + self.bytes


SQUARE = (0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
CORNERS = (0, 0, 1, 0, 1, 1, 0, 1)


def square(document):
    return {"POSITION": document.floats("VEC3", *SQUARE), "NORMAL": document.floats("VEC3", *(4 * (0, 0, 1))),
            "TEXCOORD_0": document.floats("VEC2", *CORNERS)}


def rig():
    """Returns a skin of two joints, morph targets (one of them sparse), and an animation of each kind."""
    document = Document()
    attributes = square(document)
    attributes["JOINTS_0"] = document.accessor(5121, "VEC4", 8 * (0, 1))
    attributes["WEIGHTS_0"] = document.accessor(5121, "VEC4", 4 * (200, 55, 0, 0), normalized=True)
    targets = [{"POSITION": document.floats("VEC3", *(4 * (0, 0, 0.5))), "NORMAL": document.floats("VEC3", *(12 * (0.1,)))},
               {"POSITION": document.sparse(4, (1, 3), (0, 0.5, 0, 0.5, 0, 0))}]
    indices = document.accessor(5123, "SCALAR", (0, 1, 2, 0, 2, 3))
    document.json["meshes"] = [{"primitives": [{"attributes": attributes, "indices": indices, "targets": targets}],
                                "weights": [0.2, 0.1]}]
    inverse = document.floats("MAT4", *(2 * (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)))
    document.node(mesh=0, skin=0, name="skinned")
    joint = document.node(translation=[0, 0.1, 0], name="joint")
    other = document.node(rotation=[0, 0, 0.6, 0.8], scale=[1, 2, 1])
    document.json["skins"] = [{"joints": [joint, other], "inverseBindMatrices": inverse, "skeleton": joint}]
    times = document.floats("SCALAR", 0, 0.5, 1)
    samplers = [
        {"input": times, "output": document.floats("VEC3", *(0.1 * i for i in range(9)))},
        {"input": times, "output": document.accessor(5122, "VEC4", (0, 0, 0, 32767, 0, 0, 32767, 0, 0, 32767, 0, 0),
                                                     normalized=True)},
        {"input": times, "interpolation": "CUBICSPLINE", "output": document.floats("VEC3", *(27 * (1,)))},
        {"input": times, "interpolation": "STEP", "output": document.floats("SCALAR", 0, 1, 0.5, 0.5, 1, 0)}]
    paths = [(joint, "translation"), (other, "rotation"), (other, "scale"), (0, "weights")]
    document.json["animations"] = [{"name": "move", "samplers": samplers, "channels": [
        {"sampler": i, "target": {"node": node, "path": path}} for i, (node, path) in enumerate(paths)]}]
    return document.glb()


def stage():
    """Returns a scene with textures, material variants, instances, lights, cameras, hidden nodes, XMP, and a strip
    without indices."""
    document = Document()
    mapping = {"mappings": [{"material": 1, "variants": [0]}]}
    indices = document.accessor(5125, "SCALAR", (0, 1, 2, 0, 2, 3))
    strip = document.floats("VEC3", 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0)
    colors = document.accessor(5121, "VEC4", 4 * (255, 128, 0, 255), normalized=True)
    document.json["meshes"] = [
        {"primitives": [{"attributes": square(document), "indices": indices, "material": 0,
                         "extensions": {"KHR_materials_variants": mapping}}]},
        {"primitives": [{"attributes": {"POSITION": strip, "COLOR_0": colors}, "mode": 5, "material": 2}]}]
    document.json["images"] = [{"bufferView": document.view(png(4, 4)), "mimeType": "image/png"}]
    document.json["samplers"] = [{"wrapS": 33071, "wrapT": 33648}]
    document.json["textures"] = [{"source": 0, "sampler": 0}]
    move = {"KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.3, "scale": [2, 0.5], "texCoord": 0}}
    base = {"baseColorTexture": {"index": 0, "extensions": move}, "roughnessFactor": 0.4, "metallicFactor": 0.1,
            "metallicRoughnessTexture": {"index": 0}}
    glass = {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.4},
             "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0.2]},
             "KHR_materials_specular": {"specularFactor": 0.7, "specularColorFactor": [1, 1, 0]}}
    document.json["materials"] = [
        {"pbrMetallicRoughness": base, "normalTexture": {"index": 0, "scale": 0.5}, "alphaMode": "MASK"},
        {"extensions": glass, "doubleSided": True},
        {"emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 0}, "alphaMode": "BLEND",
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}}]
    places = {"TRANSLATION": document.floats("VEC3", -1, 0, 0, 1, 0, 0), "SCALE": document.floats("VEC3", *(6 * (0.5,))),
              "ROTATION": document.accessor(5120, "VEC4", (0, 0, 0, 127, 0, 0, 127, 0), normalized=True)}
    document.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
                                {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}}]
    document.node(mesh=0, extensions={"EXT_mesh_gpu_instancing": {"attributes": places}})
    document.node(mesh=1, translation=[0, 0, -1], extensions={"KHR_node_visibility": {"visible": True}})
    document.node(camera=0, translation=[0.5, 0.5, 4])
    document.node(camera=1, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1])
    for i in range(3):
        document.node(translation=[0, 1, 2], extensions={"KHR_lights_punctual": {"light": i}}, extras={"radius": 0.1})
    lights = [{"type": "point", "intensity": 10, "range": 5}, {"type": "directional", "color": [1, 0.9, 0.8]},
              {"type": "spot", "intensity": 5, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}]
    document.json["extensions"] = {
        "KHR_lights_punctual": {"lights": lights}, "KHR_materials_variants": {"variants": [{"name": "glass"}]},
        "KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"}, "dc:title": "seed"}]}}
    document.json["asset"]["extensions"] = {"KHR_xmp_json_ld": {"packet": 0}}
    document.use("KHR_lights_punctual", "KHR_materials_variants", "KHR_xmp_json_ld", "EXT_mesh_gpu_instancing",
                 "KHR_node_visibility", "KHR_texture_transform", "KHR_materials_emissive_strength", *glass)
    return document.glb()


def lamps():
    """Returns a scene with light profiles of types B and C, as data and as a view, and an environment of six images."""
    document = Document()
    document.json["meshes"] = [{"primitives": [{"attributes": square(document)}]}]
    document.node(mesh=0)
    type_c = ("IESNA:LM-63-1995\n[TEST] seed\nTILT=INCLUDE\n1 2 0 90 1 0.9\n1 -1 2 3 3 1 2 0 0 0\n1 0.9 10\n"
              "0 45 90\n0 45 90\n9 5 1 9 4 2 9 3 3\n")
    type_b = "IES:LM-63-2019\r\nTILT=NONE\r\n1 -1 1 3 2 2 1 0 0 0\r\n1 1 10\r\n-90,0,90\r\n0 90\r\n1 9 1 2 2 2\r\n"
    data = "data:application/x-ies-lm-63;base64," + base64.b64encode(type_b.encode()).decode()
    profiles = [{"bufferView": document.view(type_c.encode()), "mimeType": "application/x-ies-lm-63"}, {"uri": data}]
    document.node(translation=[0, 1, 2], extensions={"EXT_lights_ies": {"light": 0, "multiplier": 2, "color": [1, 0.5, 0.2]}})
    document.node(translation=[1, 1, 1], scale=[1, -2, 1], extensions={"EXT_lights_ies": {"light": 1}})
    document.json["images"] = [{"bufferView": document.view(png(2, 2, kind)), "mimeType": "image/png"} for kind in (2, 6)]
    cube = {"intensity": 3, "rotation": [0, 0.6, 0, 0.8], "specularImageSize": 2, "specularImages": [[0, 1, 0, 1, 0, 1]],
            "irradianceCoefficients": 9 * [[0, 0, 0]]}
    document.json["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}
    document.json["extensions"] = {"EXT_lights_ies": {"lights": profiles}, "EXT_lights_image_based": {"lights": [cube]}}
    document.use("EXT_lights_ies", "EXT_lights_image_based")
    return document.glb()


def plain():
    """Returns a text file with its buffer as a data URI: a fan with integer positions."""
    positions = "AAAAAAEAAAABAAEAAAABAA=="  # four points of three signed bytes and a byte of padding
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [1]}, {}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 6}]}],
        "accessors": [{"bufferView": 0, "componentType": 5120, "type": "VEC3", "count": 4}],
        "bufferViews": [{"buffer": 0, "byteLength": 16, "byteStride": 4}],
        "buffers": [{"byteLength": 16, "uri": "data:application/octet-stream;base64," + positions}],
        "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"]}).encode()


def parts(command):
    """Returns parts of renders of a few pixels, and their JSON."""
    scene = "scenes/cornell-box.gltf"  # the part will contain this name
    project = pathlib.Path(__file__).resolve().parents[2]
    kinds = {"bdpt": ["--integrator", "bdpt"], "layers": ["--integrator", "mis", "--aov", "albedo,depth,variance,alpha", "--crop", "1,0,3,2"],
             "ids": ["--integrator", "pt", "--aov", "object,material"],
             "strategies": ["--integrator", "lt", "--strategy-depth", "2", "--clamp", "5"]}
    files = {}
    with tempfile.TemporaryDirectory() as scratch:
        for name, words in kinds.items():
            file = pathlib.Path(scratch) / f"{name}.part.exr"
            subprocess.run([pathlib.Path(command).resolve(), "render", scene, "--size", "4x3", "--samples", "3:5", "--part",
                            file, "--quiet", *words], check=True, cwd=project)
            files[file.name] = file.read_bytes()
            begin = files[file.name].index(b'{"format"')
            size, = struct.unpack("<I", files[file.name][begin - 4:begin])
            files[f"{name}.json"] = files[file.name][begin:begin + size]
    return files


def plans_and_rates(command):
    """Returns plans of an image, of frames and of cameras, and rates of a few pixels."""
    project = pathlib.Path(__file__).resolve().parents[2]
    kinds = {"image": ["--spp", "4", "--integrator", "bdpt", "--env", "none", "-o", "out.exr", "-o", "out.png", "--half", "--for", "make"],
             "frames": ["--spp", "2", "--frames", "1:3", "--fps", "8", "-o", "out.####.exr", "--for", "slurm"],
             "cameras": ["--spp", "2", "--cameras", "all", "-o", "out.{camera}.exr", "--strategies", "all.{camera}.exr", "--for", "make"],
             "rates": ["--spp", "16", "--adaptive", "-o", "out.exr", "--denoise", "--exposure", "1", "--for", "kubernetes"]}
    plans = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "scene.gltf").write_bytes((project / "scenes/motion.gltf").read_bytes())
        for name, words in kinds.items():
            subprocess.run([pathlib.Path(command).resolve(), "plan", "scene.gltf", "--size", "4x3", "--parts", "2", "--quiet", "-d", name,
                            *words], check=True, cwd=folder)
            plans[f"{name}.json"] = (folder / name / "plan.json").read_bytes()
        return plans, {"rates.exr": (folder / "rates/rates.exr").read_bytes()}


def main():
    folder = pathlib.Path(sys.argv[1])
    images = {"grey.png": png(3, 3, 0), "rgb.png": png(5, 2, 2), "rgba.png": png(4, 4), "halves.exr": exr(4, 2), **environments()}
    with tempfile.TemporaryDirectory() as scratch:
        source = pathlib.Path(scratch) / "source.png"
        for name, kind, how in (("small.jpg", 2, ()), ("small.webp", 2, ()),
                                ("progressive.jpg", 2, ("--attrib", "jpeg:progressive", "1")),
                                ("lossless.webp", 6, ("--compression", "lossless"))):
            source.write_bytes(png(8, 8, kind))
            made = pathlib.Path(scratch) / name
            subprocess.run(["oiiotool", source, "--nosoftwareattrib", *how, "-o", made], check=True)
            images[name] = made.read_bytes()
        source.write_bytes(exr(16, 16))
        made = pathlib.Path(scratch) / "tiles.exr"
        subprocess.run(["oiiotool", source, "--nosoftwareattrib", "--tile", "8", "8", "--compression", "zip", "-o", made],
                       check=True)
        images["tiles.exr"] = made.read_bytes()
    scenes = {"rig.glb": rig(), "stage.glb": stage(), "lamps.glb": lamps(), "fan.gltf": plain()}
    seeds = {"image": images, "scene": scenes}
    if len(sys.argv) > 2:
        seeds["part"] = parts(sys.argv[2])
        seeds["plan"], seeds["rates"] = plans_and_rates(sys.argv[2])
    for name, files in seeds.items():
        (folder / name).mkdir(parents=True, exist_ok=True)
        for file, data in files.items():
            (folder / name / file).write_bytes(data)


if __name__ == "__main__":
    main()
