// Numbered jobs for free threads: results come in the order of the numbers, whatever the number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "palpate/base/background.h"
#include "palpate/base/progress.h"

namespace palpate::lab {

/// `job(number)` on this thread and on helpers. `threads` 0: as many as there are processors.
template <class Job>
auto sharedJobs(std::size_t count, std::size_t threads, const char* stage, const Progress& progress, const Job& job) {
  std::vector<decltype(job(std::size_t{}))> results(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&](const Progress& told) {
    for (std::size_t i = next++; i < count; i = next++) {
      report(told, stage, static_cast<double>(i) / static_cast<double>(count));
      results[i] = job(i);
    }
  };
  std::vector<Background> helpers;
  const std::size_t wanted = threads > 0 ? threads : processors();
  for (std::size_t i = 1; i < wanted; ++i) helpers.emplace_back([&work] { work({}); });
  work(progress);
  for (Background& helper : helpers) helper.join();
  return results;
}

}  // namespace palpate::lab
