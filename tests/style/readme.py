#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""README.md has each of its two commands once, and prm/README.md names every scene."""
import argparse
import pathlib
import re
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
root = parser.parse_args().root

text = (root / "README.md").read_text()
scenes = (root / "prm" / "README.md").read_text()
errors = [f"'{file.stem}' of prm/ is not named" for file in (root / "prm").rglob("*.prm")
          if not re.search(rf"\b{file.stem}\b", scenes)]
for target in ("run_en50318", "check"):
    commands = re.findall(rf"^apt-get .*doc/packages\.txt.* --target {target}$", text, re.MULTILINE)
    if len(commands) != 1:
        errors.append(f"{len(commands)} commands end with --target {target}")
sys.exit("\n".join(errors) or None)
