# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sliding contacts as they are evaluated: those of one strip on several wires together, their force the sum."""

import numpy as np
from taut_plot_files import UserError, low_pass, numbers, statistic


class Strip:
    """A contact strip over time: `force` [N], the sum over the wires it touches; `x` [m]; `shares`, {wire: force} of a strip
    on several wires; `evaluated`, the force that statistics are of: low-passed at `frequency` [Hz] if that is not 0."""

    def __init__(self, results, name, contacts, table):
        columns = table.columns
        self.name, self.contacts, self.time = name, contacts, table.time
        forces = [columns[f"{contact} force [N]"] for contact in contacts]
        self.force = forces[0] if len(forces) == 1 else np.sum(forces, axis=0)
        self.shares = {wire_of(results, contact): force for contact, force in zip(contacts, forces)} \
            if len(contacts) > 1 else {}
        self.position = columns[f"{contacts[0]} position [m]"]
        self.x = place_of(results, contacts[0], self.position)
        self.moves = np.ptp(self.position) > 0
        self.step = (self.time[-1] - self.time[0]) / max(1, len(self.time) - 1)
        self.frequency = filter_frequency(results, contacts[0])
        if not (self.frequency and 4 * self.frequency * self.step < 1 and len(self.force) > 2):
            self.frequency = 0
        self.evaluated = self.low_passed(self.force)
        self.window = statistic(results.statistics, "sliding contacts", contacts[0], "window") or \
            numbers(results.entries.get("Statistics/Window", ""))

    def low_passed(self, force):
        return low_pass(self.evenly(force), self.step, self.frequency) if self.frequency else force

    def evenly(self, values):
        """The values at equal steps between begin and end: themselves where the steps are equal."""
        steps = np.diff(self.time)
        if len(steps) == 0 or np.ptp(steps) <= 1e-6 * self.step:
            return values
        return np.interp(np.linspace(self.time[0], self.time[-1], len(values)), self.time, values)

    @property
    def at(self):
        """What it is drawn over: x, or time where it stands."""
        return self.x if self.moves else self.time

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
    """Frequencies [Hz] and one-sided power spectral density of evenly spaced values without their mean, through the window of
    Hann; its integral is the variance."""
    values = np.asarray(values, float) - np.mean(values)
    window = np.hanning(len(values) + 1)[:-1]
    power = np.abs(np.fft.rfft(values * window)) ** 2 * step / (window ** 2).sum()
    power[1:] *= 2
    if len(values) % 2 == 0:
        power[-1] /= 2
    return np.fft.rfftfreq(len(values), step), power


def deviation_in(frequencies, power, low, high):
    """Standard deviation of what lies between two frequencies."""
    inside = (frequencies >= low) & (frequencies < high)
    return float(np.sqrt(power[inside].sum() * (frequencies[1] - frequencies[0])))


def sections(places, strip):
    """[(from, to)] of the spans that the strip passes in whole."""
    low, high = strip.x.min(), strip.x.max()
    places = np.unique(np.round(places, 6))
    return [(a, b) for a, b in zip(places[:-1], places[1:]) if a >= low - 1e-6 and b <= high + 1e-6 and b - a > 1]

