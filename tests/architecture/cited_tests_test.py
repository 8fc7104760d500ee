"""Each test that docs/verse.md names exists."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
page = root / "docs/verse.md"
known = {name for file in root.glob("tests/**/*.cpp") for name in re.findall(r'TEST_CASE\("([^"]+)"', file.read_text(encoding="utf-8"))}
cited = re.findall(r'"([^"]+)"', page.read_text(encoding="utf-8"))
missing = [name for name in cited if name not in known]
for name in missing:
    print(f'{page.relative_to(root)}: no test is called "{name}"')
if not cited:
    print(f"{page.relative_to(root)}: it names no test")
sys.exit(bool(missing) or not cited)
