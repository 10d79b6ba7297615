#include "engine/output/json_file.h"

#include <nlohmann/json.hpp>

#include "engine/output/checked_file.h"

namespace firn {

void write_json(const std::filesystem::path& file, const nlohmann::json& content) {
  // A file name in the content may hold bytes that are not UTF-8; they are replaced rather than fatal at the
  // very end of a run.
  const std::string text = content.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  CheckedFile out(file, text.size());
  out.stream() << text;
  out.commit();
}

}  // namespace firn
