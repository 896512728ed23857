// Blocks of the same ticks with and without lumps, one after the other, so that a busy machine slows both.
#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "lab/counters/thread_counts.h"
#include "lab/runs/lump_costs.h"
#include "lab/workloads/random_lumps.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/stopwatch.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/mesh/repair.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::bench {

namespace {

constexpr std::size_t kTriangles = 30000;
constexpr double kSkinNPerMm = 0.5;
constexpr std::size_t kWarmTicks = 20;
constexpr std::size_t kTimedTicks = 100;

/// Where the finger is in the block that is timed.
struct LumpSlide {
  contact::Surface bare;
  std::vector<Vec3> approach;  ///< to where the block begins
  std::vector<Vec3> block;
};

LumpSlide slideOverBack() {
  LumpSlide slide;
  const mesh::TriangleMesh mesh = mesh::repair(lab::backMesh(kTriangles)).mesh;
  slide.bare = contact::buildSurface(mesh, std::vector<double>(mesh.positions.size(), kSkinNPerMm),
                                     {.self_intersecting = false});
  const device::Trajectory path = device::resampled(lab::backSlide(), 1e-3);
  const auto first = static_cast<std::ptrdiff_t>(lab::kSlideFromSeconds * 1e3);
  slide.approach.assign(path.tip_mm.begin(), path.tip_mm.begin() + first);
  slide.block.assign(path.tip_mm.begin() + first,
                     path.tip_mm.begin() + first + static_cast<std::ptrdiff_t>(kTimedTicks));
  return slide;
}

/// Eight balls of 8 mm in two rows, all felt along the whole block; or the one nearest to its middle.
contact::Surface withLumps(const LumpSlide& slide, const tissue::LumpPlace& place, std::size_t count, bool mobile) {
  constexpr double kApartMm = 9.0;
  const tissue::LumpShape shape{.half_axes_mm = {4.0, 4.0, 4.0}, .depth_mm = 4.0, .stiffness_ratio = 10.0};
  const Vec3 middle = slide.block[slide.block.size() / 2];
  contact::Lumps lumps;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / 2;
    const Vec3 aside(kApartMm * (static_cast<double>(row) - 1.0), kApartMm * static_cast<double>(i % 2), 0.0);
    contact::Lump lump{
        .foot = count == 1 ? middle : Vec3(middle + aside), .energy = place.energyOf(shape), .shape = shape};
    contact::setPlane(lump);
    if (mobile) lump.mobility.spring_n_per_mm = 0.1;
    lumps.all.push_back(std::move(lump));
  }
  contact::Surface surface = slide.bare;
  surface.lumps = std::make_shared<const contact::Lumps>(std::move(lumps));
  return surface;
}

/// A finger that has come to the beginning of the block, again and again.
class TimedFinger {
 public:
  TimedFinger(const LumpSlide& slide, const contact::Surface& surface)
      : block_(slide.block), solver_(std::move(servo::makeSolvers(surface, nullptr, 1).front())) {
    settings_.radius_mm = tissue::kFingertipMm;
    for (const Vec3& tip : slide.approach) touch(tip);
    begun_ = state_;
    for (const Vec3& tip : block_) felt_.push_back(touch(tip));
  }
  const std::vector<contact::FingerOutput>& felt() const { return felt_; }

  /// us a tick; `each` gets the outputs.
  template <class Each>
  double block(const Each& each) {
    state_ = begun_;
    for (const Vec3& tip : block_.first(kWarmTicks)) (void)touch(tip);
    const Clock::time_point start = Clock::now();
    for (const Vec3& tip : block_.subspan(kWarmTicks)) each(touch(tip));
    return microsecondsSince(start) / static_cast<double>(block_.size() - kWarmTicks);
  }

 private:
  contact::FingerOutput touch(const Vec3& tip) { return servo::touch(solver_, settings_, state_, tip); }

  std::span<const Vec3> block_;
  servo::FingerSolver solver_;
  contact::FingerSettings settings_;
  contact::FingerState state_, begun_;
  std::vector<contact::FingerOutput> felt_;
};

void updateShortest(double& shortest, double now) { shortest = std::min(shortest, now); }

/// The pads of a block's ticks.
class TimedPad {
 public:
  TimedPad(const contact::PressureGround& ground, const contact::Surface& surface, std::size_t taxels)
      : ground_(ground), lumps_(*surface.lumps), pad_{.taxels = taxels}, kpa_(taxels * taxels) {}

  double of(const contact::FingerOutput& felt) {
    return contact::pressureField(ground_, &lumps_, felt, pad_, kpa_).normal_n + kpa_[kpa_.size() / 2];
  }
  /// us a pad.
  double block(const std::vector<contact::FingerOutput>& felt, double& sum) {
    const Clock::time_point start = Clock::now();
    for (const contact::FingerOutput& one : felt) sum += of(one);
    return microsecondsSince(start) / static_cast<double>(felt.size());
  }

 private:
  const contact::PressureGround& ground_;
  const contact::Lumps& lumps_;
  contact::PressurePad pad_;
  std::vector<double> kpa_;
};

}  // namespace

Json measureLumpCosts(double seconds, const Progress& progress) {
  const LumpSlide slide = slideOverBack();
  const tissue::LumpPlace place = tissue::libraryPlaceAt(40.0, 8.0);
  const contact::PressureGround ground({{40.0, tissue::PressureForm(place.fields)}});
  const contact::Surface one = withLumps(slide, place, 1, false), eight = withLumps(slide, place, 8, false);
  const contact::Surface mobile = withLumps(slide, place, 8, true);
  TimedFinger bare_finger(slide, slide.bare), one_finger(slide, one), eight_finger(slide, eight);
  TimedFinger mobile_finger(slide, mobile);
  TimedPad four(ground, one, 4), nine(ground, one, 8), sixteen(ground, one, 16), four_of_eight(ground, eight, 4);

  constexpr double kLong = std::numeric_limits<double>::max();
  double bare = kLong, with_one = kLong, with_eight = kLong, with_mobile = kLong, with_pad = kLong;
  double field_4 = kLong, field_8 = kLong, field_16 = kLong, field_4_of_eight = kLong;
  std::size_t rounds = 0;
  double sum = 0.0;
  const auto add = [&sum](const contact::FingerOutput& felt) { sum += felt.force.z(); };
  const auto add_pad = [&](const contact::FingerOutput& felt) { sum += felt.force.z() + four_of_eight.of(felt); };
  const Clock::time_point started = Clock::now();
  const lab::ThreadCounts before = lab::countsOfThisThread();
  do {
    updateShortest(bare, bare_finger.block(add));
    updateShortest(with_one, one_finger.block(add));
    updateShortest(with_eight, eight_finger.block(add));
    updateShortest(with_mobile, mobile_finger.block(add));
    updateShortest(with_pad, eight_finger.block(add_pad));
    updateShortest(field_4, four.block(one_finger.felt(), sum));
    updateShortest(field_8, nine.block(one_finger.felt(), sum));
    updateShortest(field_16, sixteen.block(one_finger.felt(), sum));
    updateShortest(field_4_of_eight, four_of_eight.block(eight_finger.felt(), sum));
    ++rounds;
  } while (secondsSince(started) < seconds && sum < kLong);
  const std::optional<std::uint64_t> allocations = lab::countsSince(before).allocations;
  report(progress, "timing lumps", 1.0);
  Json json;
  json["tick_us"] = bare;
  json["tick_extra_us"] = {{"1", with_one - bare},
                           {"8", with_eight - bare},
                           {"8_mobile", with_mobile - bare},
                           {"8_and_pad_4", with_pad - bare}};
  json["field_us"] = {{"4", field_4}, {"8", field_8}, {"16", field_16}, {"4_of_8_lumps", field_4_of_eight}};
  json["allocations"] = allocations ? Json(*allocations) : Json(nullptr);
  json["rounds"] = rounds;
  return json;
}

}  // namespace palpate::bench
