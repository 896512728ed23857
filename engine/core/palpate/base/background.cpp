#include "palpate/base/background.h"

#include <algorithm>
#include <utility>
#include <vector>

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

void shareOut(std::size_t count, std::size_t least, const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t parts = std::max<std::size_t>(1, std::min(processors(), count / std::max<std::size_t>(1, least)));
  std::vector<Background> others;
  for (std::size_t i = 1; i < parts; ++i) {
    others.emplace_back([&work, from = count * i / parts, to = count * (i + 1) / parts] { work(from, to); });
  }
  work(0, count / parts);
  for (Background& other : others) other.join();
}

}  // namespace palpate
