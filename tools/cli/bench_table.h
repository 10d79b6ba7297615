// Results as lines of JSON, or as CSV.
#pragma once

#include <ostream>
#include <vector>

#include <nlohmann/json.hpp>

namespace firn {

/// All with the same keys in the same order; null where a row has nothing to say.
using BenchRows = std::vector<nlohmann::ordered_json>;

/// One line a row, without its nulls.
void print_json(const BenchRows& rows, std::ostream& out);

/// At least one row. A header, then one line a row. The keys of an object within become columns of their own,
/// as "passes.sort".
void print_csv(const BenchRows& rows, std::ostream& out);

}  // namespace firn
