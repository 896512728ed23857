// The paths of `palpate study hunt`: deep, quick, crooked and exact ones, found by the oracle's own geometry.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lab/judges/hunt_judge.h"

namespace palpate::lab {

struct HuntedPathSettings {
  std::size_t ticks = 1500;  ///< each 1 ms
  double mm = 1.0;           ///< one millimetre in units of the body
  double radius_mm = 0.0;    ///< radius of the finger: paths begin out of its reach, grazing ones stay at it
  std::uint64_t seed = 1;
};

/// Motions of the finger: press (to 80 mm, oblique too), drag, stab (0.05 to 5 m/s), jump (to 30 mm a tick), cross
/// (through limbs and plates), tour (in and out at any angle), crease (along edges), sheets (round places where sheets
/// pierce each other), circle, walk (at random, inside), tremble (noise of microns), exact (stops on vertices, edges
/// and planes), graze, burrow (deeper and deeper into a pocket), slow and gap (through gaps about as wide as the
/// finger).
std::vector<std::string> huntedPathKinds();

/// Tips in the body's units, `ticks` of them; the first is outside and free where the body is closed. Two or three
/// kinds, the first of them `kind`, one after the other; some with noise. The same for the same seed.
std::vector<Vec3> huntedPath(OracleBody& body, std::string_view kind, const HuntedPathSettings& settings);

}  // namespace palpate::lab
