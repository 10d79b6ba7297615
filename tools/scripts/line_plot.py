"""Line plots as SVG, for the scripts beside this file: panels side by side, with one vertical axis. The colours are of
middle brightness and nothing is filled behind them, so that it reads on a white page and on a black one."""

import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 800, 340
LEFT, RIGHT, TOP, BOTTOM, GAP = 64, 784, 64, 286, 20
APART_TOP = 36
TEXT = "#808891"
COLOURS = {"orange": "#d97a1e", "blue": "#3a8fe0", "green": "#3aa76d"}


class Curve:
    def __init__(self, name, colour, points):
        self.name, self.colour, self.points = name, COLOURS[colour], points


class Panel:
    def __init__(self, across, up, curves):
        self.across, self.up, self.curves = across, up, curves


def draw(title, panels, across, up):
    """`panels`: pairs of a heading and its curves; `across`, `up`: what the axes show."""
    everything = [point for _, curves in panels for curve in curves for point in curve.points]
    y_axis = Axis([y for _, y in everything], BOTTOM, TOP, 6)
    width = (RIGHT - LEFT - GAP * (len(panels) - 1)) / len(panels)
    x_ticks = 8 if len(panels) == 1 else 4
    parts = [text(LEFT, 20, up, "start")]
    place = RIGHT
    for curve in reversed(panels[0][1]):
        parts.append(text(place, 20, curve.name, "end", curve.colour))
        place -= 24 + 7 * len(curve.name)
    for k, (heading, curves) in enumerate(panels):
        left = LEFT + k * (width + GAP)
        x_axis = Axis([x for x, _ in everything], left, left + width, x_ticks)
        for tick in y_axis.ticks:
            y = y_axis.at(tick)
            parts.append(line(left, y, left + width, y, 0.7 if tick == y_axis.ticks[0] else 0.25))
            if k == 0:
                parts.append(text(left - 8, y + 4, f"{tick:g}", "end"))
        for tick in x_axis.ticks:
            parts.append(line(x_axis.at(tick), BOTTOM, x_axis.at(tick), BOTTOM + 5, 0.7))
            # The last of a panel would meet the first of the next.
            if k == len(panels) - 1 or tick < x_axis.ticks[-1]:
                parts.append(text(x_axis.at(tick), BOTTOM + 21, f"{tick:g}", "middle"))
        parts.append(text(left + width / 2, BOTTOM + 44, across, "middle"))
        parts.append(text(left + width / 2, TOP - 12, heading, "middle"))
        for curve in curves:
            parts.append(polyline(x_axis, y_axis, curve))
    return document(title, parts)


def draw_apart(title, panels):
    """Panels that share no axis."""
    width = (RIGHT - LEFT - GAP - LEFT) / len(panels)
    parts = []
    for k, panel in enumerate(panels):
        left = LEFT + k * (width + GAP + LEFT)
        points = [point for curve in panel.curves for point in curve.points]
        x_axis = Axis([x for x, _ in points], left, left + width, 5)
        y_axis = Axis([y for _, y in points], BOTTOM, APART_TOP, 6)
        parts.append(text(left, 20, panel.up, "start"))
        parts.append(text(left + width / 2, BOTTOM + 44, panel.across, "middle"))
        for tick in y_axis.ticks:
            parts.append(line(left, y_axis.at(tick), left + width, y_axis.at(tick), 0.7 if tick == 0 else 0.25))
            parts.append(text(left - 8, y_axis.at(tick) + 4, f"{tick:g}", "end"))
        for tick in x_axis.ticks:
            parts.append(line(x_axis.at(tick), BOTTOM, x_axis.at(tick), BOTTOM + 5, 0.7))
            parts.append(text(x_axis.at(tick), BOTTOM + 21, f"{tick:g}", "middle"))
        parts += [polyline(x_axis, y_axis, curve) for curve in panel.curves]
    return document(title, parts)


def polyline(x_axis, y_axis, curve):
    path = " ".join(f"{x_axis.at(x):.1f},{y_axis.at(y):.1f}" for x, y in curve.points)
    return f'<polyline points="{path}" fill="none" stroke="{curve.colour}" stroke-width="2"/>'


def document(title, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            f'font-family="sans-serif" font-size="13">\n<title>{escape(title)}</title>\n' + "\n".join(parts)
            + "\n</svg>\n")


class Axis:
    """From value to place, with ticks at round numbers around all of the values and zero."""

    def __init__(self, values, start, end, most_ticks):
        low, high = min(0.0, *values), max(0.0, *values)
        rough = (high - low or 1.0) / most_ticks
        power = 10.0 ** math.floor(math.log10(rough))
        # 1e-9: a value that stands on a tick but for rounding needs no other tick beyond it.
        step = next(power * m for m in (1, 2, 5, 10) if power * m >= rough * (1 - 1e-9))
        first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
        self.ticks = [k * step for k in range(first, max(last, first + 1) + 1)]
        self.start, self.end = start, end

    def at(self, value):
        return self.start + (self.end - self.start) * (value - self.ticks[0]) / (self.ticks[-1] - self.ticks[0])


def text(x, y, words, anchor, colour=TEXT):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{escape(words)}</text>'


def line(x1, y1, x2, y2, opacity):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{TEXT}" '
            f'stroke-opacity="{opacity}"/>')
