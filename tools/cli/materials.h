// `firn materials`: the models, their parameters, units, ranges, defaults and sources.
#pragma once

#include <ostream>
#include <string>

namespace firn {

/// All models and presets, or the one called `name`. Throws Error{ExitCode::input} when there is none of that
/// name.
int run_materials(const std::string& name, std::ostream& out);

/// The README's tables of models and presets.
int run_materials_markdown(std::ostream& out);

}  // namespace firn
