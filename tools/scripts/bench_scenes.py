"""What `scaling` and `prices` share: scenes as text, calls of firn, and Markdown."""

import argparse
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

CELL = 0.02  # m, as of the box that `firn bench` brings along

SNOW = {"model": '"snow_stomakhin_2013"'}


def options(description, rounds, steps):
    """The arguments of both scripts."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("firn", nargs="?", default=os.path.join(ROOT, "build", "release", "firn"),
                        help="the program to measure (build/release/firn)")
    parser.add_argument("--out", metavar="FILE", help="for the Markdown; standard output if left out")
    parser.add_argument("--rounds", type=int, default=rounds, help="turns, of which the best counts (%(default)s)")
    parser.add_argument("--steps", type=int, default=steps, help="of a round (%(default)s)")
    parser.add_argument("--quick", action="store_true", help="few particles and steps: for tests, not for figures")
    return parser


def parsed(parser):
    given = parser.parse_args()
    if given.rounds < 1 or given.steps < 1:
        parser.error("--rounds and --steps are 1 or more")
    if not os.access(given.firn, os.X_OK):
        parser.exit(3, f"{parser.prog}: {given.firn} is no program; tools/firn builds it\n")
    if given.quick:
        given.rounds, given.steps = 1, 2
    return given


# ---- scenes ----


def table(name, values):
    return f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in values.items())


def scene(bodies, materials, *effects):
    """A scene in free space that no frame interrupts; `effects` are tables of their own."""
    simulation = {"cell_size": CELL, "duration": 10, "frame_rate": 0.1, "transfer": '"mls"', "precision": '"float"'}
    parts = [table("simulation", simulation)]
    parts += [table("[bodies]", body) for body in bodies]
    parts += [table(f"materials.{name}", values) for name, values in materials.items()]
    return "\n".join([*parts, *effects])


def box(low, high):
    """From corner to corner, in cells."""
    return f'{{ type = "box", min = {metres(low)}, max = {metres(high)} }}'


def metres(cells):
    return [round(CELL * c, 9) for c in cells]


def write(folder, name, text):
    file = os.path.join(folder, name)
    with open(file, "w", encoding="utf-8") as out:
        out.write(text)
    return file


# ---- firn ----


def firn(program, *arguments):
    """What it prints. Its messages and its progress go where ours do."""
    done = subprocess.run([program, *map(str, arguments)], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode < 0:
        sys.exit(f"{program} was ended by signal {-done.returncode}")
    if done.returncode > 0:
        sys.exit(done.returncode)
    return done.stdout


def plan(program, file):
    return json.loads(firn(program, "plan", file, "--json"))


def bench(program, files, rounds, steps, threads):
    """The measurements, a dictionary each; `case` is the file."""
    printed = firn(program, "bench", *files, "--json", "--rounds", rounds, "--steps", steps, "--threads",
                   ",".join(map(str, threads)))
    return [row for row in map(json.loads, printed.splitlines()) if "case" in row]


# ---- Markdown ----


def markdown(header, rows):
    """The first column is words, the others are numbers."""
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def grouped(number):
    return f"{number:,.0f}"


def where_measured(row):
    """The part of a caption that is the same for all rows."""
    return f"{processor()}, {row['isa']}, {row['precision']}, MLS"


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as text:
        for line in text:
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                return value.strip()
    return "unknown processor"


def deliver(text, file):
    if file is None:
        sys.stdout.write(text)
        return
    with open(file, "w", encoding="utf-8") as out:
        out.write(text)
