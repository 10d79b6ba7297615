// Every model, by type: one line here makes a model known to scenes, to the command line and to the contract
// tests. Heavy to include; for names and parameters alone see materials/model_info.h.
#pragma once

#include <string_view>
#include <variant>

#include "materials/fixed_corotated.h"
#include "materials/neo_hookean.h"
#include "materials/snow_stomakhin_2013.h"
#include "materials/stvk_hencky.h"

namespace firn {

using Material = std::variant<  //
    NeoHookean,                 //
    FixedCorotated,             //
    StvkHencky,                 //
    SnowStomakhin2013>;

/// The model called `model`, which must exist, from values that are complete and in range
/// (materials/model_info.h).
Material make_material(std::string_view model, const ParameterValues& values);

}  // namespace firn
