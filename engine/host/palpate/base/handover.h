// Gives a running loop a new object without stopping it: one thread makes it, the loop adopts it between two ticks, and
// the thread that made the old one destroys it, never the loop.
//
// Two slots that change by atomic exchange: one for the offered object, one for the old one. The loop adopts only while
// the second is empty, so it never has to wait nor to free.
#pragma once

#include <atomic>
#include <memory>

namespace palpate {

/// One offering thread, one taking thread.
template <class T>
class Handover {
 public:
  Handover() = default;
  ~Handover() {
    delete offered_.load();
    delete put_down_.load();
  }
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;

  /// Offering thread: offers the next object, in place of an older one that was not adopted yet.
  void offer(std::unique_ptr<T> next) {
    collect();
    delete offered_.exchange(next.release(), std::memory_order_acq_rel);
  }

  /// Offering thread: destroys the loop's old object. True when there was one. Call it now and then, or the loop adopts
  /// nothing more.
  bool collect() {
    const std::unique_ptr<T> old(put_down_.exchange(nullptr, std::memory_order_acq_rel));
    return old != nullptr;
  }

  /// Taking thread: replaces `current`, which is not null, by what was offered. In between `adopt(current, next)` may
  /// move things from the one to the other; nothing of the old one may be touched afterwards. False when there is
  /// nothing, or when what was released last time has not been collected. Never waits, allocates or frees.
  template <class Adopt>
  bool receive(std::unique_ptr<T>& current, const Adopt& adopt) noexcept {
    if (offered_.load(std::memory_order_relaxed) == nullptr) return false;
    if (put_down_.load(std::memory_order_acquire) != nullptr) return false;
    T* const next = offered_.exchange(nullptr, std::memory_order_acq_rel);
    adopt(*current, *next);
    put_down_.store(current.release(), std::memory_order_release);
    current.reset(next);
    return true;
  }

 private:
  std::atomic<T*> offered_{nullptr};
  std::atomic<T*> put_down_{nullptr};
};

}  // namespace palpate
