// The step of an apply that holds displaced skin back where it would tear or fold, for both ways to displace.
//
// Data flow: frames, movers, regions and edges of the plan (plan.h), displaced surface -> doubtful vertices ->
// ShearLimit -> surface, normals of held vertices. Certain cases cost a test a block: edges at which the formulae move
// next to nothing, blocks that no contact shears much (fold_bounds.h).
#pragma once

#include "palpate/deform/normals.h"
#include "palpate/deform/plan.h"
#include "palpate/deform/shear_limit.h"

namespace palpate::deform {

template <class Displacement>
class Hold {
 public:
  using ThePlan = Plan<Displacement>;

  Hold(const Skin& skin, std::size_t most_contacts) : skin_(skin), shear_(skin, most_contacts) {}

  /// Corrects positions and displacements of `surface`, which starts at the skin's first block. Returns how many
  /// vertices were held. Leaves of the plan's edges those that are in doubt.
  Index apply(const Displacement& displacement, ThePlan& plan, const DeformedBlock& surface) noexcept {
    shear_.start();
    boundShear(displacement, plan);
    const bool may_fold = findDoubtful(displacement, plan);
    dropFaintEdges(displacement, plan);
    const bool may_tear = !plan.edges.empty();
    const bool is_thin = findThin(plan);
    if (!may_fold && !may_tear && !is_thin) return 0;
    listPulls(plan);
    shear_.setPulls(plan.pulls);
    if (is_thin) shear_.limitToPart(surface);
    if (may_tear) shear_.taper(surface, bound_.press + bound_.drag, Curves{skin_, displacement, plan});
    shear_.joinSeams(surface);
    shear_.unfold(surface, plan.doubtful);
    return static_cast<Index>(shear_.held().size());
  }

  /// The formulae know nothing of what was held back: normals there come from the triangles. For the last apply.
  void setNormals(const DeformedBlock& surface) const noexcept {
    for (const Index v : shear_.held()) {
      setNormal(v, surface);
      for (const Index w : skin_.neighbours[v]) {
        if (shear_.moves(w)) setNormal(w, surface);
      }
    }
  }

 private:
  /// ShearLimit::taper's view of the displacement.
  struct Curves {
    const Skin& skin;
    const Displacement& displacement;
    const ThePlan& plan;

    double press(const Pull& pull, double q) const noexcept {
      return displacement.pressRoom(plan.frames[pull.contact], q);
    }
    double drag(const Pull& pull, double q) const noexcept {
      return displacement.dragRoom(plan.frames[pull.contact], q);
    }
    double moved(const Pull& pull, Index vertex) const noexcept {
      const auto& frame = plan.frames[pull.contact];
      const Vec3 offset = skin.restPosition(vertex).template cast<double>() - pull.anchor;
      return displacement.mostAt(frame, pull.press_mm, pull.drag_mm, offset);
    }
  };

  void boundShear(const Displacement& displacement, ThePlan& plan) noexcept {
    bound_ = {};
    is_steep_near_fingers_ =
        std::ranges::any_of(plan.frames, [](const auto& frame) { return frame.layered.has_value(); });
    for (std::size_t i = 0; i < plan.movers.size(); ++i) {
      if (Displacement::moves(plan.movers[i])) displacement.addShear(plan.frames[i], plan.movers[i], bound_);
    }
  }

  /// Shear by the contacts at the triangles of a block, and `beyond_mm` around.
  ShearBound shearNear(const Displacement& displacement, const ThePlan& plan, Index block,
                       double beyond_mm) const noexcept {
    if (!is_steep_near_fingers_) return bound_;
    ShearBound shear;
    const Vec3 centre = skin_.centreOf(block);
    const double radius_mm = skin_.radiusOf(block) + beyond_mm;
    for (std::size_t i = 0; i < plan.movers.size(); ++i) {
      if (!Displacement::moves(plan.movers[i])) continue;
      displacement.addShearNear(plan.frames[i], plan.movers[i], centre, radius_mm, shear);
    }
    return shear;
  }

  /// Vertices of which it is not certain that they keep all their triangles up. False if none was found.
  bool findDoubtful(const Displacement& displacement, ThePlan& plan) const noexcept {
    plan.doubtful.clear();
    const double certain = certainSpread(bound_);
    const auto is_spread = [&](Index tile) { return !(skin_.spread_of_tiles[tile] < certain); };
    plan.moved.forEachIn(is_spread, [&](Index block) {
      const FoldBound& of_block = skin_.fold_bounds[block];
      if (!mayFold(of_block, bound_)) return;
      const ShearBound near = shearNear(displacement, plan, block, 0.0);
      if (is_steep_near_fingers_ && !mayFold(of_block, near)) return;
      const std::uint64_t vertices = doubtfulVertices(skin_, block, near, plan.areaOf(block));
      if (vertices != 0) plan.doubtful.push_back({block, false, vertices});
    });
    return !plan.doubtful.empty();
  }

  /// Whether any part of what moves is thinner than a dent may be deep.
  bool findThin(const ThePlan& plan) const noexcept {
    if (skin_.least_thickness_mm.empty()) return false;
    const double all = totalMotion(plan);
    bool any = false;
    plan.moved.forEach([&](Index block) { any = any || ShearLimit::isThin(skin_, block, all); });
    return any;
  }

  /// Sum of the motions of all centres, mm: no vertex moves farther.
  static double totalMotion(const ThePlan& plan) noexcept {
    double all = 0.0;
    for (const auto& mover : plan.movers) all += Displacement::pressOf(mover) + Displacement::dragOf(mover);
    return all;
  }

  /// Leaves the edges at which skin may have to be held.
  void dropFaintEdges(const Displacement& displacement, ThePlan& plan) const noexcept {
    const double all = totalMotion(plan);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < plan.movers.size(); ++i) {
      const auto& mover = plan.movers[i];
      const double own = Displacement::pressOf(mover) + Displacement::dragOf(mover);
      const Index first = plan.first_edge[i];
      plan.first_edge[i] = static_cast<Index>(kept);
      if (!Displacement::moves(mover)) continue;
      for (Index e = first; e < plan.first_edge[i + 1]; ++e) {
        BlockPart part = plan.edges[e];
        // Skin farther from the edge than this may move as far as any.
        const ShearBound near = shearNear(displacement, plan, part.block, all / ShearLimit::kSteepest);
        const double faint = ShearLimit::negligibleEdgeMotion(near.press + near.drag, own);
        if (faint > 0.0) {
          part.vertices = displacement.strainedVertices(plan.movers, skin_.edgeBlock(part.block), part.vertices, faint);
        }
        if (part.vertices != 0) plan.edges[kept++] = part;
      }
    }
    plan.edges.resize(kept);
    plan.first_edge[plan.movers.size()] = static_cast<Index>(kept);
  }

  void listPulls(ThePlan& plan) const noexcept {
    plan.pulls.clear();
    const std::span<const BlockPart> parts = plan.parts;
    const std::span<const BlockPart> edges = plan.edges;
    for (std::size_t i = 0; i < plan.movers.size(); ++i) {
      if (!Displacement::moves(plan.movers[i])) continue;
      const auto& frame = plan.frames[i];
      Pull pull;
      pull.anchor = frame.anchor;
      pull.normal = frame.normal;
      pull.anchor_triangle = frame.anchor_triangle;
      pull.contact = i;
      pull.region = parts.subspan(plan.first_part[i], plan.first_part[i + 1] - plan.first_part[i]);
      pull.edges = edges.subspan(plan.first_edge[i], plan.first_edge[i + 1] - plan.first_edge[i]);
      if (frame.press.acts()) {
        pull.press_mm = Displacement::pressOf(plan.movers[i]);
        pull.press_reach_mm = Displacement::halfMajor(frame.press);
      }
      if (frame.drag.acts()) {
        pull.drag_mm = Displacement::dragOf(plan.movers[i]);
        pull.drag_reach_mm = Displacement::halfMajor(frame.drag);
      }
      plan.pulls.push_back(pull);
    }
  }

  void setNormal(Index vertex, const DeformedBlock& surface) const noexcept {
    const PositionStreams positions{surface.values[0], surface.values[1], surface.values[2]};
    const Vec3f normal = areaWeightedNormal(skin_, positions, vertex);
    for (int axis = 0; axis < 3; ++axis) surface.values[3 + axis][vertex] = normal[axis];
  }

  const Skin& skin_;
  ShearLimit shear_;
  ShearBound bound_;
  bool is_steep_near_fingers_ = false;  // some contact has layered tissue: bounds by place are tighter than bound_
};

}  // namespace palpate::deform
