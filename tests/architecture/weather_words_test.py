#!/usr/bin/env python3
"""The numbers of the weather have one list, the struct Environment: other languages name the same, in the same order where bytes follow it.

    weather_words_test.py ROOT

Prints one line for each list that differs, and exits 1.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])


def text_of(name):
    return (root / name).read_text()


def inside(text, begin, end):
    return text.split(begin, 1)[1].split(end, 1)[0]


environment = re.findall(r"^  double (\w+) =", inside(text_of("engine/world/snapshot.hpp"), "struct Environment {", "bool operator=="), re.M)
members = re.findall(r"\w+", inside(text_of("engine/world/world_members.hpp"), "SEPTET_MEMBERS(Environment,", ")"))
python = re.findall(r'"(\w+)"', inside(text_of("logging/python/septet_snapshot.py"), "ENVIRONMENT = (", ")"))
count = re.search(r"\| environment \| (\d+) × f64", text_of("engine/world/SNAPSHOT.md"))
operator = re.findall(r"&Environment::(\w+)", text_of("engine/simulation/operator_command.cpp"))
page = re.findall(r"^  (\w+): {", inside(text_of("sim-server/page/web/conditions.js"), "readings = {", "};"), re.M)

breaches = []
for where, found, wanted in [("engine/world/world_members.hpp", members, environment), ("logging/python/septet_snapshot.py", python, environment),
                             ("engine/simulation/operator_command.cpp", sorted(operator), sorted(environment)),
                             ("sim-server/page/web/conditions.js", sorted(page), sorted(environment + ["friction_scale"]))]:
    if found != wanted:
        breaches.append(f"{where}: names {' '.join(found)}, and not {' '.join(wanted)}")
if not environment or not count or int(count[1]) != len(environment):
    breaches.append(f"engine/world/SNAPSHOT.md: says another count than the {len(environment)} numbers of Environment")
print(*breaches, sep="\n")
sys.exit(bool(breaches))
