#!/usr/bin/env python3
"""No smoothstep of a shader or of engine/light has its edges reversed, which GLSL 4.60, 8.3 leaves undefined.

    smoothstep_edges_test.py ROOT

Edges that are both numbers are compared. Prints one line for each breach, and exits 1.
"""
import pathlib
import re
import sys

EDGES = re.compile(r"\bsmoothstep\(\s*(-?[\d.]+(?:e-?\d+)?)f?\s*,\s*(-?[\d.]+(?:e-?\d+)?)f?\s*,")

root = pathlib.Path(sys.argv[1])
breaches, looked_at = [], 0
for folder in ("engine/light", "engine/render/shaders"):
    for path in sorted((root / folder).iterdir()):
        for number, line in enumerate(path.read_text().split("\n"), 1):
            for low, high in EDGES.findall(line):
                looked_at += 1
                if not float(low) < float(high):
                    breaches.append(f"{path.relative_to(root)}:{number}: edges {low} and {high}")
print(*breaches, sep="\n")
sys.exit(bool(breaches) or looked_at == 0)
