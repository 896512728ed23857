// The tables [deformation] and [strain] of a scene file: how the skin gives way.
//
// The keys are in the order in which a deformation is made: how far the skin follows (tissue), where it does (regions),
// along which curve from the finger to the rim (a profile for the press and one for the drag), and what remains.
#include <iterator>

#include "palpate/scene/detail/scene_keys.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

using D = DeformationSettings;
using F = deform::FormSettings;
using Keys = std::vector<Key<D>>;

void append(Keys& keys, Keys more) { std::move(more.begin(), more.end(), std::back_inserter(keys)); }

Keys tissueKeys() {
  using T = deform::TissueSettings;
  const auto tissue = [](double T::*member) { return way(&D::forms, &F::common, &deform::Settings::tissue, member); };
  return {
      choice<D, TissueModel>(
          "tissue", &D::tissue,
          "Tissue over the bones: layers of skin, fat and muscle with their local thickness "
          "(docs/explanation/tissue.md); the half Gaussian, with one region size for the whole body; or the half "
          "Gaussian as printed (E18, E21). Layers require bones, and a scene that sets none of fidelity.E15, E18, E21, "
          "a profile, profile_rim, region, normal_radius or radial_share; otherwise a note says so and the force law "
          "\"layered\" is F = k d. All other keys affect layers too."),
      number<D>("normal_cap_mm", tissue(&T::normal_cap_mm), between(0, 1000),
                "Maximum depth to which the skin is pressed in."),
      number<D>("tangential_cap_mm", tissue(&T::tangential_cap_mm), between(0, 1000),
                "Maximum distance over which the skin is dragged."),
      number<D>("f_adj", tissue(&T::f_adj), between(0, 10),
                "Factor on how far the skin follows a drag: 1.3 for loose skin, 0.7 for tight skin."),
      number<D>("normal_radius_mm", tissue(&T::normal_radius_mm), above(0, 10000),
                "Radius of the dent at zero depth ..."),
      number<D>("normal_radius_per_depth", tissue(&T::normal_radius_per_depth), between(0, 1000),
                "... and how much it grows per mm of depth."),
  };
}

Keys regionKeys() {
  return {
      choice<D, deform::NormalRegion>(
          "region", way(&D::forms, &F::region),
          "Region of a press: grows with the depth, is always normal_radius_mm, equals the drag's (E21), or is the "
          "drag's in proportion to the depth, full size at the cap (4.2)."),
      choice<D, deform::Shape>(
          "shape", way(&D::forms, &F::shape),
          "Shape of the drag's region: the map's ellipse, a circle of the same area, or an irregular contour."),
      file<D>("contours", &D::contours,
              "Shape \"contour\": table of measured contours (docs/reference/maps.md; default: contours that follow "
              "bones and folds, docs/explanation/deformation.md)."),
      choice<D, deform::Search>(
          "search", way(&D::forms, &F::search),
          "How a region's vertices are found: along the skin, or with the octree, which also catches other fingers."),
      choice<D, deform::Boundary>(
          "boundary", way(&D::forms, &F::boundary),
          "What the measured boundary of a drag means: where the skin stops moving, or its 2 mm contour, which makes "
          "the regions 1.635 times as large (E20). Layered tissue always uses the 2 mm contour."),
  };
}

/// Where one of the two profiles is in the settings, and what its keys and their meanings begin with.
struct ProfilePlace {
  std::string prefix;
  std::string of;
  tissue::ProfileSettings F::*settings;
  std::filesystem::path D::*file;
};
const ProfilePlace kPress = {"profile", "Press", &F::normal_profile, &D::profile_file};
const ProfilePlace kDrag = {"tangential_profile", "Drag", &F::tangential_profile, &D::tangential_profile_file};

Keys profileKeys(const ProfilePlace& place) {
  using P = tissue::ProfileSettings;
  using G = tissue::TwoGaussians;
  using T = tissue::PowerTail;
  const auto& [prefix, of, settings, profile_file] = place;
  const auto profile = [&](auto... members) { return way(&D::forms, place.settings, members...); };
  return {
      choice<D, tissue::ProfileKind>(
          prefix, profile(&P::kind),
          of + ": the curve from the finger to the rim (docs/reference/deformation-forms.md)."),
      choice<D, tissue::ProfileRim>(prefix + "_rim", profile(&P::rim),
                                    of + ": what becomes of the curve's rest at the rim (E18)."),
      count<D>(prefix + "_entries", profile(&P::table_entries), 2, 1'000'000,
               of + ", \"table\": entries; 700 is the dissertation's choice."),
      choice<D, tissue::TableLookup>(prefix + "_lookup", profile(&P::lookup),
                                     of + ", \"table\": the nearest entry, or between two."),
      number<D>(prefix + "_narrow", profile(&P::two_gaussians, &G::narrow), above(0, 10),
                of + ", \"two_gaussians\": width of the dent, as a share of the region."),
      number<D>(prefix + "_wide", profile(&P::two_gaussians, &G::wide), above(0, 10),
                of + ", \"two_gaussians\": width of the bulge or foot."),
      number<D>(prefix + "_wide_weight", profile(&P::two_gaussians, &G::wide_weight), between(-1, 1),
                of + ", \"two_gaussians\": weight of the wide one; below 0 is a bulge."),
      number<D>(prefix + "_tail_width", profile(&P::power, &T::width), above(0, 10),
                of + ", \"power\": width, as a share of the region."),
      number<D>(prefix + "_tail_exponent", profile(&P::power, &T::exponent), above(0, 10),
                of + ", \"power\": how fast the tail falls."),
      file<D>(prefix + "_file", profile_file, of + ", \"user\": table q,value (docs/reference/deformation-forms.md)."),
      choice<D, tissue::UserInterpolation>(prefix + "_interpolation", profile(&P::interpolation),
                                           of + ", \"user\": smooth without overshoot, or straight."),
  };
}

Keys otherKeys() {
  using R = tissue::RadialTerm;
  return {
      number<D>("radial_share", way(&D::forms, &F::radial, &R::share), between(-1, 1),
                "How far pressed skin is also drawn in sideways, as a fraction of the depth; layered tissue has 0.05 "
                "to 0.1."),
      number<D>("radial_width", way(&D::forms, &F::radial, &R::width), above(0, 1),
                "Where the inward pull is largest, as a fraction of the region."),
      choice<D, deform::Together>(
          "together", way(&D::forms, &F::together),
          "Several fingers: each reaches its own depth, or their displacements simply add up (E25)."),
      choice<D, deform::Normals>("normals", way(&D::forms, &F::common, &deform::Settings::normals),
                                 "Normals of the deformed skin: from the formulae (fast), from all its triangles, or "
                                 "only from those that changed."),
  };
}

/// A file belongs to the profile "user" alone.
void checkProfileFile(const ProfilePlace& place, const D& settings, const Entry& entry) {
  const bool is_user = (settings.forms.*place.settings).kind == tissue::ProfileKind::user;
  const bool has_file = !(settings.*place.file).empty();
  if (is_user && !has_file) entry.fail(fmt::format("{0} = \"user\" needs {0}_file", place.prefix));
  if (!is_user && has_file) entry.fail(fmt::format("{0}_file is read only with {0} = \"user\"", place.prefix));
}

/// The same for a place.
void checkPlaceFile(tissue::ProfileKind kind, const std::filesystem::path& file, std::string_view key,
                    const Entry& entry) {
  const bool is_user = kind == tissue::ProfileKind::user;
  if (is_user && file.empty()) entry.fail(fmt::format("{0} = \"user\" needs {0}_file", key));
  if (!is_user && !file.empty()) entry.fail(fmt::format("{0}_file is read only with {0} = \"user\"", key));
}

void checkFiles(const D& settings, const Entry& entry) {
  checkProfileFile(kPress, settings, entry);
  checkProfileFile(kDrag, settings, entry);
  if (!settings.contours.empty() && settings.forms.shape != deform::Shape::contour) {
    entry.fail("contours is read only with shape = \"contour\"");
  }
}

}  // namespace

Section deformationSection() {
  Keys keys = tissueKeys();
  append(keys, regionKeys());
  append(keys, profileKeys(kPress));
  append(keys, profileKeys(kDrag));
  append(keys, otherKeys());
  return section<D>("deformation", "How the skin deforms (functional shape matched deformation).", &Scene::deformation,
                    std::move(keys), checkFiles);
}

Section profileSection() {
  using S = PlaceProfile;
  const std::vector<Key<S>> keys = {
      text<S>("at", &S::at, "Centre by name: \"T9 right 30 mm\" (docs/reference/names.md)."),
      unlessNamed(
          number<S>("x_mm", &S::x_mm, between(-kLongestMm, kLongestMm), "Centre in coordinates, seen along z.")),
      unlessNamed(
          number<S>("y_mm", &S::y_mm, between(-kLongestMm, kLongestMm), "Centre in coordinates, seen along z.")),
      number<S>("radius_mm", &S::radius_mm, above(0, kLongestMm), "Nothing changes outside this radius."),
      number<S>("edge_softness", &S::edge_softness, between(0, 1),
                "Fraction of the radius over which the curves blend into the surrounding ones; 0 is a hard edge."),
      choice<S, tissue::ProfileKind>("press", &S::press,
                                     "Curve of a press there, also in place of layers; its parameters are those of "
                                     "[deformation] profile_... (docs/reference/deformation-forms.md)."),
      file<S>("press_file", &S::press_file, "With press = \"user\": table q,value."),
      choice<S, tissue::ProfileKind>("drag", &S::drag, "Curve of a drag there."),
      file<S>("drag_file", &S::drag_file, "With drag = \"user\": table q,value."),
      number<S>("region", &S::region, above(0, 10),
                "Factor for the press and drag regions that [deformation] and the map define there."),
  };
  const auto read = [keys](const TomlNode& table, const Entry& entry) {
    S profile;
    readTable(table, entry.name, entry.file, keys, profile);
    checkPlaceFile(profile.press, profile.press_file, "press", entry);
    checkPlaceFile(profile.drag, profile.drag_file, "drag", entry);
    return profile;
  };
  return listSection<S>("profile", "A place whose skin follows a curve of its own; its force stays.", &Scene::profiles,
                        read, keys, [keys] { return describe<S>("[[profile]]", keys); });
}

Section strainSection() {
  using Strain = StrainSettings;
  std::vector<Key<Strain>> keys = {
      choice<Strain, deform::StrainKind>(
          "kind", &Strain::kind,
          "Mean strain of a vertex's edges, or its larger principal strain, which also shows shear (E24)."),
      number<Strain>("range_percent", &Strain::range_percent, above(0, 1000),
                     "Strain drawn in full red (tension) or full blue (compression)."),
  };
  return section<Strain>("strain", "The colours of the written surfaces.", &Scene::strain, std::move(keys));
}

}  // namespace palpate::scene
