#include "tools/cli/schema.h"

#include "engine/base/error.h"
#include "engine/scene/example.h"
#include "engine/scene/schema.h"

namespace firn {

int run_schema(bool example, std::ostream& out) {
  out << (example ? example_scene() : scene_schema()) << std::flush;
  return static_cast<int>(out ? ExitCode::ok : ExitCode::io);
}

}  // namespace firn
