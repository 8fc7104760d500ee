#!/usr/bin/env python3
"""Every file includes, by itself or by Septet's headers that it includes, each header that is precompiled and that it uses a name of.

    standard_headers_test.py ROOT

What else a file needs, .ci/alone finds, which reads it with these headers before it. Prints one line for each breach, and exits 1.
"""
import pathlib
import re
import sys

ALGORITHMS = """all_of any_of clamp copy copy_if copy_n count count_if equal fill fill_n find find_if for_each is_sorted lexicographical_compare
    lower_bound max max_element merge min min_element minmax mismatch none_of nth_element partition remove remove_if replace reverse rotate search
    sort stable_sort transform unique upper_bound"""
MATHEMATICS = """acos asin atan atan2 cbrt ceil copysign cos exp exp2 expm1 floor fma fmod hypot isfinite isnan lerp log log10 log1p log2 lround
    nextafter pow remainder round sin sqrt tan tanh trunc"""


def names(words):
    return rf"std::(?:ranges::)?(?:{'|'.join(words.split())})\b(?!\s*=)"


# A header, or the folder of headers, and what a file that uses it writes.
USES = {header: re.compile(use) for header, use in {
    "algorithm": names(ALGORITHMS), "array": names("array"), "chrono": names("chrono"), "cmath": names(MATHEMATICS),
    "cstdint": r"std::u?int(?:8|16|32|64)_t\b", "filesystem": names("filesystem"), "fstream": names("fstream ifstream ofstream"),
    "functional": names("function greater hash invoke less"), "map": names("map multimap"),
    "memory": names("make_shared make_unique shared_ptr unique_ptr weak_ptr"), "optional": names("nullopt optional"), "set": names("set multiset"),
    "span": names("span"), "sstream": names("istringstream ostringstream stringstream"), "string": names("string to_string"),
    "variant": names("get_if holds_alternative monostate variant visit"), "vector": names("vector"), "fmt/": r"\bfmt::", "glm/": r"\bglm::",
    "tl/expected.hpp": r"\btl::"}.items()}
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)

root = pathlib.Path(sys.argv[1])
known = {}


def included(file):
    """Headers from outside that `file` includes, by itself or by Septet's."""
    if file not in known:
        known[file] = set()
        path = root / file
        for ours, others in INCLUDE.findall(path.read_text()) if path.exists() else []:
            known[file] |= included(ours) if ours else {others}
    return known[file]


breaches, looked_at = [], 0
for folder in ("engine", "logging", "car-io", "program", "sim-client", "sim-server", "command-line"):
    for path in sorted(root.glob(f"{folder}/**/*.[ch]pp")):
        file = str(path.relative_to(root))
        code = COMMENT_OR_TEXT.sub("", path.read_text())
        looked_at += 1
        for header, use in USES.items():
            used = use.search(code)
            if used and not any(name == header or (header[-1] == "/" and name.startswith(header)) for name in included(file)):
                breaches.append(f"{file}: uses {used[0]} and does not include <{header}>")
print(*breaches, sep="\n")
sys.exit(bool(breaches) or looked_at == 0)
