#!/usr/bin/env python3
"""Makes small data sets and checks all of their files with independent code: dataset_test.py BDPT SCENES."""

import json
import math
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "ids"))
from exr_file import ExrFile

BDPT, SCENES = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
SMALL = ["--size", "32x24", "--spp", "2", "--integrator", "pt", "--views", "3", "--denoise=false"]
LAYERS = ["depth", "distance", "normal", "camera-normal", "uv", "position"]
ALL = ",".join([*LAYERS, "mask", "flow"])
BOX, SPOT = SCENES / "cornell-box.gltf", SCENES / "room-spot.gltf"


def expect(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")
    print(f"ok: {what}")


def run(*words, code=0):
    result = subprocess.run([BDPT, "dataset", *map(str, words)], capture_output=True, text=True, check=False)
    if result.returncode != code:
        sys.exit(f"failed: exit code {result.returncode} instead of {code} of {words}\n{result.stderr}")
    return result


def read_lines(file):
    return [json.loads(line) for line in file.read_text().splitlines()]


def read_integers(file):
    """Returns the rows of a grey PNG file of 16 bits."""
    data, at, pixels = file.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack_from(">IIBB", data, at + 8)
            assert (bits, color) == (16, 0), file
        pixels += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, rows, before = zlib.decompress(pixels), [], bytes(2 * width)
    for y in range(height):
        method, row = raw[y * (2 * width + 1)], bytearray(raw[y * (2 * width + 1) + 1:(y + 1) * (2 * width + 1)])
        for i in range(len(row)):
            left, up, corner = row[i - 2] if i > 1 else 0, before[i], before[i - 2] if i > 1 else 0
            guess = left + up - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest)[method]) & 255
        rows.append(struct.unpack(f">{width}H", row))
        before = row
    return rows


def product(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def read_pixels(file):
    """Returns the compressed pixels of a PNG file, without its metadata, which have times; of others all bytes."""
    data, at, pixels = file.read_bytes(), 8, b""
    if file.suffix != ".png":
        return data
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        pixels += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    return pixels


def contents(folder):
    """Returns all files but the manifests, which have times, too."""
    return {file.relative_to(folder): read_pixels(file) for file in sorted(folder.rglob("*"))
            if file.is_file() and file.name != "manifest.jsonl"}


def test_files(folder):
    broken = folder / "broken.gltf"
    broken.write_text("{")
    out = folder / "out"
    result = run(BOX, broken, SPOT, "-o", out, "--aov", ALL, "--coco", out / "coco.json", *SMALL, code=4)
    expect("6 views of 2 models; 1 failed" in result.stderr, "what was done is told")
    lines = read_lines(out / "manifest.jsonl")
    expect([line["model"] for line in lines] == ["broken"] + 4 * ["cornell-box"] + 4 * ["room-spot"], "the manifest is sorted")
    expect(lines[0]["code"] == 4 and "broken.gltf" in lines[0]["error"], "a broken model is told in the manifest")
    views = [line for line in lines if "view" in line]
    expect([line["view"] for line in views] == [0, 1, 2, 0, 1, 2], "each view is a line")
    for line in views:
        there = all((out / line["model"] / file).exists() for file in line["files"])
        has_flow = any("flow" in file for file in line["files"])
        expect(there and has_flow == (line["view"] < 2), f"view {line['view']} of {line['model']} has all of its files")
    return out


def check_poses(out, model):
    folder = out / model
    poses = json.loads((folder / "transforms.json").read_text())
    expect(len(poses["frames"]) == 3 and poses["w"] == 32 and poses["h"] == 24, f"{model}: poses of all views")
    worst, worst_depth, seen = 0.0, 0.0, 0
    for frame in poses["frames"]:
        stem = folder / frame["file_path"].removesuffix(".png")
        position, depth = ExrFile(stem.with_suffix(".position.exr")), ExrFile(stem.with_suffix(".depth.exr"))
        distance, normal = ExrFile(stem.with_suffix(".distance.exr")), ExrFile(stem.with_suffix(".normal.exr"))
        camera_normal = ExrFile(stem.with_suffix(".camera-normal.exr"))
        millimetres = read_integers(folder / frame["depth_file_path"])
        pose, world_to_camera = frame["transform_matrix"], frame["opencv"]
        eye = [row[3] for row in pose[:3]]
        for y in range(24):
            for x in range(32):
                z = depth.values["Z"][y][x]
                if not math.isfinite(z):
                    assert millimetres[y][x] == 0
                    continue
                point = [position.values[c][y][x] for c in "RGB"]
                local = product(world_to_camera, [*point, 1.0])
                u = poses["fl_x"] * local[0] / local[2] + poses["cx"]
                v = poses["fl_y"] * local[1] / local[2] + poses["cy"]
                # The same by OpenGL's matrix: the transpose of a rotation is its inverse.
                gl = [sum(pose[r][c] * (point[r] - eye[r]) for r in range(3)) for c in range(3)]
                u_gl, v_gl = poses["cx"] - poses["fl_x"] * gl[0] / gl[2], poses["cy"] + poses["fl_y"] * gl[1] / gl[2]
                worst = max(worst, abs(u - x - 0.5), abs(v - y - 0.5), abs(u_gl - x - 0.5), abs(v_gl - y - 0.5))
                worst_depth = max(worst_depth, abs(local[2] - z) / z, abs(math.dist(eye, point) - distance.values["Z"][y][x]) / z)
                assert abs(millimetres[y][x] - min(round(1000 * z), 65535)) <= 1
                n = [normal.values[c][y][x] for c in "RGB"]
                turned = [sum(pose[r][c] * n[r] for r in range(3)) for c in range(3)]
                assert max(abs(a - camera_normal.values[c][y][x]) for a, c in zip(turned, "RGB")) < 1e-4
                assert camera_normal.values["B"][y][x] > -0.2 and abs(math.hypot(*n) - 1) < 1e-3
                seen += 1
    expect(seen > 200 and worst < 0.01, f"{model}: positions appear in the middle of their pixels ({worst:.2g} pixels off)")
    expect(worst_depth < 1e-4, f"{model}: depth is along the axis, distance along the ray")


def check_masks(out, model, coco):
    folder = out / model
    names = json.loads((folder / "masks.json").read_text())
    expect(all(names[kind][0] == "" for kind in ("object", "instance", "material")), f"{model}: 0 has no name")
    categories = {category["id"]: category["name"] for category in coco["categories"]}
    for number in range(3):
        masks = {kind: read_integers(folder / f"{number:04}.{kind}.png") for kind in names}
        assert all(max(map(max, rows)) < len(names[kind]) for kind, rows in masks.items())
        (image,) = [image for image in coco["images"] if image["file_name"] == f"{model}/{number:04}.png"]
        found = [one for one in coco["annotations"] if one["image_id"] == image["id"]]
        instances = {value for row in masks["instance"] for value in row} - {0}
        assert sorted(one["instance"] for one in found) == sorted(instances) and instances
        for one in found:
            pixels = [(x, y) for y, row in enumerate(masks["instance"]) for x, value in enumerate(row) if value == one["instance"]]
            xs, ys = [x for x, _ in pixels], [y for _, y in pixels]
            assert one["area"] == len(pixels)
            assert one["bbox"] == [min(xs), min(ys), max(xs) - min(xs) + 1, max(ys) - min(ys) + 1]
            assert {names["object"][masks["object"][y][x]] for x, y in pixels} == {categories[one["category_id"]]}
            decoded, value = [], 0
            for count in one["segmentation"]["counts"]:
                decoded += [value] * count
                value = 1 - value
            height, width = one["segmentation"]["size"]
            assert [(i // height, i % height) for i, inside in enumerate(decoded) if inside] == sorted(pixels)
            assert len(decoded) == width * height
    print(f"ok: {model}: COCO's boxes, areas and masks are those of the masks")


def check_flow(out, model):
    """Follows a pixel to the next view: the same point is there."""
    folder = out / model
    followed = 0
    for number in range(2):
        flow, here = ExrFile(folder / f"{number:04}.flow.exr"), ExrFile(folder / f"{number:04}.position.exr")
        there = json.loads((folder / "transforms.json").read_text())
        frame = there["frames"][number + 1]
        for y in range(24):
            for x in range(32):
                if not flow.values["B"][y][x]:
                    continue
                point = [here.values[c][y][x] for c in "RGB"]
                local = product(frame["opencv"], [*point, 1.0])
                u = there["fl_x"] * local[0] / local[2] + there["cx"]
                v = there["fl_y"] * local[1] / local[2] + there["cy"]
                assert abs(x + 0.5 + flow.values["R"][y][x] - u) < 0.01 and abs(y + 0.5 + flow.values["G"][y][x] - v) < 0.01
                followed += 1
    expect(followed > 5, f"{model}: flow leads to the next view ({followed} pixels)")


def test_again(out):
    before = contents(out)
    result = run(BOX, SPOT, "-o", out, "--aov", ALL, "--json", *SMALL)
    events = [json.loads(line) for line in result.stdout.splitlines()]
    expect([event["rendered"] for event in events if event["event"] == "model"] == [0, 0], "what is there is not rendered again")
    expect(contents(out) == before, "and not changed")
    (out / "cornell-box" / "0001.png").unlink()
    run(BOX, SPOT, "-o", out, "--aov", ALL, *SMALL)
    expect(contents(out) == before, "a removed file is made again, with the same bits")


def test_other_options(folder):
    out = folder / "small"
    run(BOX, "-o", out, *SMALL)
    before = contents(out)
    result = run(BOX, "-o", out, *SMALL, "--seed", "3", code=6)
    expect("--restart" in result.stderr and contents(out) == before, "views of other options are not replaced")
    run(BOX, "-o", out, *SMALL, "--seed", "3", "--restart")
    expect(contents(out).keys() == before.keys() and contents(out) != before, "but with --restart")


def test_shares(folder, whole):
    shares = [folder / "share0", folder / "share1"]
    for number, out in enumerate(shares):
        run(BOX, SPOT, "-o", out, "--aov", ALL, *SMALL, "--share", f"{number}/2")
    joined = contents(shares[0]) | contents(shares[1])
    expected = {file: data for file, data in contents(whole).items() if file.name != "coco.json"}
    expect(joined == expected, "two processes that share the models make the files of one")
    alone = folder / "alone"
    run(SPOT, "-o", alone, "--aov", ALL, *SMALL, "--isolate=false", "--threads", "1")
    expect(contents(alone).items() <= expected.items(), "a model does not depend on other models, processes and threads")


def test_kills(folder, whole):
    out, kills = folder / "killed", 0
    words = [BDPT, "dataset", str(BOX), str(SPOT), "-o", str(out), "--aov", ALL, *SMALL]
    while True:
        views = len(list(out.rglob("*.png")))
        process = subprocess.Popen(words, stderr=subprocess.DEVNULL)
        while process.poll() is None and (kills >= 5 or len(list(out.rglob("*.png"))) == views):
            time.sleep(0.005)
        if process.poll() == 0:
            break
        process.kill()
        process.wait()
        kills += 1
    expected = {file: data for file, data in contents(whole).items() if file.name != "coco.json"}
    found = {file: data for file, data in contents(out).items() if ".tmp-" not in file.name}
    expect(kills >= 3 and found == expected, f"killed {kills} times, it has the bits of one run")


def test_exposure(folder):
    """Makes the other views when the first one is there: they keep its exposure."""
    cases = {"orbit": (BOX, "--orbit", "4"), "cameras": (SCENES / "motion.gltf", "--cameras", "all"), "drawn": (BOX, "--views", "3")}
    for name, words in cases.items():
        words = [*words, "--env", "studio", "--size", "32x24", "--spp", "2", "--integrator", "pt", "--denoise=false"]
        whole, again = folder / f"{name}-whole", folder / f"{name}-again"
        run(*words, "-o", whole)
        shutil.copytree(whole, again)
        for file in sorted(again.rglob("*.png"))[1:]:
            file.unlink()
        run(*words, "-o", again)
        expect(contents(again) == contents(whole), f"{name}: views keep the exposure of the first one, also when it is there")


def test_environments(folder):
    """Lets models draw one of several environments."""
    for index in range(3):
        write_hdr(folder / f"sky{index}.hdr", index)
    out = folder / "skies"
    run(BOX, SPOT, "-o", out, *SMALL, "--env", folder / "sky*.hdr")
    lines = [line for line in read_lines(out / "manifest.jsonl") if "view" in line]
    drawn = {model: {line["env"] for line in lines if line["model"] == model} for model in ("cornell-box", "room-spot")}
    expect(all(len(names) == 1 for names in drawn.values()), "all views of a model have the environment that it draws")


def write_hdr(file, index):
    """Writes a grey Radiance image of 8 x 4 pixels, without run lengths."""
    file.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes([128, 128, 128, 128 + index]) * 32)


def test_stop(folder):
    out = folder / "stopped"
    words = [BDPT, "dataset", str(BOX), str(SPOT), "-o", str(out), *SMALL, "--spp", "2000"]
    process = subprocess.Popen(words, stderr=subprocess.DEVNULL)
    while not out.is_dir() or not any(out.rglob("*")):
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    expect(process.wait() == 143, "SIGTERM ends it with 143")
    pictures = {file for file in out.rglob("*.png")}
    lines = [line for file in out.rglob("*/manifest.jsonl") for line in read_lines(file) if "view" in line]
    expect(len(pictures) == len(lines), "no picture lacks samples")


def test_limits(folder):
    out = folder / "limits"
    result = run(BOX, SPOT, "-o", out, *SMALL, "--spp", "10000000", "--model-time", "0.5", code=7)
    lines = read_lines(out / "manifest.jsonl")
    expect([line["code"] for line in lines] == [7, 7] and "--model-time" in lines[0]["error"], "a model has a limit of time")
    expect(result.stderr.count("--model-time") == 2, "which is told")
    result = run(BOX, "-o", out, *SMALL, "--max-memory", "100K", code=4)
    expect("--max-memory" in result.stderr, "and of memory")


def test_poses(folder, whole):
    out = folder / "again"
    run(BOX, "-o", out, "--poses", whole / "cornell-box" / "transforms.json", "--spp", "1", "--aov", "depth", "--integrator", "pt")
    worst = 0.0
    for number in range(3):
        ours = ExrFile(out / "cornell-box" / f"{number:04}.depth.exr").values["Z"]
        theirs = ExrFile(whole / "cornell-box" / f"{number:04}.depth.exr").values["Z"]
        worst = max(worst, *(abs(a - b) for p, q in zip(ours, theirs) for a, b in zip(p, q) if math.isfinite(a) and math.isfinite(b)))
    expect(worst < 1e-3, "poses give the same views again")


def test_frames(folder):
    out = folder / "frames"
    moving = folder / "moving.gltf"
    document = json.loads(BOX.read_text())
    data = struct.pack("<2f", 0.0, 1.0) + struct.pack("<6f", 0, 0, 0, 0.2, 0, 0)
    document["buffers"][0]["uri"] = document["buffers"][0]["uri"]
    (folder / "moving.bin").write_bytes(data)
    document["buffers"].append({"uri": "moving.bin", "byteLength": len(data)})
    for buffer in document["buffers"][:-1]:
        if not buffer["uri"].startswith("data:"):
            (folder / buffer["uri"]).write_bytes((SCENES / buffer["uri"]).read_bytes())
    number = len(document["buffers"]) - 1
    views = document["bufferViews"]
    views += [{"buffer": number, "byteLength": 8}, {"buffer": number, "byteOffset": 8, "byteLength": 24}]
    document["accessors"] += [
        {"bufferView": len(views) - 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
        {"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": "VEC3"}]
    (node,) = [i for i, node in enumerate(document["nodes"]) if node.get("name", "").startswith("tall")][:1]
    document["animations"] = [{"samplers": [{"input": len(document["accessors"]) - 2, "output": len(document["accessors"]) - 1}],
                               "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}]}]
    moving.write_text(json.dumps(document))
    run(moving, "-o", out, "--frames", "0:2", "--fps", "2", "--aov", "flow,mask", "--size", "32x32", "--spp", "1", "--integrator", "pt")
    flow, mask = ExrFile(out / "moving" / "0000.flow.exr"), read_integers(out / "moving" / "0000.object.png")
    names = json.loads((out / "moving" / "masks.json").read_text())["object"]
    moved = {names[mask[y][x]] for y in range(32) for x in range(32) if abs(flow.values["R"][y][x]) > 0.05}
    expect(len(moved) == 1 and moved.pop().startswith("tall"), "flow follows what is animated, and nothing else")
    times = [frame["time"] for frame in json.loads((out / "moving" / "transforms.json").read_text())["frames"]]
    expect(times == [0, 0.5, 1], "poses have the times of frames")


def test_names(folder):
    for name in ("a", "b"):
        (folder / name).mkdir()
        (folder / name / "model.gltf").write_bytes(BOX.read_bytes())
        for file in SCENES.glob("cornell-box*.bin"):
            (folder / name / file.name).write_bytes(file.read_bytes())
    pattern = folder / "?" / "model.gltf"
    result = run(pattern, "-o", folder / "named", *SMALL, code=2)
    expect("same name" in result.stderr and "--root" in result.stderr and not (folder / "named").exists(), "names that collide are told")
    run(pattern, "-o", folder / "named", *SMALL, "--root", folder)
    expect((folder / "named" / "b" / "model" / "0002.png").exists(), "--root names models by their folders")
    result = run(folder / "none" / "*.glb", "-o", folder / "named", code=3)
    expect("no file matches" in result.stderr, "a pattern without files is told")
    result = run(BOX, "-o", folder / "named", "--root", folder / "a", code=2)
    expect("not below --root" in result.stderr, "so is a model beside the root")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = test_files(folder)
        coco = json.loads((out / "coco.json").read_text())
        for model in ("cornell-box", "room-spot"):
            check_poses(out, model)
            check_masks(out, model, coco)
            check_flow(out, model)
        (out / "broken" / "manifest.jsonl").unlink()
        (out / "broken").rmdir()
        test_again(out)
        test_other_options(folder)
        test_shares(folder, out)
        test_kills(folder, out)
        test_exposure(folder)
        test_environments(folder)
        test_stop(folder)
        test_limits(folder)
        test_poses(folder, out)
        test_frames(folder)
        test_names(folder)


main()
