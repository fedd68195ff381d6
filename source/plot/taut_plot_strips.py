# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sliding contacts as they are evaluated: those of one strip on several wires together, their force the sum."""

import numpy as np
from taut_plot_files import UserError, low_pass, numbers, statistic


MOST_SAMPLES = 400_000  # of a record at equal steps


def equal_steps(time):
    """Times a shortest step apart, from the first on; the times themselves where steps are equal, as taut takes them."""
    steps = np.diff(time)
    if len(steps) == 0 or steps.max() <= 1.001 * steps.min():
        return time
    whole = time[-1] - time[0]
    step = max(steps.min(), whole / MOST_SAMPLES)
    return time[0] + step * np.arange(int(whole / step * (1 + 1e-12)) + 1)


class Strip:
    """A contact strip. At equal steps, linear between the rows of the table, are `time` [s], `force` [N], the sum over the
    wires it touches, `position` and `x` [m], `shares`, {wire: force} of a strip on several wires, and `evaluated`, the force
    that statistics are of: low-passed at `frequency` [Hz] if that is not 0. `rows` has time, x and force as recorded."""

    def __init__(self, results, name, contacts, table):
        columns = table.columns
        self.name, self.contacts, self.time = name, contacts, equal_steps(table.time)
        forces = [columns[f"{contact} force [N]"] for contact in contacts]
        total = forces[0] if len(forces) == 1 else np.sum(forces, axis=0)
        position = columns[f"{contacts[0]} position [m]"]
        self.rows = table.time, place_of(results, contacts[0], position), total
        self.force, self.position, self.x, *forces = (
            values if self.time is table.time else np.interp(self.time, table.time, values)
            for values in (total, position, self.rows[1], *forces))
        self.shares = {wire_of(results, contact): force for contact, force in zip(contacts, forces)} \
            if len(contacts) > 1 else {}
        self.moves = np.ptp(self.position) > 0
        self.step = (self.time[-1] - self.time[0]) / max(1, len(self.time) - 1)
        self.frequency = filter_frequency(results, contacts[0])
        if not (self.frequency and 4 * self.frequency * self.step < 1 and len(self.force) > 2):
            self.frequency = 0
        self.evaluated = self.low_passed(self.force)
        self.window = statistic(results.statistics, "sliding contacts", contacts[0], "window") or \
            numbers(results.entries.get("Statistics/Window", ""))

    def low_passed(self, force):
        return low_pass(force, self.step, self.frequency) if self.frequency else force

    @property
    def filter_text(self):
        return f"low-passed at {self.frequency:g} Hz" if self.frequency else "not filtered"

    def inside(self, window):
        """Flags of the samples that are evaluated, at positions on the (first) wire between the ends of the window."""
        limits = window or self.window
        if len(limits) != 2 or not self.moves:
            return np.ones(len(self.time), bool)
        slack = 1e-9 * (1 + abs(limits[1]))
        place = self.x if self.shares else self.position
        inside = (place >= limits[0] - slack) & (place <= limits[1] + slack)
        if window and not inside.any():
            raise UserError(f"--window {limits[0]:g},{limits[1]:g}: '{self.name}' is never there; "
                            f"it goes from {place.min():g} to {place.max():g} m")
        return inside


def filter_frequency(results, contact):
    if statistic(results.statistics, "sliding contacts", contact, "filter frequency", "resolved") is False:
        return 0
    return statistic(results.statistics, "sliding contacts", contact, "filter frequency") or \
        float(results.entries.get("Statistics/Filter frequency", 0))


def wire_of(results, contact):
    """Name of the wire that a sliding contact runs on, or None where the results do not say it."""
    entries = results.entries
    if entries.get("Generator") == "catenary":
        return contact.partition(" on ")[2] or "contact"
    for name in (contact, contact.partition(" on ")[0]):
        for end in ("To", "From"):
            wire, at, _ = entries.get(f"Network/Link {name}/{end}", "").partition("@")
            if at:
                return wire.strip()
    return contact.partition(" on ")[2] or None


def place_of(results, contact, position):
    """x [m] of positions on the wire of a contact."""
    start = results.places().get(contact)
    if start is None:
        return position
    section = f"Network/Wire {wire_of(results, contact)}"
    ends = [numbers(results.entries.get(f"{section}/{end}", "")) for end in ("From", "To")]
    backwards = all(ends) and ends[1][0] < ends[0][0]
    return start + (position[0] - position if backwards else position - position[0])


def read_strips(results):
    """The strips of sliding.csv in order; contacts named '<strip> on <wire>' are those of one strip."""
    table = results.table("sliding.csv")
    names = results.sliding()
    groups = {}
    for name in names:
        strip, on, _ = name.partition(" on ")
        several = on and sum(other.startswith(f"{strip} on ") for other in names) > 1
        groups.setdefault(strip if several else name, []).append(name)
    # A column of the sum, if there is one, says the same as those of its parts.
    groups = {name: [one for one in some if one != name] if len(some) > 1 else some for name, some in groups.items()}
    return [Strip(results, name, some, table) for name, some in groups.items()]


def strips_over_x(results):
    """Those that move, with more than two samples, and why there are none."""
    strips = read_strips(results)
    if not strips:
        return [], "no sliding contact in this run"
    strips = [strip for strip in strips if len(strip.time) > 2]
    return strips, None if strips else "too few steps"


def bands(frequency, wanted=None):
    """Limits of the bands of a spectrum [Hz]: those that are asked for, or up to 5 Hz (of the spans) and from there up to the
    filter frequency (of the droppers)."""
    if wanted:
        return wanted
    top = frequency or 20.0
    return [0.0, 5.0, top] if top > 5 else [0.0, top]


def power_spectrum(values, step):
    """Frequencies [Hz] and one-sided power spectral density of evenly spaced values by Welch's method, as taut has it in its
    statistics; its sum times the interval of the frequencies is the variance."""
    values = np.asarray(values, float) - np.mean(values)
    n = 1 << (len(values).bit_length() - 1)
    last = -(-2 * (len(values) - n) // n)  # number of the last segment
    window = np.hanning(n + 1)[:-1]
    power = sum(np.abs(np.fft.rfft(window * values[first:first + n])) ** 2
                for first in ((len(values) - n) * i // max(1, last) for i in range(last + 1)))
    power[1:-1] *= 2
    frequencies = np.fft.rfftfreq(n, step)
    total = power.sum() * frequencies[1]
    return frequencies, power * (values.var() / total if total > 0 else 0.0)


def deviation_in(frequencies, power, low, high):
    """Standard deviation of what lies between two frequencies; a value of the spectrum is for the frequencies nearest to it."""
    half = frequencies[1] / 2
    begin, end = np.maximum(frequencies - half, 0), np.minimum(frequencies + half, frequencies[-1])
    inside = np.clip(np.minimum(end, high) - np.maximum(begin, low), 0, None)
    return float(np.sqrt((power * inside / (end - begin)).sum() * frequencies[1]))


def sections(places, strip):
    """[(from, to)] of the spans that the strip passes in whole."""
    low, high = strip.x.min(), strip.x.max()
    places = np.unique(np.round(places, 6))
    return [(a, b) for a, b in zip(places[:-1], places[1:]) if a >= low - 1e-6 and b <= high + 1e-6 and b - a > 1]

