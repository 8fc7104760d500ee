#!/usr/bin/env python3
"""Each breach of the tree's rules is found by the test that is there for it, and a tree without one passes.

    breaches_test.py FOLDER of the tests, such as layers_test.py
"""
import pathlib
import subprocess
import sys
import tempfile

GOOD = {
    "tests/architecture/layers.txt": "command-line\nengine/high | engine/beside\nengine/low\n\n[engine/low]\nabove\nbelow*\n",
    "engine/high/a.hpp": '#include "engine/low/above.hpp"\n',
    "engine/beside/b.hpp": "",
    "engine/low/above.hpp": '#include "engine/low/below_it.hpp"\n',
    "engine/low/above.cpp": '#include "engine/low/above.hpp"\n',
    "engine/low/below_it.hpp": '#include "engine/low/below_too.hpp"\n',
    "engine/low/below_too.hpp": "",
    "command-line/septet/options.cpp": 'void add() {\n' + "".join(f'  app.add_subcommand("go-{c}");\n' for c in "abcdefghij") +
    '  auto* way = app.add_subcommand(\n      "way");\n  way->require_subcommand(1);\n  way->add_subcommand("keys");\n}\n',
    "NOTES.md": "engine/low holds `low/above` and engine/low/below_it.hpp; whose file is engine/low/NAME.hpp?\n`septet go-a FILE`, `septet way keys`; septet is\n",
}
# The file that is written, what it says, the test that finds it, and what that says.
BREACHES = {
    "up": ("engine/low/above.hpp", '#include "engine/high/a.hpp"\n', "layers", "not below it in layers.txt"),
    "to one side": ("engine/high/a.hpp", '#include "engine/beside/b.hpp"\n', "layers", "not below it in layers.txt"),
    "up within a folder": ("engine/low/below_it.cpp", '#include "engine/low/above.hpp"\n', "layers", "not below it in [engine/low]"),
    "a file without a line": ("engine/low/other.cpp", "", "layers", "no line for it in [engine/low]"),
    "a line without a file": ("tests/architecture/layers.txt", GOOD["tests/architecture/layers.txt"] + "gone\n", "layers", "is called gone"),
    "a folder without a line": ("engine/new/n.hpp", "", "layers", "its folder is not in layers.txt"),
    "headers in a circle": ("engine/low/below_too.hpp", '#include "engine/low/below_it.hpp"\n', "layers", "headers in a circle"),
    "another's header": ("engine/low/below_too.hpp", "#include <zstd.h>\n", "layers", "third-party header"),
    "a document that names what is gone": ("NOTES.md", "see engine/low/gone\n", "named_paths", "NOTES.md:1: there is no engine/low/gone"),
    "one from within a folder": ("NOTES.md", "see `low/gone`\n", "named_paths", "there is no low/gone"),
    "a comment": ("engine/low/above.cpp", "/// As low/gone.hpp.\n", "named_paths", "above.cpp:1: there is no low/gone.hpp"),
    "a name that its file does not have": ("NOTES.md", "see `Gone` in low/above.hpp\n", "named_paths", "NOTES.md:1: there is no Gone in low/above.hpp"),
    "one whose file follows in a comment's next line": ("engine/low/above.cpp", "/// As GoneWith\n/// (low/above.hpp).\n", "named_paths", "above.cpp:1: there is no GoneWith in low/above.hpp"),
    "a name behind its file": ("NOTES.md", "`low/above.hpp` (`gone`)\n", "named_paths", "there is no gone in low/above.hpp"),
    "a header that is not the first": ("engine/low/above.cpp", '#include <map>\n#include "engine/low/above.hpp"\n', "own_header", "does not include engine/low/above.hpp first"),
    "a standard header left out": ("engine/low/above.cpp", '#include "engine/low/above.hpp"\nstd::vector<int> a;\n', "standard_headers", "uses std::vector and does not include <vector>"),
    "a loose tolerance": ("tests/a_test.cpp", "CHECK(x == doctest::Approx(f(0.1)).epsilon(0.1));\n", "tolerances", "tests/a_test.cpp:1: an epsilon without its scale"),
    "a command that is not there": ("NOTES.md", "    septet go-z FILE\n", "named_commands", "NOTES.md:1: there is no command septet go-z"),
    "one in a help text": ("engine/low/above.cpp", 'const char* help = "as septet gone does";\n', "named_commands", "above.cpp:1: there is no command septet gone"),
    "a command behind another one": ("NOTES.md", "`septet go-a go-b FILE`\n", "named_commands", "NOTES.md:1: septet go-a has no command go-b"),
    "a command's command that is not there": ("NOTES.md", "`septet way gone`\n", "named_commands", "NOTES.md:1: septet way has no command gone"),
    "a folder's name with a slash": ("NOTES.md", "(`engine/gone/`.)\n", "named_paths", "there is no engine/gone"),
}

failures = []


def check(what, files, test, expected):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        script = pathlib.Path(sys.argv[1], f"{test}_test.py")
        result = subprocess.run([sys.executable, script, folder], capture_output=True, text=True)
        if result.returncode != (1 if expected else 0) or expected not in result.stdout or result.stderr:
            failures.append(f"{what}: exit {result.returncode}, {result.stdout!r} {result.stderr!r}")


for test in ("layers", "named_paths", "named_commands", "own_header", "tolerances"):
    check(f"no breach, {test}", GOOD, test, "")
for what, (name, text, test, expected) in BREACHES.items():
    check(what, GOOD | {name: text}, test, expected)
print("\n".join(failures))
sys.exit(bool(failures))
