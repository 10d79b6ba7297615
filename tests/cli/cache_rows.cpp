// Prints the particles of a point cache as CSV, read with OpenVDB's own reader: what no installed program
// shows.
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/engine/output/read_cache.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: cache_rows FRAME.vdb\n", stderr);
    return 2;
  }
  try {
    const firn::testing::ReadCache cache = firn::testing::read_cache(argv[1]);
    fmt::print("id,x,y,z,vx,vy,vz,pscale,Jp,material,F00,F01,F02,F10,F11,F12,F20,F21,F22\n");
    for (std::size_t p = 0; p < cache.id.size(); ++p)
      fmt::print("{},{},{},{},{},{},{}\n", cache.id[p], fmt::join(cache.P[p], ","),
                 fmt::join(cache.v[p], ","), cache.pscale[p], cache.Jp[p], cache.material[p],
                 fmt::join(cache.F_E[p], ","));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[1], error.what());
    return 1;
  }
  return 0;
}
