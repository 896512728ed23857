#include "dissertation/credibility/checked_stack.h"

#include <cmath>

#include "palpate/tissue/layered_tissue.h"

namespace palpate::study {

namespace {

constexpr double kSheetHalfMm = 200.0;
constexpr double kPaceMmPerS = 50.0;
constexpr double kMillisecond = 0.001;
/// Off the sheet's diagonal, on which its two triangles meet.
constexpr double kBesideMm = 13.0;

}  // namespace

contact::Surface flatSheet(const FlatPlace& place) {
  mesh::TriangleMesh sheet;
  sheet.positions = {{-kSheetHalfMm, -kSheetHalfMm, 0},
                     {kSheetHalfMm, -kSheetHalfMm, 0},
                     {kSheetHalfMm, kSheetHalfMm, 0},
                     {-kSheetHalfMm, kSheetHalfMm, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const tissue::LayeredTissue layered(tissue::libraryNodes(place.fat_mm));
  contact::SurfaceOptions options;
  options.force_law.kind = tissue::ForceLaw::Kind::layered;
  options.force_law.layers = layered.forceRows();
  options.self_intersecting = false;
  options.tissue_mm.assign(sheet.positions.size(), place.thickness_mm);
  const double secant = layered.secantAt(place.thickness_mm, tissue::kReferenceDepthMm);
  return contact::buildSurface(sheet, std::vector<double>(sheet.positions.size(), place.stiffness_factor * secant),
                               options);
}

std::vector<Vec3> pressFlat(const contact::Surface& surface, const FlatPress& press) {
  contact::FingerSettings settings;
  settings.radius_mm = press.radius_mm;
  settings.tick_s = press.tick_s;
  contact::FingerState state;
  const int ticks = static_cast<int>(std::lround(kMillisecond / press.tick_s));
  const double lead_mm = 1.0;  // above the skin
  const auto down_ms = static_cast<int>(std::lround((lead_mm + press.depth_mm) / (kPaceMmPerS * kMillisecond)));
  const auto drag_ms = static_cast<int>(std::lround(press.drag_mm / (kPaceMmPerS * kMillisecond)));
  std::vector<Vec3> forces;
  for (int ms = 0; ms <= down_ms + drag_ms; ++ms) {
    contact::FingerOutput felt;
    for (int tick = ms == 0 ? ticks : 1; tick <= ticks; ++tick) {
      const double at_ms = ms - 1 + static_cast<double>(tick) / ticks;
      const double down = down_ms == 0 ? 1.0 : std::min(1.0, at_ms / down_ms);
      const double along = std::max(0.0, at_ms - down_ms) * kPaceMmPerS * kMillisecond;
      felt = contact::step(surface, settings, state,
                           Vec3(along, kBesideMm, press.radius_mm + lead_mm - down * (lead_mm + press.depth_mm)));
    }
    forces.push_back(felt.force);
  }
  return forces;
}

}  // namespace palpate::study
