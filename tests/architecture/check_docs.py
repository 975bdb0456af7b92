#!/usr/bin/env python3
"""Tests that links in documents lead to files, docs/gltf.md lists the extensions that the reader knows, the index of
decisions is complete with correct titles, and the code that docs/architecture.md names as the estimator is short:
check_docs.py ROOT."""

import pathlib
import re
import sys


def find_anchors(document):
    """Returns the anchors of a page that links may point to: its headings, as GitHub names them, and `id`s."""
    text = document.read_text(encoding="utf-8")
    headings = re.findall(r"^#+ (.*)$", text, flags=re.M)
    return {re.sub(r"[^\w -]", "", heading).replace(" ", "-").lower() for heading in headings} | \
        set(re.findall(r'<a id="([^"]+)">', text))


def find_broken_links(root):
    """Returns the broken relative links in all documents, and the number of links checked."""
    errors, count = [], 0
    documents = [*root.glob("*.md"), *(root / "docs").rglob("*.md"), *(root / "scenes").glob("*.md"),
                 *(root / "benchmarks").rglob("*.md")]
    for document in sorted(documents):
        text = re.sub(r"^ {4}.*$", "", document.read_text(encoding="utf-8"), flags=re.M)  # skips code
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#?([^)\s]*)\)", text):
            if re.match(r"[a-z]+:", target):
                continue
            count += 1
            page = document.parent / target if target else document
            if not page.exists():
                errors.append(f"{document.relative_to(root)}: no such file: {target}")
            elif anchor and page.suffix == ".md" and anchor not in find_anchors(page):
                errors.append(f"{document.relative_to(root)}: no such place: {target}#{anchor}")
    return errors, count


def compare_extensions(root):
    """Compares the three lists in docs/gltf.md with the table in the code."""
    file = "lib/io/src/gltf/checks/extension_table.h"
    code = (root / file).read_text(encoding="utf-8").partition("extension_table[] = {")[2]
    row = r'^    \{"(\w+)"(?:,\s*"([^"]*)")?(.*?)\},(?=\n    [{/]|\n\};)'
    known = {(name, next((word for word in ("ignored", "draft") if f"ExtensionStatus::{word}" in rest), "supported"), note)
             for name, note, rest in re.findall(row, code, flags=re.M | re.S)}
    text = (root / "docs/gltf.md").read_text(encoding="utf-8")
    parts = re.split(r"\n### (?:Supported|Drafts|Ignored)\n", text)[1:]
    stated = {(name, status, note) for status, part in zip(("supported", "draft", "ignored"), parts)
              for name, note in re.findall(r"^- `(\w+)`(?: \(\w+\))?(?:: (.*))?$", part, flags=re.M)}
    errors = [f"{file}: no table found"] if not known else []
    errors += [f"docs/gltf.md: lacks the row {row}" for row in sorted(known - stated)]
    errors += [f"docs/gltf.md: the reader does not have the row {row}" for row in sorted(stated - known)]
    return errors, len(known)


def compare_index(root):
    """Compares the rows of docs/decisions/README.md with the headings of the decisions."""
    folder = root / "docs/decisions"
    decided = set()
    for page in folder.glob("[0-9]*.md"):
        heading = page.read_text(encoding="utf-8").splitlines()[0]
        decided.add((heading[2:6], heading[7:], page.name))
    listed = re.findall(r"^- (\d{4}) \[(.*?)\]\((.*?)\)", (folder / "README.md").read_text("utf-8"), flags=re.M)
    errors = ["docs/decisions: no decisions found"] if not decided else []
    errors += [f"docs/decisions/README.md: lacks the row {row}" for row in sorted(decided - set(listed))]
    errors += [f"docs/decisions/README.md: no decision has the row {row}" for row in sorted(set(listed) - decided)]
    errors += [f"docs/decisions/README.md: {row} is there twice" for row in sorted(set(listed)) if listed.count(row) > 1]
    return errors, len(decided)


MOST_CODE = 1000  # limit of the estimator's lines


def check_estimator(root):
    """Checks the table in docs/architecture.md of the estimator's files and their lines of code, without blank lines
    and comments."""
    page = "docs/architecture.md"
    section = (root / page).read_text(encoding="utf-8").partition("## The estimator\n")[2].partition("\n## ")[0]
    files = [root / "lib/src" / name for name in re.findall(r"`([\w/]+\.(?:h|cpp))`", section.partition("\n\nBeside")[0])]
    errors = [f"{page}: no such file: {file.relative_to(root)}" for file in files if not file.exists()]
    if not files or errors:
        return errors or [f"{page}: names no files of the estimator"], 0
    lines = [line.strip() for file in files for line in file.read_text(encoding="utf-8").splitlines()]
    code = sum(1 for line in lines if line and not line.startswith("//"))
    if code >= MOST_CODE:
        errors.append(f"{page}: the estimator has {code} lines of code, which must be fewer than {MOST_CODE}")
    return errors, code


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    link_errors, links = find_broken_links(root)
    extension_errors, extensions = compare_extensions(root)
    index_errors, decisions = compare_index(root)
    code_errors, code = check_estimator(root)
    errors = link_errors + extension_errors + index_errors + code_errors
    print("\n".join(errors) or f"{links} links, {extensions} extensions, {decisions} decisions and {code} lines are right")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
