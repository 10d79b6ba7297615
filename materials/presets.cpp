#include "materials/presets.h"

namespace firn {
namespace {

using Value = Preset::Value;

// Stiffness sets the time step: where it is a softened one, it was chosen so that a body of a metre still
// holds its shape, and the source says so.
constexpr Value kPowder[] = {
    {"density", 120}, {"youngs_modulus", 4.8e4}, {"theta_c", 1.9e-2}, {"theta_s", 5e-3}};
constexpr Value kWetSnow[] = {{"density", 500}, {"theta_c", 4e-2}, {"theta_s", 1.2e-2}, {"xi", 7}};
constexpr Value kPackedSnow[] = {{"density", 400}};
constexpr Value kIce[] = {{"density", 917},
                          {"youngs_modulus", 9e7},
                          {"poissons_ratio", 0.33},
                          {"tensile_strength", 1e6},
                          {"softening_strain", 2e-3}};
constexpr Value kDrySand[] = {{"density", 2200}};
constexpr Value kWetSand[] = {{"density", 2000}, {"tensile_strength", 1000}};
constexpr Value kMud[] = {
    {"density", 1500}, {"youngs_modulus", 3e4}, {"poissons_ratio", 0.4}, {"sigma_y", 100}, {"eta", 10},
    {"h", 0.5}};
constexpr Value kClay[] = {{"density", 1800}, {"youngs_modulus", 1e6}, {"poissons_ratio", 0.35},
                           {"M", 0.98},       {"beta", 0.5},           {"xi", 2},
                           {"alpha_0", -0.02}};
constexpr Value kFoam[] = {
    {"density", 80}, {"youngs_modulus", 900}, {"poissons_ratio", 0.45}, {"sigma_y", 30}, {"eta", 25},
    {"h", 0.3}};
constexpr Value kHoney[] = {{"density", 1420}, {"bulk_modulus", 2e5}, {"viscosity", 10}};
constexpr Value kWater[] = {{"density", 1000}, {"bulk_modulus", 2e5}};
constexpr Value kRubber[] = {{"density", 930}, {"youngs_modulus", 1e6}, {"poissons_ratio", 0.45}};
constexpr Value kJello[] = {{"density", 1000}, {"youngs_modulus", 1e4}, {"poissons_ratio", 0.4}};
constexpr Value kCopper[] = {{"density", 8960}, {"youngs_modulus", 124e9}, {"poissons_ratio", 0.34}};

constexpr Preset kPresets[] = {
    {"snow_powder", "snow_stomakhin_2013", "light snow that breaks into dust and heaps loosely",
     "Stomakhin et al. 2013, whose smaller theta_c, theta_s and E give powder; density of new snow", kPowder},
    {"snow_wet", "snow_stomakhin_2013", "heavy snow that sticks together in lumps",
     "Stomakhin et al. 2013, whose larger theta_c and theta_s give chunks; numbers chosen for the look",
     kWetSnow},
    {"snow_packed", "snow_stomakhin_2013", "a snowball: firm, breaks into pieces and powder",
     "Stomakhin et al. 2013, table 1", kPackedSnow},
    {"ice", "rankine", "brittle: cracks and falls apart in blocks",
     "density and strength of ice (1 MPa in tension); 100 times softer than ice", kIce},
    {"dry_sand", "sand_klar_2016", "runs, piles up at its angle of repose", "Klar et al. 2016", kDrySand},
    {"wet_sand", "sand_klar_2016", "stands in castles and breaks off in clods",
     "Klar et al. 2016 with a cohesion of 1 kPa, chosen for the look", kWetSand},
    {"mud", "herschel_bulkley_yue_2015", "slumps, creeps and comes to rest with a slope",
     "yield stress of the order of debris flows (100 Pa); chosen for the look", kMud},
    {"clay", "nacc_wolper_2019", "keeps the dents it is given, tears when pulled",
     "M of a friction angle of 25 degrees; the others chosen for the look", kClay},
    {"foam", "herschel_bulkley_yue_2015", "shaving foam: keeps its ridges, spreads under a push",
     "after Yue et al. 2015 in kind; numbers chosen for the look", kFoam},
    {"honey", "fluid", "thick: folds and coils as it is poured",
     "density and viscosity (10 Pa s) of honey; 10,000 times softer", kHoney},
    {"water", "fluid", "splashes; for speeds up to 1.5 m/s",
     "a tenth of its sound's speed is the fastest flow; 10,000 times softer than water", kWater},
    {"rubber", "neo_hookean", "bounces and stretches", "natural rubber, order of magnitude", kRubber},
    {"jello", "neo_hookean", "wobbles", "gelatine gel, order of magnitude", kJello},
    {"copper", "johnson_cook_1983", "bends and mushrooms, and stays so",
     "OFHC copper of Johnson & Cook 1983, without temperature", kCopper},
};

}  // namespace

std::span<const Preset> presets() {
  return kPresets;
}

const Preset* find_preset(std::string_view name) {
  for (const Preset& p : kPresets)
    if (p.name == name) return &p;
  return nullptr;
}

}  // namespace firn
