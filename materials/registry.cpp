#include "materials/registry.h"

#include <optional>

#include "engine/base/check.h"

namespace firn {
namespace {

template <class... Models>
std::optional<Material> make(std::type_identity<std::variant<Models...>>, std::string_view model,
                             const ParameterValues& values) {
  std::optional<Material> out;
  ((Models::name == model ? void(out = Models::make(values)) : void()), ...);
  return out;
}

}  // namespace

Material make_material(std::string_view model, const ParameterValues& values) {
  std::optional<Material> out = make(std::type_identity<Material>{}, model, values);
  FIRN_CHECK(out.has_value());
  return *std::move(out);
}

}  // namespace firn
