#!/usr/bin/env python3
"""A test's tolerance is a share of the value alone (tests/relative.hpp), an absolute distance, or says its scale: doctest's Approx adds one to the
value that its epsilon is a share of, so that what is small passes whatever it is.

    tolerances_test.py ROOT

Prints one line for each breach, and exits 1.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
values = r"(?:[^()]|\((?:[^()]|\([^()]*\))*\))*"
loose = re.compile(rf"doctest::Approx\((?!-?0(?:\.0*)?f?\))({values})\)\s*\.epsilon\({values}\)(?!\s*\.scale\()")
breaches = []
for source in sorted((root / "tests").rglob("*.[ch]pp")):
    if source.name == "relative.hpp":
        continue
    text = source.read_text()
    for found in loose.finditer(text):
        line = text.count("\n", 0, found.start()) + 1
        breaches.append(f"{source.relative_to(root)}:{line}: an epsilon without its scale: relative(value, share)")
print(*breaches, sep="\n")
sys.exit(bool(breaches))
