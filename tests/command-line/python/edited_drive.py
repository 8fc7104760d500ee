"""A drive with one small screen and editors of its own, for checks of scripts: what they share."""
import json
import os
import pathlib
import struct
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[3]

RIG = """name = "small"
eye_point_m = [1.35, 0.37, 1.17]
[network]
[car]
source = "simulated-driver"
[[screen]]
name = "a"
width_px = 160
height_px = 120
lower_left_m = [2.15, 0.77, 0.87]
lower_right_m = [2.15, -0.03, 0.87]
upper_left_m = [2.15, 0.77, 1.47]
"""


def use_module_of(septet_program: pathlib.Path) -> None:
    """From here on `import septet` finds this tree's module, which starts this program; so do scripts that are started."""
    sys.path.insert(0, str(root / "command-line/python"))
    os.environ["SEPTET_PROGRAM"] = str(septet_program)
    os.environ["SEPTET_DATA"] = str(root)
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    os.environ["PYTHONPATH"] = str(root / "command-line/python")


def refused(change):
    """Why the server refused it."""
    import septet
    try:
        change()
    except septet.Refused as why:
        return why
    raise AssertionError("nothing was refused")


def triangle_glb(height_m: float = 1) -> bytes:
    """A red triangle, a metre wide."""
    numbers = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, height_m, 0)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": "red", "doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, height_m, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(numbers)}],
        "buffers": [{"byteLength": len(numbers)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(numbers), 0x004E4942) + numbers
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def run(*words: str) -> str:
    done = subprocess.run(words, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout


class EditedDrive:
    """A server in real time, for `with`; `editors`: NAME=RIGHTS. Ended, its session is folder/out/session.sqlite."""

    def __init__(self, septet_program: pathlib.Path, folder: pathlib.Path, editors: list, *more: str) -> None:
        self.folder, self.keys = folder, folder / "keys"
        self.log_file, self.session = folder / "server.log", folder / "out/session.sqlite"
        (folder / "small.toml").write_text(RIG)
        run(str(septet_program), "rig", "keys", str(folder / "small.toml"), "--out", str(self.keys), *(word for one in editors for word in ("--editor", one)))
        self._command = [str(septet_program.parent / "septet-server"), "--scenario", "first-lesson", "--rig", str(folder / "small.toml"), "--keys",
                         str(self.keys / "server"), "--out", str(folder / "out"), "--any-port", "--wait-for-screens", "0", "--start-now", "--seconds", "36000", *more]

    def __enter__(self) -> "EditedDrive":
        self._server = subprocess.Popen(self._command, stdout=subprocess.PIPE, stderr=self.log_file.open("w"), text=True)
        ready = self._server.stdout.readline()
        if not ready.startswith("ready "):
            self._server.terminate()
            raise AssertionError((ready, self.log_file.read_text()))
        self.port = int(ready.split()[1])
        for editor in self.keys.iterdir():
            if editor.name != "server" and editor.is_dir():
                (editor / "address").write_text(f"127.0.0.1:{self.port}\n")
        return self

    def __exit__(self, kind, value, trace) -> None:
        self._server.terminate()
        self._server.wait(300)
        if kind:
            print(self.log_file.read_text(), file=sys.stderr)
