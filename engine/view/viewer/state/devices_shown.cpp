#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "view/viewer/state/devices_shown.h"

namespace palpate::viewer {

void Interventions::add(std::uint32_t safety, double now_s) {
  for (std::size_t i = 0; safety != 0; ++i, safety >>= 1u) {
    if ((safety & 1u) == 0 || i >= counts_.size()) continue;
    ++counts_[i];
    last_s_[i] = now_s;
  }
}

std::string Interventions::recent(double now_s) const {
  constexpr double kRecentS = 2.0;
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0 && now_s - last_s_[i] < kRecentS) seen.push_back(i);
  }
  std::stable_sort(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) { return last_s_[a] > last_s_[b]; });
  std::string words;
  for (const std::size_t i : seen) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", tr(servo::safetyNames()[i]), counts_[i]);
  }
  return words;
}

void CalibrationSteps::addPair(const Vec3& device, const Vec3& body) {
  trouble.clear();
  of_device.push_back(device);
  of_body.push_back(body);
  if (of_device.size() < device::kCalibrationPlaces) return;
  try {
    found = device::calibrationOf(of_device, of_body);
  } catch (const Error& error) {
    trouble = error.what();
    of_device.clear();
    of_body.clear();
  }
}

}  // namespace palpate::viewer
