// Roots are found by Newton's method from the exponent: products and sums alone. The processor's one divider would
// otherwise be what all lanes wait for.
#ifdef __wasm__
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

/// Of a bump; 1 + s^2 / w^2 on the circle is circle + swing x cosine.
struct KernelShape {
  double foot_x, foot_y, per_width2, circle, swing;
  std::size_t arcs;       ///< of half the circle: a multiple of PadCells::kLanes
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

/// 1 / sqrt(v), within some roundings; for 0 a number so large that its product with 0 is 0.
HWY_INLINE V rootInverse(V v) {
  const hn::RebindToUnsigned<D> bits;
  // 1 / sqrt to 3.5 % (Lomont 2003, for doubles).
  const auto guess = hn::Sub(hn::Set(bits, std::uint64_t{0x5fe6eb50c7b537a9}), hn::ShiftRight<1>(hn::BitCast(bits, v)));
  V root = hn::BitCast(D(), guess);
  const V half = hn::Mul(all(0.5), v);
  for (int round = 0; round < 4; ++round) {
    root = hn::Mul(root, hn::Sub(all(1.5), hn::Mul(hn::Mul(half, root), root)));
  }
  return root;
}

/// Eight sums side by side.
struct Lanes {
  alignas(64) double at[PadCells::kLanes] = {};
  HWY_INLINE void add(std::size_t lane, V v) { hn::Store(hn::Add(hn::Load(D(), at + lane), v), D(), at + lane); }
  double sum() const { return ((at[0] + at[1]) + (at[2] + at[3])) + ((at[4] + at[5]) + (at[6] + at[7])); }
};

/// `each(cell, column, lane, y)` for every vector of cells.
template <class Each>
HWY_INLINE void overRows(const PadCells& cells, std::size_t last, const Each& each) {
  const std::size_t step = hn::Lanes(D());
  for (std::size_t row = cells.first; row < last; ++row) {
    const V y = all(-cells.x[row]);
    for (std::size_t column = 0; column < cells.across; column += PadCells::kLanes) {
      for (std::size_t lane = 0; lane < PadCells::kLanes; lane += step) {
        each(row * cells.across + column + lane, column + lane, lane, y);
      }
    }
  }
}

HWY_INLINE V load(const double* values) { return hn::Load(D(), values); }

/// t^q by the binomial series of the fourth root: to a third of a percent above 0.05, for q to 0.5.
struct PowerSeries {
  double first, second, third;
  explicit PowerSeries(double exponent)
      : first(4.0 * exponent), second(0.5 * (first - 1.0)), third((first - 2.0) / 3.0) {}
  HWY_INLINE V of(V t) const {
    const V one = all(1.0);
    const V root = hn::Mul(t, rootInverse(t));
    const V s = hn::Sub(hn::Mul(root, rootInverse(root)), one);
    const V inner = hn::Add(one, hn::Mul(all(third), s));
    return hn::Add(one, hn::Mul(hn::Mul(all(first), s), hn::Add(one, hn::Mul(hn::Mul(all(second), s), inner))));
  }
};

/// Rows above the middle: `lever`; into `plain` the covered share, into `force` (1 - r^2 / c^2), or where `whole` the
/// product of the one and a power of the other into `plain`.
void coverUpper(const PadContact& contact, bool whole, PadCells& cells) {
  const double lever_most = 0.97 * contact.finger_mm;  // a lever ends before the equator of the tip
  const V radius = all(contact.radius_mm), half_cell = all(0.5 * contact.cell_mm), one = all(1.0), zero = all(0.0);
  const V per_cell = all(1.0 / contact.cell_mm), per_radius = all(1.0 / contact.radius_mm);
  const V finger2 = all(contact.finger_mm * contact.finger_mm);
  const PowerSeries series(contact.exponent);
  overRows(cells, (cells.side + 1) / 2, [&](std::size_t cell, std::size_t column, std::size_t, V y) {
    const V x = load(cells.x.data() + column);
    const V r2 = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    const V inverse = rootInverse(r2);
    const V r = hn::Mul(r2, inverse);
    const V covered = hn::Max(zero, hn::Min(one, hn::Add(hn::Mul(hn::Sub(radius, r), per_cell), all(0.5))));
    const V rim = hn::Sub(radius, hn::Mul(half_cell, covered));
    const V middle = hn::IfThenElse(hn::Lt(covered, one), rim, r);
    const V lever = hn::Min(middle, all(lever_most));
    const V height = rootInverse(hn::Sub(finger2, hn::Mul(lever, lever)));
    const V share = hn::Mul(middle, per_radius);
    const V inside = hn::Max(zero, hn::Sub(one, hn::Mul(share, share)));
    hn::Store(whole ? hn::Mul(covered, series.of(inside)) : covered, D(), cells.plain.data() + cell);
    hn::Store(hn::IfThenElseZero(hn::Gt(covered, zero), hn::Mul(hn::Mul(lever, inverse), height)), D(),
              cells.lever.data() + cell);
    hn::Store(inside, D(), cells.force.data() + cell);
  });
}

void scaleTo(double sum, const PadCells& cells, double* values) {
  Lanes sums;
  overRows(cells, cells.last,
           [&](std::size_t cell, std::size_t, std::size_t lane, V) { sums.add(lane, load(values + cell)); });
  const double before = sums.sum();
  const V factor = all(before > 0.0 ? sum / before : 0.0);
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t, std::size_t, V) {
    hn::Store(hn::Mul(factor, load(values + cell)), D(), values + cell);
  });
}

/// (1 + s^2 / w^2)^(-5/2)
HWY_INLINE V kernelOf(V wide) {
  const V root = rootInverse(wide);
  const V square = hn::Mul(root, root);
  return hn::Mul(hn::Mul(square, square), root);
}

PadKernel makeKernel(const KernelShape& shape, PadCells& cells) {
  Lanes sums, circle;
  const V foot_x = all(shape.foot_x), foot_y = all(shape.foot_y), per_width2 = all(shape.per_width2);
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t column, std::size_t lane, V y) {
    const V aside = hn::Sub(load(cells.x.data() + column), foot_x);
    const V along = hn::Sub(y, foot_y);
    const V away = hn::Add(hn::Mul(aside, aside), hn::Mul(along, along));
    const V kernel = kernelOf(hn::Add(all(1.0), hn::Mul(away, per_width2)));
    hn::Store(kernel, D(), cells.kernel.data() + cell);
    sums.add(lane, hn::Mul(load(cells.plain.data() + cell), kernel));
  });
  const std::size_t step = hn::Lanes(D());
  for (std::size_t arc = 0; arc < shape.arcs; arc += step) {
    const V wide = hn::Add(all(shape.circle), hn::Mul(all(shape.swing), hn::Load(D(), shape.cosines + arc)));
    circle.add(arc % PadCells::kLanes, kernelOf(wide));
  }
  return {sums.sum(), circle.sum() / static_cast<double>(shape.arcs)};
}

void addKernel(double strength, PadCells& cells) {
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t, std::size_t, V) {
    double* const bumps = cells.bumps.data() + cell;
    hn::Store(hn::Add(load(bumps), hn::Mul(all(strength), load(cells.kernel.data() + cell))), D(), bumps);
  });
}

struct MomentLanes {
  Lanes normal, u, v;
  HWY_INLINE void add(std::size_t lane, V force, V lever, V x, V y) {
    const V turned = hn::Mul(force, lever);
    normal.add(lane, force);
    u.add(lane, hn::Mul(turned, x));
    v.add(lane, hn::Mul(turned, y));
  }
  PadMoments moments() const { return {normal.sum(), u.sum(), v.sum()}; }
};

PadMoments moments(const PadCells& cells) {
  MomentLanes sums;
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t column, std::size_t lane, V y) {
    sums.add(lane, load(cells.force.data() + cell), load(cells.lever.data() + cell), load(cells.x.data() + column), y);
  });
  return sums.moments();
}

PadSlopes raiseForces(double level, PadCells& cells) {
  MomentLanes sums;
  Lanes u, v;
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t column, std::size_t lane, V y) {
    const V x = load(cells.x.data() + column);
    const V plain = load(cells.plain.data() + cell), lever = load(cells.lever.data() + cell);
    const V share = hn::Max(all(0.0), hn::Add(all(level), load(cells.bumps.data() + cell)));
    const V force = hn::Mul(plain, share);
    hn::Store(force, D(), cells.force.data() + cell);
    sums.add(lane, force, lever, x, y);
    const V turned = hn::Mul(plain, lever);
    u.add(lane, hn::Mul(turned, hn::Mul(x, x)));
    v.add(lane, hn::Mul(turned, hn::Mul(y, y)));
  });
  return {sums.moments(), u.sum(), v.sum()};
}

/// Into `kernel`; whether all are 0 or more.
bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) {
  V least = all(0.0);
  MomentLanes sums;
  overRows(cells, cells.last, [&](std::size_t cell, std::size_t column, std::size_t lane, V y) {
    const V x = load(cells.x.data() + column);
    const V along = hn::Add(hn::Mul(all(gain_u), x), hn::Mul(all(gain_v), y));
    const V force =
        hn::Add(hn::Mul(all(factor), load(cells.force.data() + cell)), hn::Mul(load(cells.plain.data() + cell), along));
    hn::Store(force, D(), cells.kernel.data() + cell);
    least = hn::Min(least, force);
    sums.add(lane, force, load(cells.lever.data() + cell), x, y);
  });
  moments = sums.moments();
  return hn::GetLane(hn::MinOfLanes(D(), least)) >= 0.0;
}

}  // namespace palpate::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace palpate::contact {

HWY_EXPORT(coverUpper);
HWY_EXPORT(scaleTo);
HWY_EXPORT(makeKernel);
HWY_EXPORT(addKernel);
HWY_EXPORT(raiseForces);
HWY_EXPORT(moments);
HWY_EXPORT(lean);

void layOut(std::size_t side, const PadContact& contact, PadCells& cells) noexcept {
  cells.side = side;
  cells.across = side <= PadCells::kLanes ? PadCells::kLanes : PadCells::kMostAcross;
  const double from = 0.5 * contact.cell_mm * (1.0 - static_cast<double>(side));
  for (std::size_t i = 0; i < cells.across; ++i) {
    // Columns beyond the pad are far off: no contact covers them.
    constexpr double kFarMm = 1e6;
    cells.x[i] = i < side ? from + static_cast<double>(i) * contact.cell_mm : kFarMm;
  }
  const double rim = contact.radius_mm + 0.5 * contact.cell_mm;
  cells.first = 0;
  while (2 * (cells.first + 1) < side && -cells.x[cells.first] >= rim) ++cells.first;
  cells.last = side - cells.first;
}

void coverCells(const PadContact& contact, PadCells& cells) noexcept {
  constexpr double kMaxSeries = 0.5;
  const bool whole = contact.exponent <= kMaxSeries;
  HWY_DYNAMIC_DISPATCH(coverUpper)(contact, whole, cells);
  const std::size_t middle = (cells.side + 1) / 2;
  for (std::size_t i = cells.begin(); !whole && i < middle * cells.across; ++i) {
    if (cells.plain[i] > 0.0) cells.plain[i] *= elementary::pow(cells.force[i], contact.exponent);
  }
  for (std::size_t row = middle; row < cells.last; ++row) {
    const std::size_t from = (cells.side - 1 - row) * cells.across;
    std::copy_n(&cells.plain[from], cells.across, &cells.plain[row * cells.across]);
    std::copy_n(&cells.lever[from], cells.across, &cells.lever[row * cells.across]);
  }
}

void scaleTo(double sum, const PadCells& cells, PadCells::Values& values) noexcept {
  HWY_DYNAMIC_DISPATCH(scaleTo)(sum, cells, values.data());
}

namespace {

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

PadKernel makeKernel(double foot_x, double foot_y, double width_mm, double circle_mm, PadCells& cells) noexcept {
  const double per_width2 = 1.0 / (width_mm * width_mm);
  const double offset2 = foot_x * foot_x + foot_y * foot_y;
  const bool wide = width_mm > 1.5 * circle_mm;  // eight arcs have such a bump to 1e-5
  const KernelShape shape{foot_x,
                          foot_y,
                          per_width2,
                          1.0 + (circle_mm * circle_mm + offset2) * per_width2,
                          2.0 * circle_mm * std::sqrt(offset2) * per_width2,
                          wide ? kFewArcs.at.size() : kManyArcs.at.size(),
                          wide ? kFewArcs.at.data() : kManyArcs.at.data()};
  return HWY_DYNAMIC_DISPATCH(makeKernel)(shape, cells);
}

void addKernel(double strength, PadCells& cells) noexcept { HWY_DYNAMIC_DISPATCH(addKernel)(strength, cells); }

PadMoments momentsOf(const PadCells& cells) noexcept { return HWY_DYNAMIC_DISPATCH(moments)(cells); }

PadSlopes raiseForces(double level, PadCells& cells) noexcept {
  return HWY_DYNAMIC_DISPATCH(raiseForces)(level, cells);
}

bool lean(double factor, double gain_u, double gain_v, PadCells& cells, PadMoments& moments) noexcept {
  if (!HWY_DYNAMIC_DISPATCH(lean)(factor, gain_u, gain_v, cells, moments)) return false;
  std::copy_n(&cells.kernel[cells.begin()], cells.end() - cells.begin(), &cells.force[cells.begin()]);
  return true;
}

}  // namespace palpate::contact
#endif  // HWY_ONCE
