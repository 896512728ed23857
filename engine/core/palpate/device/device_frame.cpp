// "y,z,x" -> rows of a rotation. A list that would mirror the hand is refused: left would be felt as right.
#include "palpate/device/device_frame.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::device {

namespace {

[[noreturn]] void refuseAxes(std::string_view words, std::string_view cause) {
  throw Error(fmt::format("axes '{}': {}; expected x, y and z in any order, each with an optional minus, e.g. y,z,x",
                          oneLine(words), cause));
}

}  // namespace

Mat3 axesNamed(std::string_view words) {
  const std::vector<std::string_view> names = split(words, ',');
  if (names.size() != 3) refuseAxes(words, "not three axes");
  Mat3 axes = Mat3::Zero();
  for (int row = 0; row < 3; ++row) {
    std::string_view name = names[static_cast<std::size_t>(row)];
    const double sign = name.starts_with('-') ? -1.0 : 1.0;
    if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
    if (name.size() != 1 || name[0] < 'x' || name[0] > 'z') refuseAxes(words, "no such axis");
    axes(row, name[0] - 'x') = sign;
  }
  const double volume = axes.determinant();
  if (volume == 0.0) refuseAxes(words, "an axis is named twice");
  if (volume < 0.0) refuseAxes(words, "a mirror image, which swaps left and right of the hand");
  return axes;
}

}  // namespace palpate::device
