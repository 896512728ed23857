#include "palpate/view/font.h"

// The assembler copies the file into the read-only data; PALPATE_FONT_FILE is found by CMake.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    "palpate_font_begin:\n"
    ".incbin \"" PALPATE_FONT_FILE
    "\"\n"
    "palpate_font_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const unsigned char palpate_font_begin[];
extern const unsigned char palpate_font_end[];
}

namespace palpate::view {

std::span<const unsigned char> embeddedFont() { return {palpate_font_begin, palpate_font_end}; }

const std::uint16_t* fontRanges() {
  // Latin 1; dashes and minus; arrows; the Greek capital delta.
  static constexpr std::uint16_t kRanges[] = {0x0020, 0x00FF, 0x2013, 0x2014, 0x2026, 0x2026, 0x2190,
                                              0x2193, 0x2212, 0x2212, 0x0394, 0x0394, 0};
  return kRanges;
}

}  // namespace palpate::view
