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

template <>
struct WordsOf<scene::Reading> {
  using V = scene::Reading;
  static constexpr std::array kAll = {Word{"corrected", V::corrected}, Word{"literal", V::literal}};
};

template <>
struct WordsOf<scene::ByDefault> {
  using V = scene::ByDefault;
  static constexpr std::array kAll = {Word{"corrected", V::corrected}, Word{"as printed", V::as_printed},
                                      Word{"our choice", V::own_choice}};
};

// ---- who touches it

template <>
struct WordsOf<scene::HeldFinger> {
  using V = scene::HeldFinger;
  static constexpr std::array kAll = {Word{"left", V::left}, Word{"right", V::right}};
};

// ---- the body

template <>
struct WordsOf<scene::BodyKind> {
  using V = scene::BodyKind;
  static constexpr std::array kAll = {Word{"trunk", V::trunk}, Word{"torso", V::torso}, Word{"back", V::back},
                                      Word{"mesh", V::mesh}};
};

template <>
struct WordsOf<body::Posture> {
  using V = body::Posture;
  static constexpr std::array kAll = {Word{"standing", V::standing}, Word{"prone", V::prone},
                                      Word{"sitting", V::sitting}};
};

template <>
struct WordsOf<scene::Unit> {
  using V = scene::Unit;
  static constexpr std::array kAll = {Word{"auto", V::from_file}, Word{"mm", V::millimetre}, Word{"cm", V::centimetre},
                                      Word{"dm", V::decimetre},   Word{"m", V::metre},       Word{"in", V::inch}};
};

template <>
struct WordsOf<body::Side> {
  using V = body::Side;
  static constexpr std::array kAll = {Word{"right", V::right}, Word{"left", V::left}};
};

// ---- maps

template <>
struct WordsOf<scene::StiffnessSource> {
  using V = scene::StiffnessSource;
  static constexpr std::array kAll = {Word{"auto", V::automatic}, Word{"depth", V::depth}, Word{"points", V::points},
                                      Word{"constant", V::constant}};
};

template <>
struct WordsOf<maps::StiffnessInterpolation> {
  using V = maps::StiffnessInterpolation;
  static constexpr std::array kAll = {Word{"gri", V::gri}, Word{"thin_plate", V::thin_plate},
                                      Word{"polynomial", V::polynomial}};
};

template <>
struct WordsOf<maps::ForceDirection> {
  using V = maps::ForceDirection;
  static constexpr std::array kAll = {Word{"up", V::up}, Word{"down", V::down}};
};

template <>
struct WordsOf<scene::EllipsePlace> {
  using V = scene::EllipsePlace;
  static constexpr std::array kAll = {Word{"anchor", V::anchor}, Word{"nearest_vertex", V::nearest_vertex}};
};

template <>
struct WordsOf<maps::Averaging> {
  using V = maps::Averaging;
  static constexpr std::array kAll = {Word{"plain", V::plain}, Word{"tensorial", V::tensorial}};
};

/// Weights of the ellipse map's key points; nothing stands for GRI, the engine's own.
template <>
struct WordsOf<std::optional<maps::LiteralWeights>> {
  using V = maps::LiteralWeights;
  using Choice = Word<std::optional<V>>;
  static constexpr std::array kAll = {Choice{"gri", std::nullopt}, Choice{"products", V::products},
                                      Choice{"printed_products", V::printed_products},
                                      Choice{"single_effects", V::single_effects}};
};

template <>
struct WordsOf<maps::DirectionBlend> {
  using V = maps::DirectionBlend;
  static constexpr std::array kAll = {Word{"tensor", V::tensor}, Word{"double_angle", V::double_angle},
                                      Word{"raw_degrees", V::raw_degrees}};
};

// ---- touch

template <>
struct WordsOf<scene::DeviceModel> {
  using V = scene::DeviceModel;
  static constexpr std::array kAll = {Word{"unknown", V::unknown},
                                      Word{"omni", V::omni},
                                      Word{"touch", V::touch},
                                      Word{"touch_x", V::touch_x},
                                      Word{"premium_1_5", V::premium_1_5},
                                      Word{"premium_3_0", V::premium_3_0},
                                      Word{"falcon", V::falcon},
                                      Word{"omega_3", V::omega_3},
                                      Word{"inverse3", V::inverse3}};
};

template <>
struct WordsOf<scene::StartRule> {
  using V = scene::StartRule;
  static constexpr std::array kAll = {Word{"outside", V::outside}, Word{"ramp", V::ramp}};
};

template <>
struct WordsOf<scene::ContactSource> {
  using V = scene::ContactSource;
  static constexpr std::array kAll = {Word{"surface", V::surface}, Word{"hdb", V::hdb}};
};

template <>
struct WordsOf<scene::HapticSurface> {
  using V = scene::HapticSurface;
  static constexpr std::array kAll = {Word{"rigid", V::rigid}, Word{"yields", V::yields},
                                      Word{"yields_doubled", V::yields_doubled}};
};

template <>
struct WordsOf<tissue::ForceLaw::Kind> {
  using V = tissue::ForceLaw::Kind;
  static constexpr std::array kAll = {Word{"linear", V::linear}, Word{"power", V::power},
                                      Word{"stiffening", V::stiffening}, Word{"table", V::table},
                                      Word{"layered", V::layered}};
};

template <>
struct WordsOf<scene::LumpForce> {
  using V = scene::LumpForce;
  static constexpr std::array kAll = {Word{"table", V::table}, Word{"solved", V::solved}};
};

template <>
struct WordsOf<scene::TissueModel> {
  using V = scene::TissueModel;
  static constexpr std::array kAll = {Word{"layered", V::layered}, Word{"gaussian", V::gaussian},
                                      Word{"literal", V::literal}};
};

template <>
struct WordsOf<hdb::TreeKind> {
  using V = hdb::TreeKind;
  static constexpr std::array kAll = {Word{"bsp", V::Bsp}, Word{"octree", V::Octree}};
};

template <>
struct WordsOf<hdb::Assignment> {
  using V = hdb::Assignment;
  static constexpr std::array kAll = {Word{"A", V::Cut}, Word{"B", V::BothSides}, Word{"C", V::Majority}};
};

template <>
struct WordsOf<hdb::HdbQuery> {
  using V = hdb::HdbQuery;
  static constexpr std::array kAll = {Word{"leaves", V::leaves}, Word{"triangles", V::triangles},
                                      Word{"coherent", V::coherent}, Word{"linked", V::linked}};
};

/// How leaves are found: nothing is findLeaves, which misses none.
template <>
struct WordsOf<std::optional<hdb::LiteralTraversal>> {
  using V = hdb::LiteralTraversal;
  using Choice = Word<std::optional<V>>;
  static constexpr std::array kAll = {Choice{"tight", std::nullopt}, Choice{"else-if", V::ElseIf},
                                      Choice{"half-space", V::HalfSpace}, Choice{"cell-box", V::CellBox},
                                      Choice{"sphere-corners", V::SphereCorners}};
};

template <>
struct WordsOf<scene::Move> {
  using V = scene::Move;
  static constexpr std::array kAll = {Word{"press", V::press}, Word{"hold", V::hold}, Word{"drag", V::drag},
                                      Word{"circle", V::circle}, Word{"lift", V::lift}};
};

// ---- deformation

template <>
struct WordsOf<deform::Search> {
  using V = deform::Search;
  static constexpr std::array kAll = {Word{"neighbours", V::neighbours}, Word{"octree", V::octree}};
};

template <>
struct WordsOf<deform::NormalRegion> {
  using V = deform::NormalRegion;
  static constexpr std::array kAll = {Word{"linear", V::linear}, Word{"constant", V::constant},
                                      Word{"shared", V::shared}, Word{"scaled", V::scaled}};
};

template <>
struct WordsOf<deform::Shape> {
  using V = deform::Shape;
  static constexpr std::array kAll = {Word{"ellipse", V::ellipse}, Word{"circle", V::circle},
                                      Word{"contour", V::contour}};
};

template <>
struct WordsOf<deform::Boundary> {
  using V = deform::Boundary;
  static constexpr std::array kAll = {Word{"zero", V::zero}, Word{"two_mm", V::two_mm}};
};

template <>
struct WordsOf<deform::Together> {
  using V = deform::Together;
  static constexpr std::array kAll = {Word{"solved", V::solved}, Word{"summed", V::summed}};
};

template <>
struct WordsOf<deform::Normals> {
  using V = deform::Normals;
  static constexpr std::array kAll = {Word{"analytic", V::analytic}, Word{"recomputed", V::recomputed},
                                      Word{"incremental", V::incremental}};
};

template <>
struct WordsOf<deform::StrainKind> {
  using V = deform::StrainKind;
  static constexpr std::array kAll = {Word{"edges", V::edges}, Word{"principal", V::principal}};
};

template <>
struct WordsOf<tissue::ProfileKind> {
  using V = tissue::ProfileKind;
  static constexpr std::array kAll = {Word{"half_gaussian", V::half_gaussian},
                                      Word{"table", V::table},
                                      Word{"sharp", V::sharp},
                                      Word{"cosine", V::cosine},
                                      Word{"logarithm", V::logarithm},
                                      Word{"two_gaussians", V::two_gaussians},
                                      Word{"power", V::power},
                                      Word{"user", V::user}};
};

template <>
struct WordsOf<tissue::ProfileRim> {
  using V = tissue::ProfileRim;
  static constexpr std::array kAll = {Word{"lowered", V::lowered}, Word{"step", V::step}, Word{"smooth", V::smooth}};
};

template <>
struct WordsOf<tissue::TableLookup> {
  using V = tissue::TableLookup;
  static constexpr std::array kAll = {Word{"nearest", V::nearest}, Word{"linear", V::linear}};
};

template <>
struct WordsOf<tissue::UserInterpolation> {
  using V = tissue::UserInterpolation;
  static constexpr std::array kAll = {Word{"cubic", V::monotone_cubic}, Word{"linear", V::linear}};
};

}  // namespace palpate
