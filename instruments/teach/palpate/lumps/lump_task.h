// Settings of a session with lumps, what it hides and asks: the table [lump] of a protocol.
//
//   [lump] ─ training/protocol_file.cpp ─► LumpTask ─► LumpBlock (lump_block.h), LumpBodies (session/lump_bodies.h)
//
// Three diameters, three depths and three ratios: each is asked about as one of three.
#pragma once

#include <array>

namespace palpate::lumps {

inline constexpr int kGrades = 3;  ///< grades of size, depth and hardness
using Grades = std::array<double, kGrades>;

/// An examination hides 18 lumps, all sizes at all hardnesses at the least and the greatest depth, in six bodies.
inline constexpr int kExamBodies = 6;
inline constexpr int kExamLumpsOfBody = 3;
inline constexpr int kExamLumps = kExamBodies * kExamLumpsOfBody;

/// Sizes and ratios as silicone sets have them: 3, 5 and 10 mm, and 40, 90 and 200 kPa in 12 kPa.
struct LumpTask {
  Grades diameters_mm = {3.0, 5.0, 10.0};
  Grades depths_mm = {3.0, 6.0, 10.0};  ///< depths of the tops under the skin
  Grades ratios = {3.3, 7.5, 17.0};     ///< Young's modulus over that of the layer
  double mobile_share = 0.25;           ///< share of lumps that are mobile
  double mobility_mm_per_n = 10.0;      ///< mobility of mobile lumps
  double empty_share = 0.3;             ///< share of practice bodies without lumps
  int bodies = 20;                      ///< in a practice session
  double start_cue = 30.0;              ///< C of the first lump that practice hides: plain to most
  bool pad_shown = false;               ///< the pressures under the finger are shown; in practice alone
  /// An examination is passed with this share of its lumps found ...
  double mark_share = 0.5;
  /// ... and at most this many places named without a lump, in all its bodies.
  int most_false = 4;
  friend bool operator==(const LumpTask&, const LumpTask&) = default;

  /// a finding counts as its lump within this, mm: a fingertip's contact, or the lump's own radius.
  double hitMm(int size) const {
    constexpr double kFingertipMm = 10.0;
    const double radius = 0.5 * diameters_mm[static_cast<std::size_t>(size)];
    return radius > kFingertipMm ? radius : kFingertipMm;
  }
};

}  // namespace palpate::lumps
