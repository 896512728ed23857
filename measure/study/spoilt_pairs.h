// Pairs of photographs that something is wrong with: what a measurement must refuse, and what it may not be wrong
// about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

/// What may become of a pair of a kind.
enum class Fate : unsigned char {
  refused,           ///< it must be
  refused_or_right,  ///< accepted only where it is right
  not_seen           ///< nothing in the pictures tells
};

struct SpoiltKind {
  std::string name;
  Fate fate = Fate::refused;
};

const std::vector<SpoiltKind>& spoiltKinds();

struct SpoiltPair {
  measure::SyntheticCase made;
  measure::Photograph before;
  measure::Photograph after;
  measure::SyntheticTruth truth;
  measure::MeasureSettings settings;
};

/// The kind by its place in spoiltKinds(); drawn from the seed.
SpoiltPair spoiltPair(std::size_t kind, std::uint64_t seed, double megapixels);

}  // namespace palpate::study
