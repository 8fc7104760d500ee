#!/usr/bin/env python3
"""Every command that a help text, message, document, comment or script names is one that `septet` has.

    named_commands_test.py ROOT

Commands are those that the programs add to their command lines; `septet film` and `septet car` start programs of their own,
whose commands are theirs. A name is `septet WORD`, in a document where it is code; a second word is looked at too: of a
command that has commands of its own it is one of these, and never a command of `septet` itself (septet film accident).
Prints one line for each name that is none, and exits 1.
"""
import pathlib
import re
import sys

READ = {".md", ".hpp", ".cpp", ".toml", ".py", ".js", ".html", ".sh", ".desktop", ".in", ""}
MADE = {"build", ".git", "out", "__pycache__"}
# Of other programs, and "septet scene 1", which keys are derived from.
BY_OTHERS = ("tests/conformance/data/", "tests/fuzz/corpus/", "tests/architecture/", "engine/net/")
# Where a program adds its commands, and to which word of the command line.
PROGRAMS = (("command-line/septet", ()), ("sim-client/film", ("film",)), ("car-io/program", ("car",)))
ADDS = re.compile(r"(?:(?:auto|CLI::App)\s*\*\s*(?:const\s+)?(?P<own>\w+)\s*=\s*)?(?P<parent>\w+)(?:\.|->)add_subcommand\(\s*\"(?P<name>[\w-]+)\"")
NEEDS_ONE = re.compile(r"(?P<parent>\w+)->require_subcommand\(1\)")
NAMED = re.compile(r"(?<![\w./$-])septet (?P<first>[a-z][a-z-]*)(?![\w./=:{])(?: (?P<second>[a-z][a-z-]*)(?![\w./=:{]))?")
CODE_IN_DOCUMENT = re.compile(r"`[^`]+`")
IN_STRING = re.compile(r"\"(?:[^\"\\]|\\.)*\"|`[^`]*`")


def commands_of(root):
    """Commands by the words before them, and those commands that need a further one."""
    known, needy = {(): set()}, set()
    for folder, words in PROGRAMS:
        for path in sorted((root / folder).rglob("*.cpp")):
            text, called = path.read_text(errors="replace"), {}
            for found in ADDS.finditer(text):
                before = called.get(found["parent"], words)
                known.setdefault(before, set()).add(found["name"])
                if found["own"]:
                    called[found["own"]] = before + (found["name"],)
            needy |= {called[found["parent"]] for found in NEEDS_ONE.finditer(text) if found["parent"] in called}
    return known, needy


def code_of(path, text):
    """Line numbers with what is code of a document, strings and backquotes of a source, or the whole line of a script."""
    is_fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if path.suffix == ".md":
            if line.lstrip().startswith("```"):
                is_fenced = not is_fenced
            elif is_fenced or line.startswith("    "):
                yield number, line
            else:
                yield number, "  ".join(CODE_IN_DOCUMENT.findall(line))
        elif path.suffix in (".hpp", ".cpp", ".js", ".py"):
            yield number, "  ".join(IN_STRING.findall(line))
        else:
            yield number, line


def unknown_names(root):
    known, needy = commands_of(root)
    top = known[()]
    for path in sorted(root.rglob("*")):
        file = path.relative_to(root).as_posix()
        if MADE & set(path.relative_to(root).parts) or file.startswith(BY_OTHERS) or path.is_symlink():
            continue
        if path.suffix not in READ or not path.is_file():
            continue
        for number, code in code_of(path, path.read_text(errors="replace")):
            for found in NAMED.finditer(code):
                first, second = found["first"], found["second"]
                if first.startswith("septet-") or first == "and":
                    continue  # A list of programs or packages.
                if first not in top:
                    yield f"{file}:{number}: there is no command septet {first}"
                elif second and second not in known.get((first,), ()) and (second in top or (first,) in needy):
                    yield f"{file}:{number}: septet {first} has no command {second}"


if __name__ == "__main__":
    at = pathlib.Path(sys.argv[1])
    if len(commands_of(at)[0][()]) < 10:
        sys.exit("named_commands_test.py: it finds no commands in command-line/septet: look at ADDS")
    unknown = list(unknown_names(at))
    print("\n".join(unknown))
    sys.exit(1 if unknown else 0)
