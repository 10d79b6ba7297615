#include "engine/output/content_hash.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <xxhash.h>

namespace firn {
namespace {

// Sum of the hashes of particles [first, last): gathers each particle's bytes from the columns.
std::uint64_t sum_of_hashes(const FrameView& frame, std::size_t stride, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  std::vector<unsigned char> records(count * stride);
  std::vector<std::int64_t> ids(count);
  frame.copy_id(first, ids);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&records[i * stride], &ids[i], sizeof(std::int64_t));

  std::vector<float> values;
  std::size_t offset = sizeof(std::int64_t);
  for (const AttributeView& attribute : frame.attributes) {
    const auto components = static_cast<std::size_t>(attribute.components);
    values.resize(count * components);
    attribute.copy(first, values);
    const std::size_t bytes = components * sizeof(float);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&records[i * stride + offset], &values[i * components], bytes);
    }
    offset += bytes;
  }
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += XXH3_64bits(&records[i * stride], stride);
  return sum;
}

}  // namespace

std::uint64_t content_hash(const FrameView& frame) {
  std::size_t stride = sizeof(std::int64_t);
  std::string layout;
  for (const AttributeView& attribute : frame.attributes) {
    stride += static_cast<std::size_t>(attribute.components) * sizeof(float);
    layout += fmt::format("{}:{};", attribute.name, attribute.components);
  }
  constexpr std::size_t kGrain = 4096;  // a record buffer that stays in the cache
  const std::uint64_t sum = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, frame.particles, kGrain), std::uint64_t{0},
      [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t partial) {
        for (std::size_t first = range.begin(); first < range.end(); first += kGrain) {
          partial += sum_of_hashes(frame, stride, first, std::min(first + kGrain, range.end()));
        }
        return partial;
      },
      std::plus<>());
  const std::string whole = fmt::format("{}{};{}", layout, frame.particles, sum);
  return XXH3_64bits(whole.data(), whole.size());
}

}  // namespace firn
