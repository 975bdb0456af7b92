"""Runs what a container image says that it runs, in its file system: image.py BUNDLE VERSION. BUNDLE is of umoci."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import urllib.request


def main():
    bundle, version = pathlib.Path(sys.argv[1]), sys.argv[2]
    process = json.loads((bundle / "config.json").read_text(encoding="utf-8"))["process"]
    user = process["user"]
    assert user["uid"] != 0, user
    root = bundle / "rootfs"
    words = ["env", "-i", *process["env"], shutil.which("chroot"), f"--userspec={user['uid']}:{user['gid']}", root, *process["args"]]
    assert process["args"] == ["bdpt"] and process["cwd"] == "/data", process
    os.chown(root / process["cwd"].lstrip("/"), user["uid"], user["gid"])
    said = subprocess.run([*words, "--version"], check=True, capture_output=True, text=True).stdout
    assert said.startswith(f"bdpt {version}\n"), said
    out = f"{process['cwd']}/out.png"
    subprocess.run([*words, "render", "/scenes/cornell-box.gltf", "--size", "32x32", "--spp", "1", "--quiet", "-o", out], check=True)
    made = root / out.lstrip("/")
    assert made.stat().st_size > 0 and made.stat().st_uid == user["uid"], made.stat()
    with subprocess.Popen([*words, "view", "/scenes/cornell-box.gltf", "--listen", "127.0.0.1:0", "--size", "32x32"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as shown:
        address = next(word for line in shown.stdout for word in line.split() if word.startswith("http://"))
        with urllib.request.urlopen(address, timeout=20) as page:
            assert b"<html" in page.read().lower()
        shown.terminate()


main()
