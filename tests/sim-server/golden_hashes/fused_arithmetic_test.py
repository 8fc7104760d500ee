"""A compiler that fuses products and sums gives the simulation other last bits than another one does, and the state another hash. What only
draws may be fused.

    fused_arithmetic_test.py PROGRAM
"""
import re
import subprocess
import sys

DRAWS = "polynomial_"


def fused_functions(program):
    listing = subprocess.run(["objdump", "--disassemble", "--no-show-raw-insn", program], capture_output=True, text=True, check=True).stdout
    functions, function = set(), ""
    for line in listing.splitlines():
        if line.endswith(">:"):
            function = line
        elif re.search(r"\tv?fn?m(add|sub)", line):
            functions.add(re.search("<(.*)>", function)[1])
    return functions


fused = fused_functions(sys.argv[1])
if not any(DRAWS in name for name in fused):
    sys.exit(f"{sys.argv[1]}: nothing is fused, not even {DRAWS} is, which is meant to be: this test can find nothing")
wrong = sorted(name for name in fused if DRAWS not in name)
if wrong:
    sys.exit("products and sums are fused in\n" + "\n".join(wrong))
