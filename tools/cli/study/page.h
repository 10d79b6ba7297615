// The page that shows a study, with its style, its program and the chart library in it.
#pragma once

#include <string>

namespace firn {

/// `json`: study.json.
std::string assemble_page(const std::string& json);

}  // namespace firn
