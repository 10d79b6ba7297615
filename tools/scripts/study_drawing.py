"""The plot of `study_plot` as SVG. A white page is drawn behind it: Okabe and Ito's colours, which colour-blind readers
tell apart, are made for one. Kernels and transfers look as in study.html."""

import collections
import math
import os
import textwrap
from xml.sax.saxutils import escape

import study_labels
import svg_axes as svg

WIDTH, HEIGHT = 800, 520
LEFT, RIGHT, TOP, BOTTOM = 74, 646, 50, 458
FAILED_STRIP = 26  # pixels above the axis, for the runs that have no error
LEGEND = RIGHT + 20
INK, SOFT, GRID, GREY = "#1f272e", "#5d6770", "#dde2e6", "#c8cdd2"

COLOURS = ["#e69f00", "#009e73", "#0072b2", "#d55e00", "#cc79a7", "#56b4e9", "#000000"]
KERNELS = ["linear", "gimp", "quadratic", "cubic"]
TRANSFERS = ["apic", "flip", "pic", "mls"]
# Corners of the marks by angle, and radii that make them look alike in size; no corners: a disk.
DISK = ((), 1)
SHAPES = [DISK, ((-90, 30, 150), 1.3), ((-135, -45, 45, 135), 1.25), ((-90, 0, 90, 180), 1.3),
          ((90, 210, 330), 1.3), ((-90, -18, 54, 126, 198), 1.2)]

Point = collections.namedtuple("Point", "run seconds error")


def seconds_of(run):
    """Of failed runs too; none if they are not known."""
    return (run["seconds"] or {}).get("median")


def draw(study, quantity, points):
    """Of the runs to be shown, at least one."""
    return Drawing(study, quantity, points).document()


class Drawing:
    def __init__(self, study, quantity, points):
        self.study, self.quantity, self.points = study, quantity, points
        self.failed = [run for run in study["runs"] if run["state"] == "failed"]
        runs = [point.run for point in points]
        coloured = [run for run in runs if not self.grey(run)] + self.failed
        self.colours = looks([setting(run, "kernel") for run in coloured], KERNELS, COLOURS)
        self.shapes = looks([setting(run, "transfer") for run in runs], TRANSFERS, SHAPES)
        self.sizes = sorted({run["settings"]["cell_size"] for run in runs if run["settings"].get("cell_size")})
        times = [point.seconds for point in points] + [s for s in map(seconds_of, self.failed) if s]
        self.x = svg.LogAxis(*svg.around(times, 0.05), LEFT, RIGHT)
        errors = [point.error for point in points]
        self.y = svg.LogAxis(*svg.around(errors, 0.05), BOTTOM, TOP + (FAILED_STRIP if self.failed else 0))

    def grey(self, run):
        """The truth itself is not known much better."""
        return self.quantity in run["greyed"]

    def document(self):
        title = self.study["title"] or os.path.basename(self.study["study"])
        parts = [f'<rect width="{WIDTH}" height="{HEIGHT}" rx="6" fill="#fff"/>',
                 svg.text(LEFT, 30, escape(textwrap.shorten(title, 72, placeholder=" …")), "start", INK, font_size=17,
                          font_weight="bold"),
                 *self.axes(), *self.crosses(), *self.marks(), *self.legend()]
        return svg.document(WIDTH, HEIGHT, f"{title}: error of {self.quantity} against seconds", parts)

    # ---- axes ----

    def axes(self):
        parts = []
        for tick in self.x.ticks():
            x = self.x.at(tick)
            parts.append(svg.line(x, TOP, x, BOTTOM, GRID, 1))
            parts.append(svg.text(x, BOTTOM + 19, seconds_text(tick), "middle", SOFT))
        for tick in self.y.ticks():
            y = self.y.at(tick)
            parts.append(svg.line(LEFT, y, RIGHT, y, GRID, 1))
            parts.append(svg.text(LEFT - 8, y + 4.5, percent(tick), "end", SOFT))
        parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}" fill="none" '
                     f'stroke="{SOFT}"/>')
        made, middle = self.study["made"], (TOP + BOTTOM) / 2
        repeats = f"median of {made['repeats']}, " if made["repeats"] > 1 else ""
        where = escape(textwrap.shorten(made["machine"], 40, placeholder=" …"))
        parts.append(svg.text((LEFT + RIGHT) / 2, BOTTOM + 45, f"time to compute ({repeats}{where})", "middle", INK))
        parts.append(svg.text(18, middle, f"relative error of {self.quantity} (L2)", "middle", INK,
                              transform=f"rotate(-90 18 {middle:.0f})"))
        return parts

    # ---- runs ----

    def place(self, point):
        return self.x.at(point.seconds), self.y.at(point.error)

    def radius(self, run):
        """The coarser the cells, the larger."""
        size = run["settings"].get("cell_size")
        return self.radius_of(size) if size else 5

    def radius_of(self, size):
        if len(self.sizes) < 2:
            return 5
        finest, coarsest = self.sizes[0], self.sizes[-1]
        return 3.5 + 4 * math.log(size / finest) / math.log(coarsest / finest)

    def colour(self, run):
        return GREY if self.grey(run) else self.colours[setting(run, "kernel")]

    def marks(self):
        ids = self.study["front"][self.quantity]
        by_id = {point.run["id"]: point for point in self.points}
        front = [by_id[name] for name in ids if name in by_id]
        # Grey below colours, and small marks over large ones, so that each can be seen.
        order = sorted(self.points, key=lambda point: (not self.grey(point.run), -self.radius(point.run)))
        return ['<g class="front">', svg.polyline([self.place(point) for point in front], INK, 1.5), "</g>",
                '<g class="runs">', *[self.mark(point, point in front) for point in order], "</g>",
                f'<g class="labels" font-size="{study_labels.FONT_SIZE}">', *self.labels(front), "</g>"]

    def mark(self, point, in_front):
        run = point.run
        look = self.shapes[setting(run, "transfer")]
        edge = (INK, 1.2) if in_front else ("#fff", 0.8)
        return shape(look, self.place(point), self.radius(run), self.colour(run), *edge)

    def labels(self, front):
        """The ends of the front first: where there is room for few, they say the most."""
        taken = [study_labels.around(self.place(point), self.radius(point.run)) for point in self.points]
        taken += study_labels.along([self.place(point) for point in front])
        room = study_labels.Room((LEFT, self.y.end, RIGHT, BOTTOM), taken)
        for point in [*front[:1], *front[:0:-1]]:
            words = label(point.run)
            spot = room.place(self.place(point), self.radius(point.run), words)
            if spot and spot.leader:
                yield svg.polyline(spot.leader, SOFT, 1)
            if spot:
                yield svg.text(spot.x, spot.base, escape(words), spot.anchor, INK)

    def crosses(self):
        if not self.failed:
            return
        y = TOP + FAILED_STRIP / 2
        yield svg.line(LEFT, self.y.end, RIGHT, self.y.end, SOFT, 0.5)
        yield svg.text(LEFT - 8, y + 4.5, "failed", "end", SOFT)
        yield '<g class="failed">'
        for run in self.failed:
            seconds = seconds_of(run)
            # At the left end: how long it took is not known.
            x = self.x.at(seconds) if seconds else LEFT + 10
            yield cross((x, y), self.colours[setting(run, "kernel")])
        yield "</g>"

    # ---- legend ----

    def legend(self):
        y = TOP - 12
        for heading, rows in self.keys():
            if rows and heading:
                y += 26
                yield svg.text(LEGEND - 8, y, heading, "start", INK, font_weight="bold")
            elif rows:
                y += 9
            for words, mark in rows:
                y += 18
                yield f'<g transform="translate({LEGEND} {y - 4.5:.1f})">{mark}</g>'
                yield svg.text(LEGEND + 15, y, escape(words), "start", INK)

    def keys(self):
        """Rows of words and marks below headings."""
        sizes = self.sizes if len(self.sizes) <= 6 else [self.sizes[0], self.sizes[-1]]
        yield "kernel", [(name, shape(DISK, (0, 0), 5.5, colour)) for name, colour in self.colours.items()]
        yield "transfer", [(name, shape(look, (0, 0), 5.5, SOFT)) for name, look in self.shapes.items()]
        yield "cells", [(metres(size), shape(DISK, (0, 0), self.radius_of(size), SOFT)) for size in reversed(sizes)]
        yield "", [("Pareto front", svg.polyline([(-8, 4), (8, -4)], INK, 1.5))]
        if any(self.grey(point.run) for point in self.points):
            yield "", [("near the truth's", shape(DISK, (0, 0), 5.5, GREY)), ("own uncertainty", "")]


# ---- looks ----


def setting(run, name):
    return str(run["settings"].get(name) or "–")


def looks(values, usual, offered):
    """A look for each of the values that occur; `usual` ones have the same in every study."""
    found = set(values)
    places = [*usual, *sorted(found.difference(usual))]
    return {value: offered[k % len(offered)] for k, value in enumerate(places) if value in found}


def shape(look, place, radius, colour, edge="none", width=1):
    corners, stretch = look
    border = f'fill="{colour}" stroke="{edge}" stroke-width="{width}"'
    if not corners:
        return f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="{radius:.1f}" {border}/>'
    points = [(place[0] + stretch * radius * math.cos(math.radians(angle)),
               place[1] + stretch * radius * math.sin(math.radians(angle))) for angle in corners]
    return f'<polygon points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" {border} stroke-linejoin="round"/>'


def cross(place, colour):
    x, y = place
    return (f'<path d="M{x - 5:.1f},{y - 5:.1f} l10,10 m0,-10 l-10,10" fill="none" stroke="{colour}" '
            f'stroke-width="2.2"/>')


# ---- words ----


def label(run):
    """The settings that every study has. The others are in study.html."""
    size = run["settings"].get("cell_size")
    return " ".join([setting(run, "kernel"), setting(run, "transfer"), *([metres(size)] if size else [])])


def metres(size):
    return f"{size:.3g}\u00a0m"


def percent(error):
    return f"{100 * error:g}\u00a0%"


def seconds_text(seconds):
    """In the largest unit of which there is at least a tenth."""
    for unit, size in (("s", 1), ("ms", 1e-3)):
        if seconds >= 0.0999 * size:
            return f"{seconds / size:g}\u00a0{unit}"
    return f"{seconds / 1e-6:g}\u00a0µs"
