# SPDX-License-Identifier: LGPL-2.1-or-later
"""A results folder as one HTML file: verdict, warnings, figures as tables, and the pictures inside. It refers to nothing else."""
import csv
import html
import io
import json
import os
import re

import matplotlib
import taut_plot_assessment as assessment
from taut_plot_files import UserError

MOST_ROWS = 200
# Units of files and those that people read.
CUSTOMARY = {"m": (1e3, "mm"), "rad": (1e3, "mrad"), "Pa": (1e-6, "MPa")}
AS_IN_FILES = ("position", "from", "to", "window", "point", "length")  # places stay in m
STYLE = """body{font:15px/1.45 sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#222}
h1{font-size:1.6em}h2{font-size:1.2em;margin-top:1.8em;border-bottom:1px solid #ccc}
table{border-collapse:collapse;margin:.6em 0;font-size:.86em}td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #eee}
td:first-child,th:first-child{text-align:left}.inside{color:#176117}.outside{color:#a11212;font-weight:bold}
.warning{background:#fff4d6;padding:.4em .8em;margin:.3em 0}svg{max-width:100%;height:auto}figure{margin:1em 0}"""


def text_of(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (list, tuple)):
        return ", ".join(map(text_of, value))
    return f"{value:.4g}" if isinstance(value, (int, float)) else str(value)


def shown(key, entry):
    """[value with its unit, range, class] of a quantity."""
    unit, value = entry.get("unit", ""), entry["value"]
    factor, unit = CUSTOMARY.get(unit, (1, unit)) if key not in AS_IN_FILES else (1, unit)
    is_share = unit == "1" and (key == "contact_loss" or "share" in key)
    factor, unit = (100, "%") if is_share else (factor, unit)

    def scaled(v):
        return [scaled(x) for x in v] if isinstance(v, list) else v * factor if isinstance(v, (int, float)) else v

    limits = entry.get("expected")
    return (f"{text_of(scaled(value))} {'' if unit == '1' else unit}".strip(),
            assessment.between(*[None if limit is None else text_of(scaled(limit)) for limit in limits])
            if limits and limits != [None, None] else "",
            {True: "inside", False: "outside"}.get(entry.get("inside"), ""))


def quantities(tree, path=()):
    """[(path, quantity)] of a tree."""
    if isinstance(tree, dict) and "value" in tree:
        yield path, tree
    elif isinstance(tree, dict):
        for key, entry in tree.items():
            yield from quantities(entry, (*path, key))


def words(path):
    return html.escape(" ".join(path).replace("_", " "))


def table(heads, rows):
    """Cells are texts, or (text, class)."""
    def cell(content, tag):
        content, kind = content if isinstance(content, tuple) else (content, "")
        return f"<{tag}{f' class={kind}' if kind else ''}>{html.escape(str(content))}</{tag}>"

    lines = ["".join(cell(head, "th") for head in heads)] if heads else []
    lines += ["".join(cell(content, "td") for content in row) for row in rows[:MOST_ROWS]]
    more = f"<p>{len(rows) - MOST_ROWS} more rows are in the files.</p>" if len(rows) > MOST_ROWS else ""
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>" + more


def item_tables(section):
    """An item has a table of its own if it has ranges; else items are rows, quantities columns."""
    lines, plain = [], {}
    for name, tree in section.items():
        found = list(quantities(tree))
        if any("expected" in entry for _, entry in found):
            rows = []
            for path, entry in found:
                value, limits, kind = shown(path[-1], entry)
                rows.append((words(path), value, limits, (kind, kind)))
            lines += [f"<h3>{html.escape(name)}</h3>", table(("", "", "expected", ""), rows)]
        elif found:
            plain[name] = {words(path): shown(path[-1], entry)[0] for path, entry in found}
    heads = list(dict.fromkeys(head for row in plain.values() for head in row))
    if plain:
        lines.append(table(("", *heads), [(name, *(row.get(head, "") for head in heads)) for name, row in plain.items()]))
    return lines


def assessment_part(tree, folder):
    rows = assessment.rows(tree, folder)
    if not rows:
        return []
    said = [f"<p>{html.escape(assessment.heading(tree['sliding_contacts']))}</p>"] if tree.get("sliding_contacts") else []
    return ["<h2>Assessment of the line</h2>", *said, table(("", "of", "", "expected", "source"), rows)]


def statistics_part(tree, folder):
    lines = []
    if "verdict" in tree:
        verdict = tree["verdict"]
        lines.append(f'<p>Expected ranges: <b class="{"inside" if verdict == "inside" else "outside" if verdict == "outside" else ""}">'
                     f"{html.escape(verdict)}</b></p>")
    if tree.get("partial"):
        lines.append('<p class="warning">The run is not complete.</p>')
    for warning in tree.get("warnings", []):
        lines.append(f'<p class="warning">{html.escape(warning["message"])}</p>')
    lines += assessment_part(tree, folder)
    for key, section in tree.items():
        if isinstance(section, dict) and "value" in section:
            if key not in ("step", "end"):
                lines.append(f"<p>{words((key,))}: {html.escape(shown(key, section)[0])}</p>")
        elif isinstance(section, dict) and section:
            parts = item_tables({"": section} if key == "certificate" else section)
            lines += [f"<h2>{words((key,))}</h2>", *parts] if parts else []
    return lines


def study_part(tree):
    """The settings of a study with their cost and error."""
    rows = [row for row in tree.get("settings", tree.get("runs", [])) if isinstance(row, dict)]
    heads = list(dict.fromkeys(key for row in rows for key in row))

    def cell(value):
        return ", ".join(f"{key}: {text_of(of)}" for key, of in value.items()) if isinstance(value, dict) else text_of(value)

    return ["<h2>Study</h2>", table(heads, [[cell(row.get(head, "")) for head in heads] for row in rows])] if rows else []


def file_part(path, title):
    """A CSV table of a study or sweep."""
    with open(path, newline="", encoding="utf-8") as file:
        heads, *rows = csv.reader(file)
    return [f"<h2>{title}</h2>", table(heads, rows)]


def inline(name, figure):
    """The picture as SVG for HTML, where it needs no names of its own."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": name}):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    text = re.sub(r"<metadata>.*?</metadata>", "", stream.getvalue(), flags=re.DOTALL)
    text = re.sub(r' xmlns(:\w+)?="[^"]*"', "", text[text.index("<svg"):])
    for attribute in ('id="', 'href="#', "url(#"):  # ids of one file are different
        text = text.replace(attribute, f"{attribute}{name}-")
    return f"<figure>{text}<figcaption>{words((name,))}</figcaption></figure>"


def write_report(folder, figures, path):
    """@p figures: {name: figure}."""
    lines, title = [], os.path.basename(os.path.abspath(folder))
    try:
        if os.path.exists(os.path.join(folder, "statistics.json")):
            with open(os.path.join(folder, "statistics.json"), encoding="utf-8") as file:
                tree = json.load(file)
            title = tree.get("scene", title)
            said = [f"{key}: {text_of(tree[key]['value'])} {tree[key]['unit']}" for key in ("step", "end") if key in tree]
            said += [f"{key}: {tree[key]}" for key in ("generator", "scheme", "version") if tree.get(key)]
            lines += [f"<p>{html.escape('; '.join(said))}</p>", *statistics_part(tree, folder)]
        else:
            lines += assessment_part({}, folder)
        for name, what in (("sweep.csv", "Sweep"), ("start.csv", "Links at the start")):
            if os.path.exists(os.path.join(folder, name)):
                lines += file_part(os.path.join(folder, name), what)
        if os.path.exists(os.path.join(folder, "study.json")):
            with open(os.path.join(folder, "study.json"), encoding="utf-8") as file:
                lines += study_part(json.load(file))
    except (ValueError, KeyError, TypeError) as error:
        raise UserError(f"the files in '{folder}' are damaged: {error}") from error
    if figures:
        lines.append("<h2>Pictures</h2>")
    lines += [inline(name, figure) for name, figure in figures.items()]
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
                   f"<style>{STYLE}</style></head>\n<body><h1>{html.escape(title)}</h1>\n" + "\n".join(lines) + "\n</body></html>\n")
