#!/usr/bin/env python3
"""Turns a TOML file of numbers with their sources into C++: one line `SEPTET_ENTRY(NAME, {.key = value, …})` for each table at its top.

    sourced_entries.py FILE.toml OUT.inc

Who includes the lines defines SEPTET_ENTRY first; they end by undefining it.

Every value stands as { value = …, source = "…" }, and its source begins with "sourced: ", "derived: " or "assumed: ". A bare text
is the name of a C++ enumerator, and so is one with a source. A table within a table is a struct within a struct, an array of numbers a braced list. What is
misspelt or left out is found by the compiler, which reads the lines into structs; what lacks a source is refused here.
"""

import sys
import tomllib
from pathlib import Path

KINDS = ("sourced: ", "derived: ", "assumed: ")


class Refused(Exception):
    pass


def literal(value, path):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str) and "::" in value:
        return value
    if isinstance(value, list):
        return "{" + ", ".join(literal(item, path) for item in value) + "}"
    raise Refused(f"{path}: is neither a number, true, false, an enumerator (Kind::name) nor a list of them")


def initialiser(node, path):
    if isinstance(node, str):
        return node
    if not isinstance(node, dict):
        raise Refused(f'{path}: has no source; write {{ value = {node}, source = "…" }}')
    if "value" not in node:
        fields = (f".{key} = {initialiser(item, f'{path}.{key}')}" for key, item in node.items())
        return "{" + ", ".join(fields) + "}"
    source = node.get("source", "")
    if set(node) != {"value", "source"} or not source.startswith(KINDS) or len(source) < 12:
        raise Refused(f'{path}: add source = "sourced: …", "derived: …" or "assumed: …", and nothing else')
    return literal(node["value"], path)


def main():
    file, out = Path(sys.argv[1]), Path(sys.argv[2])
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
        lines = [f"SEPTET_ENTRY({name}, {initialiser(table, name)})" for name, table in tables.items()]
    except (Refused, tomllib.TOMLDecodeError) as error:
        sys.exit(f"{file}: {error}")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join([*lines, "#undef SEPTET_ENTRY", ""]), encoding="utf-8")


main()
