// Each piece of work is one std::async, whose future carries what it threw; there is no pool, so a piece must be worth
// the making of a thread. Without threads the work is done in the constructor. Cold paths only. Own.
#include "palpate/base/background.h"

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace palpate {

#ifdef PALPATE_NO_THREADS

Background::Background(std::function<void()> work) {
  std::packaged_task<void()> task(std::move(work));
  future_ = task.get_future();
  task();
}

std::size_t processors() { return 1; }

#else

// This policy falls back on doing the work in `join` where the system refuses a thread.
Background::Background(std::function<void()> work)
    : future_(std::async(std::launch::async | std::launch::deferred, std::move(work))) {}

std::size_t processors() { return std::max(1u, std::thread::hardware_concurrency()); }

#endif

Background::~Background() {
  if (future_.valid()) future_.wait();
}

// A deferred piece is never `ready`: it is done by the one who joins, so there is nothing to wait for.
bool Background::done() const { return future_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout; }

void Background::join() { future_.get(); }

void lowerPriority([[maybe_unused]] int nice) {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, nice);
#endif
}

}  // namespace palpate
