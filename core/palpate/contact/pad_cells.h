// The cells of a pad of taxels, and what is done to all of them at once: written once, compiled for every vector
// instruction set and chosen at run time. Sums go in eight lanes whatever the processor, so all give the same bits.
#pragma once

#include <array>
#include <cstddef>

namespace palpate::contact {

/// Rows of 8 or 16 columns, of which the last may be beyond the pad; whole rows are looked at, from `first` to `last`
/// (half open), which are those that the contact reaches.
struct alignas(64) PadCells {
  static constexpr std::size_t kMostAcross = 16;
  static constexpr std::size_t kLanes = 8;
  using Values = std::array<double, kMostAcross * kMostAcross>;

  Values plain;                       ///< N, without lumps; 0 where the contact does not cover a cell
  Values lever;                       ///< 1 / sqrt(R^2 - r^2): times x and y it is lateral over normal force; 0 there
  Values force;                       ///< N
  Values kernel;                      ///< of one lump's bump
  Values bumps;                       ///< of all lumps, times the plain force
  std::array<double, kMostAcross> x;  ///< of a column's middle, mm along u; the same downwards, mm against v
  std::size_t side = 0;               ///< cells along a side of the pad
  std::size_t across = 0;             ///< columns of a row: 8 or 16
  std::size_t first = 0, last = 0;    ///< rows

  std::size_t begin() const noexcept { return first * across; }
  std::size_t end() const noexcept { return last * across; }
};

/// A contact in the middle of a pad.
struct PadContact {
  double radius_mm = 0.0;  ///< c
  double finger_mm = 0.0;  ///< R
  double exponent = 0.0;   ///< q
  double cell_mm = 0.0;    ///< side of a cell
};

/// Lays out the cells: x, side, across and the rows that the contact reaches.
void layOut(std::size_t side, const PadContact& contact, PadCells& cells) noexcept;

/// Covered share x (1 - r^2 / c^2)^q into `plain`, and `lever`. A cell at the rim is covered in part, from the inside:
/// no taxel jumps when the contact grows.
void coverCells(const PadContact& contact, PadCells& cells) noexcept;

/// Makes them add up to `sum`.
void scaleTo(double sum, const PadCells& cells, PadCells::Values& values) noexcept;

/// K = (1 + s^2 / w^2)^(-5/2) round a foot.
struct PadKernel {
  double sum = 0.0;   ///< of K x plain
  double mean = 0.0;  ///< of K over a circle round the middle
};
/// K into `kernel`, and its mean over a circle of that radius, as tissue::bumpBase has it.
PadKernel makeKernel(double foot_x, double foot_y, double width_mm, double circle_mm, PadCells& cells) noexcept;
/// bumps += strength x kernel.
void addKernel(double strength, PadCells& cells) noexcept;
/// What forces add up to, and their moments about the middle of the finger over its radius.
struct PadMoments {
  double normal = 0.0, u = 0.0, v = 0.0;
};
PadMoments momentsOf(const PadCells& cells) noexcept;

/// Of forces; and the sums of plain x x lever along u, plain y y lever along v.
struct PadSlopes {
  PadMoments moments;
  double u = 0.0, v = 0.0;
};
/// force = plain x (level + bumps), not below 0.
PadSlopes raiseForces(double level, PadCells& cells) noexcept;

/// force = factor x force + plain x (gain_u x + gain_v y), and its moments. False where some of it would be below 0:
/// the forces stay then.
bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) noexcept;

}  // namespace palpate::contact
