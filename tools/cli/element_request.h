// What a line of `firn element` asks, checked.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "engine/math/matrix.h"
#include "materials/registry.h"

namespace firn {

using Rows = std::vector<std::vector<double>>;

struct ElementRequest {
  Material material;
  double dt;  // s
  Rows F_trial;
  Rows F_P;  // identity when the line leaves it out
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
