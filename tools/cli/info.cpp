#include "tools/cli/info.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/output/point_cache_reader.h"
#include "engine/shapes/file_bytes.h"
#include "tools/cli/units.h"

namespace firn {
namespace {

using nlohmann::json;

constexpr std::string_view kAxes = "xyz";

/// "F_E_01", "v_x", "Jp".
std::string component_name(const std::string& name, std::size_t component, std::size_t components) {
  if (components == 9) return fmt::format("{}_{}{}", name, component / 3, component % 3);
  if (components == 3) return fmt::format("{}_{}", name, kAxes[component]);
  return name;
}

/// Where the particles are, or nullptr when there are none.
const PointAttribute* places(const PointCacheSummary& cache) {
  const auto P = std::find_if(cache.attributes.begin(), cache.attributes.end(),
                              [](const PointAttribute& a) { return a.name == "P" && a.ranges.size() == 3; });
  return P == cache.attributes.end() ? nullptr : &*P;
}

void print_frame(const std::filesystem::path& file, const PointCacheSummary& cache, std::ostream& out) {
  std::string head = file.filename().string() + ":";
  if (cache.frame) head += fmt::format(" frame {}", *cache.frame);
  if (cache.time) head += fmt::format(" at {:.6g} s,", *cache.time);
  out << fmt::format("{} {} particles, cells of {:g} m{}\n", head,
                     grouped(static_cast<double>(cache.particles)), cache.voxel_size,
                     cache.creator.empty() ? "" : ", by " + printable(cache.creator));
  if (const PointAttribute* P = places(cache)) {
    const auto& r = P->ranges;
    out << fmt::format("between ({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g}) m\n", r[0].min,
                       r[1].min, r[2].min, r[0].max, r[1].max, r[2].max);
  }
  out << fmt::format("\n  {:<12} {:<6} {:>13} {:>13} {:>13}\n", "attribute", "type", "min", "mean", "max");
  for (const PointAttribute& a : cache.attributes) {
    if (a.ranges.empty()) out << fmt::format("  {:<12} {:<6}\n", printable(a.name), printable(a.type));
    for (std::size_t c = 0; c < a.ranges.size(); ++c)
      out << fmt::format("  {:<12} {:<6} {:>13.6g} {:>13.6g} {:>13.6g}\n",
                         printable(component_name(a.name, c, a.ranges.size())),
                         c == 0 ? printable(a.type) : "", a.ranges[c].min, a.ranges[c].mean, a.ranges[c].max);
    if (a.not_finite > 0)
      out << fmt::format("  {:<12} is not finite for {} particles, which are left out above\n",
                         printable(a.name), grouped(static_cast<double>(a.not_finite)));
  }
}

template <class T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

json of_components(const PointAttribute& attribute, double ComponentRange::*value) {
  json out = json::array();
  for (const ComponentRange& range : attribute.ranges) out.push_back(range.*value);
  return out;
}

json frame_json(const std::filesystem::path& file, const PointCacheSummary& cache) {
  json attributes = json::array();
  for (const PointAttribute& a : cache.attributes)
    attributes.push_back({{"name", a.name},
                          {"type", a.type},
                          {"min", of_components(a, &ComponentRange::min)},
                          {"mean", of_components(a, &ComponentRange::mean)},
                          {"max", of_components(a, &ComponentRange::max)},
                          {"not_finite", a.not_finite}});
  const PointAttribute* P = places(cache);
  return {{"file", file.string()},
          {"frame", or_null(cache.frame)},
          {"time", or_null(cache.time)},
          {"frame_rate", or_null(cache.frame_rate)},
          {"creator", cache.creator},
          {"particles", cache.particles},
          {"voxel_size", cache.voxel_size},
          {"min", P ? of_components(*P, &ComponentRange::min) : json()},
          {"max", P ? of_components(*P, &ComponentRange::max) : json()},
          {"attributes", attributes}};
}

/// In the shortest form that reads back to what the file holds.
void put_number(fmt::memory_buffer& line, const PointColumn& column, double value) {
  const bool single = column.type == "float" || column.type == "mat3s" || column.type == "vec3s";
  // A place is a float from the middle of its voxel: a double in metres.
  if (single && column.name != "P")
    fmt::format_to(std::back_inserter(line), ",{}", static_cast<float>(value));
  else
    fmt::format_to(std::back_inserter(line), ",{}", value);
}

void print_rows(const std::filesystem::path& file, std::vector<std::string> names, std::ostream& out) {
  names.insert(names.begin(), {"id", "P"});
  const std::vector<PointColumn> columns = read_point_columns(file, names);
  out << "id,x,y,z";
  for (std::size_t k = 2; k < columns.size(); ++k)
    for (std::size_t c = 0; c < columns[k].components; ++c)
      out << ',' << component_name(columns[k].name, c, columns[k].components);
  out << '\n';

  const std::vector<double>& id = columns[0].values;
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  fmt::memory_buffer line;
  for (const std::size_t p : order) {
    line.clear();
    fmt::format_to(std::back_inserter(line), "{:.0f}", id[p]);
    for (std::size_t k = 1; k < columns.size(); ++k)
      for (std::size_t c = 0; c < columns[k].components; ++c)
        put_number(line, columns[k], columns[k].values[p * columns[k].components + c]);
    line.push_back('\n');
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace

int run_info(const InfoOptions& options, std::ostream& out) {
  if (std::filesystem::is_directory(options.path)) {
    if (!options.csv.empty())
      throw Error(ExitCode::input, fmt::format("--csv is for a frame; {} is a folder", quoted(options.path)));
    return run_folder_info(options.path, options.json, out);
  }
  if (!options.csv.empty()) {
    print_rows(options.path, options.csv, out);
  } else {
    const PointCacheSummary cache = summarize_point_cache(options.path);
    if (options.json)
      out << frame_json(options.path, cache).dump(2) << '\n';
    else
      print_frame(options.path, cache, out);
  }
  return static_cast<int>(ExitCode::ok);
}

}  // namespace firn
