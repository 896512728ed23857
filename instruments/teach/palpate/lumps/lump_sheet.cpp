#include "palpate/lumps/lump_sheet.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "palpate/tissue/layered_tissue.h"
#include "palpate/tissue/library_fields.h"
#include "palpate/tissue/pressure_form.h"

namespace palpate::lumps {

namespace {

contact::FingerSettings fingertip() { return {.radius_mm = tissue::kFingertipMm}; }

contact::Surface plainSheet(tissue::LayeredTable table) {
  constexpr double kHalfMm = 200.0;  // far beyond a finger's reach
  // A drag that was not solved has its usual form: it is of no use to a press.
  if (!table.drag) table.drag = tissue::DragShape{};
  const tissue::LayeredTissue layered({tissue::nodeOf(table)});
  const double thickness_mm = tissue::totalThickness(table.stack);
  mesh::TriangleMesh sheet;
  sheet.positions = {{-kHalfMm, -kHalfMm, 0}, {kHalfMm, -kHalfMm, 0}, {kHalfMm, kHalfMm, 0}, {-kHalfMm, kHalfMm, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  contact::SurfaceOptions options;
  options.force_law.kind = tissue::ForceLaw::Kind::layered;
  options.force_law.layers = layered.forceRows();
  options.self_intersecting = false;
  options.tissue_mm.assign(sheet.positions.size(), thickness_mm);
  const double secant = layered.secantAt(thickness_mm, tissue::kReferenceDepthMm);
  return contact::buildSurface(sheet, std::vector<double>(sheet.positions.size(), secant), options);
}

}  // namespace

LumpSheet::LumpSheet(tissue::LayeredTable table) : table_(std::move(table)), plain_(plainSheet(table_)) {
  const tissue::LumpPlace place = tissue::tablePlace(table_, "the sheet's table");
  ground_ = std::make_shared<const contact::PressureGround>(std::vector<contact::PressureGround::Place>{
      {tissue::totalThickness(table_.stack), tissue::PressureForm(place.fields)}});
}

ComparedSkin LumpSheet::with(const std::optional<tissue::LumpShape>& lump) const {
  contact::Surface surface = plain_;
  if (lump) {
    const tissue::LumpPlace place = tissue::tablePlace(table_, "the sheet's table");
    contact::Lump placed{.foot = foot(), .energy = place.energyOf(*lump), .shape = *lump};
    placed.skin_mm = table_.stack.layers.front().thickness_mm;
    contact::setPlane(placed);
    surface.lumps = std::make_shared<const contact::Lumps>(contact::Lumps{.all = {std::move(placed)}});
  }
  return {std::move(surface), ground_, fingertip()};
}

double LumpSheet::depthAt(double force_n) const {
  return with(std::nullopt).press(foot(), Vec3::UnitZ(), force_n).without.depth_mm;
}

std::vector<LumpCue> strokePast(const ComparedSkin& skin, double beside_mm, double depth_mm, std::size_t taxels) {
  constexpr double kTickMm = 0.5;  // a brisk stroke of 500 mm/s: nothing here depends on the pace
  constexpr int kTicksPerCue = 2;
  const double radius_mm = skin.finger().radius_mm;
  const double half_mm = 0.5 * kStrokesApartMm;
  const Vec3 start = LumpSheet::foot() + Vec3(beside_mm, -half_mm, radius_mm - depth_mm);
  contact::FingerState state;
  contact::FingerOutput felt;
  const auto to = [&](const Vec3& tip) { felt = contact::step(skin.surface(), skin.finger(), state, tip); };
  const int down = static_cast<int>(std::ceil(depth_mm / kTickMm)) + 2;
  for (int i = down; i >= 0; --i) to(start + Vec3(0.0, 0.0, i * kTickMm));
  std::vector<LumpCue> cues;
  const int along = static_cast<int>(std::lround(2.0 * half_mm / kTickMm));
  for (int i = 0; i <= along; ++i) {
    to(start + Vec3(0.0, i * kTickMm, 0.0));
    if (i % kTicksPerCue == 0) cues.push_back(computeCue(felt, skin.surface().lumps.get(), skin.ground(), taxels));
  }
  return cues;
}

double maxClarity(const std::vector<LumpCue>& cues, const LumpObserver& observer) noexcept {
  double clearest = 0.0;
  for (const LumpCue& cue : cues) clearest = std::max(clearest, computeClarity(cue, observer));
  return clearest;
}

}  // namespace palpate::lumps
