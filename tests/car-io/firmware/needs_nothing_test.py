#!/usr/bin/env python3
"""The microcontroller's core needs nothing: no heap, no library, no floating point, no state of its own that can be written.

    needs_nothing_test.py COMPILER FOLDER

Each file is compiled alone, as for a controller without an operating system; its callees must be in one of the others.
"""
import pathlib
import subprocess
import sys
import tempfile

compiler, folder = sys.argv[1], pathlib.Path(sys.argv[2])
FLAGS = ["-std=c11", "-Os", "-ffreestanding", "-fno-stack-protector", "-mgeneral-regs-only"]
FROM_THE_COMPILER = {"memcpy", "memmove", "memset", "memcmp"}  # Which each calls by itself, and each toolchain has.
wanted, given, writable, code_bytes = set(), set(), set(), 0
with tempfile.TemporaryDirectory() as scratch:
    for source in sorted(folder.glob("*.c")):
        made = pathlib.Path(scratch) / (source.name + ".o")
        if subprocess.run([compiler, *FLAGS, "-c", source, "-o", made]).returncode != 0:
            sys.exit(f"{source} is not for a controller")
        for line in subprocess.run(["nm", "--format=posix", made], check=True, capture_output=True, text=True).stdout.splitlines():
            name, kind, *numbers = line.split()
            if kind == "U":
                wanted.add(name)
            else:
                given.add(name)
            if kind in "bBdDcC":
                writable.add(name)
            if kind in "tT" and len(numbers) == 2:
                code_bytes += int(numbers[1], 16)
print(f"{code_bytes} bytes of code; calls from file to file: {', '.join(sorted(wanted))}")
problems = [f"calls {name}, which is none of its own" for name in sorted(wanted - given - FROM_THE_COMPILER)] + [f"keeps {name}" for name in sorted(writable)]
if not given:
    problems.append(f"there is nothing in {folder}")
if code_bytes > 4096:
    problems.append("is larger than 4 KiB")
sys.exit("\n".join(problems) if problems else 0)
