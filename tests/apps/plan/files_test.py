#!/usr/bin/env python3
"""Tests that the render engines can read the files of bdpt plan: plan_files_test.py COMMAND SCENE.

Checks shell scripts with bash, and with shellcheck if it is installed; manifests of Kubernetes with the Python package
kubernetes-validate, and calls of AWS with botocore, if these are installed. Prints which are not."""

import importlib.util
import json
import os
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


def run_submit(job, folder):
    """Returns the arguments of each call of the aws command by submit.sh."""
    tools = folder / "tools"
    tools.mkdir()
    log = folder / "calls"
    (tools / "aws").write_text(f'#!/bin/sh\nprintf "%s\\0" "$@" >> "{log}"; printf "\\n\\0" >> "{log}"\necho id-5\n')
    (tools / "aws").chmod(0o755)
    run("./submit.sh", "queue", "registry/bdpt:1", "fs-0123456789abcdef0", cwd=job,
        env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"})
    calls = [call.split("\0")[:-1] for call in log.read_text().split("\n\0")[:-1]]
    return [dict(zip(call[2::2], call[3::2])) for call in calls]


def check_aws(job, folder):
    define, tasks, merge = run_submit(job, folder)
    container = json.loads(define["--container-properties"])
    retry = json.loads(define["--retry-strategy"])
    overrides = json.loads(merge["--container-overrides"])
    place = f"/data/aws-batch/{ODD}/plan.json"
    seen = [container["command"][:3], container["image"], overrides["command"], tasks["--array-properties"],
            merge["--depends-on"]]
    expected = [["render", "--plan", place], "registry/bdpt:1", ["merge", "--plan", place], "size=4", "jobId=id-5"]
    errors = [] if seen == expected else [f"aws-batch: {seen}, not {expected}"]
    if is_installed("botocore"):
        import botocore.loaders
        import botocore.model
        import botocore.validate
        model = botocore.model.ServiceModel(botocore.loaders.Loader().load_service_model("batch", "service-2"))
        validate = botocore.validate.ParamValidator().validate
        calls = {"RegisterJobDefinition": {"jobDefinitionName": define["--job-definition-name"], "type": define["--type"],
                                           "containerProperties": container, "retryStrategy": retry},
                 "SubmitJob": {"jobName": merge["--job-name"], "jobQueue": merge["--job-queue"],
                               "jobDefinition": merge["--job-definition"], "containerOverrides": overrides,
                               "arrayProperties": {"size": 4}, "dependsOn": [{"jobId": "id-5"}]}}
        for name, values in calls.items():
            report = validate(values, model.operation_model(name).input_shape)
            errors += [f"aws-batch: {name}: {report.generate_report()}"] if report.has_errors() else []
    return errors


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


def check_opencue(job):
    lines = (job / "commands.txt").read_text().splitlines()
    words = [run("bash", "-c", f"bdpt() {{ printf '%s\\n' \"$@\"; }}; {line}").splitlines() for line in lines]
    expected = [["render", "--plan", str(job / "plan.json"), "--task", str(task)] for task in range(4)]
    return [] if words == expected else [f"opencue: {words}, not {expected}"]


def main():
    print(f"shellcheck: {'used' if shutil.which('shellcheck') else 'not installed'}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        shutil.copy(SCENE, folder)
        errors = check_scripts(plan(folder, "slurm"))
        aws = plan(folder, "aws-batch")
        errors += check_scripts(aws) + check_aws(aws, folder)
        errors += check_kubernetes(plan(folder, "kubernetes"))
        errors += check_opencue(plan(folder, "opencue"))
    print("\n".join(errors) or "all files are what engines read")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
