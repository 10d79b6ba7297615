// With point_cache.cpp the only file of the output layer that includes OpenVDB: half a minute to compile.
#include "engine/output/point_cache_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/child_process.h"
#include "engine/shapes/file_bytes.h"

namespace firn {
namespace {

using nlohmann::json;
using openvdb::points::AttributeHandle;
using openvdb::points::PointDataGrid;
using Bytes = std::vector<std::uint8_t>;
using Leaf = openvdb::points::PointDataTree::LeafNodeType;

constexpr std::uint64_t kLargestFile = std::uint64_t{64} << 30;

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::input, why);
}

std::array<double, 1> numbers(double value) {
  return {value};
}

template <class T>
std::array<double, 3> numbers(const openvdb::math::Vec3<T>& v) {
  return {v[0], v[1], v[2]};
}

template <class T>
std::array<double, 9> numbers(const openvdb::math::Mat3<T>& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

/// Calls take(span of components) for each point of a leaf.
template <class Value, class Take>
void walk(const Leaf& leaf, const openvdb::math::Transform& transform, const std::string& name,
          const Take& take) {
  const AttributeHandle<Value> values(leaf.constAttributeArray(name));
  for (auto point = leaf.beginIndexOn(); point; ++point) {
    auto row = numbers(values.get(*point));
    if constexpr (row.size() == 3)
      // Stored from the centre of the voxel, in voxels.
      if (name == "P")
        row = numbers(transform.indexToWorld(point.getCoord().asVec3d() + openvdb::Vec3d(row.data())));
    take(std::span<const double>(row));
  }
}

/// The same for each point of the grid; false for a type that is not numbers.
template <class Take>
bool walk(const PointDataGrid& grid, const std::string& name, const std::string& type, const Take& take) {
  const auto leaves = [&](auto value) {
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
      walk<decltype(value)>(*leaf, grid.transform(), name, take);
    return true;
  };
  if (type == "float") return leaves(float{});
  if (type == "double") return leaves(double{});
  if (type == "int32") return leaves(std::int32_t{});
  if (type == "int64") return leaves(std::int64_t{});
  if (type == "vec3s") return leaves(openvdb::Vec3f{});
  if (type == "vec3d") return leaves(openvdb::Vec3d{});
  if (type == "mat3s") return leaves(openvdb::Mat3s{});
  return false;
}

struct Opened {
  openvdb::MetaMap::Ptr metadata;
  PointDataGrid::Ptr grid;
  std::vector<std::pair<std::string, std::string>> attributes;  // name and type
};

Opened open(const std::string& path) {
  openvdb::initialize();
  // OpenVDB itself does not look whether it got what it read: of a file cut short the rest would be noise.
  std::ifstream in(path, std::ios::binary);
  in.exceptions(std::ios::failbit | std::ios::badbit);
  Opened out;
  std::string others;
  try {
    openvdb::io::Stream stream(in, false);  // no delayed load: values would be read unseen, later
    out.metadata = stream.getMetadata();
    for (const openvdb::GridBase::Ptr& grid : *stream.getGrids()) {
      if (!out.grid) out.grid = openvdb::gridPtrCast<PointDataGrid>(grid);
      others += (others.empty() ? "" : ", ") + printable(grid->getName());
    }
  } catch (const std::ios::failure&) {
    fail("is damaged: it ends too early");
  }
  if (!out.grid) fail("holds no points; its grids: " + (others.empty() ? "none" : others));
  const auto leaf = out.grid->tree().cbeginLeaf();
  if (!leaf) return out;
  const auto& descriptor = leaf->attributeSet().descriptor();
  out.attributes.resize(leaf->attributeSet().size());
  for (const auto& [name, position] : descriptor.map())
    out.attributes[position] = {name, descriptor.valueType(position)};
  return out;
}

/// A summary of one attribute as JSON.
json summary(const PointDataGrid& grid, const std::string& name, const std::string& type) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> min, max, sum;
  std::size_t finite = 0, not_finite = 0;
  walk(grid, name, type, [&](std::span<const double> row) {
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); })) {
      ++not_finite;
      return;
    }
    ++finite;
    min.resize(row.size(), kInfinity);
    max.resize(row.size(), -kInfinity);
    sum.resize(row.size());
    for (std::size_t c = 0; c < row.size(); ++c) {
      min[c] = std::min(min[c], row[c]);
      max[c] = std::max(max[c], row[c]);
      sum[c] += row[c];
    }
  });
  for (double& s : sum) s /= static_cast<double>(finite);
  return {{"name", name}, {"type", type}, {"min", min},
          {"mean", sum},  {"max", max},   {"not_finite", not_finite}};
}

template <class Metadata>
json metadata(const openvdb::MetaMap& all, const char* name) {
  const auto found = all.getMetadata<Metadata>(name);
  return found ? json(found->value()) : json();
}

Bytes bytes_of(const json& content) {
  // Names and texts of a file need not be UTF-8.
  const std::string text = content.dump(-1, ' ', false, json::error_handler_t::replace);
  return {text.begin(), text.end()};
}

Bytes summary_of_file(const std::string& path) {
  const Opened file = open(path);
  json attributes = json::array();
  for (const auto& [name, type] : file.attributes) attributes.push_back(summary(*file.grid, name, type));
  std::size_t particles = 0;
  for (auto leaf = file.grid->tree().cbeginLeaf(); leaf; ++leaf) particles += leaf->onPointCount();
  return bytes_of({{"particles", particles},
                   {"voxel_size", file.grid->voxelSize()[0]},
                   {"attributes", attributes},
                   {"creator", metadata<openvdb::StringMetadata>(*file.metadata, "creator")},
                   {"frame", metadata<openvdb::Int32Metadata>(*file.metadata, "frame")},
                   {"time", metadata<openvdb::DoubleMetadata>(*file.metadata, "time")},
                   {"frame_rate", metadata<openvdb::DoubleMetadata>(*file.metadata, "frame_rate")}});
}

/// A line of JSON for what the columns are, then their numbers.
Bytes columns_of_file(const std::string& path, const std::vector<std::string>& names) {
  const Opened file = open(path);
  std::vector<std::string_view> known;
  for (const auto& attribute : file.attributes) known.push_back(attribute.first);
  json head = json::array();
  std::vector<double> values;
  for (const std::string& name : names) {
    const auto found = std::find_if(file.attributes.begin(), file.attributes.end(),
                                    [&](const auto& attribute) { return attribute.first == name; });
    if (found == file.attributes.end()) fail(unknown_name("attribute", name, known));
    const std::size_t before = values.size();
    std::size_t components = 0;
    if (!walk(*file.grid, name, found->second, [&](std::span<const double> row) {
          components = row.size();
          values.insert(values.end(), row.begin(), row.end());
        }))
      fail(fmt::format("attribute '{}' is of type {}, not numbers", printable(name),
                       printable(found->second)));
    head.push_back({{"name", name},
                    {"type", found->second},
                    {"components", components},
                    {"values", values.size() - before}});
  }
  Bytes out = bytes_of(head);
  out.push_back('\n');
  const std::size_t start = out.size();
  out.resize(start + values.size() * sizeof(double));
  std::memcpy(out.data() + start, values.data(), values.size() * sizeof(double));
  return out;
}

Bytes in_child(const std::filesystem::path& file, const std::function<Bytes(const std::string&)>& work) {
  const std::uint64_t size = check_regular_file(file, kLargestFile);
  // What is the same for a whole leaf is stored once, so that memory may exceed the file many times; numbers
  // are handed over as doubles.
  const ChildLimits limits{(std::uint64_t{4} << 30) + 40 * size, 60 + static_cast<unsigned>(size >> 24),
                           (std::uint64_t{1} << 30) + 40 * size, true};
  const std::string path = file.string();
  return run_in_child(quoted(file), limits, [&] { return work(path); });
}

template <class T>
std::optional<T> optional(const json& value) {
  return value.is_null() ? std::nullopt : std::optional<T>(value.get<T>());
}

}  // namespace

PointCacheSummary summarize_point_cache(const std::filesystem::path& file) {
  const json content = json::parse(in_child(file, summary_of_file));
  PointCacheSummary out;
  out.particles = content["particles"];
  out.voxel_size = content["voxel_size"];
  out.creator = optional<std::string>(content["creator"]).value_or("");
  out.frame = optional<int>(content["frame"]);
  out.time = optional<double>(content["time"]);
  out.frame_rate = optional<double>(content["frame_rate"]);
  for (const json& attribute : content["attributes"]) {
    PointAttribute& a = out.attributes.emplace_back();
    a.name = attribute["name"];
    a.type = attribute["type"];
    a.not_finite = attribute["not_finite"];
    for (std::size_t c = 0; c < attribute["min"].size(); ++c)
      a.ranges.push_back({attribute["min"][c], attribute["mean"][c], attribute["max"][c]});
  }
  return out;
}

std::vector<PointColumn> read_point_columns(const std::filesystem::path& file,
                                            const std::vector<std::string>& names) {
  const Bytes bytes = in_child(file, [&](const std::string& path) { return columns_of_file(path, names); });
  const auto end = std::find(bytes.begin(), bytes.end(), '\n');
  std::vector<PointColumn> out;
  std::size_t at = static_cast<std::size_t>(end - bytes.begin()) + 1;
  for (const json& column : json::parse(bytes.begin(), end)) {
    PointColumn& c = out.emplace_back();
    c.name = column["name"];
    c.type = column["type"];
    c.components = column["components"];
    c.values.resize(column["values"]);
    std::memcpy(c.values.data(), bytes.data() + at, c.values.size() * sizeof(double));
    at += c.values.size() * sizeof(double);
  }
  return out;
}

}  // namespace firn
