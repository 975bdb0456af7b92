#!/usr/bin/env python3
"""Tests that the render engines can read the files of bdpt plan: plan_files_test.py COMMAND SCENE.

Checks shell scripts with bash, and with shellcheck if it is installed; manifests of Kubernetes with the Python package
kubernetes-validate, if these are installed. Prints which are not."""

import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile

COMMAND, SCENE = sys.argv[1:3]
ODD = "a $HOME `job` \"of\" mine's"  # a name that every language must quote


def plan(folder, engine):
    job = folder / engine / ODD
    job.parent.mkdir()
    subprocess.run([COMMAND, "plan", pathlib.Path(SCENE).name, "--size", "8x8", "--spp", "256", "--parts", "4", "--for",
                    engine, "-o", folder / "out.exr", "-d", job, "--quiet"], check=True, cwd=folder)
    return job


def run(*words, **more):
    done = subprocess.run([*map(str, words)], capture_output=True, text=True, check=False, **more)
    return done.stdout if done.returncode == 0 else sys.exit(f"{' '.join(map(str, words))}: {done.stdout}{done.stderr}")


def is_installed(module):
    there = importlib.util.find_spec(module) is not None
    print(f"{module}: {'used' if there else 'not installed'}")
    return there


def check_scripts(job):
    scripts = [file for file in job.iterdir() if file.read_text().startswith("#!/bin/bash")]
    for script in scripts:
        run("bash", "-n", script)
        if shutil.which("shellcheck"):
            run("shellcheck", script)
    return [f"{job}: no scripts"] if not scripts else []


def check_kubernetes(job):
    if not is_installed("kubernetes_validate"):
        return []
    import kubernetes_validate
    import yaml
    text = (job / "kubernetes.yaml").read_text()
    manifests = list(yaml.safe_load_all(text))
    for manifest in manifests:
        kubernetes_validate.validate(manifest, "1.29", strict=True)
    broken = yaml.safe_load(text.split("---")[1].replace("backoffLimitPerIndex", "backoffLimitPerIndx"))
    try:
        kubernetes_validate.validate(broken, "1.29", strict=True)
        return ["kubernetes: the validation finds no mistakes"]
    except kubernetes_validate.ValidationError:
        pass
    container = manifests[0]["spec"]["template"]["spec"]["containers"][0]
    place = f"/data/kubernetes/{ODD}"
    return [] if container["workingDir"] == place else [f"kubernetes: works in {container['workingDir']}, not {place}"]


def main():
    print(f"shellcheck: {'used' if shutil.which('shellcheck') else 'not installed'}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        shutil.copy(SCENE, folder)
        errors = check_scripts(plan(folder, "slurm"))
        errors += check_kubernetes(plan(folder, "kubernetes"))
    print("\n".join(errors) or "all files are what engines read")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
