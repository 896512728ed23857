// Published numbers on soft tissue and the friction of skin, and the project's defaults.
//
// A small library of numbers with their sources, to be looked at and chosen from. Published stiffness of one tissue
// spreads over two or three powers of ten, with the method, the load and the person: the defaults bracket people and
// represent no individual. docs/reference/tissue-tables.md says so wherever a number is shown.
#pragma once

#include <span>
#include <string_view>

namespace palpate::tissue {

/// Young's modulus at rest, kPa; low and high are the same where a source gives one number.
struct PublishedModulus {
  std::string_view tissue;  ///< "skin", "fat", "muscle"
  double low_kpa = 0.0;
  double high_kpa = 0.0;
  std::string_view how;     ///< measured or worked out
  std::string_view source;  ///< "" for a choice of the project's
  std::string_view doubt;   ///< what is not sure about it; "" for nothing
  bool is_default = false;
};

/// Coulomb's coefficient; low and high as above.
struct PublishedFriction {
  std::string_view surface;
  double low = 0.0;
  double high = 0.0;
  std::string_view how;
  std::string_view source;
};

/// Values for a finger's friction_static and friction_kinetic.
struct FrictionPreset {
  std::string_view name;
  double still = 0.0;
  double slipping = 0.0;
  std::string_view why;
};

std::span<const PublishedModulus> publishedModuli();
std::span<const PublishedFriction> publishedFriction();
std::span<const FrictionPreset> frictionPresets();

/// kPa: of "skin", "fat" or "muscle" in the stacks that the project solves. Throws Error for another word.
double defaultModulus(std::string_view tissue);

/// A line for wherever these numbers are shown.
std::string_view moduliCaveat();

}  // namespace palpate::tissue
