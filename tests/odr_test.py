#!/usr/bin/python3
"""Fails when code built for AVX2 or AVX-512 could be linked into what runs on a processor without it.

usage: odr_test.py BUILD_FOLDER

An inline function or a template that is not inlined is a weak symbol, and of all objects that define it the linker
keeps one: that of an AVX-512 object may end up in the plain path. So the weak functions of these objects must belong
to their set by name: to its namespace, or to one of its types. Nor may they run anything when the program starts,
before anybody has asked what the processor can do. First the check is tried on listings made up for it.
"""

import glob
import os
import re
import subprocess
import sys

# What a function's own or its template arguments' namespaces must name.
OWN = {
    "avx2": re.compile(r"\b(firn::avx2|hwy::N_AVX2)::"),
    "avx512": re.compile(r"\b(firn::avx512|hwy::N_AVX3(_\w+)?)::"),
}

SYMBOL = re.compile(r"^[0-9a-f]+ ([A-Za-z]) (.*)$")


def complaints(isa, listing):
    """What is wrong with an object of instruction set `isa`, from what `nm -C` says of it."""
    out = []
    for line in listing.splitlines():
        found = SYMBOL.match(line)
        if not found:
            continue
        kind, name = found.groups()
        # W: weak and defined, and no object; V and u, weak and unique objects, hold constants, not code.
        if kind == "W" and not OWN[isa].search(name):
            out.append(f"{name} is weak and not of {isa} by name")
        if kind in "tT" and name.startswith(("_GLOBAL__sub_I_", "__static_initialization")):
            out.append(f"{name} runs when the program starts")
    return out


GOOD = {
    "avx2": """
0000000000000000 W void firn::avx2::update_tile<firn::NeoHookean, float, 3>(void const*, float)
0000000000000000 W hwy::N_AVX2::Vec256<float> hwy::N_AVX2::Exp<float>(hwy::N_AVX2::Vec256<float>)
0000000000000000 u firn::kColumnInfo
0000000000000000 V firn::kOther
0000000000000010 T firn::avx2::kernel_table()
                 U std::max<float>(float const&, float const&)
                 w __gmon_start__""",
    "avx512": """
0000000000000000 W firn::Vector<firn::avx512::Wide<float, 1>, 3> firn::cross<firn::avx512::Wide<float, 1> >()
0000000000000000 W hwy::N_AVX3_DL::Vec512<double> hwy::N_AVX3_DL::Log<double>(hwy::N_AVX3_DL::Vec512<double>)
0000000000000000 W hwy::N_AVX3::Log<double>()
0000000000000000 t firn::avx512::(anonymous namespace)::helper()""",
}
BAD = {
    "avx2": """
0000000000000000 W float const& std::max<float>(float const&, float const&)
0000000000000000 W firn::avx512::update_tile<firn::NeoHookean, float, 3>()
0000000000000000 W firn::avx2_report()
0000000000000040 t _GLOBAL__sub_I_materials_3d_float.cpp""",
    "avx512": """
0000000000000000 W firn::SnowStomakhin2013::update<float>(float)
00000000000000a0 W hwy::N_AVX2::Vec256<float> hwy::N_AVX2::Exp<float>(hwy::N_AVX2::Vec256<float>)
0000000000000000 W std::vector<float, std::allocator<float> >::~vector()""",
}


def self_test():
    for isa in OWN:
        wrong = complaints(isa, GOOD[isa])
        expected = len(BAD[isa].strip().splitlines())
        if wrong or len(complaints(isa, BAD[isa])) != expected:
            sys.exit(f"the check itself is wrong: of {isa} it should find {expected} mistakes and these are none:\n" +
                     "\n".join(wrong))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    self_test()
    problems, objects = [], 0
    for isa in OWN:
        paths = glob.glob(os.path.join(sys.argv[1], "CMakeFiles", f"firn_vector_{isa}.dir", "**", "*.o"), recursive=True)
        if not paths:
            sys.exit(f"no objects for {isa} in {sys.argv[1]}")
        objects += len(paths)
        for path in sorted(paths):
            listing = subprocess.run(["nm", "-C", path], check=True, capture_output=True, text=True).stdout
            problems += [f"{isa}/{os.path.basename(path)}: {problem}" for problem in complaints(isa, listing)]
    if problems:
        sys.exit("\n".join(problems))
    print(f"{objects} objects keep their instructions to themselves")


if __name__ == "__main__":
    main()
