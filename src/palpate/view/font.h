// The typeface of all pictures and panels, built into the program: no font file is needed where it runs.
//
// DejaVu Sans (https://dejavu-fonts.github.io), free to embed under the Bitstream Vera licence; its changes are in the
// public domain.
#pragma once

#include <cstdint>
#include <span>

namespace palpate::view {

/// A TrueType file in memory, for the program's life.
std::span<const unsigned char> embeddedFont();

/// Ranges of characters that the pictures use, as ImGui wants them: pairs of first and last, ended by 0.
const std::uint16_t* fontRanges();

}  // namespace palpate::view
