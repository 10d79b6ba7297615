#!/usr/bin/python3
"""Runs the experiments that tests/validation/README.md has a table of, and prints its rows.

usage: experiments.py FIRN CACHE_ROWS [column] [slope] [taylor] [landings] ...

All of them take some fifteen minutes on one core.
"""

import math
import os
import sys

sys.dont_write_bytecode = True

import column  # noqa: E402
import experiment  # noqa: E402
import landings  # noqa: E402
import slope  # noqa: E402
import taylor  # noqa: E402
from firn_cli import cache_rows  # noqa: E402


def show(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def run(text):
    return experiment.Run(text, "--threads", "1")


def columns():
    show("a", "cells in d0", "run-out", "height / d0")
    found = []
    for aspect, cells in ((0.5, 30), (1, 30), (2, 30), (4, 30), (8, 30), (4, 20), (8, 20), (16, 20)):
        got = column.measure(run(column.scene(aspect, cells)).points(-1), aspect, cells)
        show(aspect, cells, f"{got.runout:.2f}", f"{got.height:.2f}")
        if cells == 20:
            found.append((aspect, got))
    for name in ("runout", "height"):
        prefactor, exponent = power_law([(aspect, getattr(got, name)) for aspect, got in found])
        show(name, "4 to 16", f"{prefactor:.2f} a^{exponent:.3f}", "")
    for degrees in (24.8, 35):
        friction = math.tan(math.radians(degrees))
        got = column.measure(run(column.scene(2, friction=friction)).points(-1), 2, 30)
        show(f"2, friction of {degrees} degrees", 30, f"{got.runout:.2f}", f"{got.height:.2f}")


def power_law(pairs):
    """Prefactor and exponent of the straight line through the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in pairs]
    x0, y0 = (sum(values) / len(logs) for values in zip(*logs))
    exponent = sum((x - x0) * (y - y0) for x, y in logs) / sum((x - x0)**2 for x, _ in logs)
    return math.exp(y0 - exponent * x0), exponent


def slopes():
    show("dimension", "length / H", "cells in H", "angle", "mean creep / H", "largest")
    for dimension, length, cells, angles in ((2, 100, 6, (23.8, 24.3, 25.3, 25.8)), (2, 20, 10, (20, 23.8, 25.8, 28)),
                                             (3, 12, 10, (33.7, 35.7))):
        for angle in angles:
            done = run(slope.scene(angle, length=length, cells=cells, dimension=dimension))
            mean, most = slope.creep(done.tracked(6), done.tracked(-1), length)
            show(dimension, length, cells, angle, f"{mean:.1e}", f"{most:.1e}")


def bars():
    show("bar", "cells in radius", "precision", "transfer", "length, mm", "foot radius", "radius at 0.2 L0", "largest strain")
    fine = ((8, "float", "apic"), (8, "double", "apic"), (8, "float", "mls"), (12, "float", "apic"))
    for name, bar, settings in (("smooth", taylor.SMOOTH, fine), ("Johnson-Cook", taylor.JOHNSON_COOK, fine),
                                ("Johnson-Cook, C = 0", taylor.WITHOUT_RATE, fine[:1])):
        for cells, precision, transfer in settings:
            done = run(taylor.scene(bar, cells, precision, transfer))
            got = taylor.measure(bar, cells, done.tracked(1), done.tracked(-1))
            strain = max(experiment.attribute(done.frame(-1), "alpha"))
            show(name, cells, precision, transfer,
                 *(f"{1e3 * x:.2f}" for x in (got.length, got.mushroom, got.fifth)), f"{strain:.2f}")


def beds():
    show("landings", "cells in depth", "correction", "height of the middle half", "median volume", "J_P under load")
    for count, cells, correction in ((100, 20, True), (100, 10, True), (25, 20, False)):
        done = run(landings.scene(count, correction, cells))
        rows = cache_rows(done.frame(-1))
        low, high = landings.opening_under_load(rows)
        show(count, cells, "with" if correction else "without",
             f"{landings.spread(done.points(-1)) / landings.spread(done.points(1)):.3f}", f"{landings.volume(rows):.3f}",
             f"{low:.5f} to {high:.5f}")


EXPERIMENTS = {"column": columns, "slope": slopes, "taylor": bars, "landings": beds}


def main():
    if len(sys.argv) < 3 or any(name not in EXPERIMENTS for name in sys.argv[3:]):
        sys.exit(__doc__)
    experiment.programs["firn"], experiment.programs["cache_rows"] = map(os.path.abspath, sys.argv[1:3])
    for name in sys.argv[3:] or EXPERIMENTS:
        print(f"\n{name}\n", flush=True)
        EXPERIMENTS[name]()


if __name__ == "__main__":
    main()
