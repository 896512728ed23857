// Faulty pairs of photographs: some that a measurement must refuse, others that it may not be wrong about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

/// Acceptable outcomes for a kind of pair.
enum class Fate : unsigned char {
  refused,           ///< it must be
  refused_or_right,  ///< accepted only where it is right
  not_seen           ///< nothing in the pictures shows it
};

struct CorruptedKind {
  std::string name;
  Fate fate = Fate::refused;
};

const std::vector<CorruptedKind>& corruptedKinds();

struct CorruptedPair {
  measure::SyntheticCase made;
  measure::Photograph before;
  measure::Photograph after;
  measure::SyntheticTruth truth;
  measure::MeasureSettings settings;
};

/// The kind by its place in corruptedKinds(); drawn from the seed.
CorruptedPair corruptedPair(std::size_t kind, std::uint64_t seed, double megapixels);

}  // namespace palpate::study
