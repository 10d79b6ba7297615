#include "engine/output/content_hash.h"

#include <numeric>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "engine/particles/frame_snapshot.h"
#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using testing::SampleFrame;

// More than one block of the hash, and not a multiple of it.
constexpr std::size_t kParticles = 10'001;

template <class T>
void permute(std::vector<T>& values, const std::vector<std::size_t>& order) {
  const std::size_t components = values.size() / order.size();
  const std::vector<T> old = values;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::copy_n(&old[order[i] * components], components, &values[i * components]);
  }
}

}  // namespace

TEST_CASE("the content hash does not depend on the order of the particles or on threads") {
  const SampleFrame original(kParticles);
  SampleFrame shuffled = original;
  std::vector<std::size_t> order(kParticles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  permute(shuffled.id, order);
  for (auto* column : {&shuffled.P, &shuffled.v, &shuffled.F_E, &shuffled.Jp, &shuffled.material})
    permute(*column, order);

  const std::uint64_t hash = content_hash(original.view());
  CHECK(content_hash(shuffled.view()) == hash);
  for (const std::size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CHECK(content_hash(original.view()) == hash);
  }
}

TEST_CASE("the content hash of a snapshot is that of the frame") {
  const SampleFrame sample(kParticles);
  FrameSnapshot snapshot;
  snapshot.take(sample.view());
  CHECK(content_hash(snapshot.view()) == content_hash(sample.view()));
}

TEST_CASE("the content hash sees one changed bit, swapped values and a lost particle") {
  SampleFrame sample(kParticles);
  const std::uint64_t hash = content_hash(sample.view());
  SECTION("one bit") {
    sample.F_E[17] = std::nextafter(sample.F_E[17], 2.0F);
    CHECK(content_hash(sample.view()) != hash);
  }
  SECTION("the sign of zero") {
    sample.v[5] = 0.0F;
    const std::uint64_t positive = content_hash(sample.view());
    sample.v[5] = -0.0F;
    CHECK(content_hash(sample.view()) != positive);
  }
  SECTION("two particles exchange their ids") {
    std::swap(sample.id[0], sample.id[1]);
    CHECK(content_hash(sample.view()) != hash);
  }
  SECTION("an attribute is missing or has another name") {
    FrameView fewer = sample.view();
    fewer.attributes.pop_back();
    CHECK(content_hash(fewer) != hash);
    FrameView renamed = sample.view();
    renamed.attributes.back().name = "other";
    CHECK(content_hash(renamed) != hash);
  }
  SECTION("one particle fewer") {
    FrameView fewer = sample.view();
    --fewer.particles;
    CHECK(content_hash(fewer) != hash);
  }
}

TEST_CASE("the content hash has the value it always had") {
  // Written into run.json and compared across versions and machines: a change of the recipe must be
  // deliberate.
  FrameView frame;
  frame.particles = 3;
  frame.copy_id = [](std::size_t first, std::span<std::int64_t> out) {
    std::iota(out.begin(), out.end(), static_cast<std::int64_t>(first));
  };
  frame.attributes = {{"P", 3, [](std::size_t first, std::span<float> out) {
                         std::iota(out.begin(), out.end(), static_cast<float>(3 * first));
                       }}};
  CHECK(content_hash(frame) == 0x65aedbeda830f475);
}

}  // namespace firn
