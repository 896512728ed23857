// Waiting for what another thread does.
#pragma once

#include <chrono>
#include <thread>

#include "palpate/base/stopwatch.h"

namespace palpate::support {

/// Asks again and again, for as long as even a busy machine may take: true as soon as it is so, false after 20 s.
template <class Ready>
bool waitFor(const Ready& ready) {
  const auto until = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < until) {
    if (ready()) return true;
    std::this_thread::yield();
  }
  return false;
}

}  // namespace palpate::support
