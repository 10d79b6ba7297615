// `--set bodies.ball.velocity=[1, 0, 0]`: changes a scene's text before anything in it is looked at.
#pragma once

#include <string>

#include <toml++/toml.h>

#include "engine/scene/report.h"

namespace firn {

/// KEY=VALUE with a dotted key and a value in TOML; a bare word is a string. Tables in an array go by their
/// name or by their index. What the key names is replaced, or made if it is absent; with no value it is
/// removed.
void apply_override(const std::string& text, toml::table& scene, Report& report);

}  // namespace firn
