// The product's lumps against finite elements with the lump in the mesh: force, pressure, points off the axis, and the
// field behind all of it.
//
// Cases come from a file (tests/data/golden/lumps.json has the form) or are drawn and solved. Bars and errors:
// docs/reference/lump-figures.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/tissue/layered_table.h"
#include "palpate/tissue/lump_energy.h"

namespace palpate::lab {

/// One press over a lump, and the same without it.
struct LumpPress {
  double depth_mm = 0.0;
  double force_n = 0.0;
  double force_without_n = 0.0;
  double contact_radius_mm = 0.0;            ///< seen along the axis
  std::vector<double> pressure_kpa;          ///< means over rings of 1 mm; empty: unknown, and not compared
  std::vector<double> surface_change_share;  ///< at LumpCases::surface_radii_mm, share of the depth
};

struct LumpCase {
  std::string name;
  std::size_t stack = 0;
  tissue::LumpShape lump;
  std::vector<LumpPress> presses;
};

/// A press off a lump's axis, from a solver whose mesh is too coarse for its size: only ratios count.
struct BesidePress {
  double depth_mm = 0.0;
  double extra_share = 0.0;    ///< over the force without lump
  double lateral_share = 0.0;  ///< away from the lump
};

struct BesideCase {
  std::string name;
  std::size_t stack = 0;
  tissue::LumpShape lump;
  double at_mm = 0.0;
  std::vector<BesidePress> presses;
};

/// Strain energy in a ball of 1 mm, per kPa of mu and of lambda.
struct FieldEntry {
  std::size_t stack = 0;
  double centre_mm = 0.0;
  double at_mm = 0.0;
  double depth_mm = 0.0;
  double shear_mm3 = 0.0;
  double volume_mm3 = 0.0;
};

struct LumpCases {
  std::vector<std::string> stack_names;
  std::vector<tissue::LayerStack> stacks;
  std::vector<std::vector<double>> forces_n;  ///< per stack without lump, at 1, 2, 3 ... mm
  std::vector<double> surface_radii_mm;
  std::vector<LumpCase> cases;
  std::vector<BesideCase> beside;  ///< those on the axis (at_mm 0) first among those of one mesh
  std::vector<FieldEntry> field;
};

/// Throws Error naming the file and its fault.
LumpCases readLumpCases(const std::filesystem::path& file);
/// Parses the text of such a file; messages name `file`.
LumpCases parseLumpCases(std::string_view text, const std::filesystem::path& file);

/// Stacks and lumps without presses, four to a stack: skin over fat of 2 to 20 kPa over muscle; balls of 3 to 14
/// mm, 1.5 to 40 times as stiff as their layer, tops from the shallowest that is allowed to 12 mm.
LumpCases drawLumpCases(std::uint64_t seed, std::size_t lumps);
/// Draws and solves cases (some 10 s a lump) that nothing was fitted to.
LumpCases solveLumpCases(std::uint64_t seed, std::size_t lumps, const Progress& progress);

struct Spread {
  double mean = 0.0;
  double p90 = 0.0;
  double p95 = 0.0;
  double worst = 0.0;
  std::size_t count = 0;
};
Spread computeSpread(std::vector<double> values);

/// All for presses of 2 mm and more. "Small": lumps to 12 mm.
struct LumpFindings {
  struct One {
    std::string name;
    double force_percent = 0.0;     ///< worst, of the total force
    double pressure_percent = 0.0;  ///< worst RMS, of the peak
    double surface_percent = 0.0;   ///< worst RMS, of the depth
  };
  std::vector<One> cases;
  Spread force;  ///< % of the total force, of the cases' worst
  Spread force_small;
  std::vector<double> extra_ratios;  ///< model over truth, lumps to 14 mm, where the truth is above 2 % of the force
  Spread pressure;                   ///< RMS over the contact, % of the peak
  Spread pressure_small;
  double pressure_gain = 0.0;  ///< mean error over that of a pattern without bump, tops to 3.5 mm
  Spread surface_small;        ///< error of the skin drawn as without lump, RMS over 40 mm, % of the depth
  Spread surface_large;
  Spread field;  ///< % of mu w_s + lambda w_v in balls of 1 mm
  struct Beside {
    std::string name;
    double at_mm = 0.0;
    double ratio_percent = 0.0;  ///< worst error of the extra force over that on the axis, 3 mm and more
    double lateral = 0.0;        ///< worst error of the lateral force, share of the force without lump
  };
  std::vector<Beside> beside;
};

LumpFindings judgeLumps(const LumpCases& cases, const Progress& progress);

}  // namespace palpate::lab
