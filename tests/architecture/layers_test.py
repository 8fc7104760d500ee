#!/usr/bin/env python3
"""Every #include of the tree looks down the table of layers; third-party headers stay in .cpp files.

Reads tests/architecture/layers.txt. Exits 1 and prints one line per violation.
"""
import pathlib
import re
import sys

# Third-party headers that Septet's own headers may show (DECISIONS.md says why).
ALLOWED_IN_HEADERS = ("glm/", "tl/expected.hpp", "fmt/", "Eigen/")
# Headers that only their own folder includes may show the library that the folder is made of.
ALLOWED_IN_FOLDER = {"engine/render/vulkan/": "volk.h", "logging/outcome_json.hpp": "nlohmann/json_fwd.hpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# Programs join everything: tests, and the folder of a program's own main.
FREE = ("tests/",)


def read_layers(root):
    level_of = {}
    lines = [l for l in (root / "tests/architecture/layers.txt").read_text().splitlines() if l and not l.startswith("#")]
    for level, line in enumerate(lines):
        for peer in line.split("|"):
            for folder in peer.split():
                level_of[folder] = (level, peer.strip())
    return level_of


def folder_of(path, level_of):
    """The longest folder of the table that holds this path."""
    candidates = [f for f in level_of if path.startswith(f + "/")]
    return max(candidates, key=len) if candidates else None


def violations(root):
    level_of = read_layers(root)
    for top in ("engine", "sim-server", "sim-client", "car-io", "logging"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".hpp", ".cpp"):
                continue
            path = file.relative_to(root).as_posix()
            own = folder_of(path, level_of)
            if own is None:
                yield f"{path}: its folder is not in layers.txt"
                continue
            for bracket, target in INCLUDE.findall(file.read_text()):
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
                (own_level, own_peer), (level, peer) = level_of[own], level_of[other]
                if level < own_level or (level == own_level and peer != own_peer):
                    yield f"{path}: includes {target}, which is not below it in layers.txt"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
