#!/usr/bin/env python3
"""Every #include of the tree looks down the table of layers, also within the folders that have a table of their own; third-party
headers stay in .cpp files; headers form no circle.

Reads tests/architecture/layers.txt. Exits 1 and prints one line per violation.
"""
import pathlib
import re
import sys

# Third-party headers that Septet's own headers may show (DECISIONS.md says why).
ALLOWED_IN_HEADERS = ("glm/", "tl/expected.hpp", "fmt/", "Eigen/")
# Headers that only their own folder, or only the programs' mains, include may show the library that they are made for.
ALLOWED_IN_FOLDER = {"engine/render/vulkan/": "volk.h", "engine/document/json.hpp": "nlohmann/json_fwd.hpp", "engine/gltf/container.hpp": "nlohmann/json_fwd.hpp",
                     "program/command_line.hpp": "CLI/CLI.hpp", "engine/raytrace/eight.hpp": "immintrin.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# Programs join everything: tests, and the folder of a program's own main.
FREE = ("tests/",)


def read_layers(root):
    """Of the tree, by "", and of each folder that has a table of its own, by its path: the level of each name."""
    tables = {"": {}}
    table = tables[""]
    for level, line in enumerate((root / "tests/architecture/layers.txt").read_text().splitlines()):
        if line.startswith("["):
            table = tables.setdefault(line.strip("[] "), {})
        elif line and not line.startswith("#"):
            table.update({name.strip(): level for name in line.split("|")})
    return tables


def folder_of(path, level_of):
    """The longest folder of the table that holds this path."""
    candidates = [f for f in level_of if path.startswith(f + "/")]
    return max(candidates, key=len) if candidates else None


def name_within(path, level_of):
    """Name of a path from within a folder in the folder's table: the most precise one."""
    def holds(name):
        return path.startswith(name[:-1]) if name.endswith("*") else path == name or path.startswith((name + "/", name + "."))
    candidates = [name for name in level_of if holds(name)]
    return max(candidates, key=len) if candidates else None


def violations_within(folder, level_of, includes_of):
    """`includes_of`: each file of the tree with the paths that it includes."""
    used = set()
    for path, includes in includes_of.items():
        if not path.startswith(folder + "/"):
            continue
        own = name_within(path[len(folder) + 1:], level_of)
        used.add(own)
        if own is None:
            yield f"{path}: layers.txt has no line for it in [{folder}]"
            continue
        for target in includes:
            other = name_within(target[len(folder) + 1:], level_of) if target.startswith(folder + "/") else None
            used.add(other)
            if other is not None and other != own and level_of[other] <= level_of[own]:
                yield f"{path}: includes {target}, which is not below it in [{folder}] of layers.txt"
    for name in level_of:
        if name not in used:
            yield f"layers.txt: nothing in {folder} is called {name}"


def circles(headers_of):
    """Each circle among headers that include each other, once."""
    done, way = set(), []

    def visit(header):
        if header in way:
            yield " -> ".join(way[way.index(header):] + [header])
        elif header not in done:
            way.append(header)
            for other in headers_of.get(header, ()):
                yield from visit(other)
            done.add(way.pop())

    for header in headers_of:
        yield from visit(header)


def violations(root):
    tables = read_layers(root)
    level_of = tables.pop("")
    headers_of, includes_of = {}, {}
    for folder in level_of:
        if not (root / folder).is_dir():
            yield f"layers.txt: {folder} is no folder of the tree"
    for top in ("engine", "program", "sim-server", "sim-client", "car-io", "logging", "command-line"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".hpp", ".cpp"):
                continue
            path = file.relative_to(root).as_posix()
            own = folder_of(path, level_of)
            if own is None:
                yield f"{path}: its folder is not in layers.txt"
                continue
            includes = INCLUDE.findall(file.read_text())
            includes_of[path] = [target for bracket, target in includes if bracket == '"']
            if file.suffix == ".hpp":
                headers_of[path] = includes_of[path]
            for bracket, target in includes:
                if bracket == "<":
                    third_party = "/" in target or target.endswith(".h") or target.endswith(".hpp")
                    system = target.startswith("sys/") or target.startswith("linux/") or "/" not in target and file.suffix == ".cpp"
                    if file.suffix == ".hpp" and third_party and not system and not target.startswith(ALLOWED_IN_HEADERS) \
                            and not any(path.startswith(f) and target == t for f, t in ALLOWED_IN_FOLDER.items()):
                        yield f"{path}: third-party header <{target}> in a header; include it in the .cpp"
                    continue
                other = folder_of(target, level_of)
                if other is None:
                    yield f'{path}: "{target}" is not a path from the root of the tree'
                    continue
                if other == own:
                    continue
                if level_of[other] <= level_of[own]:
                    yield f"{path}: includes {target}, which is not below it in layers.txt"
    for folder, table in tables.items():
        yield from violations_within(folder, table, includes_of)
    for circle in circles(headers_of):
        yield f"headers in a circle: {circle}"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
