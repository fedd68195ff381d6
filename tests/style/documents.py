#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All links between the documents lead to a file and a heading that exist; the pages speak of Taut, not of their own making;
every page of doc/ can be reached from README.md."""
import argparse
import pathlib
import re
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
root = parser.parse_args().root.resolve()

HISTORY = re.compile(r"\b20\d\d-\d\d-\d\d\b|was asked|(is|are|was) missed|the aim\b|today.s|tried as|was wrong|"
                     r"\bcommit [0-9a-f]{7}|nothing beats", re.IGNORECASE)


def prose(page):
    """Its lines, blank where they are in a fenced block."""
    fenced, lines = False, []
    for line in page.read_text(encoding="utf-8").splitlines():
        fence = line.startswith("```")
        fenced ^= fence
        lines.append("" if fenced or fence else line)
    return lines


def anchors(page):
    """What a link may name behind #, as GitHub makes it from headings."""
    headings = (re.match(r"#+ +(.*)", line) for line in prose(page))
    texts = (re.sub(r"\[([^]]*)\]\([^)]*\)|[`*]", r"\1", heading[1]) for heading in headings if heading)
    return {re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-") for text in texts}


errors, n_links, reached = [], 0, set()
pages = [root / "README.md", root / "prm" / "README.md", *sorted((root / "doc").rglob("*.md"))]
for page in pages:
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        found = HISTORY.search(line)
        if found:
            errors.append(f"{page}:{number}: '{found[0]}' is about the page's making")
    for number, line in enumerate(prose(page), 1):
        for link in re.findall(r"\]\(([^)\s]+)\)", line):
            if "://" in link:
                continue
            n_links += 1
            name, _, anchor = link.partition("#")
            target = (page.parent / name).resolve() if name else page
            if not target.exists():
                errors.append(f"{page}:{number}: '{link}': there is no such file")
            elif anchor and anchor not in anchors(target):
                errors.append(f"{page}:{number}: '{link}': there is no such heading")
            if target != page:
                reached.add(target)
errors += [f"{page}: no page leads there" for page in pages[1:] if page not in reached]
print(len(pages), "pages,", n_links, "links")
if n_links == 0:
    errors.append("no links found")
sys.exit("\n".join(errors) or None)
