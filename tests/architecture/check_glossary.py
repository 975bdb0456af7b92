#!/usr/bin/env python3
"""Tests that docs/glossary.md is complete and names only what exists: check_glossary.py ROOT.

Complete means that each word of a type in the public headers ("StrategyFilm": strategy, film) is a term of the glossary
or is in PLAIN below, the words that need no explanation for readers who know rendering, C++ and image files. Each
`Name` in the glossary must be a name in the code.
"""

import pathlib
import re
import sys

PLAIN = set("""
    alpha anisotropy axis background bench bias bidirectional bounds budget builder cache channel choice clamp clearcoat
    coat code color combined comparison component content contribution control count counts curve default defects
    denoiser desc diffuse direction directional display enumerator epsilon equal error errors estimate estimator exact
    exposures exr extension facts false field file film flip frame framed fuzz gltf halved hash hasher heuristic ids
    info inspected instance integrator iridescence isa json kind layer layout length lights limit limits list load
    loaded loss machine manifest map maps material mean memory merge mesh message metadata meter metric mode moments
    name named noisy notes number old option options output phase pixel place placement png point primary profile
    profiling progress projection range read record rect ref reference render renderer report result run sampler scale
    scatter scene score set setting shared sheen shutter size source speed split spot spread stats status storage sum
    summary surface system test texel text texture thread threshold time to tone totals transmission transport type unit
    up use value variant verify vertex view volume weight wrap write checkpoint role sheet""".split())


def read_terms(glossary):
    """Returns the words of all terms, in lower case."""
    heads = re.findall(r"^- \*\*(.+?)\*\*", glossary, flags=re.M)
    return {word for head in heads for word in re.findall(r"[a-z]+", head.lower())}


def find_public_types(root):
    """Returns the types of the public headers, by file."""
    declaration = re.compile(r"^(?:class|struct|enum class)\s+(?:BDPT_\w*EXPORT\s+)?(\w+)\s*(?:final\s*)?[:{]", flags=re.M)
    types = {}
    for folder in ("lib/include", "lib/io/include", "lib/eval/include", "lib/job/include"):
        for header in sorted((root / folder).rglob("*.h")):
            for name in declaration.findall(header.read_text(encoding="utf-8")):
                types.setdefault(name, header.relative_to(root))
    return types


def find_code_names(root):
    """Returns all names in the headers and sources of the libraries and the command."""
    names = set()
    for folder in ("lib", "apps"):
        for file in (root / folder).rglob("*"):
            if file.suffix in (".h", ".cpp"):
                names.update(re.findall(r"\w+", file.read_text(encoding="utf-8")))
    return names


def errors_in(root):
    glossary = (root / "docs/glossary.md").read_text(encoding="utf-8")
    terms = read_terms(glossary)
    errors = []
    for name, header in find_public_types(root).items():
        for word in re.findall(r"[A-Z][a-z0-9]*|[a-z0-9]+", name):
            if not {word.lower(), word.lower().removesuffix("s")} & (terms | PLAIN):
                errors.append(f"{header}: {name}: docs/glossary.md does not explain \"{word.lower()}\"")
    names = find_code_names(root)
    for quoted in re.findall(r"`([A-Za-z_:]+(?:\(\))?)`", glossary):
        if not set(re.findall(r"\w+", quoted)) <= names:
            errors.append(f"docs/glossary.md: {quoted} is not in the code")
    return errors


def main():
    root = pathlib.Path(sys.argv[1])
    errors = errors_in(root)
    types = len(find_public_types(root))
    if types < 100:
        errors.append(f"only {types} types were found")
    print("\n".join(errors) or f"the words of {types} types are explained or plain")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
