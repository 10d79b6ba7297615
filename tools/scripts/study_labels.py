"""Where labels find room beside points, in pixels. A box is left, top, right, bottom."""

import collections

FONT_SIZE = 11
LETTER = 0.6 * FONT_SIZE  # the mean width, of a wide font: what shows the SVG chooses its own
AIR = 3


Spot = collections.namedtuple("Spot", "x base anchor leader box")


class Room:
    """What is left of a frame."""

    def __init__(self, frame, taken):
        self.frame, self.taken = frame, list(taken)

    def place(self, point, radius, words):
        """The first spot where the words would cover nothing, and takes it; None if there is none."""
        width = LETTER * len(words)
        for spot in [*beside(point, radius + AIR, width), *self.below(point, radius + AIR, width)]:
            boxes = [spot.box, *along(spot.leader)]
            if inside(spot.box, self.frame) and not any(overlap(box, other) for box in boxes for other in self.taken):
                self.taken += boxes
                return spot
        return None

    def below(self, point, away, width):
        """Farther down, with a line to the point; left of it where the frame lets it."""
        x, y = point
        for drop in range(14, 102, 11):
            base = y + away + drop
            leader = [(x, y + away), (x, base - FONT_SIZE)]
            if x - width > self.frame[0]:
                yield spot_at(x + AIR, base, "end", width, leader)
            yield spot_at(x - AIR, base, "start", width, leader)


def beside(point, away, width):
    """Left and below first: no run lies there, or it would be of the front."""
    x, y = point
    middle = 0.3 * FONT_SIZE
    for dx, dy, anchor in ((-1, 0, "end"), (-1, 1, "end"), (0, 1.6, "middle"), (1, 0, "start"), (1, -1, "start"),
                           (0, -1.2, "middle"), (-1, -1, "end"), (1, 1, "start")):
        yield spot_at(x + dx * away, y + dy * away + middle, anchor, width, [])


def spot_at(x, base, anchor, width, leader):
    left = x - width * {"start": 0, "middle": 0.5, "end": 1}[anchor]
    return Spot(x, base, anchor, leader, (left, base - 0.8 * FONT_SIZE, left + width, base + 0.25 * FONT_SIZE))


def inside(box, frame):
    return box[0] > frame[0] and box[1] > frame[1] and box[2] < frame[2] and box[3] < frame[3]


def overlap(one, other):
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def around(point, radius):
    return point[0] - radius, point[1] - radius, point[0] + radius, point[1] + radius


def along(points):
    """Boxes that cover a line through the points, each short enough to be hardly wider than the line."""
    steps = 40
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        for k in range(steps + 1):
            yield around((x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps), 1.5)
