// A simulated observer of the training window who feels nothing: it reads off each press how far the drawn finger
// sinks, in pixels, with noise, and names the place where it sinks least.
//
//   EyeSites (read off pictures) ─ EyeObserver ─ answers ─► Block ─► threshold
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "palpate/training/block.h"
#include "report/page/study_page.h"
#include "teach/study/eye_pictures.h"

namespace palpate::study {

/// The word for this observer, and its number of tests where --cases is not given.
inline constexpr std::string_view kEyeObserver = "eye";
inline constexpr std::size_t kEyeTests = 200;

/// Noise of a reading: a floor of pixels and a share of the length, as lengths that are seen one after the other are
/// compared. Assumed, not measured on people.
struct EyeNoise {
  double floor_px = 1.5;
  double share = 0.1;
  double of(double length_px) const;
};

/// How far the odd one is from the others, in standard deviations of one reading: places differ, and the reader errs.
double computeDPrime(const std::vector<double>& normal, const std::vector<double>& odd, const EyeNoise& noise);

/// One test of the protocol's length. The reading of a place with change d is that of the place without it times
/// (1 - d): even tissue answers by Hooke's law, and the picture is linear in depth (checked against pictures).
training::BlockResult eyeTest(const std::vector<double>& normal_px, const training::BlockSettings& settings,
                              const EyeNoise& noise, std::uint64_t seed);

struct EyeMeasurement {
  std::uint64_t seed = 1;
  EyeSites sites{};
  EyeNoise noise{};
  double sink_normal_px = 0.0, sink_stiffer_px = 0.0;    ///< means over sites
  double rings_normal_px = 0.0, rings_stiffer_px = 0.0;  ///< likewise
  double d_prime_sink = 0.0, d_prime_rings = 0.0;
  double off_line_percent = 0.0;          ///< largest error of the stiffer sinks against (1 - d) times the normal ones
  training::BlockResult first{};          ///< the test of the seed
  std::vector<double> medians{};          ///< medians of all tests, compliance
  std::vector<double> stiffness_share{};  ///< lower, middle and upper 2.5, 50, 97.5 % of tests, as k'/k - 1
};

EyeMeasurement measureEye(std::uint64_t seed, std::size_t tests, int sites, const Progress& progress);
/// Whether the threshold of the first test is shown with an interval and within 60 % of stiffness; both d' at least 2.
bool eyeBarsMet(const EyeMeasurement& found);

/// The page of `palpate study training --observer eye`.
StudyPage studyEye(const StudySettings& settings);

}  // namespace palpate::study
