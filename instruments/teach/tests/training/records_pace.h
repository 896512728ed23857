// Trials at the pace of a class of 200 (training in earnest: 5 to 12 a second), and how long each commit takes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace palpate::training::pace {

inline double fromEnvironment(const char* name, double standard) {
  const char* const text = std::getenv(name);
  return text == nullptr ? standard : std::atof(text);
}

struct Measured {
  std::uint64_t trials = 0;
  double seconds = 0.0;
  double p50_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;
};

/// For PALPATE_LOAD_S seconds; in the suite for one.
inline Measured atTwelveASecond(const std::function<void(std::uint64_t)>& save) {
  using Clock = std::chrono::steady_clock;
  const auto trials = static_cast<std::uint64_t>(12.0 * fromEnvironment("PALPATE_LOAD_S", 1.0));
  const auto begin = Clock::now();
  std::vector<double> ms;
  for (std::uint64_t number = 1; number <= trials; ++number) {
    std::this_thread::sleep_until(begin + number * std::chrono::microseconds(1'000'000 / 12));
    const auto before = Clock::now();
    save(number);
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - before).count());
  }
  std::ranges::sort(ms);
  const auto at = [&](double share) {
    return ms[std::min(ms.size() - 1, static_cast<std::size_t>(share * static_cast<double>(ms.size())))];
  };
  return {trials, std::chrono::duration<double>(Clock::now() - begin).count(), at(0.5), at(0.99), ms.back()};
}

/// A commit may take 50 ms, but for one in a hundred. Asked for only where the machine was left alone for it.
inline void judge(const std::string& database, const Measured& measured) {
  if (std::getenv("PALPATE_LOAD_S") == nullptr) return;
  std::printf("%s: %llu trials in %.0f s; commit p50 %.1f ms, p99 %.1f ms, max %.1f ms\n", database.c_str(),
              static_cast<unsigned long long>(measured.trials), measured.seconds, measured.p50_ms, measured.p99_ms,
              measured.max_ms);
  EXPECT_LE(measured.p99_ms, 50.0);
}

}  // namespace palpate::training::pace
