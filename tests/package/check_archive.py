"""Tests the relocatable archive: check_archive.py ARCHIVE FOLDER SCENES VERSION OPENVDB.

Unpacks it into FOLDER, away from the build, and runs it there; as root also in a file system that contains only glibc.
OPENVDB is 1 if the build has the reader of volumes.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

GLIBC = re.compile(r"(ld-linux[\w-]*|lib(c|m|mvec|pthread|dl|rt|util|resolv))\.so[.\d]*$")
BARE = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}


def find_elf_files(folder):
    for file in sorted(folder.rglob("*")):
        if file.is_file() and not file.is_symlink():
            with file.open("rb") as stream:
                if stream.read(4) == b"\x7fELF":
                    yield file


def read_dynamic_section(file):
    """Returns the names of the needed libraries, and their search folders."""
    text = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
    folders = re.findall(r"\((?:RUNPATH|RPATH)\).*\[(.*)\]", text)
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", text)), [name for names in folders for name in names.split(":")]


def check_libraries(root):
    """Tests that every needed library is in the archive or in glibc. Returns the files of the local glibc that are
    needed."""
    glibc = set()
    files = list(find_elf_files(root))
    assert len(files) > 10, files
    for file in files:
        needed, folders = read_dynamic_section(file)
        assert folders and all(re.fullmatch(r"\$ORIGIN(/\.\.(/[\w./-]+)?)?", name) for name in folders), (file, folders)
        places = [pathlib.Path(name.replace("$ORIGIN", str(file.parent))) for name in folders]
        for name in needed:
            if not GLIBC.match(name):
                found = [place / name for place in places if (place / name).exists()]
                assert found and found[0].resolve().is_relative_to(root), f"{file} needs {name}, which is not there"
        said = subprocess.run(["ldd", file], check=True, capture_output=True, text=True, env=BARE).stdout
        for name, path in re.findall(r"^\s*(?:(\S+) => )?(/\S.*?) \(0x", said, flags=re.M):
            if GLIBC.match(pathlib.Path(name or path).name):
                glibc.add(pathlib.Path(path))
            else:
                assert pathlib.Path(path).resolve().is_relative_to(root), f"{file} takes {path}"
    return glibc


def render(command, scenes, out, volume, **how):
    """Renders to `out`; `command` has the words before those of bdpt."""
    words = ["render", f"{scenes}/cornell-box.gltf", "--size", "16x16", "--spp", "1", "--quiet", "-o", str(out)]
    words += ["--volume", f"{scenes}/smoke.vdb"] if volume else []
    done = subprocess.run([*command, *words, "--json"], env=BARE, capture_output=True, text=True, check=False, **how)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    assert json.loads(done.stdout)["denoised"] == [str(out)], (command, done.stdout)


def check_tiff_is_refused(program, scenes, folder):
    (folder / "sky.tif").write_bytes(b"II*\0")
    done = subprocess.run([program, "render", f"{scenes}/cornell-box.gltf", "--env", folder / "sky.tif", "-o", folder / "x.png"],
                          env=BARE, capture_output=True, text=True, check=False)
    assert done.returncode == 5 and "libbdpt_oiio.so not found" in done.stderr, (done.returncode, done.stderr)


def check_ktx2(program, scenes, folder):
    """Renders a scene that needs a KTX2 texture."""
    scene = json.loads((pathlib.Path(scenes) / "cornell-box.gltf").read_text(encoding="utf-8"))
    for buffer in scene["buffers"]:
        assert buffer["uri"].startswith("data:"), "the scene has files of its own"
    shutil.copy(pathlib.Path(scenes).parent / "tests/data/ktx2/uastc-rgb.ktx2", folder / "wall.ktx2")
    scene["images"] = [{"uri": "wall.ktx2"}]
    scene["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
    scene["materials"][0].setdefault("pbrMetallicRoughness", {})["baseColorTexture"] = {"index": 0}
    scene["extensionsUsed"] = [*scene.get("extensionsUsed", []), "KHR_texture_basisu"]
    scene["extensionsRequired"] = ["KHR_texture_basisu"]
    (folder / "ktx.gltf").write_text(json.dumps(scene), encoding="utf-8")
    subprocess.run([program, "render", folder / "ktx.gltf", "--size", "16x16", "--spp", "1", "--strict", "--quiet", "-o",
                    folder / "ktx.exr"], env=BARE, check=True)


def check_bare_root(root, glibc, scenes, folder, volume):
    """Runs in a file system that contains nothing but glibc: no shell, no libstdc++."""
    bare = folder / "root"
    for path in glibc:
        copy = bare / path.relative_to("/")
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy)
    for name in ("proc", "dev", "out", "scenes"):
        (bare / name).mkdir()
    (bare / "dev/null").touch()
    for name in ("cornell-box.gltf", "smoke.vdb"):
        shutil.copy(f"{scenes}/{name}", bare / "scenes")
    if os.geteuid() != 0:
        return "skipped the bare root: only root can enter one"
    mount = 'mount -t proc proc "$0/proc" && mount --bind /dev/null "$0/dev/null" && exec "$@"'
    inside = ["unshare", "--mount", "sh", "-c", mount, str(bare)]
    allowed = subprocess.run([*inside, "true"], capture_output=True, text=True, check=False)
    if allowed.returncode != 0:
        return f"skipped the bare root: {allowed.stderr.strip()}"
    shutil.move(root, bare / "bdpt")
    for with_volume in (False, volume):
        out = bare / "out" / f"{with_volume}.png"
        render([*inside, "chroot", str(bare), "/bdpt/bin/bdpt"], "/scenes", f"/out/{out.name}", with_volume)
        assert out.stat().st_size > 0
    return f"ran in a root of {len(glibc)} files of glibc"


def main():
    archive, folder, scenes, version, openvdb = sys.argv[1:]
    folder = pathlib.Path(folder).resolve() / "some where else"
    folder.mkdir(parents=True)
    with tarfile.open(archive) as tar:
        assert all(entry.uid == entry.gid == 0 for entry in tar.getmembers()), "files belong to who has built them"
        tar.extractall(folder)
    (root,) = folder.iterdir()
    assert re.fullmatch(rf"bdpt-{re.escape(version)}-linux-\w+", root.name), root
    glibc = check_libraries(root)
    program = root / "bin" / "bdpt"
    said = subprocess.run([program, "--version"], env=BARE, capture_output=True, text=True, check=True).stdout
    assert said.startswith(f"bdpt {version}\n"), said
    render([program], scenes, folder / "out.png", openvdb == "1")
    check_tiff_is_refused(program, scenes, folder)
    check_ktx2(program, scenes, folder)
    link = folder / "bdpt"
    link.symlink_to(program)
    render([link], scenes, folder / "linked.png", openvdb == "1")
    listed = (root / "share/doc/bdpt/libraries.txt").read_text(encoding="utf-8")
    assert "libstdc++.so.6: " in listed and "glibc 2." in listed, listed
    assert list(root.glob("lib*/bdpt/denoiser/third-party-programs.txt")), "no licences of what is in the denoiser"
    print(check_bare_root(root, glibc, scenes, folder, openvdb == "1"))


main()
