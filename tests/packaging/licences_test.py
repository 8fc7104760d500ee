#!/usr/bin/env python3
"""docs/licences.md has one line for each package of .ci/packages.txt and for each library that a program is linked with, and names the licence
that Debian names.

    licences_test.py SOURCE_DIR PROGRAM…
"""
import pathlib
import re
import subprocess
import sys


def said_by_debian(package):
    """The licence of `Files: *` in a machine-readable copyright file; None if it is missing, or only prose."""
    file = pathlib.Path(f"/usr/share/doc/{package}/copyright")
    if not file.exists():
        return None
    for paragraph in re.split(r"\n\s*\n", file.read_text(errors="replace")):
        if re.search(r"^Files:\s*\*\s*$", paragraph, re.M):
            said = re.search(r"^License:[ \t]*(\S.*)$", paragraph, re.M)
            return said and said[1].strip()
    return None


def source_of(package):
    """The source package that an installed one is built from; empty if it is not installed."""
    shown = subprocess.run(["dpkg-query", "--show", "--showformat=${db:Status-Abbrev}${source:Package}\n", package], capture_output=True, text=True).stdout
    return next((line[3:].strip() for line in shown.splitlines() if line.startswith("ii")), "")


def linked_packages(programs):
    """The package of each library that the programs themselves name."""
    dynamic = subprocess.run(["readelf", "--dynamic", "--wide", *programs], capture_output=True, text=True, check=True).stdout
    libraries = sorted(set(re.findall(r"\(NEEDED\).*\[(.+)\]", dynamic)))
    owners = subprocess.run(["dpkg-query", "--search", *(f"*/{library}" for library in libraries)], capture_output=True, text=True).stdout
    return {library: next((line.split(":")[0] for line in owners.splitlines() if line.endswith("/" + library)), "") for library in libraries}


def faults(root, programs):
    rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in (root / "docs/licences.md").read_text().splitlines() if line.startswith("| ")][1:]
    rows = [row for row in rows if not row[0].startswith("---")]
    names = [row[0] for row in rows]
    wanted = [line for line in (root / ".ci/packages.txt").read_text().splitlines() if line and not line.startswith("#")]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"{name} has two lines"
    for name in wanted:
        if name not in names:
            yield f"{name} of .ci/packages.txt has no line"
    linked = linked_packages(programs)
    for row in rows:
        if row[0] not in wanted and row[0] not in linked.values():
            yield f"{row[0]} has a line and is not used"
        if row[1] not in ("linked", "run", "build", "test") or not row[2]:
            yield f"{row[0]} has no use or no licence"
        if said_by_debian(row[0]) not in (None, row[2]):
            yield f"{row[0]}: {row[2]}, but Debian says {said_by_debian(row[0])}"
    sources = {source_of(row[0]) for row in rows if row[1] == "linked"} - {""}
    for library, package in linked.items():
        if source_of(package) not in sources:
            yield f"{library} ({package}) is linked and has no line"


found = list(faults(pathlib.Path(sys.argv[1]), sys.argv[2:]))
print("\n".join(found))
sys.exit(1 if found else 0)
