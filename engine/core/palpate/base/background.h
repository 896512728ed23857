// Cold work on threads of its own. They come from the environment (base/environment.h): where it has none, the work is
// done by the caller. The servo loop and the hand-over of worlds, which *are* threads, keep their own.
#pragma once

#include <cstddef>
#include <functional>

#include "palpate/base/environment.h"

namespace palpate {

/// A piece of work in progress. Its captures must live until it has been joined.
class Background {
 public:
  /// Starts it. Without a thread it is done here and now, or at the latest in `join`.
  explicit Background(std::function<void()> work);
  /// Waits for it; what it threw is lost.
  ~Background();
  Background(Background&& other) noexcept;
  Background& operator=(Background&&) = delete;

  /// `join` would not wait for long.
  bool done() const;
  /// Waits until it is done and throws what it threw. Call it once.
  void join();

 private:
  StartedWork work_;  // empty once it has been joined
};

/// Number of pieces of work that are worth starting at once, the caller's own among them; at least 1.
std::size_t processors();

/// Calls work(begin, end) for ranges that make up [0, count), on as many threads as there are processors, but on one
/// for fewer than `least` items each. Returns when all are done and throws what the first of them threw.
void shareOut(std::size_t count, std::size_t least, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace palpate
