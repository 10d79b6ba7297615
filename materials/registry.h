// Every model, by type: one line here makes a model known to scenes, to the command line and to the contract
// tests. Heavy to include; for names and parameters alone see materials/model_info.h.
#pragma once

#include <string_view>
#include <variant>

#include "materials/fixed_corotated.h"
#include "materials/flow_bargteil_2007.h"
#include "materials/fluid.h"
#include "materials/herschel_bulkley_yue_2015.h"
#include "materials/nacc_wolper_2019.h"
#include "materials/neo_hookean.h"
#include "materials/rankine.h"
#include "materials/sand.h"
#include "materials/snow_stomakhin_2013.h"
#include "materials/stvk_hencky.h"
#include "materials/von_mises.h"

namespace firn {

using Material = std::variant<  //
    NeoHookean,                 //
    FixedCorotated,             //
    StvkHencky,                 //
    SnowStomakhin2013,          //
    SandKlar2016,               //
    SandPerzyna,                //
    VonMisesLinear,             //
    VonMisesVoce,               //
    VonMisesJohnsonCook,        //
    VonMisesPerzyna,            //
    NaccWolper2019,             //
    HerschelBulkleyYue2015,     //
    FlowBargteil2007,           //
    RankineCutOff,              //
    Fluid>;

/// The model called `model`, which must exist, from values that are complete and in range
/// (materials/model_info.h).
Material make_material(std::string_view model, const ParameterValues& values);

}  // namespace firn
