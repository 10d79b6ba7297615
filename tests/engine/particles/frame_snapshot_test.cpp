#include "engine/particles/frame_snapshot.h"

#include <bit>
#include <limits>
#include <new>

#include <catch2/catch.hpp>

#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using testing::SampleFrame;

// Several tasks of the copy, the last one shorter.
constexpr std::size_t kParticles = 10'001;

/// Everything a view gives, in pieces that do not fit its own; floats as bits, since NaN equals nothing.
struct Content {
  std::vector<std::int64_t> ids;
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> attributes;
  friend bool operator==(const Content&, const Content&) = default;

  explicit Content(const FrameView& frame) : ids(frame.particles) {
    constexpr std::size_t kPiece = 777;
    for (const AttributeView& a : frame.attributes) attributes.push_back({a.name, {}});
    for (std::size_t first = 0; first < frame.particles; first += kPiece) {
      const std::size_t count = std::min(kPiece, frame.particles - first);
      frame.copy_id(first, std::span(ids).subspan(first, count));
      for (std::size_t i = 0; i < attributes.size(); ++i) {
        std::vector<float> piece(count * static_cast<std::size_t>(frame.attributes[i].components));
        frame.attributes[i].copy(first, piece);
        for (const float x : piece) attributes[i].second.push_back(std::bit_cast<std::uint32_t>(x));
      }
    }
  }
};

}  // namespace

TEST_CASE("a snapshot gives what the frame gave, bit for bit, after the frame has changed") {
  const std::size_t particles = GENERATE(std::size_t{0}, std::size_t{1}, kParticles);
  SampleFrame sample(particles);
  if (particles > 1) {
    sample.P[3] = -0.0F;
    sample.v[4] = std::bit_cast<float>(0x7fc01234U);  // a NaN with a payload
    sample.F_E[5] = std::numeric_limits<float>::denorm_min();
  }
  const Content before(sample.view());
  FrameSnapshot snapshot;
  snapshot.take(sample.view());
  CHECK(Content(snapshot.view()) == before);
  for (std::vector<float>* column : {&sample.P, &sample.v, &sample.F_E, &sample.Jp, &sample.material})
    std::fill(column->begin(), column->end(), 3.5F);
  std::fill(sample.id.begin(), sample.id.end(), 1);
  CHECK(Content(snapshot.view()) == before);
}

TEST_CASE("a snapshot keeps the numbers of the frame as a whole") {
  const SampleFrame sample(10);
  FrameView frame = sample.view();
  frame.totals = {.mass = 2, .momentum = {3, 4, 5}, .dissipated = 6, .min_J = 0.5};
  frame.steps = {7, 1e-4, 2e-4};
  frame.counters = {{"capped", 8}, {"a counter with a long name", 9}};
  FrameSnapshot snapshot;
  snapshot.take(frame);
  const FrameView& view = snapshot.view();
  CHECK(view.frame == 12);
  CHECK(view.time == 0.4375);
  CHECK(view.particles == 10);
  CHECK(view.totals.mass == 2);
  CHECK(view.totals.momentum[2] == 5);
  CHECK(view.totals.dissipated == 6);
  CHECK(view.totals.min_J == 0.5);
  CHECK(view.steps.steps == 7);
  CHECK(view.steps.dt_max == 2e-4);
  CHECK(view.counters == frame.counters);
}

TEST_CASE("a snapshot of the next frame needs no new buffers") {
  const SampleFrame sample(kParticles), smaller(kParticles / 2);
  FrameSnapshot snapshot;
  snapshot.take(sample.view());
  std::vector<const void*> buffers{snapshot.ids().data()};
  for (std::size_t i = 0; i < sample.view().attributes.size(); ++i)
    buffers.push_back(snapshot.values(i).data());
  for (const SampleFrame* next : {&smaller, &sample}) {
    snapshot.take(next->view());
    CHECK(Content(snapshot.view()) == Content(next->view()));
    std::vector<const void*> now{snapshot.ids().data()};
    for (std::size_t i = 0; i < sample.view().attributes.size(); ++i)
      now.push_back(snapshot.values(i).data());
    CHECK(now == buffers);
  }
}

TEST_CASE("a snapshot follows a frame with other attributes") {
  const SampleFrame sample(kParticles);
  FrameView frame = sample.view();
  FrameSnapshot snapshot;
  snapshot.take(frame);
  SECTION("fewer") {
    frame.attributes.erase(frame.attributes.begin() + 1);
  }
  SECTION("more") {
    frame.attributes.push_back(SampleFrame::column("more", 3, sample.v));
  }
  SECTION("in another order") {
    std::swap(frame.attributes[2], frame.attributes[4]);  // one component each
  }
  SECTION("of other sizes") {
    frame.attributes[3] = SampleFrame::column("F_E", 3, sample.v);
  }
  snapshot.take(frame);
  CHECK(Content(snapshot.view()) == Content(frame));
}

TEST_CASE("a snapshot that failed can be taken again") {
  const SampleFrame sample(kParticles);
  FrameView failing = sample.view();
  failing.attributes[4].copy = [](std::size_t first, std::span<float>) {
    if (first > 0) throw std::bad_alloc();
  };
  FrameSnapshot snapshot;
  CHECK_THROWS_AS(snapshot.take(failing), std::bad_alloc);
  snapshot.take(sample.view());
  CHECK(Content(snapshot.view()) == Content(sample.view()));
}

}  // namespace firn
