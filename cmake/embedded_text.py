#!/usr/bin/env python3
"""Turns a text file into C++ string literals, one a line, for `constexpr std::string_view NAME =\n#include "FILE.inc"\n;`.

    embedded_text.py FILE OUT.inc
"""

import sys
from pathlib import Path

# Of two question marks and a third sign the language makes another sign.
ESCAPES = {"\\": "\\\\", "\"": "\\\"", "\n": "\\n", "\t": "\\t", "?": "\\?"}


def main():
    file, out = Path(sys.argv[1]), Path(sys.argv[2])
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("".join('"' + "".join(ESCAPES.get(c, c) for c in line) + '"\n' for line in lines), encoding="utf-8")


main()
