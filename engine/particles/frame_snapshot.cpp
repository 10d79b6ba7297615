#include "engine/particles/frame_snapshot.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace firn {
namespace {

std::size_t components(const AttributeView& attribute) {
  return static_cast<std::size_t>(attribute.components);
}

}  // namespace

void FrameSnapshot::take(const FrameView& frame) {
  if (!has_attributes_of(frame)) lay_out(frame);
  ids_.resize(frame.particles);
  for (std::size_t i = 0; i < values_.size(); ++i)
    values_[i].resize(frame.particles * components(frame.attributes[i]));

  constexpr std::size_t kGrain = 4096;  // enough to pay for a task, and its columns stay in the cache
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, frame.particles, kGrain), [&](const auto& range) {
    frame.copy_id(range.begin(), std::span(ids_).subspan(range.begin(), range.size()));
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::size_t each = components(frame.attributes[i]);
      frame.attributes[i].copy(range.begin(),
                               std::span(values_[i]).subspan(range.begin() * each, range.size() * each));
    }
  });

  view_.frame = frame.frame;
  view_.time = frame.time;
  view_.particles = frame.particles;
  view_.totals = frame.totals;
  view_.steps = frame.steps;
  view_.counters = frame.counters;
}

bool FrameSnapshot::has_attributes_of(const FrameView& frame) const {
  return std::equal(frame.attributes.begin(), frame.attributes.end(), view_.attributes.begin(),
                    view_.attributes.end(), [](const AttributeView& a, const AttributeView& b) {
                      return a.name == b.name && a.components == b.components;
                    });
}

void FrameSnapshot::lay_out(const FrameView& frame) {
  view_.attributes.clear();
  values_.resize(frame.attributes.size());
  view_.copy_id = [this](std::size_t first, std::span<std::int64_t> out) {
    std::copy_n(ids_.begin() + static_cast<std::ptrdiff_t>(first), out.size(), out.begin());
  };
  for (std::size_t i = 0; i < frame.attributes.size(); ++i) {
    const AttributeView& a = frame.attributes[i];
    view_.attributes.push_back({a.name, a.components, [this, i](std::size_t first, std::span<float> out) {
                                  const std::size_t begin = first * components(view_.attributes[i]);
                                  std::copy_n(values_[i].begin() + static_cast<std::ptrdiff_t>(begin),
                                              out.size(), out.begin());
                                }});
  }
}

}  // namespace firn
