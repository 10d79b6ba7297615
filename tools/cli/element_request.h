// What a line of `firn element` asks, checked.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/math/matrix.h"
#include "materials/model_info.h"
#include "materials/registry.h"

namespace firn {

using Rows = std::vector<std::vector<double>>;

struct ElementRequest {
  Material material;
  double dt;  // s; a millisecond when the line leaves it out
  Rows F_trial;
  Rows F_P;                             // identity when the line leaves it out
  std::map<std::string, double> state;  // by the name of a history variable; what is left out is at rest
  bool tangent;

  int dimension() const { return static_cast<int>(F_trial.size()); }
};

/// Throws Error{ExitCode::input} that names the key and what it may hold.
ElementRequest parse_element_request(const nlohmann::json& line);

template <int D>
Matrix<double, D> to_matrix(const Rows& rows) {
  Matrix<double, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return out;
}

}  // namespace firn
