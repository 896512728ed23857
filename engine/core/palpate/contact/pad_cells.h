// The cells of a pad of taxels, and what is done to all of them at once: written once, compiled for every vector
// instruction set and chosen at run time. Sums go in eight lanes whatever the processor, so all give the same bits.
// Lengths are in cells.
#pragma once

#include <array>
#include <cstddef>

namespace palpate::contact {

/// Rows of 8 or 16 columns, of which the last may be beyond the pad; whole rows are looked at, from `first` to `last`
/// (half open), which are those that the contact reaches.
struct alignas(64) PadCells {
  static constexpr std::size_t kMaxAcross = 16;
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kKernels = 8;
  using Values = std::array<double, kMaxAcross * kMaxAcross>;

  Values plain;   ///< what a cell has of the force without lumps, to no scale; 0 where the contact does not cover it
  Values lever;   ///< 1 / sqrt(R^2 - r^2): times x and y it is lateral over normal force
  Values bumps;   ///< of lumps whose kernels are gone, times the plain force
  Values raised;  ///< the plain forces with the bumps of all lumps
  Values force;   ///< N
  std::array<Values, kKernels> kernels;    ///< each of one lump's bump
  std::array<double, kKernels> strengths;  ///< of the bumps
  std::size_t kernel_count = 0;
  bool has_bumps = false;           ///< `bumps` counts
  const double* x = nullptr;        ///< of a column's middle along u; the same downwards, against v
  std::size_t side = 0;             ///< cells along a side of the pad
  std::size_t across = 0;           ///< columns of a row: 8 or 16
  std::size_t first = 0, last = 0;  ///< rows

  std::size_t begin() const noexcept { return first * across; }
  std::size_t end() const noexcept { return last * across; }
};

/// A contact in the middle of a pad.
struct PadContact {
  double radius = 0.0;    ///< c
  double finger = 0.0;    ///< R
  double exponent = 0.0;  ///< q
};

/// Fewest cells along a side of a pad; the most are those across.
inline constexpr std::size_t kMinSide = PadCells::kLanes;

/// Sums over the plain forces.
struct PadCover {
  double normal = 0.0;
  double slope = 0.0;  ///< of plain x lever x x^2; the same along v
};
/// Lays out the cells and covers them: share x (1 - r^2 / c^2)^q into `plain`, and `lever`. A cell at the rim is
/// covered in part, from the inside: no taxel jumps when the contact grows.
PadCover coverCells(std::size_t side, const PadContact& contact, PadCells& cells) noexcept;

/// K = (1 + s^2 / w^2)^(-5/2) round a foot, within some 1e-6 of itself.
struct PadKernel {
  double sum = 0.0;   ///< of K x plain
  double mean = 0.0;  ///< of K over a circle round the middle
};
/// K into the kernel after those that count, and its mean over a circle of that radius, as tissue::bumpBase has it.
PadKernel makeKernel(double foot_x, double foot_y, double width, double circle, PadCells& cells) noexcept;
/// Lets the kernel that was made last count: strength x K of the plain force.
void commitKernel(double strength, PadCells& cells) noexcept;

/// Sum of the forces, and their moments about the middle of the finger over its radius.
struct PadMoments {
  double normal = 0.0, u = 0.0, v = 0.0;
};
PadMoments momentsOf(const PadCells& cells) noexcept;

/// raised = plain x (level + all that the kernels make), not below 0.
PadMoments raiseForces(double level, PadCells& cells) noexcept;

/// force = factor x raised + plain x (gain_u x + gain_v y), and its moments. False where some of it is below 0.
bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) noexcept;

/// force = factor x values.
void scaleTo(double factor, const PadCells::Values& values, PadCells& cells) noexcept;

/// Rows of `split` rows of `values` each, added up, into the first rows of `sums`, which are as wide.
void sumRows(const PadCells::Values& values, std::size_t split, const PadCells& cells, PadCells::Values& sums) noexcept;

}  // namespace palpate::contact
