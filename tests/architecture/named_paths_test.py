#!/usr/bin/env python3
"""No document, comment or script names a folder or file of the tree that is not there, or a name in a file that does not have it.

    named_paths_test.py ROOT

A name is a path from the root (engine/road/CHECKS.md), or, where it ends as a source does or stands in a document between backquotes,
from within any folder (passes/smoke_pass); the file's ending may be left out. What users put into data folders is theirs to name.
A name in a file is a name of the code beside a file: IceTile (passes/ice_tiles.hpp), IceTile of ice_tiles.hpp, `ice_tiles.hpp` (`IceTile`). It
is known for one by two humps, an underscore, :: or its backquotes, and the file by its ending.
Prints one line for each name that leads nowhere, and exits 1.
"""
import pathlib
import re
import sys

READ = {".md", ".hpp", ".cpp", ".txt", ".toml", ".cmake", ".py", ".json", ".vert", ".frag", ".comp", ".glsl", ".in", ""}
MADE = {"build", ".git", "out", "__pycache__"}
# They speak of other trees.
BY_OTHERS = ("tests/conformance/data/", "tests/fuzz/corpus/", "tests/architecture/breaches_test.py")
DATA = ("rigs", "scenarios", "vehicles")
# Not within a longer path, and without what stands for something else: NAME, *, …, {a,b}, <folder>, $variable.
NAME = re.compile(r"(?<![\w./\\{}$…*<>@:~-])((?:[a-z][\w-]*/)+[a-z_.][\w.-]*)/?(?![\w/\\…*<>{}$(-])")
SOURCE = re.compile(r"\.(hpp|cpp|md|py|glsl|frag|vert|comp|cmake)$")
# A name of the code and the file that has it, in either order; a sentence may run on over lines of a comment.
CODE = r"(?:`(?P<quoted{0}>(?:\w+::)*\w+)(?:\(\))?`|(?P<plain{0}>(?:\w+::)+\w+|[A-Z][a-z0-9]+[A-Z]\w*|[a-z]\w*_\w*\w)(?:\(\))?)"
FILE = r"(?P<file{0}>[a-z](?:[\w/-]*[\w-])?\.(?:hpp|cpp|h|c|glsl|frag|vert|comp|py))"
IN_FILE = re.compile(r"(?<![\w:./`-])" + CODE.format(1) + r"(?:\s+\(`?| (?:of|in) `?)" + FILE.format(1) + r"(?=[`),.;:\s])|"
                     r"(?<![\w./-])`?" + FILE.format(2) + r"`?\s+\(`(?P<quoted2>(?:\w+::)*\w+)(?:\(\))?`\)")
NEXT_LINE = re.compile(r"\n[ \t]*(?://[/!]?<?|#)?")


def files_of(root, folder=""):
    """Files and folders, by their path from the root."""
    for path in sorted((root / folder).iterdir()):
        if path.name in MADE or path.is_symlink():
            continue
        name = folder + path.name
        yield name, path
        if path.is_dir():
            yield from files_of(root, name + "/")


def endings(name):
    """The path and what is left of it without the folders at its beginning, each with and without the endings of the file."""
    parts = name.split("/")
    for i in range(len(parts)):
        end = "/".join(parts[i:])
        while True:
            yield end
            if "." not in end.rsplit("/", 1)[-1].strip("."):
                break
            end = end.rsplit(".", 1)[0]


def broken_names(root):
    files = list(files_of(root))
    there = {end for name, _ in files for end in endings(name)}
    folders = {path.name for _, path in files if path.is_dir()}
    tops = {name for name, path in files if "/" not in name and path.is_dir()} - set(DATA)
    for file, path in files:
        if path.suffix not in READ or not path.is_file() or file.startswith(BY_OTHERS):
            continue
        for number, line in enumerate(path.read_text(errors="replace").split("\n"), 1):
            if line.lstrip().startswith("#include"):
                continue  # The compiler finds these, and some are made.
            for found in NAME.finditer(line):
                name = found[1].rstrip(".")
                first = name.split("/")[0]
                is_quoted = path.suffix == ".md" and line[:found.start()].endswith("`") and line[found.end():].startswith("`")
                if first in tops or first in folders and first not in DATA and (SOURCE.search(name) or is_quoted):
                    if name not in there:
                        yield f"{file}:{number}: there is no {name}"


def misplaced_names(root):
    """Names of the code beside a file in which they do not occur."""
    sources = [(name, path) for name, path in files_of(root) if path.is_file()]
    words = {}
    for file, path in sources:
        if path.suffix not in READ or file.startswith(BY_OTHERS):
            continue
        text = path.read_text(errors="replace")
        running = NEXT_LINE.sub(lambda end: " " * len(end[0]), text)
        for found in IN_FILE.finditer(running):
            part = "1" if found["file1"] else "2"
            name = (found["quoted" + part] or found["plain1"]).split("::")[-1]
            if running[:found.start()].endswith("#include "):
                continue
            meant = [at for other, at in sources if other == found["file" + part] or other.endswith("/" + found["file" + part])]
            for at in meant:
                words.setdefault(at, set(re.findall(r"\w+", at.read_text(errors="replace"))))
            if not any(name in words[at] for at in meant):
                line = text.count("\n", 0, found.start()) + 1
                yield f"{file}:{line}: there is no {name} in {found['file' + part]}"


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    broken = list(broken_names(root)) + list(misplaced_names(root))
    print("\n".join(broken))
    sys.exit(1 if broken else 0)
