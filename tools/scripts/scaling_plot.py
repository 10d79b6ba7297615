"""The plot of `scaling` as SVG: two panels with one scale of time. The colours are of middle brightness and nothing is
filled behind them, so that it reads on a white page and on a black one. Time is logarithmic too: a gain of two is the
same distance everywhere, and nearly empty blocks cost many times what full ones do."""

import math

import svg_axes as svg

WIDTH, HEIGHT = 800, 360
TOP, BOTTOM = 46, 300
PANELS = ((64, 480), (540, 784))  # left and right ends
TEXT, COLOURS = "#808891", ("#d97a1e", "#3a8fe0", "#3aa76d")  # of threads, in the order of their numbers


def draw(by_count, by_cell, shapes):
    """Of rows as `scaling` measures them: two curves and single points; some of each."""
    rows = by_count + by_cell + shapes
    threads = sorted(rows[0].best)
    time = TimeAxis([ns(row, t) for row in rows for t in threads])

    first = CountAxis(PANELS[0], [particles(row) for row in by_count + shapes], 10)
    second = CountAxis(PANELS[1], [row.per_cell for row in by_cell], 2)
    parts = frame(first, time, f"particles ({by_count[0].per_cell} in a cell)", power_of_ten)
    parts += frame(second, time, f"particles in a cell ({power_of_ten(by_cell[0].count)} in all)", str)
    parts.append(text(PANELS[0][0], 20, "ns a particle and step", "start"))
    for k, t in enumerate(threads):
        colour = COLOURS[k % len(COLOURS)]
        parts += curve([(first.at(particles(row)), time.at(ns(row, t))) for row in by_count], colour)
        parts += curve([(second.at(row.per_cell), time.at(ns(row, t))) for row in by_cell], colour)
        for row in shapes:
            x, y = first.at(particles(row)), time.at(ns(row, t))
            parts.append(f'<rect x="{x - 4:.1f}" y="{y - 4:.1f}" width="8" height="8" fill="none" stroke="{colour}" '
                         f'stroke-width="2"/>')
            parts.append(text(x + 9, y + 4, row.shape, "start", colour))
        parts.append(text(PANELS[1][1] - 90 * (len(threads) - 1 - k), 20, f"{t} thread{'s' if t > 1 else ''}", "end",
                          colour))
    return svg.document(WIDTH, HEIGHT,
                        "Nanoseconds a particle and step of snow, by particles and by particles in a cell", parts)


def ns(row, threads):
    return row.best[threads]["ns_per_particle_step"]


def particles(row):
    return next(iter(row.best.values()))["particles"]


class CountAxis(svg.LogAxis):
    """With a tick at each power of `base`."""

    def __init__(self, panel, values, base):
        low = math.floor(math.log(min(values), base) + 0.05)
        high = max(low + 1, math.ceil(math.log(max(values), base) - 0.05))
        # A margin, so that no marker stands on the frame.
        super().__init__(base**low, base**high, panel[0] + 12, panel[1] - 12)
        self.left, self.right = panel
        self.powers = [base**k for k in range(low, high + 1)]

    def ticks(self):
        return self.powers


class TimeAxis(svg.LogAxis):
    """Nanoseconds, with ticks at 1, 2 and 5 times powers of ten."""

    def __init__(self, values):
        nice = [m * 10**k for k in range(7) for m in (1, 2, 5)]
        low = max((n for n in nice if n <= min(values)), default=nice[0])
        high = min((n for n in nice if n > max(values)), default=nice[-1])
        super().__init__(low, high, BOTTOM, TOP)
        self.nice = [n for n in nice if low <= n <= high]

    def ticks(self):
        return self.nice


def power_of_ten(number):
    exponent = math.log10(number)
    if exponent != int(exponent):
        return f"{number:,}"
    return f'10<tspan dy="-5" font-size="10">{int(exponent)}</tspan><tspan dy="5">&#8203;</tspan>'


def text(x, y, words, anchor, colour=TEXT):
    return svg.text(x, y, words, anchor, colour)


def line(x1, y1, x2, y2, opacity):
    return svg.line(x1, y1, x2, y2, TEXT, opacity)


def curve(points, colour):
    dots = [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in points]
    return [svg.polyline(sorted(points), colour, 2), *dots]


def frame(axis, time, words, label):
    parts = []
    for tick in time.ticks():
        y = time.at(tick)
        parts.append(line(axis.left, y, axis.right, y, 0.7 if y == BOTTOM else 0.25))
        parts.append(text(axis.left - 8, y + 4, tick, "end"))
    for tick in axis.ticks():
        parts.append(line(axis.at(tick), BOTTOM, axis.at(tick), BOTTOM + 5, 0.7))
        parts.append(text(axis.at(tick), BOTTOM + 21, label(tick), "middle"))
    parts.append(text((axis.left + axis.right) / 2, BOTTOM + 46, words, "middle"))
    return parts
