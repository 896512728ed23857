#include "palpate/base/background.h"

#include <utility>

namespace palpate {

Background::Background(std::function<void()> work) : work_(environment().start(std::move(work))) {}

Background::Background(Background&& other) noexcept : work_(std::exchange(other.work_, {})) {}

Background::~Background() {
  if (!work_.join) return;
  try {
    work_.join();
  } catch (...) {  // lost, as promised
  }
}

bool Background::done() const { return !work_.done || work_.done(); }

void Background::join() {
  const StartedWork work = std::exchange(work_, {});
  work.join();
}

std::size_t processors() { return environment().processors(); }

}  // namespace palpate
