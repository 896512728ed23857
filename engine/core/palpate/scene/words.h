// The words that scene files, commands and panels have for the engine's enumerations: one table a type (base/words.h).
// Those of pictures stand beside their types in view_settings.h. Words that neither scene files nor commands know stand
// with who uses them: the states of forces.csv in trace/forces_csv.cpp, how the mouse presses in the viewer.
//
// A new enumerator needs its word in its table and nowhere else: the reader, its error messages, the writer, the
// panels' lists, the commands' choices and docs/reference/scene-files.md follow. Where people read other words than
// files have, a titleOf says them.
#pragma once

#include "palpate/base/words.h"
#include "palpate/body/hand.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene.h"

namespace palpate {

constexpr auto wordTable(Named<scene::Reading>) { return wordsUpTo(scene::Reading::literal, {"corrected", "literal"}); }

constexpr auto wordTable(Named<scene::ByDefault>) {
  return wordsUpTo(scene::ByDefault::own_choice, {"corrected", "as printed", "our choice"});
}

// ---- who touches it

constexpr auto wordTable(Named<scene::HeldFinger>) { return wordsUpTo(scene::HeldFinger::right, {"left", "right"}); }

// ---- the body

constexpr auto wordTable(Named<scene::BodyKind>) {
  using V = scene::BodyKind;
  return std::array{Word{"trunk", V::trunk}, Word{"torso", V::torso}, Word{"back", V::back}, Word{"mesh", V::mesh}};
}

constexpr auto wordTable(Named<body::Posture>) {
  return wordsUpTo(body::Posture::sitting, {"standing", "prone", "sitting"});
}

constexpr auto wordTable(Named<scene::Unit>) {
  return wordsUpTo(scene::Unit::inch, {"auto", "mm", "cm", "dm", "m", "in"});
}

constexpr auto wordTable(Named<body::Side>) {
  using V = body::Side;
  return std::array{Word{"right", V::right}, Word{"left", V::left}};
}

// ---- maps

constexpr auto wordTable(Named<scene::StiffnessSource>) {
  return wordsUpTo(scene::StiffnessSource::constant, {"auto", "depth", "points", "constant"});
}

constexpr auto wordTable(Named<maps::StiffnessInterpolation>) {
  return wordsUpTo(maps::StiffnessInterpolation::polynomial, {"gri", "thin_plate", "polynomial"});
}

constexpr auto wordTable(Named<maps::ForceDirection>) { return wordsUpTo(maps::ForceDirection::down, {"up", "down"}); }

constexpr auto wordTable(Named<scene::EllipsePlace>) {
  return wordsUpTo(scene::EllipsePlace::nearest_vertex, {"anchor", "nearest_vertex"});
}

constexpr auto wordTable(Named<maps::Averaging>) {
  return wordsUpTo(maps::Averaging::tensorial, {"plain", "tensorial"});
}

/// Weights of the ellipse map's key points; nothing stands for GRI, the engine's own.
constexpr auto wordTable(Named<std::optional<maps::LiteralWeights>>) {
  using V = maps::LiteralWeights;
  using Choice = Word<std::optional<V>>;
  return std::array{Choice{"gri", std::nullopt}, Choice{"products", V::products},
                    Choice{"printed_products", V::printed_products}, Choice{"single_effects", V::single_effects}};
}

constexpr auto wordTable(Named<maps::DirectionBlend>) {
  return wordsUpTo(maps::DirectionBlend::raw_degrees, {"tensor", "double_angle", "raw_degrees"});
}

// ---- touch

constexpr auto wordTable(Named<scene::DeviceModel>) {
  return wordsUpTo(scene::DeviceModel::inverse3, {"unknown", "omni", "touch", "touch_x", "premium_1_5", "premium_3_0",
                                                  "falcon", "omega_3", "inverse3"});
}

constexpr auto wordTable(Named<scene::StartRule>) { return wordsUpTo(scene::StartRule::ramp, {"outside", "ramp"}); }

constexpr auto wordTable(Named<scene::ContactSource>) {
  return wordsUpTo(scene::ContactSource::hdb, {"surface", "hdb"});
}

constexpr auto wordTable(Named<scene::HapticSurface>) {
  return wordsUpTo(scene::HapticSurface::yields_doubled, {"rigid", "yields", "yields_doubled"});
}

constexpr auto wordTable(Named<tissue::ForceLaw::Kind>) {
  return wordsUpTo(tissue::ForceLaw::Kind::layered, {"linear", "power", "stiffening", "table", "layered"});
}

constexpr auto wordTable(Named<scene::LumpForce>) { return wordsUpTo(scene::LumpForce::solved, {"table", "solved"}); }

constexpr auto wordTable(Named<scene::TissueModel>) {
  return wordsUpTo(scene::TissueModel::literal, {"layered", "gaussian", "literal"});
}

constexpr auto wordTable(Named<hdb::TreeKind>) { return wordsUpTo(hdb::TreeKind::Octree, {"bsp", "octree"}); }

constexpr auto wordTable(Named<hdb::Assignment>) { return wordsUpTo(hdb::Assignment::Majority, {"A", "B", "C"}); }

constexpr auto wordTable(Named<hdb::HdbQuery>) {
  return wordsUpTo(hdb::HdbQuery::linked, {"leaves", "triangles", "coherent", "linked"});
}

/// How leaves are found: nothing is findLeaves, which misses none.
constexpr auto wordTable(Named<std::optional<hdb::LiteralTraversal>>) {
  using V = hdb::LiteralTraversal;
  using Choice = Word<std::optional<V>>;
  return std::array{Choice{"tight", std::nullopt}, Choice{"else-if", V::ElseIf}, Choice{"half-space", V::HalfSpace},
                    Choice{"cell-box", V::CellBox}, Choice{"sphere-corners", V::SphereCorners}};
}

constexpr auto wordTable(Named<scene::Move>) {
  return wordsUpTo(scene::Move::lift, {"press", "hold", "drag", "circle", "lift"});
}

// ---- deformation

constexpr auto wordTable(Named<deform::Search>) { return wordsUpTo(deform::Search::octree, {"neighbours", "octree"}); }

constexpr auto wordTable(Named<deform::NormalRegion>) {
  return wordsUpTo(deform::NormalRegion::scaled, {"linear", "constant", "shared", "scaled"});
}

constexpr auto wordTable(Named<deform::Shape>) {
  return wordsUpTo(deform::Shape::contour, {"ellipse", "circle", "contour"});
}

constexpr auto wordTable(Named<deform::Boundary>) { return wordsUpTo(deform::Boundary::two_mm, {"zero", "two_mm"}); }

constexpr auto wordTable(Named<deform::Together>) { return wordsUpTo(deform::Together::summed, {"solved", "summed"}); }

constexpr auto wordTable(Named<deform::Normals>) {
  return wordsUpTo(deform::Normals::incremental, {"analytic", "recomputed", "incremental"});
}

constexpr auto wordTable(Named<deform::StrainKind>) {
  return wordsUpTo(deform::StrainKind::principal, {"edges", "principal"});
}

constexpr auto wordTable(Named<tissue::ProfileKind>) {
  return wordsUpTo(tissue::ProfileKind::user,
                   {"half_gaussian", "table", "sharp", "cosine", "logarithm", "two_gaussians", "power", "user"});
}

constexpr auto wordTable(Named<tissue::ProfileRim>) {
  return wordsUpTo(tissue::ProfileRim::smooth, {"lowered", "step", "smooth"});
}

constexpr auto wordTable(Named<tissue::TableLookup>) {
  return wordsUpTo(tissue::TableLookup::linear, {"nearest", "linear"});
}

constexpr auto wordTable(Named<tissue::UserInterpolation>) {
  return wordsUpTo(tissue::UserInterpolation::linear, {"cubic", "linear"});
}

}  // namespace palpate
