# SPDX-License-Identifier: LGPL-2.1-or-later
"""What standards of overhead lines ask of a run, as one table: contact forces of each pantograph, uplift at the masts, droppers,
wires and elasticity. All from statistics.json, and from elasticity.json where `--elasticity` wrote into the same folder."""
import json
import os

# Label, where it is below a sliding contact, factor and unit, digits.
OF_CONTACT = (
    ("mean force F_m", ("filtered", "mean"), 1, "N", 1),
    ("standard deviation σ", ("filtered", "standard_deviation"), 1, "N", 1),
    ("σ / F_m", ("filtered", "standard_deviation_over_mean"), 1, "", 3),
    ("F_m + 3 σ", ("filtered", "mean_plus_3_standard_deviations"), 1, "N", 1),
    ("F_m − 3 σ", ("filtered", "mean_minus_3_standard_deviations"), 1, "N", 1),
    ("largest force", ("filtered", "maximum"), 1, "N", 1),
    ("smallest force", ("filtered", "minimum"), 1, "N", 1),
    ("σ, 0 to 2 Hz", ("standard_deviation_0_to_2_Hz",), 1, "N", 1),
    ("σ, 0 to 5 Hz", ("standard_deviation_0_to_5_Hz",), 1, "N", 1),
    ("σ, 5 to 20 Hz", ("standard_deviation_5_to_20_Hz",), 1, "N", 1),
    ("contact loss", ("contact_loss",), 100, "%", 2),
    ("losses over 5 ms", ("losses_over_5_ms",), 1, "", 0),
    ("range of heights", ("height_range",), 1e3, "mm", 1),
)


def found(tree, path):
    for key in path:
        tree = tree.get(key, {}) if isinstance(tree, dict) else {}
    return tree if isinstance(tree, dict) and isinstance(tree.get("value"), (int, float)) else None


def number(value, factor, unit, digits):
    return f"{factor * value:.{digits}f} {unit}".strip()


def between(low, high):
    """Texts of limits, of which one may be None."""
    return f"at most {high}" if low is None else f"at least {low}" if high is None else f"{low} to {high}"


def limits(entry, factor, unit, digits):
    low, high = entry.get("expected", (None, None))
    if low is None and high is None:
        return ""
    return between(None if low is None else number(low, factor, unit if high is None else "", digits),
                   None if high is None else number(high, factor, unit, digits))


def kind(entry):
    return {True: "inside", False: "outside"}.get(entry.get("inside"), "")


def row(label, entry, factor, unit, digits, where="", source=""):
    return (label, where, (number(entry["value"], factor, unit, digits), kind(entry)), limits(entry, factor, unit, digits), source)


def of_contact(name, contact, constants):
    """The rows of a sliding contact."""
    for label, key, factor, unit, digits in (("speed", "speed", 3.6, "km/h", 1), ("speed over that of waves", "speed_over_wave_speed", 1, "", 3)):
        entry = found(constants, (name, key))
        if entry:
            yield row(label, entry, factor, unit, digits, name)
    for label, path, factor, unit, digits in OF_CONTACT:
        entry = found(contact, path)
        if not entry:
            continue
        yield row(label, entry, factor, unit, digits, name)
        at_speed = found(contact, ("filtered", "mean_at_this_speed")) if path[-1] == "mean" else None
        if at_speed:
            yield row("F_m at this speed", at_speed, factor, unit, digits, name, contact.get("largest_mean_force", {}).get("source", ""))


def largest(section, key, sign=1):
    """(Name, quantity) of the item with the largest, or smallest, value of a key."""
    entries = [(name, found(item, (key,))) for name, item in section.items()]
    entries = [(name, entry) for name, entry in entries if entry]
    return max(entries, key=lambda pair: sign * pair[1]["value"], default=None)


def of_line(tree):
    """The rows of masts, droppers and wires."""
    for name, probe in tree.get("probes", {}).items():
        entry = found(probe, ("largest",))
        if entry and entry["unit"] == "m":
            yield row("uplift", entry, 1e3, "mm", 1, name)
    links = tree.get("links", {})
    for label, key, sign in (("largest force of a dropper or link", "largest_force", 1), ("smallest", "smallest_force", -1)):
        one = largest(links, key, sign)
        if one:
            yield row(label, one[1], 1, "N", 1, one[0])
    slack = [name for name, link in links.items() if (found(link, ("slackenings",)) or {"value": 0})["value"] > 0]
    if links:
        yield ("links that went slack", "", (f"{len(slack)} of {len(links)}", ""), "", "")
    for label, section, key, factor, unit in (("largest reaction of a support", "supports", "largest_reaction", 1, "N"),
                                              ("largest sag at rest", "spans", "sag", 1, "m"),
                                              ("largest tension", "observers", "largest_tension", 1e-3, "kN"),
                                              ("largest bending moment", "observers", "largest_bending_moment", 1, "N m"),
                                              ("largest stress", "observers", "largest_stress", 1e-6, "MPa")):
        one = largest(tree.get(section, {}), key)
        if one:
            yield row(label, one[1], factor, unit, 2, one[0])


def of_elasticity(folder):
    path = os.path.join(folder, "elasticity.json")
    if not os.path.exists(path):
        return
    with open(path, encoding="utf-8") as file:
        tree = json.load(file)
    for name, wire in tree["wires"].items():
        for label, key, factor, unit, digits in (("largest elasticity", "largest_elasticity", 1e3, "mm/N", 3),
                                                 ("smallest elasticity", "smallest_elasticity", 1e3, "mm/N", 3),
                                                 ("non-uniformity u", "nonuniformity", 100, "%", 1)):
            yield row(label, wire[key], factor, unit, digits, name, "(e_max − e_min) / (e_max + e_min), EN 50119" if key == "nonuniformity" else "")


def heading(contacts):
    """Where the forces come from."""
    said = []
    for name, contact in contacts.items():
        window, filtered = contact.get("window", {}), contact.get("filter_frequency", {})
        evaluated = window.get("evaluated") or window.get("value") or []
        place = f" from {evaluated[0]:g} to {evaluated[1]:g} m" if len(evaluated) == 2 else ""
        below = f", low-passed at {filtered['value']:g} Hz" if filtered.get("value") else ", not filtered"
        said.append(f"{name}{place}{below}, {contact.get('samples', 0)} samples")
    return "Contact forces: " + "; ".join(said) + ". Definitions are those of EN 50318 and EN 50367; limits are those of this run."


def rows(tree, folder):
    """Rows (quantity, where, (value, class), expected, source); none for a scene without a sliding contact."""
    contacts = tree.get("sliding_contacts", {})
    result = [line for name, contact in contacts.items() for line in of_contact(name, contact, tree.get("line_constants", {}))]
    return [*result, *of_line(tree), *of_elasticity(folder)] if result else list(of_elasticity(folder))
