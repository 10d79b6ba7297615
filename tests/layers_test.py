#!/usr/bin/python3
"""Fails when a source file includes what its layer must not see.

usage: layers_test.py SOURCE_FOLDER

A layer includes itself and what stands left of it; files of one group may include each other unless a rule below says
otherwise. A test may include what the layer it tests may. First the check is tried on a small tree with one
violation of each kind, so that a check that finds nothing is known to work.
"""

import fnmatch
import os
import re
import sys
import tempfile

LAYERS = [
    ["engine/base", "engine/math"],
    ["engine/particles", "engine/grid", "engine/shapes"],
    ["materials", "engine/passes", "engine/effects"],
    ["engine/vector"],
    ["engine/scene"],
    ["engine/simulation", "engine/output"],
    ["tools"],
]
RANK = {folder: rank for rank, group in enumerate(LAYERS) for folder in group}

# Folders that see less than their rank gives them.
ONLY = {"materials": ["materials/*", "engine/base/*", "engine/math/*", "engine/particles/columns.h"]}
NEVER = {"engine/output": ["engine/simulation/*"], "engine/simulation": ["engine/output/*"]}

# Half a minute of compile time each, and not the solver's business.
# A header of the shapes' own that includes it counts as OpenVDB wherever it is included.
HEAVY = re.compile(r"(openvdb|nanovdb|assimp)/|engine/shapes/level_set_shape\.h$")
HEAVY_ALLOWED = [
    "engine/shapes/*.cpp",
    "engine/shapes/level_set_shape.h",
    "engine/output/point_cache.cpp",
    "engine/output/point_cache_reader.cpp",
    "tests/engine/shapes/*.cpp",
    "tests/engine/output/read_cache.cpp",
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """The layer a source path belongs to, or None; tests belong to what they mirror."""
    if path.startswith("tests/"):
        path = path[len("tests/"):]
    for folder in RANK:
        if path.startswith(folder + "/"):
            return folder
    return None


def matches(path, patterns):
    return any(fnmatch.fnmatch(path, pattern) for pattern in patterns)


def includes(root, path):
    """(line number, included path) for each include; a path relative to the file becomes one from the root."""
    with open(os.path.join(root, path), encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            found = INCLUDE.match(line)
            if not found:
                continue
            name = found.group(2)
            beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
            if found.group(1) == '"' and os.path.exists(os.path.join(root, beside)):
                name = beside
            yield number, name


def complaint(path, name):
    """Why `path` must not include `name`, or None."""
    if HEAVY.match(name) and not matches(path, HEAVY_ALLOWED):
        return "OpenVDB and assimp stay in " + ", ".join(HEAVY_ALLOWED)
    here = layer_of(path)
    if here is None:
        return None
    if name.startswith("tests/"):
        if not path.startswith("tests/"):
            return "the program does not include its tests"
        return None
    there = layer_of(name)
    if there is None:
        return None
    if here in ONLY and not matches(name, ONLY[here]) and not (path.startswith("tests/") and there == here):
        return f"{here} sees only " + ", ".join(ONLY[here])
    if matches(name, NEVER.get(here, [])):
        return f"{here} does not see {there}"
    if RANK[there] > RANK[here]:
        return f"{there} stands right of {here}"
    return None


def check(root):
    problems, files = [], 0
    for top in ("engine", "materials", "tools", "tests"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in sorted(names):
                if not name.endswith((".h", ".inl", ".cpp")):
                    continue
                files += 1
                path = os.path.relpath(os.path.join(folder, name), root)
                for line, included in includes(root, path):
                    why = complaint(path, included)
                    if why:
                        problems.append(f"{path}:{line}: includes {included}: {why}")
    return problems, files


GOOD = {
    "engine/particles/columns.h": "",
    "engine/base/error.h": "",
    "engine/simulation/run.h": '#include "engine/scene/plan.h"',
    "engine/scene/plan.h": '#include "materials/registry.h"',
    "materials/registry.h": '#include "engine/particles/columns.h"\n#include "snow.h"',
    "materials/snow.h": '#include "engine/base/error.h"\n#include <vector>',
    "engine/shapes/level_set.cpp": "#include <openvdb/openvdb.h>",
    "tools/cli/run.cpp": '#include "engine/simulation/run.h"',
    "tests/engine/output/a_test.cpp": '#include "tests/engine/output/support.h"',
    "tests/validation/seeds_test.cpp": '#include "engine/simulation/run.h"',
}
BAD = {
    "engine/base/up.h": '#include "engine/grid/blocks.h"',
    "engine/grid/blocks.h": "  #  include <engine/passes/transfer.h>",
    "engine/particles/relative.h": '#include "../base/error.h"\n#include "../scene/plan.h"',
    "engine/passes/p2g.h": "#include <openvdb/Grid.h>",
    "engine/shapes/level_set.h": "#include <openvdb/Grid.h>",
    "engine/scene/mesh.cpp": "#include <assimp/scene.h>",
    "engine/output/writer.cpp": '#include "engine/simulation/run.h"',
    "engine/simulation/step.cpp": '#include "engine/output/writer.h"',
    "engine/effects/test_only.cpp": '#include "tests/engine/output/support.h"',
    "materials/table.h": '#include "engine/particles/particle_table.h"',
    "tests/engine/grid/grid_test.cpp": '#include "engine/simulation/run.h"',
}


def self_test():
    with tempfile.TemporaryDirectory() as root:
        for path, text in {**GOOD, **BAD}.items():
            os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as out:
                out.write(text + "\n")
        problems, files = check(root)
        found = sorted(problem.split(":")[0] for problem in problems)
        if found != sorted(BAD) or files != len(GOOD) + len(BAD):
            sys.exit(f"the check itself is wrong: it should find one problem each in\n{sorted(BAD)}\nand found\n" +
                     "\n".join(problems))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    self_test()
    problems, files = check(sys.argv[1])
    if files == 0:
        sys.exit(f"no source files in {sys.argv[1]}")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{files} files include nothing they should not see")


if __name__ == "__main__":
    main()
