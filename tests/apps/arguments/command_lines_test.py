"""Compares the output of many command lines with recorded output: command_lines_test.py [--record] BDPT SCENES.

command_lines.txt has a block for each: the line, the exit code, the output (> standard output, ! standard error) and
the files that were written (+). The lines run one after the other in one folder, with box.gltf (a scene of SCENES),
sky.hdr and empty.gltf. --record writes the current output: review the difference before committing it.
"""

import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).with_name("command_lines.txt")
SKY = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81"


def list_files(folder):
    """Returns the names of the files below the folder, with their modification times."""
    return {str(file.relative_to(folder)): file.stat().st_mtime_ns for file in folder.rglob("*") if file.is_file()}


def run_line(bdpt, folder, line):
    """Runs one command line; returns its block."""
    words = shlex.split(line)[1:]
    before = list_files(folder)
    ran = subprocess.run([bdpt, *words], cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, timeout=300,
                         check=False)
    written = sorted(name for name, time in list_files(folder).items() if before.get(name) != time)
    lines = [f"$ {line}", f"exit code {ran.returncode}"]
    lines += ["> " + text for text in ran.stdout.decode().splitlines()]
    lines += ["! " + text for text in ran.stderr.decode().splitlines()]
    lines += ["+ " + name for name in written]
    return [text.rstrip() for text in lines]


def read_table(text):
    """Parses blocks of lines: titles, which begin with #, and command lines with their recorded output."""
    return [block.splitlines() for block in text.strip().split("\n\n")]


def main():
    record = sys.argv[1] == "--record"
    bdpt, scenes = sys.argv[-2], pathlib.Path(sys.argv[-1])
    blocks = read_table(TABLE.read_text())
    wrong = 0
    now = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copy(scenes / "cornell-box.gltf", folder / "box.gltf")
        (folder / "sky.hdr").write_bytes(SKY)
        (folder / "empty.gltf").write_bytes(b"")
        for block in blocks:
            if block[0].startswith("#"):
                now.append(block)
                continue
            now.append(run_line(bdpt, folder, block[0].removeprefix("$ ")))
            if now[-1] != block and not record:
                wrong += 1
                print("recorded:", *block, "now:", *now[-1], "", sep="\n")
    if record:
        TABLE.write_text("\n\n".join("\n".join(block) for block in now) + "\n")
    lines = sum(block[0].startswith("$") for block in blocks)
    print(f"{lines} command lines, {wrong} with another answer")
    assert lines >= 300, "the table is not whole"
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
