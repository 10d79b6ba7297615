// Mistakes in a path file that show only when several keys are seen together.
#pragma once

#include "tools/cli/path/description.h"

namespace firn {

class TableReader;

void check(TableReader& reader, const LegDescription& d);
void check(TableReader& reader, const PathDescription& d);

}  // namespace firn
