// Mistakes that show only when several keys of a scene are seen together. Called when a table has been read;
// keys that had a mistake of their own are left alone.
#pragma once

#include "engine/scene/description.h"

namespace firn {

class TableReader;

void check(TableReader& reader, const SimulationDescription& d);
void check(TableReader& reader, const Vec3& gravity);
void check(TableReader& reader, const MaterialDescription& d);
void check(TableReader& reader, const ShapeDescription& d);
void check(TableReader& reader, const BodyDescription& d);
void check(TableReader& reader, const KeyFrame& d);
void check(TableReader& reader, const ColliderDescription& d);
void check(TableReader& reader, const BodyForceDescription& d);
void check(TableReader& reader, const LoadDescription& d);
void check(TableReader& reader, const DomainDescription& d);
void check(TableReader& reader, const OutputDescription& d);
void check(TableReader& reader, const SceneDescription& d);

}  // namespace firn
