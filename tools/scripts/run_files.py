"""What scripts read of a run's folder; a mistake ends the script with exit code 3."""

import csv
import json
import os
import sys
import tomllib


def diagnostics(folder):
    """A dictionary of numbers for each frame; at least two."""
    try:
        with open(os.path.join(folder, "diagnostics.csv"), encoding="utf-8", newline="") as text:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(text)]
    except (OSError, ValueError, TypeError) as problem:
        fail(f"{folder} holds no diagnostics.csv of a run: {problem}")
    if len(rows) < 2:
        fail(f"{folder} holds fewer than two frames")
    return rows


def scene(folder):
    """The scene of the run, overrides included."""
    try:
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as text:
            return tomllib.loads(json.load(text)["scene"])
    except (OSError, ValueError, KeyError) as problem:
        fail(f"{folder} holds no run.json of a run: {problem}")


def deliver(text, file):
    if file is None:
        sys.stdout.write(text)
        return
    with open(file, "w", encoding="utf-8") as out:
        out.write(text)


def fail(message):
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(3)
