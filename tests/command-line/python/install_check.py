"""septet.py is installed by pip into a fresh folder, without a network, and is there what it is here. Exit status 77 where pip is not installed."""
import ast
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from importlib import metadata

root = pathlib.Path(__file__).resolve().parents[3]
module = root / "command-line/python"

if importlib.util.find_spec("pip") is None:
    print("no pip: install the package python3-pip")
    sys.exit(77)

# It imports Python's own library alone, and each function says its types.
tree = ast.parse((module / "septet.py").read_text())
imported = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
imported |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
assert {name.partition(".")[0] for name in imported} <= sys.stdlib_module_names, imported
functions = [node for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]
assert len(functions) > 50
for function in functions:
    given = function.args
    arguments = [*given.posonlyargs, *given.args, *given.kwonlyargs, *filter(None, (given.vararg, given.kwarg))]
    untyped = [one.arg for one in arguments if one.annotation is None and one.arg != "self"]
    assert function.returns and not untyped, (function.name, untyped)

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    source, installed = folder / "source", folder / "installed"
    source.mkdir()
    for file in ("pyproject.toml", "README.md", "build_wheel.py", "septet.py"):  # pip builds where the source lies.
        shutil.copy(module / file, source)
    # As one types it, in an environment of its own for the build, but with no index to fetch from.
    environment = {"PATH": "/usr/bin:/bin", "HOME": name}
    done = subprocess.run([sys.executable, "-m", "pip", "--isolated", "install", "--no-index", "--no-cache-dir", "--no-compile",
                           "--target", str(installed), str(source)], env=environment, cwd=name, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    modules = {str(file.relative_to(installed / "septet")) for file in installed.rglob("*") if file.is_file() and ".dist-info" not in file.parts[-2]}
    assert modules == {"__init__.py", "py.typed"}, modules  # The second says to type checkers that the first is typed.
    (septet,) = metadata.distributions(path=[str(installed)])
    assert septet.metadata["Name"] == "septet" and not septet.requires, septet.metadata
    assert "Tag: py3-none-any" in septet.read_text("WHEEL")
    version = re.search(r"^project\(septet VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(), re.M)[1]
    assert septet.version == version, (septet.version, version)
    # Elsewhere it is found, and is the file that lies here.
    said = subprocess.run([sys.executable, "-B", "-c", "import septet; print(septet.__file__); print(*septet.__all__)"], cwd=name,
                          env=environment | {"PYTHONPATH": str(installed)}, capture_output=True, text=True, timeout=600)
    assert said.returncode == 0, said.stderr
    where, names = said.stdout.splitlines()
    assert where == str(installed / "septet" / "__init__.py") and "connect" in names.split(), said.stdout
    assert pathlib.Path(where).read_bytes() == (module / "septet.py").read_bytes()
