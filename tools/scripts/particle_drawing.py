"""Particles as dots whose area follows their own, with a diverging scale of colours; for dots and movie.

Everything is of middle brightness on nothing, so that it reads on a white page and on a black one.
"""

import argparse
import math
import sys

import run_files

try:
    from PIL import Image, ImageDraw, ImageFont
except ImportError:
    run_files.fail("the Python module PIL is missing; it comes with Debian's package python3-pil")

PLAIN = (0x3a, 0x8f, 0xe0)
TEXT = (0x80, 0x88, 0x91)
# From far below the centre to far above it; blue and red are told apart by the colour-blind, too.
SCALE = ((0x1d, 0x4f, 0xb8), (0x5a, 0x9b, 0xee), (0xb6, 0xbb, 0xc1), (0xee, 0x85, 0x5c), (0xb5, 0x1f, 0x1f))
FINE = 4  # pixels are averaged from that many squared
GAP, LABEL, LEGEND = 16, 26, 118  # pixels between panels, below them, and right of them
UNITS = {"pressure": "Pa", "stress": "Pa", "density": "kg/m³", "volume": "m³", "mass": "kg", "v": "m/s", "C": "1/s",
         "pscale": "m", "P": "m"}


def add_options(parser):
    parser.add_argument("--colour", metavar="NAME", help="by this attribute or component, as in pressure, stress_01")
    parser.add_argument("--centre", type=float, default=0, metavar="VALUE",
                        help="of the scale of colours, where it is grey (%(default)s)")
    parser.add_argument("--cover", type=positive, default=0.72, metavar="SHARE",
                        help="what a dot covers of its particle's area; on a lattice dots meet at 0.79 (%(default)s)")
    parser.add_argument("--limit", type=positive, metavar="SPAN",
                        help="from the centre to the ends of the scale; if left out, from the particles")


def positive(text):
    value = float(text)
    if not (value > 0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text} is not above 0")
    return value


class Colours:
    """From an attribute's value to a colour."""

    def __init__(self, name, centre, limit, frames):
        self.name, self.centre = name, centre
        away = sorted(abs(value - centre) for frame in frames for value in frame.value)
        # One particle in two hundred may be off the scale, or the oddest few would take all of it.
        self.limit = limit or rounded_up(away[int(0.995 * (len(away) - 1))])

    def of(self, value):
        place = (min(1.0, max(-1.0, (value - self.centre) / self.limit)) + 1) / 2 * (len(SCALE) - 1)
        k = min(int(place), len(SCALE) - 2)
        return tuple(round(a + (b - a) * (place - k)) for a, b in zip(SCALE[k], SCALE[k + 1]))


def rounded_up(value):
    if value <= 0:
        return 1.0
    power = 10.0**math.floor(math.log10(value))
    return next(power * m for m in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if power * m >= value * (1 - 1e-9))


class View:
    """The part of the plane that all panels show, its size in pixels, and how much of their area dots cover."""

    def __init__(self, frames, width, cover):
        margin = max(frame.cell for frame in frames) / 2
        x, y = ([end(end(getattr(frame, axis)) for frame in frames) + sign * margin
                 for end, sign in ((min, -1), (max, 1))] for axis in "xy")
        self.left, self.top = x[0], y[1]
        self.scale, self.swell = width / (x[1] - x[0]), math.sqrt(cover)
        self.size = width, max(1, round((y[1] - y[0]) * self.scale))


def panel(frame, view, colours=None):
    """One frame as a picture with nothing behind the dots."""
    picture = Image.new("RGBA", tuple(FINE * length for length in view.size), (*TEXT, 0))
    draw, scale = ImageDraw.Draw(picture), FINE * view.scale
    for k, (x, y, radius) in enumerate(zip(frame.x, frame.y, frame.radius)):
        # An ellipse's far edge is inside it: without the 1 dots would be a pixel too wide.
        a, b, r = (x - view.left) * scale, (view.top - y) * scale, view.swell * radius * scale
        fill = colours.of(frame.value[k]) if colours else PLAIN
        draw.ellipse((a - r, b - r, a + r - 1, b + r - 1), (*fill, 255))
    return picture.resize(view.size, Image.Resampling.BOX)


def font(size):
    try:
        return ImageFont.truetype("DejaVuSans.ttf", size)
    except OSError:
        run_files.fail("the font DejaVu Sans is missing; it comes with Debian's package fonts-dejavu-core")


def legend(colours, height):
    """A bar of colours with its ends and its middle in numbers, and what they are."""
    picture = Image.new("RGBA", (LEGEND, height), (*TEXT, 0))
    draw = ImageDraw.Draw(picture)
    unit = UNITS.get(colours.name, UNITS.get(colours.name.rpartition("_")[0], ""))
    power, prefix = next(((p, s) for p, s in ((1e9, "G"), (1e6, "M"), (1e3, "k")) if unit == "Pa"
                          and colours.limit >= p), (1, ""))
    draw.text((GAP, 0), colours.name, TEXT, font(13))
    draw.text((GAP, 17), prefix + unit, TEXT, font(12))
    top, bottom = 46, max(60, min(height - 8, 46 + 220))
    for y in range(top, bottom):
        value = colours.centre + colours.limit * (1 - 2 * (y - top + 0.5) / (bottom - top))
        draw.line((GAP, y, GAP + 13, y), (*colours.of(value), 255))
    for share in (-1, -0.5, 0, 0.5, 1):
        y = bottom - (share + 1) / 2 * (bottom - top)
        words = f"{(colours.centre + share * colours.limit) / power:.4g}".replace("-", "\N{MINUS SIGN}")
        draw.line((GAP + 14, y, GAP + 18, y), TEXT)
        draw.text((GAP + 23, y), words, TEXT, font(12), anchor="lm")
    return picture


def picture(frames, view, colours=None):
    """Panels side by side with their times below, and the legend."""
    width = len(frames) * view.size[0] + (len(frames) - 1) * GAP + (LEGEND if colours else 0)
    out = Image.new("RGBA", (width, view.size[1] + LABEL), (*TEXT, 0))
    draw = ImageDraw.Draw(out)
    for k, frame in enumerate(frames):
        left = k * (view.size[0] + GAP)
        out.paste(panel(frame, view, colours), (left, 0))
        if frame.time is not None:
            draw.text((left + view.size[0] / 2, view.size[1] + LABEL / 2), f"t = {frame.time:.4g} s", TEXT, font(13),
                      anchor="mm")
    if colours:
        out.paste(legend(colours, out.height), (width - LEGEND, 0))
    return out


def colours_of(given, frames):
    return Colours(given.colour, given.centre, given.limit, frames) if given.colour else None


def save(picture_or_first, file, **how):
    try:
        picture_or_first.save(file, **how)
    except (OSError, ValueError) as problem:
        print(f"{file}: {problem}", file=sys.stderr)
        sys.exit(3)


def on_white(image):
    """Without transparency, which costs a moving picture more than all the rest."""
    white = Image.new("RGBA", image.size, (255, 255, 255, 255))
    return Image.alpha_composite(white, image).convert("RGB")
