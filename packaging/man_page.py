#!/usr/bin/env python3
"""man_page.py PROGRAM VERSION NAME.1.gz: a program's manual page, made of its own --help and that of every command below it.

CLI11 writes help as: a description, "Usage: …", sections ("Options:", "Positionals:", "Subcommands:") of entries that begin at column 2 and whose
text begins at column 30, here or in the next line, and a footer.
"""
import gzip
import pathlib
import re
import subprocess
import sys

SECTIONS = ("Options:", "Positionals:", "Subcommands:")


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def paragraphs(lines):
    """Free text, which keeps its lines."""
    return [f".br\n{escaped(line)}" if line.strip() else ".PP" for line in lines]


def entries(lines):
    """(name, text) of each entry of a section."""
    found = []
    for line in lines:
        name, text = line[:30].strip(), line[30:].strip()
        if line.startswith(" " * 30):
            found[-1][1] += (" " if found[-1][1] else "") + line.strip()
        elif len(line) > 30 and line[28:30] == "  ":
            found.append([name, text])
        else:
            found.append([line.strip(), ""])
    return found


def help_of(program, commands):
    text = subprocess.run([program, *commands, "--help"], capture_output=True, text=True, check=True).stdout
    before, usage, after = re.match(r"(.*?)^Usage: (.*?)\n(.*)", text, re.S | re.M).groups()
    sections, footer, current = {}, [], None
    for line in after.splitlines():
        if line in SECTIONS:
            current = sections.setdefault(line, [])
        elif current is not None and line.startswith("  "):
            current.append(line)
        else:
            current = None
            footer.append(line)
    return before.strip("\n").splitlines(), usage, {name: entries(lines) for name, lines in sections.items()}, footer


def page(program, version):
    name = pathlib.Path(program).name
    shared_footer = "\n".join(help_of(program, [])[3]).strip()

    def body(commands):
        before, usage, sections, footer = help_of(program, commands)
        yield f".B {escaped(usage.replace(program, name))}"
        yield ".PP"
        yield from paragraphs(before)
        for section in ("Positionals:", "Options:"):
            for option, text in sections.get(section, []):
                if not option.startswith("-h,"):
                    yield f".TP\n.B {escaped(option)}\n{escaped(text)}"
        footer = "\n".join(footer).strip()
        if footer and (footer != shared_footer or not commands):
            yield ".PP"
            yield from paragraphs(footer.splitlines())
        for command, _ in sections.get("Subcommands:", []):
            yield f".SS {escaped(' '.join([name, *commands, command]))}"
            yield from body([*commands, command])

    summary = help_of(program, [])[0][0]
    summary = summary.removeprefix(name + ": ").removeprefix("Septet: ").split(". ")[0].rstrip(".")
    return "\n".join([f'.TH {name.upper()} 1 "" "Septet {version}" "User commands"', ".SH NAME", f"{escaped(name)} \\- {escaped(summary)}",
                      ".SH COMMANDS" if help_of(program, [])[2].get("Subcommands:") else ".SH OPTIONS", *body([]),
                      ".SH FILES", ".TP\n.I /usr/share/septet", "Rigs, scenarios and vehicles; the environment's", ".B SEPTET_DATA",
                      "names another folder.", ".TP\n.I /usr/share/doc/septet", "Documents; begin with README.md.", ""])


if __name__ == "__main__":
    # Without a time in it: the same help gives the same file.
    pathlib.Path(sys.argv[3]).write_bytes(gzip.compress(page(sys.argv[1], sys.argv[2]).encode(), mtime=0))
