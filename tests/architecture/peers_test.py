#!/usr/bin/env python3
"""Tests benchmarks/peers without any peer: peers_test.py [BDPT]. Skips tests that need the command without it."""

import dataclasses
import json
import math
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks" / "peers"))
import contest
import cycles_peer
import gltf_reader
import gltf_writer
import luxcore_peer
import mitsuba_peer
import peers
import report
from scene import Medium, NotShared, from_json, to_json

BDPT = sys.argv.pop(1) if len(sys.argv) > 1 else None
REFUSED = {"night-market": "spot light", "orthographic": "perspective", "room-environment": "no light",
           "room-profiles": "no light", "room-spot": "spot light", "room-sun": "directional light",
           "textured-emitter": "no light"}
JOB = {"width": 40, "height": 20, "max_depth": 7, "integrator": "PATHCPU", "seed": 3, "threads": 2, "output": "o.exr",
       "roulette": False}


def scene(name):
    return gltf_reader.read(ROOT / "scenes" / f"{name}.gltf")


def find_mesh(described, name):
    return next(mesh for mesh in described.meshes if mesh.name == name)


def area_vector(mesh):
    """Returns the sum of area times normal over its triangles."""
    total = [0.0, 0.0, 0.0]
    for a, b, c in ([mesh.positions[i] for i in triangle] for triangle in mesh.triangles):
        e, f = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        for i in range(3):
            total[i] += (e[i - 2] * f[i - 1] - e[i - 1] * f[i - 2]) / 2
    return total


class Reader(unittest.TestCase):
    def test_all_scenes_are_read_or_refused_with_the_reason(self):
        for file in sorted((ROOT / "scenes").glob("*.gltf")):
            with self.subTest(file.stem):
                if file.stem in REFUSED:
                    with self.assertRaisesRegex(NotShared, REFUSED[file.stem]):
                        gltf_reader.read(file)
                else:
                    described = gltf_reader.read(file)
                    self.assertEqual(from_json(to_json(described)), described)

    def test_files_that_are_no_such_glTF(self):
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / "broken.gltf"
            for content in (b"glTF\x02\xff", b"[]", b"{}", b'{"buffers": [{"uri": "box.bin"}]}',
                            b'{"buffers": [{"uri": "data:,"}], "scenes": [{"nodes": [7]}]}'):
                file.write_bytes(content)
                with self.assertRaisesRegex(NotShared, "broken.gltf: "):
                    gltf_reader.read(file)

    def test_lamp(self):
        described = scene("cornell-box")
        lamp = find_mesh(described, "lamp")
        for value, expected in zip(area_vector(lamp), (0, -0.13 * 0.105, 0)):
            self.assertAlmostEqual(value, expected, places=6)
        for value, expected in zip(described.materials[lamp.material].emission, (17, 12, 4)):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertEqual(described.changes, ())
        self.assertEqual(sum(len(mesh.triangles) for mesh in described.meshes), 32)
        self.assertEqual(described.camera.direction, (0, 0, 1))
        self.assertAlmostEqual(described.camera.vertical_fov, 2 * math.atan(0.0125 / 0.035), places=6)

    def test_transforms(self):
        """Tests that plates that emit downwards still do when they are mirrored."""
        described = scene("instances")
        for name in ("plain plate", "mirrored plate"):
            vector = area_vector(find_mesh(described, name))
            self.assertAlmostEqual(vector[1], -0.09, places=5)
        x = [p[0] for p in find_mesh(described, "mirrored plate").positions]
        self.assertAlmostEqual(sum(x) / len(x), 1.6, places=5)

    def test_sphere_light(self):
        described = scene("veach-plates")
        lamp = next(m for m in described.materials if m.name == "lamp of radius 0.3 m")
        file = json.loads((ROOT / "scenes" / "veach-plates.gltf").read_text(encoding="utf-8"))
        light = next(item for item in file["extensions"]["KHR_lights_punctual"]["lights"] if item["name"] == lamp.name)
        for value, color in zip(lamp.emission, light["color"]):
            self.assertAlmostEqual(value, light["intensity"] * color / (math.pi * 0.09), places=3)
        ball = find_mesh(described, lamp.name)
        center = [sum(p[i] for p in ball.positions) / len(ball.positions) for i in range(3)]
        outwards = sum(c * n for c, n in zip([p - q for p, q in zip(ball.positions[0], center)],
                                             area_vector(dataclasses.replace(ball, triangles=ball.triangles[:1]))))
        self.assertGreater(outwards, 0)

    def test_materials(self):
        described = scene("glass-rough")
        by_name = {material.name: material for material in described.materials}
        self.assertEqual((by_name["gold"].kind, by_name["gold"].color), ("metal", (1, 1, 1)))
        self.assertAlmostEqual(by_name["gold"].alpha, 0.04)
        self.assertEqual((by_name["glass of roughness 0"].alpha, by_name["glass of roughness 0"].ior), (0, 1.5))
        self.assertAlmostEqual(by_name["glass of roughness 0.6"].alpha, 0.36)
        self.assertNotIn("thin pane", by_name)
        changes = "\n".join(described.changes)
        for part in ("gold reflects all light", "amber is clear", "thin pane is left out", "flat"):
            self.assertIn(part, changes)
        self.assertEqual(described.kinds(), {"diffuse", "glass", "rough glass", "rough metal"})


    def test_media(self):
        described = scene("tea-glass")
        tea = next(material for material in described.materials if material.name == "tea").inside
        for value, color in zip(tea.extinction, (0.78, 0.33, 0.08)):
            self.assertAlmostEqual(math.exp(-0.03 * value), color)
        self.assertEqual(tea.anisotropy, 0.6)
        self.assertEqual(sorted(tea.albedo, reverse=True), list(tea.albedo))
        glass = next(material for material in described.materials if material.name == "glass")
        self.assertIsNone(glass.inside)
        self.assertNotIn("tea is clear", described.changes)
        self.assertIn("media", described.kinds())
        self.assertNotIn("media", scene("glass-rough").kinds())
        self.assertIn("wax is left out: not all renderers have it", scene("candle").changes)

    def test_sphere_of_the_fog(self):
        center, radius = scene("furnace").sphere()
        self.assertEqual(center, (0, 0, 0))
        self.assertAlmostEqual(radius, math.sqrt(3))


class Writer(unittest.TestCase):
    def test_albedo_is_that_of_the_colour(self):
        for color in (0.0, 0.01, 0.3, 0.7, 0.99):
            albedo = gltf_reader.medium({}, {"multiscatterColor": (color,) * 3}).albedo[0]
            self.assertAlmostEqual(gltf_writer.multiscatter(albedo), color, places=6)
        self.assertAlmostEqual(gltf_reader.medium({}, {"multiscatterColor": (0.5,)}).albedo[0], 0.9117088, places=6)

    def test_what_is_written_is_read_again(self):
        with tempfile.TemporaryDirectory() as name:
            for stem in ("glass-rough", "room-point", "door-ajar", "tea-glass"):
                file = pathlib.Path(name) / f"{stem}.gltf"
                first = scene(stem)
                gltf_writer.write(first, file)
                again = gltf_reader.read(file)
                self.assertEqual(again.changes, ())
                self.assertEqual([mesh.triangles for mesh in again.meshes], [mesh.triangles for mesh in first.meshes])
                for a, b in zip(first.materials, again.materials):
                    self.assertEqual((a.name, a.kind, a.color, a.ior), (b.name, b.kind, b.color, b.ior))
                    self.assertAlmostEqual(a.alpha, b.alpha, places=6)
                    self.assertEqual(bool(a.emission), bool(b.emission))
                    self.assertEqual(bool(a.inside), bool(b.inside))
                    if a.inside:
                        for x, y in zip(a.inside.extinction + a.inside.albedo, b.inside.extinction + b.inside.albedo):
                            self.assertAlmostEqual(x, y, delta=2e-6 * max(1, x))
                for mesh, copy in zip(first.meshes, again.meshes):
                    self.assertLess(max(abs(x - y) for p, q in zip(mesh.positions, copy.positions)
                                        for x, y in zip(p, q)), 1e-6)
                for a, b in zip(first.points, again.points):
                    for x, y in zip(a.intensity + a.position, b.intensity + b.position):
                        self.assertAlmostEqual(x, y, delta=1e-5 * max(1, abs(x)))
                for x, y in zip(first.camera.direction + first.camera.up, again.camera.direction + again.camera.up):
                    self.assertAlmostEqual(x, y, places=5)

    @unittest.skipUnless(BDPT, "no command is given")
    def test_bdpt_sees_the_same(self):
        """Compares images of a scene and of its copy, where the copy has no changes."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            gltf_writer.write(scene("cornell-box-hidden"), folder / "copy.gltf")
            for file in (ROOT / "scenes" / "cornell-box-hidden.gltf", folder / "copy.gltf"):
                subprocess.run([BDPT, "render", str(file), "-o", str(folder / f"{file.stem}.exr"), "--size", "24x24",
                                "--spp", "8", "--quiet"], check=True)
            done = subprocess.run([BDPT, "compare", str(folder / "copy.exr"), str(folder / "cornell-box-hidden.exr"),
                                   "--json", "--metrics", "relmse"], check=True, stdout=subprocess.PIPE, text=True)
            self.assertLess(json.loads(done.stdout)["metrics"]["relmse"]["mean"], 1e-6)


class Adapters(unittest.TestCase):
    def test_surfaces(self):
        rough = scene("glass-rough").materials
        kinds = {m.name: mitsuba_peer.bsdf(m) for m in rough}
        self.assertEqual(kinds["gold"]["bsdf"]["type"], "roughconductor")
        self.assertEqual(kinds["glass of roughness 0"], {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0})
        self.assertEqual(kinds["grey"]["type"], "twosided")
        lamp = next(m for m in rough if m.emission)
        values = luxcore_peer.material_properties("m", lamp)
        self.assertEqual(values["scene.materials.m.type"], "matte")
        self.assertEqual(values["scene.materials.m.emission"], list(lamp.emission))

    def test_media_of_mitsuba(self):
        described = mitsuba_peer.medium(Medium((2.0, 4.0, 1.0), (0.9, 0.8, 0.7), 0.3))
        self.assertEqual((described["scale"], described["sigma_t"]["value"]), (4.0, [0.5, 1.0, 0.25]))
        self.assertEqual((described["albedo"]["value"], described["phase"]["g"]), ([0.9, 0.8, 0.7], 0.3))
        tea = next(material for material in scene("tea-glass").materials if material.name == "tea")
        self.assertEqual(mitsuba_peer.bsdf(dataclasses.replace(tea, ior=1)), {"type": "null"})
        self.assertEqual(mitsuba_peer.bsdf(tea)["type"], "dielectric")

    def test_bodies_in_fog_of_mitsuba(self):
        described = dataclasses.replace(scene("tea-glass"), fog=Medium((1, 1, 1), (1, 1, 1)))
        mi = types.SimpleNamespace(ScalarTransform4f=lambda: types.SimpleNamespace(look_at=lambda *places: places))
        with tempfile.TemporaryDirectory() as folder:
            result = mitsuba_peer.description(mi, described, JOB, pathlib.Path(folder))
        fog = {"type": "ref", "id": "fog"}
        extent = next(item for item in result.values() if isinstance(item, dict) and item["type"] == "sphere")
        self.assertEqual((extent["interior"], extent["radius"]), (fog, described.sphere()[1]))
        for i, mesh in enumerate(described.meshes):
            shape, name = result[f"mesh{i}"], described.materials[mesh.material].name
            self.assertEqual(shape.get("exterior"), fog if name in ("glass", "tea") else None)
            self.assertEqual("interior" in shape, name == "tea")

    def test_who_has_media(self):
        names = {entry.name for entry in peers.ENTRIES if "media" not in entry.cannot_show}
        self.assertEqual(names, {"bdpt", "bdpt-auto", "bdpt-mis", "mitsuba-volpath", "mitsuba-volpathmis"})
        volpath = next(entry for entry in peers.ENTRIES if entry.name == "mitsuba-volpath")
        self.assertEqual((volpath.lacks(scene("cornell-box")), volpath.lacks(scene("tea-glass"))), ("media", ""))

    def test_fog_of_bdpt(self):
        self.assertEqual(contest.fog_options(None), ())
        self.assertEqual(contest.fog_options(Medium((1, 2, 3), (1, 0.5, 1), 0.1)),
                         ("--fog", "1,2,3", "--fog-albedo", "1,0.5,1", "--fog-anisotropy", "0.1"))

    def test_camera_of_luxcore(self):
        """Tests that the window compensates LuxCore's row offset, and that the field of view is vertical."""
        camera = scene("cornell-box").camera
        values = luxcore_peer.camera_properties(camera, JOB)
        self.assertEqual(values["scene.camera.screenwindow"], [-2.0, 2.0, -1.1, 0.9])
        self.assertAlmostEqual(values["scene.camera.fieldofview"], math.degrees(camera.vertical_fov))

    def test_lengths_are_edges(self):
        self.assertEqual(luxcore_peer.settings(JOB)["path.pathdepth.total"], 7)
        self.assertEqual(luxcore_peer.settings(JOB)["path.russianroulette.depth"], 8)
        self.assertNotIn("path.russianroulette.depth", luxcore_peer.settings({**JOB, "roulette": True}))
        cycles = Recorder()
        cycles_peer.configure(cycles, JOB)
        self.assertEqual(cycles.cycles.max_bounces, 5)

    def test_light_tracing_is_kept_from_mirrors(self):
        ptracer = next(entry for entry in peers.ENTRIES if entry.name == "mitsuba-ptracer")
        self.assertEqual(ptracer.unsupported_kinds(scene("cornell-box")), "")
        self.assertEqual(ptracer.unsupported_kinds(scene("cornell-spheres")), "glass, metal")
        stage = types.SimpleNamespace(name="cornell-spheres", scene=scene("cornell-spheres"),
                                      options=types.SimpleNamespace(seeds=1))
        runs, skipped = contest.contest(stage, [ptracer], {}, print)
        self.assertEqual(runs, {})
        self.assertEqual(skipped, {"mitsuba-ptracer": "it does not show glass, metal"})


class Recorder:
    """Provides any attribute that is requested."""

    def __getattr__(self, name):
        self.__dict__[name] = Recorder()
        return self.__dict__[name]


def bias_report(value, error):
    channels = ("red", "green", "blue", "mean")
    return {"bias": {channel: {"value": value, "standard_error": error} for channel in channels}}


class Judgement(unittest.TestCase):
    def test_means(self):
        """Tests that errors of three images and of the reference add up as variances."""
        far = contest.decide_means([bias_report(0.12, 0.03)] * 3, {"mean": 0.01})["mean"]
        self.assertAlmostEqual(far["standard_error"], math.hypot(0.03 / math.sqrt(3), 0.01))
        self.assertAlmostEqual(far["z"], 0.12 / far["standard_error"])
        spread = contest.decide_means([bias_report(v, 0.001) for v in (-1.0, 0.0, 1.0)], {})["mean"]
        self.assertAlmostEqual(spread["standard_error"], 1 / math.sqrt(3))
        self.assertEqual(spread["z"], 0)

    def test_excess(self):
        told = {"bias": {"pixel_standard_error": 0.1}, "metrics": {"mse": {"mean": 0.14}}}
        self.assertAlmostEqual(contest.excess(told, 4, 0.03), 2.0)

    def test_noise_of_the_reference(self):
        self.assertEqual(contest.own_errors([0.5, 0.75, 0.25], 0.125), [0.375, 0.625, 0.125])
        self.assertEqual(contest.own_errors([0.5, 0.75, 0.25], 0.375), [])

    def test_ratio_is_at_equal_time(self):
        ours = {"relmse": [0.1, 0.2, 0.1], "seconds": [2.0, 1.0, 2.0]}
        theirs = {"relmse": [0.4, 0.4, 0.4], "seconds": [1.0, 1.0, 4.0]}
        self.assertAlmostEqual(contest.ratio(theirs, ours, "seconds"), 2.0)
        self.assertIsNone(contest.ratio(theirs, {"relmse": [0.0], "seconds": [1.0]}, "seconds"))
        self.assertIsNone(contest.ratio({"relmse": [], "seconds": [1.0]}, ours, "seconds"))

    @unittest.skipUnless(BDPT, "no command is given")
    def test_a_image_without_indirect_light_differs(self):
        options = contest.Options(BDPT, None, None, 3, (16, 16), 16, 2)
        with tempfile.TemporaryDirectory() as folder:
            stage = contest.Stage(options, ROOT / "scenes" / "cornell-box.gltf", pathlib.Path(folder))
            stage.reference = stage.folder / "reference.exr"
            stage.reference_run = contest.run_bdpt(options, stage.gltf, None, "bdpt", contest.REFERENCE_SEED,
                                                   ("--spp", "256"), stage.reference)
            runs = {}
            for name, integrator, depth in (("bdpt", "bdpt", 16), ("bdpt-mis", "mis", 16), ("short", "bdpt", 2)):
                (stage.folder / name).mkdir()
                runs[name] = []
                for seed in range(3):
                    image = stage.folder / name / f"{seed}.exr"
                    told = contest.run_bdpt(dataclasses.replace(options, max_depth=depth), stage.gltf, None, integrator, seed,
                                            ("--spp", "16"), image)
                    runs[name].append({**told, "picture": str(image)})
            entries = contest.judge(stage, runs)["entries"]
        self.assertEqual({name: entry["agrees"] for name, entry in entries.items()},
                         {"bdpt": True, "bdpt-mis": True, "short": False})
        self.assertAlmostEqual(entries["bdpt"]["ratio_seconds"], 1.0)


def program(folder, name, text):
    file = folder / name
    file.write_text(f"#!{sys.executable}\n{text}\n", encoding="utf-8")
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    return str(file)


class Missing(unittest.TestCase):
    def test_reasons(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            failures = {"import os; os.abort()": "signal 6", 
                        "import no_such_module": "No module named 'no_such_module'", "pass": "exit code 0"}
            for text, reason in failures.items():
                with self.assertRaisesRegex(peers.Unavailable, reason):
                    peers.find("luxcore", (program(folder, "peer", text),), folder)
            with self.assertRaisesRegex(peers.Unavailable, "nowhere is not there"):
                peers.find("luxcore", ("nowhere",), folder)

    def test_mitsuba_compiles_with_the_newest_llvm_and_does_without(self):
        files = ["/usr/lib/a/libLLVM-15.so", "/usr/lib/a/libLLVM-15.so.1", "/usr/lib/a/libLLVM.so",
                 "/usr/lib/a/libLLVM.so.19.1", "/usr/lib/a/libLLVM-9.so"]
        with unittest.mock.patch.dict(os.environ), unittest.mock.patch("glob.glob", side_effect=[files, []]):
            os.environ.pop("DRJIT_LIBLLVM_PATH", None)
            ways = peers.candidates("mitsuba")
        self.assertEqual([environment.get("DRJIT_LIBLLVM_PATH") for _, environment in ways],
                         [files[3], files[0], files[4], None])
        self.assertEqual([job["variant"] for job, _ in ways], ["llvm_ad_rgb"] * 3 + ["scalar_rgb"])

    @unittest.skipUnless(BDPT, "no command is given")
    def test_peers_that_are_not_there_are_skipped(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            tool = ROOT / "benchmarks" / "peers" / "compare_peers.py"
            scenes = [str(ROOT / "scenes" / f"{stem}.gltf") for stem in ("cornell-box", "room-sun")]
            done = subprocess.run([sys.executable, str(tool), *scenes, "-o", str(folder), "--bdpt", BDPT, "--python",
                                   "no-python", "--blender", "no-blender", "--time", "0.05", "--seeds", "2", "--size",
                                   "16x16"], stdout=subprocess.PIPE, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout)
            text = (folder / "results.txt").read_text(encoding="utf-8")
            for line in ("mitsuba: skipped: no-python is not there", "luxcore: skipped: no-python is not there",
                         "cycles: skipped: no-blender is not there", "room-sun: skipped: "):
                self.assertIn(line, text)
            document = json.loads((folder / "results.json").read_text(encoding="utf-8"))
            self.assertEqual(set(document["missing"]), set(peers.PEERS))
            entries = document["scenes"][0]["entries"]
            self.assertEqual(set(entries), {"bdpt", "bdpt-auto", "bdpt-mis"})
            self.assertEqual(len((folder / "results.csv").read_text(encoding="utf-8").splitlines()), 4)


class Readme(unittest.TestCase):
    def test_it_knows_all_entries(self):
        text = (ROOT / "benchmarks" / "peers" / "README.md").read_text(encoding="utf-8")
        described = {line.split("`")[1] for line in text.splitlines() if re.match(r"\| `(bdpt|\w+-\w+|cycles)", line)}
        self.assertEqual(described, {entry.name for entry in peers.ENTRIES})

    def test_columns(self):
        self.assertEqual(report.table([("a", "bb"), ("ccc", "d")]), "a    bb\nccc   d")


if __name__ == "__main__":
    unittest.main()
