// Roots are found by Newton's method from the exponent: products and sums alone. The processor's one divider would
// otherwise be what all lanes wait for.
#ifdef __wasm__
#undef HWY_COMPILE_ONLY_STATIC   // what builds without Highway's library asks for
#define HWY_COMPILE_ONLY_SCALAR  // this Highway has no arithmetic of doubles in lanes there
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "palpate/contact/pad_cells.cpp"
#include <hwy/foreach_target.h>
// The order matters: foreach_target compiles this file once more for every further instruction set.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/contact/pad_cells.h"

#ifndef PALPATE_KERNEL_SHAPE
#define PALPATE_KERNEL_SHAPE
namespace palpate::contact {

/// Where the cells of a pad are, by its side; r is that of rows above the middle and of the middle one.
struct alignas(64) PadGrid {
  std::array<double, PadCells::kMaxAcross> x;
  std::array<double, PadCells::kMaxAcross * PadCells::kMaxAcross / 2> r, inverse_r;
};

/// A bump's kernel; 1 + s^2 / w^2 on the circle is circle + swing x cosine.
struct KernelShape {
  double foot_x, foot_y, per_width2, circle, swing;
  std::size_t arcs;  ///< of half the circle: a multiple of PadCells::kLanes and a power of 2
  double per_arc;
  const double* cosines;  ///< of their middles
};

}  // namespace palpate::contact
#endif

HWY_BEFORE_NAMESPACE();
namespace palpate::contact::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, PadCells::kLanes>;
using V = hn::Vec<D>;

HWY_INLINE V all(double value) { return hn::Set(D(), value); }
HWY_INLINE V load(const double* values) { return hn::Load(D(), values); }

/// 1 / sqrt(v) to 6e-7 after two rounds and 5e-13 after three; for 0 a number so large that its product with 0 is 0.
template <int kRounds>
HWY_INLINE V rootInverse(V v) {
  static_assert(kRounds == 2 || kRounds == 3);
  const hn::RebindToUnsigned<D> bits;
  // 1 / sqrt to 3.5 % (Lomont 2003, for doubles).
  const auto guess = hn::Sub(hn::Set(bits, std::uint64_t{0x5fe6eb50c7b537a9}), hn::ShiftRight<1>(hn::BitCast(bits, v)));
  const V root = hn::BitCast(D(), guess);
  const V half = hn::Mul(all(0.5), v);
  const auto round = [half](V r, double from)
                         HWY_ATTR { return hn::Mul(r, hn::Sub(all(from), hn::Mul(hn::Mul(half, r), r))); };
  // Newton's rounds have 1.5 and end too low; a little more puts as much of the error above as below.
  const V near = round(round(root, 1.50089081), 1.5000005954);
  return kRounds == 2 ? near : round(near, 1.5);
}

/// Eight sums side by side.
struct Sums {
  alignas(64) double at[PadCells::kLanes] = {};
  HWY_INLINE void add(std::size_t lane, V v) { hn::Store(hn::Add(hn::Load(D(), at + lane), v), D(), at + lane); }
  /// In halves, as the widest vectors do it in the fewest steps.
  HWY_INLINE double sum() const {
    const hn::CappedTag<double, PadCells::kLanes / 2> half;
    alignas(64) std::array<double, PadCells::kLanes / 2> four;
    for (std::size_t i = 0; i < four.size(); i += hn::MaxLanes(half)) {
      hn::Store(hn::Add(hn::Load(half, at + i), hn::Load(half, at + four.size() + i)), half, four.data() + i);
    }
    return (four[0] + four[2]) + (four[1] + four[3]);
  }
};

/// `each(column, lane)` for every vector of a row.
template <class Each>
HWY_INLINE void overColumns(const PadCells& cells, const Each& each) {
  constexpr std::size_t kStep = hn::MaxLanes(D());
  const std::size_t across = cells.across;
  for (std::size_t column = 0; column < across; column += PadCells::kLanes) {
    for (std::size_t lane = 0; lane < PadCells::kLanes; lane += kStep) each(column + lane, lane);
  }
}

/// `each(cell, column, lane, row)` for every vector of cells.
template <class Each>
HWY_INLINE void overRows(const PadCells& cells, const Each& each) {
  const std::size_t across = cells.across, last = cells.last;
  for (std::size_t row = cells.first; row < last; ++row) {
    overColumns(cells,
                [&](std::size_t column, std::size_t lane) HWY_ATTR { each(row * across + column, column, lane, row); });
  }
}

/// The fourth root to 7e-6, as rootInverse finds its own; 0 for 0.
HWY_INLINE V fourthRoot(V v) {
  const hn::RebindToUnsigned<D> bits;
  const auto guess = hn::Sub(hn::Set(bits, std::uint64_t{0x4feb100000000000}), hn::ShiftRight<2>(hn::BitCast(bits, v)));
  const V quarter = hn::Mul(all(0.25), v);
  const auto round = [quarter](V r, double from) HWY_ATTR {
    const V square = hn::Mul(r, r);
    return hn::Mul(r, hn::Sub(all(from), hn::Mul(hn::Mul(quarter, square), square)));
  };
  const V inverse = round(round(hn::BitCast(D(), guess), 1.251296385), 1.2500021027);
  return hn::Mul(hn::Mul(v, inverse), hn::Mul(inverse, inverse));
}

/// t^q: half powers of t, and the rest by the binomial series of the fourth root, to a third of a percent above 0.05.
struct Power {
  std::size_t roots;
  double first, second, third;
  explicit Power(double exponent)
      : roots(exponent < 0.5 ? 0 : static_cast<std::size_t>(2.0 * exponent)),
        first(4.0 * exponent - 2.0 * static_cast<double>(roots)),
        second(0.5 * (first - 1.0)),
        third((1.0 / 3.0) * (first - 2.0)) {}
  HWY_INLINE V of(V t) const {
    const V one = all(1.0);
    const V fourth = fourthRoot(t);
    const V s = hn::Sub(fourth, one);
    const V inner = hn::Add(one, hn::Mul(all(third), s));
    V power = hn::Add(one, hn::Mul(hn::Mul(all(first), s), hn::Add(one, hn::Mul(hn::Mul(all(second), s), inner))));
    for (std::size_t i = 0; i < roots; ++i) power = hn::Mul(power, hn::Mul(fourth, fourth));
    return power;
  }
};

PadCover cover(const PadGrid& grid, const PadContact& contact, PadCells& cells) {
  Sums normal, slope;
  const double lever_most = 0.97 * contact.finger;  // a lever ends before the equator of the tip
  const V radius = all(contact.radius), one = all(1.0), half = all(0.5), outer = all(contact.radius + 0.5);
  const V per_radius = all(1.0 / contact.radius), finger2 = all(contact.finger * contact.finger);
  const Power power(contact.exponent);
  for (std::size_t row = cells.first; 2 * row < cells.side; ++row) {
    const std::size_t mirrored = cells.side - 1 - row;
    overColumns(cells, [&](std::size_t column, std::size_t lane) HWY_ATTR {
      const std::size_t cell = row * cells.across + column;
      const V r = load(grid.r.data() + cell);
      const V covered = hn::Max(all(0.0), hn::Min(one, hn::Sub(outer, r)));
      const V middle = hn::Min(r, hn::Sub(radius, hn::Mul(half, covered)));
      const V share = hn::Mul(middle, per_radius);
      const V plain = hn::Mul(covered, power.of(hn::Max(all(0.0), hn::Sub(one, hn::Mul(share, share)))));
      const V aside = hn::Min(middle, all(lever_most));
      const V height = rootInverse<3>(hn::Sub(finger2, hn::Mul(aside, aside)));
      const V lever = hn::Mul(hn::Mul(aside, load(grid.inverse_r.data() + cell)), height);
      const V x = load(grid.x.data() + column);
      const V steep = hn::Mul(hn::Mul(plain, lever), hn::Mul(x, x));
      for (const std::size_t at : {row, mirrored}) {
        hn::Store(plain, D(), cells.plain.data() + at * cells.across + column);
        hn::Store(lever, D(), cells.lever.data() + at * cells.across + column);
        normal.add(lane, plain);
        slope.add(lane, steep);
        if (row == mirrored) break;
      }
    });
  }
  return {normal.sum(), slope.sum()};
}

/// (1 + s^2 / w^2)^(-5/2)
HWY_INLINE V kernelValue(V wide) {
  const V root = rootInverse<2>(wide);
  const V square = hn::Mul(root, root);
  return hn::Mul(hn::Mul(square, square), root);
}

PadKernel makeKernel(const KernelShape& shape, PadCells& cells) {
  Sums sums, circle;
  // 1 + s^2 / w^2 is a sum of what the column gives and what the row gives.
  alignas(64) std::array<double, PadCells::kMaxAcross> across, down;
  const V per_width2 = all(shape.per_width2);
  overColumns(cells, [&](std::size_t column, std::size_t) HWY_ATTR {
    const V x = load(cells.x + column);
    const V aside = hn::Sub(x, all(shape.foot_x)), along = hn::Add(x, all(shape.foot_y));
    hn::Store(hn::Add(all(1.0), hn::Mul(per_width2, hn::Mul(aside, aside))), D(), across.data() + column);
    hn::Store(hn::Mul(per_width2, hn::Mul(along, along)), D(), down.data() + column);
  });
  double* const made = cells.kernels[cells.kernel_count].data();
  overRows(cells, [&](std::size_t cell, std::size_t column, std::size_t lane, std::size_t row) HWY_ATTR {
    const V kernel = kernelValue(hn::Add(load(across.data() + column), all(down[row])));
    hn::Store(kernel, D(), made + cell);
    sums.add(lane, hn::Mul(load(cells.plain.data() + cell), kernel));
  });
  for (std::size_t arc = 0; arc < shape.arcs; arc += hn::MaxLanes(D())) {
    const V wide = hn::Add(all(shape.circle), hn::Mul(all(shape.swing), load(shape.cosines + arc)));
    circle.add(arc % PadCells::kLanes, kernelValue(wide));
  }
  return {sums.sum(), circle.sum() * shape.per_arc};
}

/// The factor on a plain force: `level`, all kernels and the earlier bumps.
HWY_INLINE V bumpsAt(const PadCells& cells, std::size_t cell, V level) {
  V sum = cells.has_bumps ? hn::Add(level, load(cells.bumps.data() + cell)) : level;
  for (std::size_t i = 0; i < cells.kernel_count; ++i) {
    sum = hn::Add(sum, hn::Mul(all(cells.strengths[i]), load(cells.kernels[i].data() + cell)));
  }
  return sum;
}

void gatherBumps(PadCells& cells) {
  overRows(cells, [&](std::size_t cell, std::size_t, std::size_t, std::size_t)
                      HWY_ATTR { hn::Store(bumpsAt(cells, cell, all(0.0)), D(), cells.bumps.data() + cell); });
}

struct MomentSums {
  Sums normal, u, v;
  HWY_INLINE void add(std::size_t lane, V force, V lever, V x, V y) {
    const V turned = hn::Mul(force, lever);
    normal.add(lane, force);
    u.add(lane, hn::Mul(turned, x));
    v.add(lane, hn::Mul(turned, y));
  }
  PadMoments moments() const { return {normal.sum(), u.sum(), v.sum()}; }
};

PadMoments moments(const PadCells& cells) {
  MomentSums sums;
  overRows(cells, [&](std::size_t cell, std::size_t column, std::size_t lane, std::size_t row) HWY_ATTR {
    sums.add(lane, load(cells.force.data() + cell), load(cells.lever.data() + cell), load(cells.x + column),
             all(-cells.x[row]));
  });
  return sums.moments();
}

PadMoments raiseForces(double level, PadCells& cells) {
  MomentSums sums;
  overRows(cells, [&](std::size_t cell, std::size_t column, std::size_t lane, std::size_t row) HWY_ATTR {
    const V share = hn::Max(all(0.0), bumpsAt(cells, cell, all(level)));
    const V force = hn::Mul(load(cells.plain.data() + cell), share);
    hn::Store(force, D(), cells.raised.data() + cell);
    sums.add(lane, force, load(cells.lever.data() + cell), load(cells.x + column), all(-cells.x[row]));
  });
  return sums.moments();
}

/// Whether all are 0 or more.
bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) {
  V least = all(0.0);
  MomentSums sums;
  overRows(cells, [&](std::size_t cell, std::size_t column, std::size_t lane, std::size_t row) HWY_ATTR {
    const V x = load(cells.x + column), y = all(-cells.x[row]);
    const V along = hn::Add(hn::Mul(all(gain_u), x), hn::Mul(all(gain_v), y));
    const V force = hn::Add(hn::Mul(all(factor), load(cells.raised.data() + cell)),
                            hn::Mul(load(cells.plain.data() + cell), along));
    hn::Store(force, D(), cells.force.data() + cell);
    least = hn::Min(least, force);
    sums.add(lane, force, load(cells.lever.data() + cell), x, y);
  });
  moments = sums.moments();
  return hn::GetLane(hn::MinOfLanes(D(), least)) >= 0.0;
}

void scaleTo(double factor, const double* values, PadCells& cells) {
  overRows(cells, [&](std::size_t cell, std::size_t, std::size_t, std::size_t) HWY_ATTR {
    hn::Store(hn::Mul(all(factor), load(values + cell)), D(), cells.force.data() + cell);
  });
}

void sumRows(const double* values, std::size_t split, const PadCells& cells, double* sums) {
  const std::size_t across = cells.across;
  for (std::size_t row = 0; row * split < cells.side; ++row) {
    overColumns(cells, [&](std::size_t column, std::size_t) HWY_ATTR {
      V sum = all(0.0);
      for (std::size_t part = row * split; part < (row + 1) * split; ++part) {
        if (part >= cells.first && part < cells.last) sum = hn::Add(sum, load(values + part * across + column));
      }
      hn::Store(sum, D(), sums + row * across + column);
    });
  }
}

}  // namespace palpate::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::contact {

HWY_EXPORT(cover);
HWY_EXPORT(makeKernel);
HWY_EXPORT(gatherBumps);
HWY_EXPORT(raiseForces);
HWY_EXPORT(moments);
HWY_EXPORT(lean);
HWY_EXPORT(scaleTo);
HWY_EXPORT(sumRows);

namespace {

std::size_t paddedWidth(std::size_t side) noexcept {
  return side <= PadCells::kLanes ? PadCells::kLanes : PadCells::kMaxAcross;
}

PadGrid makeGrid(std::size_t side) {
  constexpr double kFar = 1e6;  // columns beyond the pad: no contact covers them
  PadGrid grid{};
  const std::size_t across = paddedWidth(side);
  for (std::size_t i = 0; i < across; ++i) {
    grid.x[i] = i < side ? static_cast<double>(i) + 0.5 - 0.5 * static_cast<double>(side) : kFar;
  }
  for (std::size_t i = 0; i < (side + 1) / 2 * across; ++i) {
    const double x = grid.x[i % across], y = grid.x[i / across];
    grid.r[i] = std::sqrt(x * x + y * y);
    grid.inverse_r[i] = grid.r[i] > 0.0 ? 1.0 / grid.r[i] : 0.0;
  }
  return grid;
}

struct PadGrids {
  std::array<PadGrid, PadCells::kMaxAcross - kMinSide + 1> of;
  PadGrids() {
    for (std::size_t i = 0; i < of.size(); ++i) of[i] = makeGrid(kMinSide + i);
  }
};

const PadGrids kGrids;

template <std::size_t kArcs>
struct ArcCosines {
  alignas(64) std::array<double, kArcs> at;
  ArcCosines() {
    for (std::size_t i = 0; i < kArcs; ++i)
      at[i] = elementary::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(kArcs));
  }
};

const ArcCosines<8> kFewArcs;
const ArcCosines<16> kManyArcs;

}  // namespace

PadCover coverCells(std::size_t side, const PadContact& contact, PadCells& cells) noexcept {
  const PadGrid& grid = kGrids.of[side - kMinSide];
  cells.x = grid.x.data();
  cells.side = side;
  cells.across = paddedWidth(side);
  const double rim = contact.radius + 0.5;
  cells.first = 0;
  while (2 * (cells.first + 1) < side && -cells.x[cells.first] >= rim) ++cells.first;
  cells.last = side - cells.first;
  return HWY_DYNAMIC_DISPATCH(cover)(grid, contact, cells);
}

PadKernel makeKernel(double foot_x, double foot_y, double width, double circle, PadCells& cells) noexcept {
  if (cells.kernel_count == PadCells::kKernels) {
    HWY_DYNAMIC_DISPATCH(gatherBumps)(cells);
    cells.kernel_count = 0;
    cells.has_bumps = true;
  }
  const double per_width2 = 1.0 / (width * width);
  const double offset2 = foot_x * foot_x + foot_y * foot_y;
  const bool wide = width > 1.5 * circle;  // eight arcs have such a bump to 1e-5
  const KernelShape shape{foot_x,
                          foot_y,
                          per_width2,
                          1.0 + (circle * circle + offset2) * per_width2,
                          2.0 * circle * std::sqrt(offset2) * per_width2,
                          wide ? kFewArcs.at.size() : kManyArcs.at.size(),
                          wide ? 1.0 / 8.0 : 1.0 / 16.0,
                          wide ? kFewArcs.at.data() : kManyArcs.at.data()};
  return HWY_DYNAMIC_DISPATCH(makeKernel)(shape, cells);
}

void commitKernel(double strength, PadCells& cells) noexcept { cells.strengths[cells.kernel_count++] = strength; }

PadMoments momentsOf(const PadCells& cells) noexcept { return HWY_DYNAMIC_DISPATCH(moments)(cells); }

PadMoments raiseForces(double level, PadCells& cells) noexcept {
  return HWY_DYNAMIC_DISPATCH(raiseForces)(level, cells);
}

bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) noexcept {
  return HWY_DYNAMIC_DISPATCH(lean)(factor, gain_u, gain_v, cells, moments);
}

void scaleTo(double factor, const PadCells::Values& values, PadCells& cells) noexcept {
  HWY_DYNAMIC_DISPATCH(scaleTo)(factor, values.data(), cells);
}

void sumRows(const PadCells::Values& values, std::size_t split, const PadCells& cells,
             PadCells::Values& sums) noexcept {
  HWY_DYNAMIC_DISPATCH(sumRows)(values.data(), split, cells, sums.data());
}

}  // namespace palpate::contact
#endif  // HWY_ONCE
