#include "materials/model_info.h"

#include <array>

#include "materials/registry.h"

namespace firn {
namespace {

template <class... Models>
std::array<ModelInfo, sizeof...(Models)> all_of(std::type_identity<std::variant<Models...>>) {
  return {Models::info()...};
}

}  // namespace

std::span<const ModelInfo> models() {
  static const auto table = all_of(std::type_identity<Material>{});
  return table;
}

const ModelInfo* find_model(std::string_view name) {
  for (const ModelInfo& m : models())
    if (m.name == name) return &m;
  return nullptr;
}

}  // namespace firn
