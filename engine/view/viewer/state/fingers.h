// The two fingers of the window.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace palpate::viewer {

inline constexpr std::size_t kFingers = 2;
/// Names in recordings.
inline constexpr std::array<std::string_view, kFingers> kFingerNames = {"left", "right"};

}  // namespace palpate::viewer
