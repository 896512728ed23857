// The tables of skin_numbers.txt, which says whose skin it is.
#include "palpate/body/skin_table.h"

#include <iterator>

namespace palpate::body {

namespace {

using SkinRow = float[kSkinAlong];

#include "palpate/body/skin_numbers.inc"

static_assert(std::ssize(kSkinRadii) == kSkinAcrossStored);

}  // namespace

std::span<const float> skinRadii(int row) { return kSkinRadii[row]; }
std::span<const OutlinePoint> outlineFlank() { return kOutlineFlank; }
std::span<const OutlinePoint> outlineArm() { return kOutlineArm; }
std::span<const OutlinePoint> outlineRidge() { return kOutlineRidge; }

}  // namespace palpate::body
