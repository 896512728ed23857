// A flag for objects that change while the interpreter's lock is released: a second caller gets an error instead of
// ending the process (three threads on one skin: bad_alloc in noexcept).
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace palpate::python {

/// A member of an object that one call at a time may use.
class Busy {
 public:
  Busy() = default;
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  /// Held for a call. Throws std::runtime_error (RuntimeError) when another call holds it.
  class Guard {
   public:
    Guard(Busy& busy, const char* what) : busy_(busy) {
      if (busy_.taken_.exchange(true)) {
        throw std::runtime_error(std::string(what) + " is in use by another call; give each thread its own");
      }
    }
    ~Guard() { busy_.taken_.store(false); }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

   private:
    Busy& busy_;
  };

 private:
  std::atomic<bool> taken_{false};
};

}  // namespace palpate::python
