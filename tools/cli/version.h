#pragma once

namespace firn {
inline constexpr char kVersion[] = FIRN_VERSION;
}
