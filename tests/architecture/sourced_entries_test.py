#!/usr/bin/env python3
"""A value without a source, or with a source of no kind, does not get into the programs; one with a source does.

    sourced_entries_test.py SCRIPT
"""
import pathlib
import subprocess
import sys
import tempfile

REFUSED = {
    "a number without a source": "[ice]\ndensity_kgpm3 = 917",
    "an empty source": '[ice]\ndensity_kgpm3 = { value = 917, source = "" }',
    "a source of no kind": '[ice]\ndensity_kgpm3 = { value = 917, source = "somebody said so" }',
    "a kind and no source": '[ice]\ndensity_kgpm3 = { value = 917, source = "sourced: " }',
    "a text that is no enumerator": '[ice]\nbreakage = { value = "pieces", source = "assumed: by eye" }',
    "a unit beside the value": '[ice]\ndensity_kgpm3 = { value = 917, unit = "kg/m3", source = "sourced: tables" }',
    "no TOML": "[ice",
}
ACCEPTED = ('[ice]\nelastic.density_kgpm3 = { value = 917, source = "sourced: tables" }\nshards = { value = true, source = "assumed: by eye" }\n'
            'breakage = { value = "Breakage::pieces", source = "assumed: by eye" }',
            "SEPTET_ENTRY(ice, {.elastic = {.density_kgpm3 = 917}, .shards = true, .breakage = Breakage::pieces})")

failures = []
with tempfile.TemporaryDirectory() as folder:
    entries, lines = pathlib.Path(folder, "a.toml"), pathlib.Path(folder, "a.inc")

    def run(text):
        entries.write_text(text)
        return subprocess.run([sys.executable, sys.argv[1], entries, lines], capture_output=True, text=True)

    for what, text in REFUSED.items():
        result = run(text)
        if result.returncode == 0 or str(entries) not in result.stderr or "Traceback" in result.stderr:
            failures.append(f"{what}: exit {result.returncode}, {result.stderr!r}")
        if lines.exists():
            failures.append(f"{what}: something was written")
    result = run(ACCEPTED[0])
    if result.returncode != 0 or lines.read_text().splitlines()[0] != ACCEPTED[1]:
        failures.append(f"what has its sources: exit {result.returncode}, {result.stderr!r}")
print("\n".join(failures))
sys.exit(bool(failures))
