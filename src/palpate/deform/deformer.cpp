#include "palpate/deform/deformer.h"

#include <algorithm>

#include "palpate/deform/normals.h"
#include "palpate/deform/strain.h"
#include "palpate/deform/together.h"
#include "palpate/tissue/profile.h"

namespace palpate::deform {

namespace {

/// Share of contact j's displacement that reaches the anchor of contact i.
double weightAt(const PartFrame& part, const ContactFrame& i, const ContactFrame& j) noexcept {
  return part.acts ? tissue::profile(part.ratioAt(i.anchor - j.anchor)) : 0.0;
}

bool wantsToMove(const ContactFrame& frame) noexcept { return frame.depth_mm > 0.0 || !frame.drag_mm.isZero(0.0); }

std::uint32_t degenerateParts(const ContactFrame& frame) noexcept {
  const bool lost_press = frame.depth_mm > 0.0 && !frame.normal_part.acts;
  const bool lost_drag = !frame.drag_mm.isZero(0.0) && !frame.tangential_part.acts;
  return lost_press || lost_drag ? std::uint32_t{kDegenerateRegion} : 0;
}

bool movesAnything(const ContactLanes& lanes) noexcept {
  const auto moves = [](const PartLanes& part) {
    return part.outside == 0.0f && (part.shift[0] != 0.0f || part.shift[1] != 0.0f || part.shift[2] != 0.0f);
  };
  return moves(lanes.normal) || moves(lanes.tangential);
}

}  // namespace

Deformer::Deformer(const Skin& skin, const Settings& settings)
    : skin_(skin),
      settings_(settings),
      search_(skin),
      first_entry_(skin.blocks, kNoIndex),
      moved_(skin.blocks),
      affected_(skin.blocks) {
  const std::size_t n = settings.max_contacts;
  frames_.reserve(n);
  lanes_.reserve(n);
  first_part_.reserve(n + 1);
  parts_.reserve(n * skin.blocks);
  entries_.reserve(n * skin.blocks);
  on_block_.reserve(n);
  normal_coupling_.resize(n * n);
  tangential_coupling_.resize(n * n);
  depths_.resize(n);
  amplitudes_.resize(n);
  drags_.resize(n, Vec3::Zero());
  shifts_.resize(n, Vec3::Zero());
}

Report Deformer::apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept {
  Report report;
  frameContacts(contacts, report);
  findRegions(report);
  solveAmplitudes();
  collectBlocks();
  displace(surface, report);
  finishNormalsAndStrain(surface);
  surface.written_ = affected_;
  return report;
}

void Deformer::frameContacts(std::span<const Contact> contacts, Report& report) noexcept {
  frames_.clear();
  for (const Contact& contact : contacts) {
    if (const std::uint32_t reason = whyIgnored(contact, skin_.triangles.size()); reason != 0) {
      report.status |= reason;
    } else if (frames_.size() == settings_.max_contacts) {
      report.status |= kIgnoredOverCapacity;
    } else if (const ContactFrame frame = frameOf(contact, settings_.tissue); wantsToMove(frame)) {
      report.status |= degenerateParts(frame);
      frames_.push_back(frame);
    }
  }
}

void Deformer::findRegions(Report& report) noexcept {
  parts_.clear();
  first_part_.assign(1, 0);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const ContactLanes lanes = lanesOf(frames_[i], 0.0, Vec3::Zero());
    const auto region = search_.find(skin_, lanes, skin_.triangles[frames_[i].anchor_triangle]);
    parts_.insert(parts_.end(), region.begin(), region.end());
    first_part_.push_back(static_cast<Index>(parts_.size()));
    report.visited_vertices += search_.visitedBlocks() * kBlockVertices;
    if (region.empty()) report.status |= kNoVertexInRegion;
    noteCoupling(i);
  }
}

/// Fills column `source` while its region is known: an anchor outside it feels nothing, however near it looks.
void Deformer::noteCoupling(std::size_t source) noexcept {
  const std::size_t n = frames_.size();
  const ContactFrame& from = frames_[source];
  for (std::size_t i = 0; i < n; ++i) {
    const ContactFrame& at = frames_[i];
    bool feels = false;
    for (const Index corner : skin_.triangles[at.anchor_triangle]) feels = feels || search_.reached(corner);
    const double alignment = std::max(0.0, at.normal.dot(from.normal));
    normal_coupling_[i * n + source] = feels ? alignment * weightAt(from.normal_part, at, from) : 0.0;
    tangential_coupling_[i * n + source] = feels ? weightAt(from.tangential_part, at, from) : 0.0;
  }
}

void Deformer::solveAmplitudes() noexcept {
  const std::size_t n = frames_.size();
  for (std::size_t i = 0; i < n; ++i) {
    depths_[i] = frames_[i].normal_part.acts ? frames_[i].depth_mm : 0.0;
    drags_[i] = frames_[i].tangential_part.acts ? frames_[i].drag_mm : Vec3::Zero();
  }
  solveDepths({normal_coupling_, n}, {depths_.data(), n}, {amplitudes_.data(), n});
  solveDrags({tangential_coupling_, n}, {drags_.data(), n}, settings_.tissue.tangential_cap_mm, {shifts_.data(), n});
  lanes_.clear();
  for (std::size_t i = 0; i < n; ++i) lanes_.push_back(lanesOf(frames_[i], amplitudes_[i], shifts_[i]));
}

/// Chains the regions of all contacts that still move something block by block.
void Deformer::collectBlocks() noexcept {
  moved_.clear();
  entries_.clear();
  for (Index contact = 0; contact < lanes_.size(); ++contact) {
    if (!movesAnything(lanes_[contact])) continue;
    for (Index p = first_part_[contact]; p < first_part_[contact + 1]; ++p) {
      const auto [block, region] = parts_[p];
      const Index next = moved_.contains(block) ? first_entry_[block] : kNoIndex;
      first_entry_[block] = static_cast<Index>(entries_.size());
      entries_.push_back({region, contact, next});
      moved_.insert(block);
    }
  }
  affected_ = moved_;
  if (!settings_.strain && settings_.normals == Normals::analytic) return;
  moved_.forEach([&](Index block) {
    for (const GroupLink& link : skin_.linksOf(block)) affected_.insert(link.group);
  });
}

void Deformer::displace(DeformedSurface& surface, Report& report) noexcept {
  surface.changed_.clear();
  Run run;
  BlockSet::forEachOfBoth(surface.written_, affected_, [&](Index block) {
    surface.listChange(block);
    if (moved_.contains(block)) {
      displaceBlock(block, run, surface, report);
    } else {
      surface.restore(skin_, block);
    }
  });
  displaceRun(run, surface, report);
}

void Deformer::displaceBlock(Index block, Run& run, DeformedSurface& surface, Report& report) noexcept {
  const Entry& entry = entries_[first_entry_[block]];
  if (entry.next != kNoIndex || entry.region != ~std::uint64_t{0}) {
    report.moved_vertices += displaceParts(block, surface);
    return;
  }
  if (block != run.end || entry.contact != run.contact) {
    displaceRun(run, surface, report);
    run = {block, block, entry.contact};
  }
  run.end = block + 1;
}

void Deformer::displaceRun(Run& run, DeformedSurface& surface, Report& report) noexcept {
  const Index blocks = run.end - run.first;
  if (blocks == 0) return;
  displaceWholeBlocks(lanes_[run.contact], blocks, skin_.restBlock(run.first), surface.block(run.first));
  report.moved_vertices += blocks * kBlockVertices;
}

/// A block that contacts share, or that lies in a region in part. Returns how many of its vertices moved.
Index Deformer::displaceParts(Index block, DeformedSurface& surface) noexcept {
  on_block_.clear();
  std::uint64_t moved = 0;
  for (Index e = first_entry_[block]; e != kNoIndex; e = entries_[e].next) {
    on_block_.push_back({&lanes_[entries_[e].contact], entries_[e].region});
    moved |= entries_[e].region;
  }
  deform::displaceBlock(on_block_, skin_.restBlock(block), surface.block(block));
  return static_cast<Index>(std::popcount(moved));
}

void Deformer::finishNormalsAndStrain(DeformedSurface& surface) noexcept {
  const bool recompute = settings_.normals != Normals::analytic;
  if (!recompute && !settings_.strain) return;
  const PositionStreams positions = surface.positions();
  const PositionStreams displacements = surface.displacements();
  affected_.forEach([&](Index block) {
    const Index end = std::min((block + 1) * kBlockVertices, skin_.vertices);
    for (Index v = block * kBlockVertices; v < end; ++v) {
      if (recompute) surface.setNormal(v, areaWeightedNormal(skin_, positions, v));
      if (settings_.strain) surface.setStrain(v, strainOfVertex(skin_, displacements, v));
    }
  });
}

DeformedSurface deformed(const mesh::TriangleMesh& mesh, std::span<const Contact> contacts, const Settings& settings) {
  const Skin skin = buildSkin(mesh);
  Settings enough = settings;
  enough.max_contacts = contacts.size();
  DeformedSurface surface(skin);
  Deformer(skin, enough).apply(contacts, surface);
  return surface;
}

}  // namespace palpate::deform
