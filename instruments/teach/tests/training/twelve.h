// A spine for tests: the landmarks that the twelve sites need, 40 mm apart, on a flat back.
#pragma once

#include <vector>

#include "palpate/body/places.h"
#include "palpate/training/site.h"

namespace palpate::training {

inline std::vector<body::SkinLandmark> flatSpine() {
  std::vector<body::SkinLandmark> landmarks;
  double y = 200.0;
  for (const auto level : body::kSiteLevels) {
    landmarks.push_back({.name = "spinous_" + std::string(level),
                         .bone = std::string(level),
                         .position = Vec3(0.0, y, 100.0),
                         .normal = Vec3::UnitZ(),
                         .bone_position = Vec3(0.0, y, 80.0)});
    y -= 40.0;
  }
  return landmarks;
}

inline SiteSet flatTwelve() { return twelveSites(flatSpine()); }

/// A finger that presses here with so many newtons; none: it is in the air.
inline trace::Sample pressAt(const Vec3& place, double force_n, std::uint32_t finger = 0) {
  trace::Sample sample;
  sample.finger = finger;
  contact::FingerOutput& contact = sample.contact;
  contact.tip = contact.proxy = contact.anchor = place;
  contact.normal = Vec3::UnitZ();
  contact.force = sample.device_force = force_n * Vec3::UnitZ();
  contact.depth_mm = 2.0 * force_n;
  contact.touch = force_n > 0.0 ? contact::Touch::stick : contact::Touch::free;
  return sample;
}

}  // namespace palpate::training
