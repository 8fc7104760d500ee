#!/usr/bin/env python3
"""Prints a suite's result from the virtual machine.

    suite_result.py WORK SUITE

Exit status: 0 every case passed; 1 one failed, or the suite did not end; 77 there was no machine.
"""
import pathlib
import sys
import xml.etree.ElementTree

out, suite = pathlib.Path(sys.argv[1]) / "out", sys.argv[2]
if (out / "skipped.txt").exists():
    print("skipped:", (out / "skipped.txt").read_text())
    sys.exit(77)
try:
    cases = list(xml.etree.ElementTree.parse(out / f"{suite}.xml").iter("testcase"))
except (OSError, xml.etree.ElementTree.ParseError) as error:
    console = out / "console.txt"
    print(f"{suite} did not end: {error}\n" + (console.read_text(errors="replace")[-3000:] if console.exists() else ""))
    sys.exit(1)
failed = 0
for case in cases:
    faults = [*case.iter("failure"), *case.iter("error")]
    failed += bool(faults)
    print("FAILED" if faults else "passed", case.get("name"))
    for fault in faults:
        print(fault.get("message"), fault.text, sep="\n")
print(f"{len(cases)} cases, {failed} failed")
sys.exit(0 if cases and not failed else 1)
