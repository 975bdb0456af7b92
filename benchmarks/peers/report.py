"""Writes the results as text, CSV and JSON."""

import csv
import json
import os
import pathlib
import platform
import statistics


def machine():
    names = [line.partition(":")[2].strip() for line in
             pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines() if line.startswith("model name")] \
        if pathlib.Path("/proc/cpuinfo").exists() else []
    return {"cpu": names[0] if names else platform.processor(), "cores": os.cpu_count(), "system": platform.platform()}


def shown(number, form):
    return "-" if number is None else format(number, form)


def table(rows):
    """Formats rows of strings in columns; the first column is left-aligned."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(w) if i == 0 else cell.rjust(w)
                               for i, (cell, w) in enumerate(zip(row, widths))).rstrip() for row in rows)


def scene_rows(result):
    """Returns the rows of a scene: the column names, then one row for each entry."""
    for name, entry in result["entries"].items():
        mean = entry["means"]["mean"]
        yield {"scene": result["scene"], "renderer": name, "spp": statistics.median(entry["samples"]),
               "seconds": statistics.median(entry["seconds"]), "cpu_seconds": statistics.median(entry["cpu_seconds"]),
               "bias_percent": 100 * mean["bias"] / result["mean"],
               "standard_error_percent": 100 * mean["standard_error"] / result["mean"],
               "worst_channel_z": max((c["z"] for c in entry["means"].values()), key=abs),
               "excess": entry["excess"], "agrees": entry["agrees"],
               "relmse": statistics.median(entry["relmse"]) if entry["relmse"] else None,
               "ratio_seconds": entry["ratio_seconds"], "ratio_cpu_seconds": entry["ratio_cpu_seconds"]}


def scene_text(result):
    header = ("renderer", "spp", "seconds", "bias %", "+-", "z", "excess", "mean", "relMSE", "error x", "by CPU time")
    rows = [header] + [
        (row["renderer"], f"{row['spp']:.0f}", f"{row['seconds']:.2f}", f"{row['bias_percent']:+.3f}",
         f"{row['standard_error_percent']:.3f}", f"{row['worst_channel_z']:+.1f}", f"{row['excess']:.2f}",
         "agrees" if row["agrees"] else "DIFFERS", shown(row["relmse"], ".4g"), shown(row["ratio_seconds"], ".3g"),
         shown(row["ratio_cpu_seconds"], ".3g")) for row in scene_rows(result)]
    lines = [f"{result['scene']}: {result['width']}x{result['height']}, paths of up to {result['max_depth']} edges, "
             f"mean {result['mean']:.5g} nit", table(rows)]
    lines += [f"{name}: skipped: {reason}" for name, reason in result["skipped"].items()]
    lines += [f"changed for all: {change}" for change in result["changes"]]
    return "\n".join(lines)


def cpu_text(result):
    rows = [("renderer", "CPU seconds for a sample per pixel", "over bdpt")]
    for name, cost in result["cost"].items():
        rows.append((name, f"{cost:.3f}", shown(cost / result["cost"]["bdpt"] if "bdpt" in result["cost"] else None,
                                                ".2f")))
    return f"{result['scene']}: {result['width']}x{result['height']}, paths of up to {result['max_depth']} edges, " \
        f"one thread\n" + table(rows)


def text(document):
    lines = [" ".join([f"{name}: {peer['version']}", *map(str, peer["job"].values())])
             for name, peer in document["peers"].items()]
    lines += [f"{name}: skipped: {reason}" for name, reason in document["missing"].items()]
    parts = ["\n".join(lines)] + [scene_text(result) for result in document["scenes"]]
    parts += [f"{name}: skipped: {reason}" for name, reason in document["refused"].items()]
    return "\n\n".join(parts + ([cpu_text(document["cpu"])] if document.get("cpu") else [])) + "\n"


def write(document, folder):
    """Writes results.txt, results.csv and results.json."""
    (folder / "results.txt").write_text(text(document), encoding="utf-8")
    (folder / "results.json").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    rows = [row for result in document["scenes"] for row in scene_rows(result)]
    if not rows:
        return
    with open(folder / "results.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
