"""What the plots share: logarithmic axes, and the pieces of an SVG."""

import math
from xml.sax.saxutils import escape


class LogAxis:
    """From value to place: `low` is at `start`, `high` at `end`."""

    def __init__(self, low, high, start, end):
        self.low, self.high, self.start, self.end = low, high, start, end

    def at(self, value):
        return self.start + (self.end - self.start) * math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self):
        """At powers of ten; at 2 and 5 times them as well where there are few; at some powers where there are many."""
        decades = math.log10(self.high / self.low)
        every = math.ceil(decades / 8)
        powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        values = [float(f"{digit}e{power}") for power in powers if power % every == 0
                  for digit in ((1,) if decades > 2.5 else (1, 2, 5))]
        return [value for value in values if self.low <= value <= self.high]


def around(values, margin):
    """Ends of an axis with the values well inside, `margin` of their logarithms' span away, a decade at the least."""
    low, high = math.log10(min(values)), math.log10(max(values))
    span = max(high - low, 1)
    spare = (span - (high - low)) / 2 + margin * span
    return 10 ** (low - spare), 10 ** (high + spare)


def document(width, height, title, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="sans-serif" font-size="13">\n<title>{escape(title)}</title>\n' + "\n".join(parts)
            + "\n</svg>\n")


def text(x, y, words, anchor, colour, **others):
    """`words` may hold elements. In the names of `others`, _ stands for -."""
    more = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in others.items())
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}"{more}>{words}</text>'


def line(x1, y1, x2, y2, colour, opacity):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'stroke-opacity="{opacity}"/>')


def polyline(points, colour, width):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"/>'
