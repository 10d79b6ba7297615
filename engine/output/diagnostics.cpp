#include "engine/output/diagnostics.h"

#include <algorithm>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"

namespace firn {
namespace {

constexpr const char* kHeader =
    "frame,time,steps,dt_min,dt_max,particles,mass,momentum_x,momentum_y,momentum_z,angular_x,angular_y,"
    "angular_z,"
    "kinetic,elastic,gravity,dissipated,total,max_speed,min_J,max_J";

}  // namespace

Diagnostics::Diagnostics(const std::filesystem::path& file, std::vector<std::string> counters)
    : file_(file, O_WRONLY | O_CREAT | O_TRUNC, 0666), counters_(std::move(counters)) {
  write_line(counters_.empty() ? std::string(kHeader)
                               : fmt::format("{},{}", kHeader, fmt::join(counters_, ",")));
}

void Diagnostics::append(const FrameView& frame) {
  const FrameTotals& t = frame.totals;
  // What a return map dissipated is gone from the body but not from the balance.
  const double total = t.kinetic + t.elastic + t.gravity + t.dissipated;
  const double reals[] = {t.mass,       t.momentum[0], t.momentum[1], t.momentum[2], t.angular[0],
                          t.angular[1], t.angular[2],  t.kinetic,     t.elastic,     t.gravity,
                          t.dissipated, total,         t.max_speed,   t.min_J,       t.max_J};
  std::string line =
      fmt::format("{},{},{},{},{},{},{}", frame.frame, frame.time, frame.steps.steps, frame.steps.dt_min,
                  frame.steps.dt_max, frame.particles, fmt::join(reals, ","));
  for (const auto& [name, count] : frame.counters) {
    FIRN_CHECK(std::find(counters_.begin(), counters_.end(), name) != counters_.end());
  }
  for (const std::string& counter : counters_) {
    const auto found = std::find_if(frame.counters.begin(), frame.counters.end(),
                                    [&](const auto& entry) { return entry.first == counter; });
    line += fmt::format(",{}", found == frame.counters.end() ? 0 : found->second);
  }
  write_line(line);
}

void Diagnostics::write_line(const std::string& line) {
  const std::string text = line + '\n';
  try {
    file_.write_at(text.data(), text.size(), end_, text.size());
    file_.sync();
  } catch (const Error&) {
    file_.truncate(end_);
    throw;
  }
  end_ += text.size();
}

}  // namespace firn
