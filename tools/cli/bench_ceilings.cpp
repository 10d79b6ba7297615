#include "tools/cli/bench_ceilings.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <thread>

#include "engine/base/check.h"
#include "tools/cli/read_memory.h"

namespace firn {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Larger than any cache.
constexpr std::size_t kArrayBytes = std::size_t{1} << 29;

// Long enough for the clock and the start of threads not to matter, short beside a case.
constexpr double kFmaSeconds = 0.02;

/// Calls work(0) ... work(threads - 1) side by side.
template <class F>
void on_threads(int threads, F&& work) {
  std::vector<std::jthread> running;
  for (int t = 1; t < threads; ++t) running.emplace_back([&work, t] { work(t); });
  work(0);
}

double fma_rate(const BenchRun& run) {
  std::vector<double> gflops(static_cast<std::size_t>(run.threads));
  on_threads(run.threads, [&](int t) {
    const Clock::time_point start = Clock::now();
    std::int64_t flops = 0;
    do {
      const FmaBurst burst =
          run.precision() == Precision::single ? fma_burst<float>(*run.isa) : fma_burst<double>(*run.isa);
      flops += burst.flops;
    } while (seconds_since(start) < kFmaSeconds);
    gflops[static_cast<std::size_t>(t)] = 1e-9 * static_cast<double>(flops) / seconds_since(start);
  });
  return std::accumulate(gflops.begin(), gflops.end(), 0.0);
}

double read_rate(std::span<const std::uint64_t> array, int threads) {
  const auto count = static_cast<std::size_t>(threads);
  const std::size_t lines = array.size() / kLineNumbers;
  std::vector<std::uint64_t> sums(count);
  const Clock::time_point start = Clock::now();
  on_threads(threads, [&](int t) {
    const auto part = static_cast<std::size_t>(t);
    const std::size_t first = lines * part / count, last = lines * (part + 1) / count;
    sums[part] = sum_of(array.subspan(first * kLineNumbers, (last - first) * kLineNumbers));
  });
  const double seconds = seconds_since(start);
  // The array holds ones: every number was read once.
  FIRN_CHECK(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}) == array.size());
  return 1e-9 * static_cast<double>(array.size_bytes()) / seconds;
}

}  // namespace

void Ceilings::measure(const BenchRun& run) {
  if (!run.isa) return;
  array_.resize(kArrayBytes / sizeof(std::uint64_t), 1);
  double& gflops = fma_[key(run)];
  gflops = std::max(gflops, fma_rate(run));
  double& read = read_[run.threads];
  read = std::max(read, read_rate(array_, run.threads));
}

BenchRows Ceilings::rows() const {
  BenchRows out;
  const auto add = [&](const char* ceiling, int threads) -> nlohmann::ordered_json& {
    return out.emplace_back(nlohmann::ordered_json{{"ceiling", ceiling},
                                                   {"isa", nullptr},
                                                   {"precision", nullptr},
                                                   {"threads", threads},
                                                   {"gflops", nullptr},
                                                   {"gb_per_s", nullptr}});
  };
  for (const auto& [key, gflops] : fma_) {
    const auto& [isa, precision, threads] = key;
    auto& row = add("fma", threads);
    row["isa"] = name(isa);
    row["precision"] = name(precision);
    row["gflops"] = gflops;
  }
  for (const auto& [threads, rate] : read_) add("read", threads)["gb_per_s"] = rate;
  return out;
}

}  // namespace firn
