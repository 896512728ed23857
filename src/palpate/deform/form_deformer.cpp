#include "palpate/deform/form_deformer.h"

#include <algorithm>

#include "palpate/deform/frame.h"
#include "palpate/deform/normals.h"
#include "palpate/deform/strain.h"
#include "palpate/deform/together.h"

namespace palpate::deform {

namespace {

/// How far the caps let a vertex move when all contacts pull it the same way.
double mostMotion(const Settings& settings) {
  const double one = std::abs(settings.tissue.normal_cap_mm) + literalDragReach(settings.tissue.tangential_cap_mm);
  return one * static_cast<double>(settings.max_contacts);
}

bool wantsToMove(const FormFrame& frame) noexcept { return frame.depth_mm != 0.0 || !frame.drag_mm.isZero(0.0); }

std::uint32_t degenerateParts(const FormFrame& frame) noexcept {
  const bool lost_press = frame.depth_mm != 0.0 && !frame.press.acts();
  const bool lost_drag = !frame.drag_mm.isZero(0.0) && !frame.drag.acts();
  return lost_press || lost_drag ? std::uint32_t{kDegenerateRegion} : 0;
}

}  // namespace

FormDeformer::FormDeformer(const Skin& skin, const FormSettings& forms)
    : skin_(skin),
      forms_(forms),
      curves_(forms),
      search_(skin),
      moved_(skin.blocks),
      affected_(skin.blocks),
      tracked_(skin.blocks) {
  const std::size_t n = forms.common.max_contacts;
  if (forms.common.normals == Normals::incremental) incremental_.emplace(skin, mostMotion(forms.common));
  frames_.reserve(n);
  parts_.reserve(n * skin.blocks);
  press_coupling_.resize(n * n);
  drag_coupling_.resize(n * n);
  depths_.resize(n);
  amplitudes_.resize(n);
  drags_.resize(n, Vec3::Zero());
  shifts_.resize(n, Vec3::Zero());
}

Report FormDeformer::apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept {
  Report report;
  frameContacts(contacts, report);
  findRegions(report);
  combine();
  collectBlocks();
  displace(surface, report);
  trackChanges(surface);
  finishNormals(surface);
  finishStrain(surface);
  surface.written_ = affected_;
  return report;
}

void FormDeformer::frameContacts(std::span<const Contact> contacts, Report& report) noexcept {
  frames_.clear();
  for (const Contact& contact : contacts) {
    if (const std::uint32_t reason = whyIgnored(contact, skin_.triangles.size()); reason != 0) {
      report.status |= reason;
    } else if (frames_.size() == forms_.common.max_contacts) {
      report.status |= kIgnoredOverCapacity;
    } else if (const FormFrame frame = formFrameOf(contact, forms_); wantsToMove(frame)) {
      report.status |= degenerateParts(frame);
      frames_.push_back(frame);
    }
  }
}

void FormDeformer::findRegions(Report& report) noexcept {
  parts_.clear();
  const bool as_printed = forms_.fidelity.literal(Erratum::E23_region_search);
  for (Index i = 0; i < frames_.size(); ++i) {
    const FormFrame& frame = frames_[i];
    const auto is_inside = [&](Index v) {
      const bool faces = as_printed || skin_.restNormal(v).cast<double>().dot(frame.normal) > 0.0;
      return faces && holds(frame, skin_.restPosition(v).cast<double>());
    };
    const RingRule rule = as_printed ? RingRule::printed : RingRule::connected;
    const auto region = search_.find(skin_, skin_.triangles[frame.anchor_triangle], rule, is_inside);
    for (const BlockPart& part : region) parts_.push_back({part.block, i, part.vertices});
    report.visited_vertices += search_.visited();
    if (region.empty()) report.status |= kNoVertexInRegion;
    noteCoupling(i);
  }
}

/// Fills column `source` while its region is known: an anchor outside it feels nothing, however near it looks.
void FormDeformer::noteCoupling(std::size_t source) noexcept {
  const std::size_t n = frames_.size();
  for (std::size_t i = 0; i < n; ++i) {
    bool feels = false;
    for (const Index corner : skin_.triangles[frames_[i].anchor_triangle]) feels = feels || search_.reached(corner);
    press_coupling_[i * n + source] = feels ? pressShare(frames_[i], frames_[source]) : 0.0;
    drag_coupling_[i * n + source] = feels ? dragShare(frames_[i], frames_[source]) : 0.0;
  }
}

/// Share of the press of `from` that reaches the anchor of `at`.
double FormDeformer::pressShare(const FormFrame& at, const FormFrame& from) const noexcept {
  const double alignment = std::max(0.0, at.normal.dot(from.normal));
  return alignment * curves_.press.at(locate(from.press, inPlane(from.press, at.anchor - from.anchor)).q).value;
}

double FormDeformer::dragShare(const FormFrame& at, const FormFrame& from) const noexcept {
  return curves_.drag.at(locate(from.drag, inPlane(from.drag, at.anchor - from.anchor)).q).value;
}

void FormDeformer::combine() noexcept {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    amplitudes_[i] = frames_[i].press.acts() ? frames_[i].depth_mm : 0.0;
    shifts_[i] = frames_[i].drag.acts() ? frames_[i].drag_mm : Vec3::Zero();
  }
  if (forms_.together == Together::solved && frames_.size() > 1) solveTogether();  // E25
}

void FormDeformer::solveTogether() noexcept {
  const std::size_t n = frames_.size();
  std::copy_n(shifts_.begin(), n, drags_.begin());
  for (std::size_t i = 0; i < n; ++i) depths_[i] = std::max(0.0, amplitudes_[i]);
  const double cap = forms_.common.tissue.tangential_cap_mm;
  const double reach = forms_.fidelity.literal(Erratum::E19_drag_cap) ? literalDragReach(cap) : cap;
  solveDepths({press_coupling_, n}, {depths_.data(), n}, {amplitudes_.data(), n});
  solveDrags({drag_coupling_, n}, {drags_.data(), n}, reach, {shifts_.data(), n});
  for (std::size_t i = 0; i < n; ++i) {
    if (frames_[i].depth_mm < 0.0 && frames_[i].press.acts()) amplitudes_[i] = frames_[i].depth_mm;  // E19
  }
}

void FormDeformer::collectBlocks() noexcept {
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return a.block != b.block ? a.block < b.block : a.contact < b.contact;
  });
  moved_.clear();
  for (const Part& part : parts_) moved_.insert(part.block);
  affected_ = moved_;
  if (!forms_.common.strain && forms_.common.normals == Normals::analytic) return;
  moved_.forEach([&](Index block) {
    for (const GroupLink& link : skin_.linksOf(block)) affected_.insert(link.group);
  });
}

void FormDeformer::displace(DeformedSurface& surface, Report& report) noexcept {
  surface.changed_.clear();
  auto part = parts_.begin();
  BlockSet::forEachOfBoth(surface.written_, affected_, [&](Index block) {
    surface.listChange(block);
    surface.restore(skin_, block);
    const auto end = std::find_if(part, parts_.end(), [&](const Part& p) { return p.block != block; });
    report.moved_vertices += displaceBlock({part, end}, surface);
    part = end;
  });
}

/// Returns how many of its vertices moved.
Index FormDeformer::displaceBlock(std::span<const Part> parts, DeformedSurface& surface) noexcept {
  std::uint64_t moved = 0;
  for (const Part& part : parts) moved |= part.vertices;
  forEachBit(moved, [&](Index bit) { displaceVertex(parts.front().block * kBlockVertices + bit, parts, surface); });
  return static_cast<Index>(std::popcount(moved));
}

void FormDeformer::displaceVertex(Index vertex, std::span<const Part> parts, DeformedSurface& surface) noexcept {
  const Vec3 place = skin_.restPosition(vertex).cast<double>();
  Motion motion;
  for (const Part& part : parts) {
    if ((part.vertices & bitOf(vertex)) == 0) continue;
    addMotion(frames_[part.contact], curves_, amplitudes_[part.contact], shifts_[part.contact], place, motion);
  }
  surface.setDisplacement(vertex, skin_, motion.displacement.cast<float>());
  if (forms_.common.normals != Normals::analytic) return;
  const Vec3 rest_normal = skin_.restNormal(vertex).cast<double>();
  surface.setNormal(vertex, turnedNormal(motion.gradient, rest_normal).cast<float>());
}

/// Tells the incremental normals where every vertex is that moves now or moved in the last apply.
void FormDeformer::trackChanges(const DeformedSurface& surface) noexcept {
  if (!incremental_) return;
  BlockSet::forEachOfBoth(tracked_, moved_, [&](Index block) {
    const Index end = std::min((block + 1) * kBlockVertices, skin_.vertices);
    for (Index v = block * kBlockVertices; v < end; ++v) {
      incremental_->place(skin_, v, moved_.contains(block) ? surface.positionAt(v) : skin_.restPosition(v));
    }
  });
  tracked_ = moved_;
  changed_triangles_ = incremental_->update(skin_);
}

template <class Visit>
void FormDeformer::forEachAffectedVertex(const Visit& visit) const {
  affected_.forEach([&](Index block) {
    const Index end = std::min((block + 1) * kBlockVertices, skin_.vertices);
    for (Index v = block * kBlockVertices; v < end; ++v) visit(v);
  });
}

void FormDeformer::finishNormals(DeformedSurface& surface) noexcept {
  if (forms_.common.normals == Normals::analytic) return;
  const PositionStreams positions = surface.positions();
  forEachAffectedVertex([&](Index v) {
    surface.setNormal(v, incremental_ ? incremental_->normal(skin_, v) : areaWeightedNormal(skin_, positions, v));
  });
}

void FormDeformer::finishStrain(DeformedSurface& surface) noexcept {
  if (!forms_.common.strain) return;
  const PositionStreams displacements = surface.displacements();
  const bool principal = forms_.strain_kind == StrainKind::principal;
  forEachAffectedVertex([&](Index v) {
    const float strain = principal ? static_cast<float>(principalStrains(skin_, displacements, v).dominant())
                                   : strainOfVertex(skin_, displacements, v);
    surface.setStrain(v, strain);
  });
}

}  // namespace palpate::deform
