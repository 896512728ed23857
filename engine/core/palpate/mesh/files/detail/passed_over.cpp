#include "palpate/mesh/files/detail/passed_over.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::mesh {

void PassedOver::add(std::string_view what, std::size_t place, FilePlace kind) {
  const auto known = std::find_if(kinds_.begin(), kinds_.end(), [what](const Kind& k) { return k.what == what; });
  if (known != kinds_.end()) {
    ++known->count;
  } else if (kinds_.size() < kMaxKinds) {
    kinds_.push_back({std::string(what), place, kind});
  } else if (kinds_.size() == kMaxKinds) {
    kinds_.push_back({"and more that is skipped", place, kind});
  } else {
    ++kinds_.back().count;
  }
}

void PassedOver::leaveOut(std::string_view what, std::size_t count) {
  const auto known =
      std::find_if(left_out_.begin(), left_out_.end(), [&](const auto& one) { return one.first == what; });
  if (known != left_out_.end()) {
    known->second += count;
  } else if (left_out_.size() < kMaxKinds) {
    left_out_.emplace_back(what, count);
  }
}

std::string PassedOver::leftOut() const {
  std::string words;
  for (const auto& [what, count] : left_out_)
    words += fmt::format("{}{} ({})", words.empty() ? "left out: " : ", ", what, count);
  return words;
}

std::vector<std::string> PassedOver::sentences(std::string_view file) const {
  std::vector<std::string> all;
  for (const Kind& kind : kinds_) {
    const std::string what = kind.count == 1 ? kind.what : fmt::format("{} ({} times)", kind.what, kind.count);
    all.emplace_back(
        (kind.place == FilePlace::line ? Error::atLine(file, kind.first, what) : Error::atByte(file, kind.first, what))
            .what());
  }
  if (!left_out_.empty()) all.emplace_back(Error::inFile(file, leftOut()).what());
  return all;
}

}  // namespace palpate::mesh
