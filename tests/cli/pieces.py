"""Connected pieces of a cloud of particles."""

import itertools

AROUND = [offset for offset in itertools.product((-1, 0, 1), repeat=3) if any(offset)]


def pieces(points, cell, least=1):
    """The pieces as lists of indices into `points`, largest first.

    Points belong together when their cells touch by a face, an edge or a corner. A cell with fewer than `least` points
    is no part of any piece.
    """
    cells = {}
    for index, point in enumerate(points):
        cells.setdefault(tuple(int(x // cell) for x in point), []).append(index)
    cells = {cell: members for cell, members in cells.items() if len(members) >= least}
    found = []
    while cells:
        first, members = cells.popitem()
        front, piece = [first], list(members)
        while front:
            here = front.pop()
            for offset in AROUND:
                there = (here[0] + offset[0], here[1] + offset[1], here[2] + offset[2])
                if there in cells:
                    piece += cells.pop(there)
                    front.append(there)
        found.append(piece)
    return sorted(found, key=len, reverse=True)
