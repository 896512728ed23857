// The steps of an apply, written once for both ways to displace.
//
// Data flow: contacts -> frameContacts -> findRegions -> combine -> chainBlocks, all into the plan (plan.h); plan ->
// displace -> holdShear -> finishNormals, finishStrain -> surface. 60 times a second and more; allocates nothing.
// Based on: Ji, dissertation 2008, chapter 4, with E19 and E25.
#include "palpate/deform/deformer.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "palpate/deform/fast_displacement.h"
#include "palpate/deform/general_displacement.h"
#include "palpate/deform/hold.h"
#include "palpate/deform/normals.h"
#include "palpate/deform/plan.h"
#include "palpate/deform/strain.h"
#include "palpate/deform/together.h"

namespace palpate::deform {

namespace {

/// Status bits of a contact that cannot be framed on a skin of `triangles` triangles; 0 for one that can.
std::uint32_t ignoredStatus(const Contact& contact, std::size_t triangles) noexcept {
  if (!isUsable(contact)) return kIgnoredNotFinite;
  return contact.anchor_triangle < triangles ? 0u : std::uint32_t{kIgnoredNoTriangle};
}

template <class Region>
std::uint32_t degenerateParts(const FramedContact<Region>& frame) noexcept {
  const bool lost_press = frame.wantsPress() && !frame.press.acts();
  const bool lost_drag = frame.wantsDrag() && !frame.drag.acts();
  return lost_press || lost_drag ? std::uint32_t{kDegenerateRegion} : 0;
}

FormSettings withDefaultForms(const Settings& settings) {
  FormSettings forms;
  forms.common = settings;
  return forms;
}

/// A drag with this slope per mm along itself leaves a tenth of the length of what it pushes together; at 1 skin turns
/// over.
constexpr double kMaxDragSlope = 0.9;

/// Largest motion of a vertex that the caps allow when all contacts pull it the same way.
double mostMotion(const Settings& settings) {
  const double one = std::abs(settings.tissue.normal_cap_mm) + literalDragReach(settings.tissue.tangential_cap_mm);
  return one * static_cast<double>(settings.max_contacts);
}

/// The longest shift that a drag may ask for.
double dragReach(const FormSettings& forms) noexcept {
  const double cap = forms.common.tissue.tangential_cap_mm;
  return forms.fidelity.literal(Erratum::E19_drag_cap) ? literalDragReach(cap) : cap;
}

}  // namespace

/// The steps of an apply with one way to displace. Each is handed the plan and fills in its part of it; those that
/// write the surface only read it.
template <class Displacement>
class Deformer::Pipeline {
 public:
  using ThePlan = Plan<Displacement>;

  Pipeline(const Skin& skin, const FormSettings& forms)
      : skin_(skin), forms_(forms), displacement_(skin, forms), plan_(skin, forms.common.max_contacts) {
    if (limitsShear(forms)) hold_.emplace(skin, forms.common.max_contacts);
    if (forms.common.normals == Normals::incremental) incremental_.emplace(skin, mostMotion(forms.common));
  }

  Report apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept {
    Report report;
    frameContacts(contacts, plan_, report);
    findRegions(plan_, report);
    combine(plan_);
    chainBlocks(plan_);
    if (!forms_.common.strain) surface.forgetStrain();
    displace(plan_, surface, report);
    holdShear(plan_, surface, report);
    finishNormals(plan_, surface, report);
    finishStrain(plan_, surface);
    surface.written_ = plan_.affected;
    return report;
  }

 private:
  /// Consecutive blocks that lie in the region of one contact as a whole, about to be displaced in one go.
  struct Run {
    Index first = 0;
    Index end = 0;
    Index contact = 0;
  };

  void frameContacts(std::span<const Contact> contacts, ThePlan& plan, Report& report) const noexcept {
    plan.frames.clear();
    for (const Contact& contact : contacts) {
      if (const std::uint32_t reason = ignoredStatus(contact, skin_.triangles.size()); reason != 0) {
        report.status |= reason;
      } else if (plan.frames.size() == forms_.common.max_contacts) {
        report.status |= kIgnoredOverCapacity;
      } else if (auto frame = displacement_.frame(contact); frame.wantsPress() || frame.wantsDrag()) {
        report.status |= degenerateParts(frame);
        frame.anchor -= skin_.origin;
        plan.frames.push_back(std::move(frame));
      }
    }
  }

  void findRegions(ThePlan& plan, Report& report) noexcept {
    plan.parts.clear();
    plan.first_part.assign(1, 0);
    plan.edges.clear();
    plan.first_edge.assign(1, 0);
    for (std::size_t i = 0; i < plan.frames.size(); ++i) {
      const std::span<const BlockPart> region = displacement_.findRegion(plan.frames[i]);
      plan.parts.insert(plan.parts.end(), region.begin(), region.end());
      plan.first_part.push_back(static_cast<Index>(plan.parts.size()));
      const std::span<const BlockPart> edges = displacement_.edges();
      plan.edges.insert(plan.edges.end(), edges.begin(), edges.end());
      plan.first_edge.push_back(static_cast<Index>(plan.edges.size()));
      report.visited_vertices += displacement_.visitedVertices();
      if (region.empty()) report.status |= kNoVertexInRegion;
      noteCoupling(i, plan);
    }
  }

  /// Fills column `source`; uses the displacement's newest search, so it comes right after that search.
  /// An anchor outside the region feels nothing, however near it looks.
  void noteCoupling(std::size_t source, ThePlan& plan) const noexcept {
    const std::size_t n = plan.frames.size();
    const auto& from = plan.frames[source];
    for (std::size_t i = 0; i < n; ++i) {
      const auto& at = plan.frames[i];
      bool feels = false;
      for (const Index corner : skin_.triangles[at.anchor_triangle]) feels = feels || displacement_.reached(corner);
      const Vec3 offset = at.anchor - from.anchor;
      const double alignment = std::max(0.0, at.normal.dot(from.normal));
      plan.press_coupling[i * n + source] = feels ? alignment * displacement_.pressShare(from, offset) : 0.0;
      plan.drag_coupling[i * n + source] = feels ? displacement_.dragShare(from, offset) : 0.0;
    }
  }

  void combine(ThePlan& plan) const noexcept {
    const std::size_t n = plan.frames.size();
    for (std::size_t i = 0; i < n; ++i) {
      plan.depths_mm[i] = plan.frames[i].press.acts() ? plan.frames[i].depth_mm : 0.0;
      plan.drags_mm[i] = plan.frames[i].drag.acts() ? plan.frames[i].drag_mm : Vec3::Zero();
    }
    if (forms_.together == Together::solved) {  // E25
      solveTogether(plan);
    } else {
      std::copy_n(plan.depths_mm.begin(), n, plan.amplitudes_mm.begin());
      std::copy_n(plan.drags_mm.begin(), n, plan.shifts_mm.begin());
    }
    if (hold_) {
      for (std::size_t i = 0; i < n; ++i) plan.shifts_mm[i] = withoutFold(plan.frames[i], plan.shifts_mm[i]);
    }
    plan.movers.clear();
    for (std::size_t i = 0; i < n; ++i) {
      plan.movers.push_back(displacement_.mover(plan.frames[i], plan.amplitudes_mm[i], plan.shifts_mm[i]));
    }
  }

  /// The shift, shortened where a drag so long would turn flat skin over in a region so narrow.
  Vec3 withoutFold(const typename Displacement::Frame& frame, const Vec3& shift_mm) const noexcept {
    const double slope = displacement_.dragSlope(frame, shift_mm);
    return slope > kMaxDragSlope ? Vec3(shift_mm * (kMaxDragSlope / slope)) : shift_mm;
  }

  void solveTogether(ThePlan& plan) const noexcept {
    const std::size_t n = plan.frames.size();
    solveDepths({plan.press_coupling, n}, {plan.depths_mm.data(), n}, {plan.amplitudes_mm.data(), n});
    solveDrags({plan.drag_coupling, n}, {plan.drags_mm.data(), n}, dragReach(forms_), {plan.shifts_mm.data(), n});
  }

  /// Chains the regions of all contacts that still move something block by block.
  void chainBlocks(ThePlan& plan) const noexcept {
    plan.moved.clear();
    plan.entries.clear();
    for (Index contact = 0; contact < plan.movers.size(); ++contact) {
      if (!Displacement::moves(plan.movers[contact])) continue;
      for (Index p = plan.first_part[contact]; p < plan.first_part[contact + 1]; ++p) {
        const auto [block, is_level, region] = plan.parts[p];
        const Index next = plan.moved.contains(block) ? plan.first_entry[block] : kNoIndex;
        plan.first_entry[block] = static_cast<Index>(plan.entries.size());
        plan.entries.push_back({region, contact, next, is_level});
        plan.moved.insert(block);
      }
    }
    plan.affected = plan.moved;
    if (!needsNeighbours()) return;
    plan.moved.forEach([&](Index block) {
      for (const GroupLink& link : skin_.linksOf(block)) plan.affected.insert(link.group);
    });
  }

  void displace(ThePlan& plan, DeformedSurface& surface, Report& report) const noexcept {
    surface.changed_.clear();
    Run run;
    BlockSet::forEachOfBoth(surface.written_, plan.affected, [&](Index block) {
      surface.listChange(block);
      if (plan.moved.contains(block)) {
        displaceBlock(block, run, plan, surface, report);
      } else {
        surface.restore(skin_, block);
      }
    });
    displaceRun(run, plan, surface, report);
  }

  void displaceBlock(Index block, Run& run, ThePlan& plan, DeformedSurface& surface, Report& report) const noexcept {
    const BlockEntry& entry = plan.entries[plan.first_entry[block]];
    if (entry.next != kNoIndex || entry.region != ~std::uint64_t{0} || !entry.is_level) {
      report.moved_vertices += displaceShared(block, plan, surface);
      return;
    }
    if (block != run.end || entry.contact != run.contact) {
      displaceRun(run, plan, surface, report);
      run = {block, block, entry.contact};
    }
    run.end = block + 1;
  }

  void displaceRun(const Run& run, ThePlan& plan, DeformedSurface& surface, Report& report) const noexcept {
    const Index blocks = run.end - run.first;
    if (blocks == 0) return;
    DeformedBlock out = surface.block(run.first);
    out.area = plan.areaOf(run.first);
    displacement_.displaceWholeBlocks(plan.movers[run.contact], blocks, skin_.restBlock(run.first), out);
    report.moved_vertices += blocks * kBlockVertices;
  }

  /// A block that contacts share, or that lies in a region in part. Returns how many of its vertices moved.
  Index displaceShared(Index block, ThePlan& plan, DeformedSurface& surface) const noexcept {
    plan.on_block.clear();
    std::uint64_t moved = 0;
    plan.forEachOnBlock(block, [&](const BlockEntry& entry) {
      plan.on_block.push_back({&plan.movers[entry.contact], entry.region, entry.is_level});
      moved |= entry.region;
    });
    DeformedBlock out = surface.block(block);
    out.area = plan.areaOf(block);
    displacement_.displaceBlock(plan.on_block, skin_.restBlock(block), out);
    return static_cast<Index>(std::popcount(moved));
  }

  /// Holds back skin that would fold, or tear next to skin that stays.
  void holdShear(ThePlan& plan, DeformedSurface& surface, Report& report) noexcept {
    if (!hold_) return;
    report.held_vertices = hold_->apply(displacement_, plan, surface.block(0));
    if (forms_.common.normals == Normals::analytic) hold_->setNormals(surface.block(0));
  }

  void finishNormals(const ThePlan& plan, DeformedSurface& surface, Report& report) noexcept {
    if (forms_.common.normals == Normals::analytic) return;
    const PositionStreams positions = surface.positions();
    if (incremental_) {
      report.changed_triangles = incremental_->follow(skin_, positions, plan.moved);
      forEachVertex(plan.affected, [&](Index v) { surface.setNormal(v, incremental_->normal(skin_, v)); });
    } else {
      forEachVertex(plan.affected, [&](Index v) { surface.setNormal(v, areaWeightedNormal(skin_, positions, v)); });
    }
  }

  void finishStrain(const ThePlan& plan, DeformedSurface& surface) const noexcept {
    if (!forms_.common.strain) return;
    const PositionStreams displacements = surface.displacements();
    const bool principal = forms_.strain_kind == StrainKind::principal;
    forEachVertex(plan.affected, [&](Index v) {
      const float strain = principal ? static_cast<float>(principalStrains(skin_, displacements, v).dominant())
                                     : strainOfVertex(skin_, displacements, v);
      surface.setStrain(v, strain);
    });
  }

  bool needsNeighbours() const noexcept { return forms_.common.strain || forms_.common.normals != Normals::analytic; }

  template <class Visit>
  void forEachVertex(const BlockSet& blocks, const Visit& visit) const {
    blocks.forEach([&](Index block) {
      const Index end = std::min((block + 1) * kBlockVertices, skin_.vertices);
      for (Index v = block * kBlockVertices; v < end; ++v) visit(v);
    });
  }

  const Skin& skin_;
  FormSettings forms_;
  Displacement displacement_;
  std::optional<IncrementalNormals> incremental_;
  std::optional<Hold<Displacement>> hold_;
  ThePlan plan_;
};

struct Deformer::Ways {
  using Fast = Pipeline<FastDisplacement>;
  using General = Pipeline<GeneralDisplacement>;
  using Choice = std::variant<Fast, General>;

  Ways(const Skin& skin, const FormSettings& forms, Way way) : choice(chosen(skin, forms, way)) {}
  static Choice chosen(const Skin& skin, const FormSettings& forms, Way way) {
    if (way == Way::general || needsForms(forms)) return Choice(std::in_place_type<General>, skin, forms);
    return Choice(std::in_place_type<Fast>, skin, forms);
  }

  Choice choice;
};

Deformer::Deformer(const Skin& skin, const FormSettings& forms, Way way)
    : ways_(std::make_unique<Ways>(skin, forms, way)) {}
Deformer::Deformer(const Skin& skin, const Settings& settings) : Deformer(skin, withDefaultForms(settings)) {}
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;
Deformer::~Deformer() = default;

Report Deformer::apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept {
  if (auto* fast = std::get_if<Ways::Fast>(&ways_->choice)) return fast->apply(contacts, surface);
  return std::get_if<Ways::General>(&ways_->choice)->apply(contacts, surface);
}

bool Deformer::isFast() const noexcept { return std::holds_alternative<Ways::Fast>(ways_->choice); }

DeformedSurface deformed(const mesh::TriangleMesh& mesh, std::span<const Contact> contacts, const Settings& settings) {
  const Skin skin = buildSkin(mesh);
  Settings enough = settings;
  enough.max_contacts = contacts.size();
  DeformedSurface surface(skin);
  Deformer(skin, enough).apply(contacts, surface);
  return surface;
}

}  // namespace palpate::deform
