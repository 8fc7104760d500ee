#!/usr/bin/env python3
"""The page's files of a language: each has every key once, with the same {names} in its text, and the page asks for no other.

Every word that Septet's own lessons and things bring onto it is told likewise, every refusal of a wish,
why there is no sound, and which screens and cars connect and leave. No two scripts declare one name.

    language_test.py FOLDER_OF_THE_PAGE ROOT
"""
import json
import pathlib
import re
import sys
import tomllib

# Keys that are put together when they are needed: a drive's end, a condition of the weather, a sentence of the server,
# a drive's title.
MADE = ("whence.", "end.", "condition.", "preset.", "said.", "severity.", "event.", "carfault.", "wheel.", "scenario.", "about.")


def once(pairs):
    keys = [key for key, _ in pairs]
    twice = {key for key in keys if keys.count(key) > 1}
    assert not twice, f"given twice: {twice}"
    return dict(pairs)


def texts_of(file):
    text = file.read_text(encoding="utf-8")
    return json.loads(text[text.index("{", text.index("languages.")):text.rindex("}") + 1], object_pairs_hook=once)


def brought_words(root):
    """The keys of what the page is told of lessons and things by files."""
    for file in root.glob("scenarios/*/*.lesson.toml"):
        lesson = tomllib.loads(file.read_text(encoding="utf-8"))
        yield f"scenario.{file.name.removesuffix('.lesson.toml')}"
        yield from (f"said.{text}" for text in [lesson["aim"], *(task["says"] for task in lesson["task"])])
    things = tomllib.loads((root / "engine/effects/debris/parts.toml").read_text(encoding="utf-8"))
    yield from (f"said.{name.replace('_', ' ')}" for name in things)


def refusals(root):
    """The keys of sentences by which a wish of the operator is refused, as the sources have them."""
    for file, sentence in (("sim-server/drive/operator_desk.cpp", r'return "([a-z][^"=]* [^"=]*)";'),
                           ("sim-server/drive/placing.cpp", r'failure\("([^"]+)"'),
                           ("sim-server/page/messages.cpp", r'no_message\("([^"]+)"\)'),
                           ("engine/traffic/own_traffic.cpp", r'failure\("([^"]+)"'),
                           ("engine/traffic/network/errors.cpp", r'failure\("([^"]+)"'),
                           ("engine/simulation/operator_command.cpp", r'failure\((?:[\w.]+ \? )?"([^"]+)"(?: : "([^"]+)")?')):
        found = re.findall(sentence, (root / file).read_text(encoding="utf-8"))
        assert found, file
        yield from (f"said.{text}" for match in found for text in ([match] if isinstance(match, str) else match) if text)


def sound_words(root):
    """The keys of device, fault and remedy where there is no sound, as the sources have them."""
    stage = (root / "engine/audio/sound_stage.cpp").read_text(encoding="utf-8")
    failures = re.findall(r'failure\(\s*"([^"]+)",[^"]*"([^"]+)"[^"]*,\s*"([^"]+)"\)', stage)
    live = (root / "sim-server/host/live_sound.cpp").read_text(encoding="utf-8")
    lost = re.findall(r'lose\(now_s, "([^"]+)"\)', live)
    remedies = re.findall(r'describe\(Error\{why, [^"]*"([^"]+)"\}\)', live)
    assert len(failures) == stage.count("failure(") and lost and remedies
    # Memory is no device of a drive, and a package's name is one in every language.
    words = [word for what, where, remedy in failures if "into memory" not in what for word in (what, where, remedy)]
    return [f"said.{word}" for word in [*words, *lost, *remedies] if word != "libopenal1"]


def told_of_clients(root):
    """The sentences of screens and car that connect and leave, with {} for each gap."""
    host = (root / "sim-server/host/screen_host.cpp").read_text(encoding="utf-8")
    joined = re.sub(r'"\s*\n\s*"', "", host)
    found = re.findall(r'tell\(\w+,\s*(?:fmt::format\()?"([^"]+)"', joined)
    assert len(found) == joined.count(" tell(client,"), found
    yield from (re.sub(r"\{[^}]*\}", "{}", sentence) for sentence in found)


def names_in(text):
    return sorted(set(re.findall(r"\{(\w+)\}", text)))


def main():
    folder, root = map(pathlib.Path, sys.argv[1:3])
    languages = {file.stem.removeprefix("language_"): texts_of(file) for file in folder.glob("language_*.js")}
    assert {"en", "de", "sv"} <= languages.keys(), languages.keys()
    english = languages["en"]
    mistakes = []
    for code, texts in languages.items():
        mistakes += [f"{code} lacks {key}" for key in english.keys() - texts.keys()]
        mistakes += [f"{code} alone has {key}" for key in texts.keys() - english.keys()]
        for key in english.keys() & texts.keys():
            if not texts[key].strip():
                mistakes.append(f"{code}: {key} is empty")
            if names_in(texts[key]) != names_in(english[key]):
                mistakes.append(f"{code}: {key} has the names {names_in(texts[key])}, English has {names_in(english[key])}")
    mistakes += [f"the page is told of {key}" for key in [*brought_words(root), *refusals(root), *sound_words(root)] if key not in english]
    with_gaps = {re.sub(r"\{\w+\}", "{}", key) for key in english if key.startswith("said.")}
    mistakes += [f"the page is told of {said}" for said in told_of_clients(root) if f"said.{said}" not in with_gaps]
    asked = set()
    areas = {key.split(".")[0] for key in english} - {made.rstrip(".") for made in MADE}
    for file in folder.iterdir():
        if file.name.startswith("language_"):
            continue
        text = file.read_text(encoding="utf-8")
        asked |= set(re.findall(r'data-t(?:-\w+)?="([^"]+)"', text))
        if file.suffix == ".js":
            asked |= {key for key in re.findall(r"'([a-z]+\.[a-z_0-9]+)'", text) if key.split(".")[0] in areas}
            mistakes += [f"{file.name} asks for {key}" for key in re.findall(r"\bt\('([^']+)'", text) if key not in english]
    mistakes += [f"the page asks for {key}" for key in asked - english.keys()]
    mistakes += [f"nothing asks for {key}" for key in english.keys() - asked if not key.startswith(MADE)]
    mistakes += [f"English tells {key} in other words" for key, text in english.items() if key.startswith("said.") and key != f"said.{text}"]
    # All scripts share one scope: a name that two of them declare stops the second one.
    declared = [name for file in folder.glob("*.js") for name in re.findall(r"(?m)^(?:const|let|function) (\w+)", file.read_text(encoding="utf-8"))]
    mistakes += [f"two scripts declare {name}" for name in set(declared) if declared.count(name) > 1]
    if mistakes:
        sys.exit("\n".join(sorted(mistakes)))


main()
