// Each stroke has a finger and a list of its own, whose refreshes are put off by another number of ticks: a puncture
// depends on where in its delay the box is when the finger comes.
#include "dissertation/hdb/late_box.h"

#include "palpate/hdb/hdb_finger.h"

namespace palpate::study {

namespace {

// Above any skin of the benchmark's back, mm.
constexpr double kSkyMm = 1000.0;

// The skin is a height field: the tip is inside where a line from above meets skin before it.
bool isUnderSkin(const contact::Surface& surface, const Vec3& tip) {
  const Vec3 above(tip.x(), tip.y(), kSkyMm);
  return tree::firstFrontCrossing(surface.geometry->tree, above, tip).triangle != kNoIndex;
}

struct Listed {
  double sum = 0.0;
  double ticks = 0.0;
};

bool isPunctured(const contact::Surface& surface, const contact::FingerSettings& finger, hdb::HdbCandidates& candidates,
                 const std::vector<Vec3>& stroke, Listed& listed) {
  contact::FingerState state;
  for (const Vec3& tip : stroke) {
    const contact::FingerOutput output = hdb::stepHdb(surface, finger, candidates, state, tip);
    if (state.touching) {
      listed.sum += static_cast<double>(candidates.size());
      listed.ticks += 1.0;
    } else if (isUnderSkin(surface, output.tip)) {
      return true;
    }
  }
  return false;
}

}  // namespace

LateBoxResult strokeWithLateBox(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                                const std::vector<std::vector<Vec3>>& strokes, const contact::FingerSettings& finger) {
  LateBoxResult result;
  Listed listed;
  std::uint32_t phase = 0;
  for (const auto& stroke : strokes) {
    hdb::HdbCandidates candidates(box);
    if (stroke.empty()) continue;
    for (std::uint32_t i = 0; i < phase; ++i) candidates.refresh(stroke.front());
    phase = (phase + 3) % box->settings.ticks_per_refresh;  // 3: no divisor of the usual numbers of ticks
    ++result.strokes;
    if (isPunctured(surface, finger, candidates, stroke, listed)) ++result.punctured;
  }
  result.mean_listed = listed.ticks > 0.0 ? listed.sum / listed.ticks : 0.0;
  return result;
}

}  // namespace palpate::study
