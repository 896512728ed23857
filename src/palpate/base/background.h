// Work beside the caller: the one place where the engine asks for a thread to get a cold task done sooner. The servo
// loop and the hand-over of worlds, which *are* threads, keep their own.
//
// Where there are no threads (PALPATE_THREADS=OFF), or none is left, the work is done all the same, by the caller.
#pragma once

#include <cstddef>
#include <functional>
#include <future>

namespace palpate {

/// A piece of work under way. What it refers to must live until it has been joined.
class Background {
 public:
  /// Starts it. Without a thread it is done here and now, or at the latest in `join`.
  explicit Background(std::function<void()> work);
  /// Waits for it; what it threw is lost.
  ~Background();
  Background(Background&&) noexcept = default;
  Background& operator=(Background&&) = delete;

  /// `join` would not wait for long.
  bool done() const;
  /// Waits until it is done and throws what it threw. Call it once.
  void join();

 private:
  std::future<void> future_;
};

/// How many pieces of work are worth starting at once, the caller's own among them; at least 1.
std::size_t processors();

/// Whatever draws or touches goes before the calling thread from now on: its nice value becomes `nice`, 1 to 19.
/// Nothing happens where a thread has no priority of its own and the whole process would be slowed (all but Linux).
void lowerPriority(int nice);

}  // namespace palpate
