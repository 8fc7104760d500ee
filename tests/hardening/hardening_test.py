"""The programs are built so that a slip in reading what comes from outside is stopped rather than used: addresses differ at each start, what
the linker resolves is read-only before main, stack frames and copies are guarded, calls and jumps land where functions begin, and each index of a container of
the standard library is looked at.

    hardening_test.py PROCESSOR COMPILE_COMMANDS PROGRAM…
"""
import json
import re
import subprocess
import sys

ENDBR64 = bytes.fromhex("f30f1efa")


def readelf(option, program):
    return subprocess.run(["readelf", "--wide", option, program], capture_output=True, text=True, check=True).stdout


def text_section(program):
    """Address and bytes of the program's code."""
    address, offset, size = (int(n, 16) for n in re.search(r" \.text +PROGBITS +(\w+) (\w+) (\w+)", readelf("--section-headers", program)).groups())
    with open(program, "rb") as file:
        file.seek(offset)
        return address, file.read(size)


def unguarded_entries(program):
    """Functions that do not begin with the instruction on which an indirect call must land, and how many were looked at: all of
    namespace septet but those that one file keeps to itself, which may never be called so. (Their names do not always tell.)"""
    start, code = text_section(program)
    entries = re.findall(r"\n +\d+: (\w+) +\d+ FUNC .* (_ZNK?6septet[^.\s]+)(?=\n)", readelf("--symbols", program))
    entries = [(int(address, 16) - start, name) for address, name in entries if "_GLOBAL__N_" not in name]
    return [name for offset, name in entries if not code.startswith(ENDBR64, offset)], len(entries)


def faults_of_program(program, processor):
    if not re.search(r"Type:\s+DYN", readelf("--file-header", program)):
        yield "it is not position-independent"
    segments = readelf("--program-headers", program)
    if "GNU_RELRO" not in segments:
        yield "nothing is read-only after relocation"
    if not re.search(r"GNU_STACK +(?:0x\w+ +){5}RW ", segments):
        yield "its stack is executable"
    dynamic = readelf("--dynamic", program)
    if not re.search(r"FLAGS\b.*\bBIND_NOW\b|FLAGS_1\b.*\bNOW\b", dynamic):
        yield "symbols are bound late, so that their table stays writable"
    if re.search(r"\((?:RPATH|RUNPATH)\)", dynamic):
        yield "it looks for libraries in a folder of its own"
    if "__stack_chk_fail" not in readelf("--dyn-syms", program):
        yield "no stack frame is guarded"
    if processor in ("x86_64", "AMD64"):
        bare, entries = unguarded_entries(program)
        if len(bare) >= entries / 100:
            yield f"{len(bare)} of {entries} functions have no landing place, such as {bare[:1]}"


def faults_of_command(command):
    """Properties that a program's own bytes need not show: few frames are longer than a page, few copies have a size that the compiler knows."""
    words = command.split()
    for word in ["-fstack-protector-strong", "-fstack-clash-protection", "-D_GLIBCXX_ASSERTIONS"]:
        if word not in words:
            yield f"compiled without {word}"
    if "-O0" not in words and "-D_FORTIFY_SOURCE=3" not in words:
        yield "compiled without -D_FORTIFY_SOURCE=3"


processor, compile_commands, *programs = sys.argv[1:]
with open(compile_commands) as file:
    commands = [entry for entry in json.load(file) if "/tests/" not in entry["file"]]
bad = [f"{program}: {fault}" for program in programs for fault in faults_of_program(program, processor)]
bad += [f"{entry['file']}: {fault}" for entry in commands for fault in faults_of_command(entry["command"])]
print("\n".join(bad))
sys.exit(1 if bad or not programs or not commands else 0)
