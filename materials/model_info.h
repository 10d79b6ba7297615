// The models by name, without their code: for readers, schemas and tables.
#pragma once

#include <span>
#include <string_view>

#include "engine/particles/columns.h"
#include "materials/parameter.h"

namespace firn {

struct ModelInfo {
  std::string_view name;                            // "snow_stomakhin_2013"
  std::string_view title;                           // one line: what it models
  std::string_view source;                          // author, year, equations
  std::string_view energy, yield, hardening, rate;  // the parts it is composed of; "none"
  std::string_view decomposition;  // "none", "polar" or "SVD": what one update costs beside arithmetic
  ColumnSet columns;
  std::span<const Parameter> parameters;  // density first
};

std::span<const ModelInfo> models();
/// Null when there is no such model.
const ModelInfo* find_model(std::string_view name);

}  // namespace firn
