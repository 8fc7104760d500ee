#!/usr/bin/env python3
"""Every source file includes the header of its own name first, so that this header is compiled with nothing before it.

    own_header_test.py ROOT

Headers without such a file are read alone by .ci/alone. Prints one line for each breach, and exits 1.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
breaches, looked_at = [], 0
for folder in ("engine", "logging", "car-io", "program", "sim-client", "sim-server", "command-line"):
    for source in sorted((root / folder).rglob("*.cpp")):
        own = source.with_suffix(".hpp")
        if not own.exists():
            continue
        looked_at += 1
        first = re.search(r'^#include [<"](.*)[>"]', source.read_text(), re.MULTILINE)
        if first is None or first[1] != str(own.relative_to(root)):
            breaches.append(f"{source.relative_to(root)}: does not include {own.relative_to(root)} first")
print(*breaches, sep="\n")
sys.exit(bool(breaches) or looked_at == 0)
