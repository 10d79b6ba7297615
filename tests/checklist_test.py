#!/usr/bin/python3
"""Fails when the checklist in tests/README.md names a test or a file that does not exist.

usage: checklist_test.py SOURCE_FOLDER
"""

import os
import re
import sys


def sources(folder):
    for path, _, files in os.walk(folder):
        for file in files:
            if file.endswith((".cpp", "_test.py")) and file != os.path.basename(__file__):
                with open(os.path.join(path, file), encoding="utf-8") as f:
                    yield f.read()


def problems(root, text, code):
    rows = [line for line in text.splitlines() if re.match(r"\| [A-E]\d", line)]
    if len(rows) < 50:
        yield f"only {len(rows)} rows: is the table still one?"
    for row in rows:
        row = row.replace("\\|", "|")
        for name in re.findall(r'"([^"]+)"', row):
            # As it stands in a source: in quotes, or as a function's name.
            if f'"{name}"' not in code and f"def {name}(" not in code:
                yield f"no test is called {name!r}"
        for file in re.findall(r"`((?:scenes|tools|validation)/[^`]+)`", row):
            below = os.path.join("tests", file) if file.startswith("validation") else file
            if not os.path.exists(os.path.join(root, below)):
                yield f"there is no {below}"


def main(root):
    # String literals that go over several lines become one.
    code = re.sub(r'"\s*\n\s*"', "", "\n".join(sources(os.path.join(root, "tests"))))
    with open(os.path.join(root, "tests", "README.md"), encoding="utf-8") as f:
        text = f.read()
    if not list(problems(root, text.replace("| C7 |", '| C7 | "no such test"', 1), code)):
        return "a name that does not exist was not noticed"
    return "\n".join(problems(root, text, code))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) or 0)
