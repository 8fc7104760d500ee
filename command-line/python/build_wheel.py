"""Packs septet.py for `pip install` (PEP 517), by Python's own library: pip fetches nothing, so a laboratory without a network installs it.

A type checker reads the types of what is installed from folders with a file py.typed alone (PEP 561): septet.py goes in as the __init__.py of one.
"""
from __future__ import annotations

import base64
import hashlib
import pathlib
import re
import zipfile
from typing import Any, Optional

_here = pathlib.Path(__file__).resolve().parent


def _project(key: str) -> str:
    """A text of pyproject.toml: Python has a reader for TOML from 3.11 on."""
    found = re.search(rf'^{key} = "(.*)"$', (_here / "pyproject.toml").read_text(encoding="utf-8"), re.M)
    if found is None:
        raise ValueError(f"pyproject.toml has no line {key} = \"…\"")
    return found[1]


def build_wheel(wheel_directory: str, config_settings: Optional[dict[str, Any]] = None, metadata_directory: Optional[str] = None) -> str:
    """Writes the wheel into that folder and returns the file's name."""
    name, version = _project("name"), _project("version")
    about = (
        f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: {_project('description')}\nLicense: Apache-2.0\n"
        f"Requires-Python: {_project('requires-python')}\nDescription-Content-Type: text/markdown\n\n{(_here / 'README.md').read_text(encoding='utf-8')}"
    )
    info = f"{name}-{version}.dist-info"
    files = {
        f"{name}/__init__.py": (_here / "septet.py").read_bytes(),
        f"{name}/py.typed": b"",
        f"{info}/METADATA": about.encode(),
        f"{info}/WHEEL": b"Wheel-Version: 1.0\nGenerator: septet\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    record = "".join(
        f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},{len(content)}\n" for path, content in files.items()
    )
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{name}-{version}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as packed:
        for path, content in files.items():
            packed.writestr(path, content)
    return wheel
