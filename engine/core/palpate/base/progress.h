// Progress reports of long work. Cold paths only.
#pragma once

#include <functional>
#include <string_view>

namespace palpate {

/// Called from the thread that works, with the stage's name and its share done in [0, 1]. May be empty.
using Progress = std::function<void(std::string_view stage, double done)>;

inline void report(const Progress& progress, std::string_view stage, double done) {
  if (progress) progress(stage, done);
}

}  // namespace palpate
