#include "palpate/scene/section_keys.h"

#include <algorithm>
#include <iterator>

namespace palpate::scene {

namespace {

using Settings = DeformationSettings;

void append(std::vector<Key<Settings>>& keys, std::vector<Key<Settings>> more) {
  std::move(more.begin(), more.end(), std::back_inserter(keys));
}

std::vector<Key<Settings>> tissueKeys() {
  using T = deform::TissueSettings;
  const auto tissue = [](double T::*member) -> Access<Settings, double> {
    return [member](Settings& s) -> double& { return s.forms.common.tissue.*member; };
  };
  return {
      number<Settings>("normal_cap_mm", tissue(&T::normal_cap_mm), between(0, 1000),
                       "The skin is pressed in no deeper than this."),
      number<Settings>("tangential_cap_mm", tissue(&T::tangential_cap_mm), between(0, 1000),
                       "The skin is dragged no farther than this."),
      number<Settings>("f_adj", tissue(&T::f_adj), between(0, 10),
                       "Factor on how far the skin follows a drag: 1.3 for loose skin, 0.7 for tight skin."),
      number<Settings>("normal_radius_mm", tissue(&T::normal_radius_mm), above(0, 10000),
                       "Radius of the dent at no depth ..."),
      number<Settings>("normal_radius_per_depth", tissue(&T::normal_radius_per_depth), between(0, 1000),
                       "... and how much it grows per mm of depth."),
  };
}

std::vector<Key<Settings>> regionKeys() {
  return {
      choice<Settings, deform::NormalRegion>(
          "region", [](Settings& s) -> deform::NormalRegion& { return s.forms.region; },
          {"linear", "constant", "shared"},
          "Of the press: growing with the depth, of normal_radius_mm always, or the same as the drag's (E21)."),
      choice<Settings, deform::Shape>(
          "shape", [](Settings& s) -> deform::Shape& { return s.forms.shape; }, {"ellipse", "circle", "contour"},
          "Of the drag's region: the map's ellipse, the circle of its area, or an irregular contour."),
      file<Settings>("contours", &Settings::contours,
                     "Shape \"contour\": table of measured contours (docs/maps.md); left out: the key ellipses."),
      choice<Settings, deform::Boundary>(
          "boundary", [](Settings& s) -> deform::Boundary& { return s.forms.boundary; }, {"zero", "two_mm"},
          "What was measured as the drag's boundary: where the skin is still, or its 2 mm contour; that makes the "
          "regions 1.635 times as large (E20)."),
  };
}

std::vector<Key<Settings>> profileKeys(const std::string& prefix, const std::string& of,
                                       tissue::ProfileSettings deform::FormSettings::*profile,
                                       std::filesystem::path Settings::*profile_file) {
  using P = tissue::ProfileSettings;
  const auto at = [profile](auto member) {
    return [profile, member](Settings& s) -> decltype(auto) { return ((s.forms.*profile).*member); };
  };
  const auto gaussians = [profile](double tissue::TwoGaussians::*member) -> Access<Settings, double> {
    return [=](Settings& s) -> double& { return (s.forms.*profile).two_gaussians.*member; };
  };
  const auto power = [profile](double tissue::PowerTail::*member) -> Access<Settings, double> {
    return [=](Settings& s) -> double& { return (s.forms.*profile).power.*member; };
  };
  return {
      choice<Settings, tissue::ProfileKind>(
          prefix, at(&P::kind),
          {"half_gaussian", "table", "sharp", "cosine", "logarithm", "two_gaussians", "power", "user"},
          of + ": the curve from the finger to the rim (docs/profiles.md)."),
      choice<Settings, tissue::ProfileRim>(prefix + "_rim", at(&P::rim), {"lowered", "step", "smooth"},
                                           of + ": what becomes of the curve's rest at the rim (E18)."),
      count<Settings>(prefix + "_entries", at(&P::table_entries), 2, 1'000'000,
                      of + ", \"table\": entries; 700 is the dissertation's choice."),
      choice<Settings, tissue::TableLookup>(prefix + "_lookup", at(&P::lookup), {"nearest", "linear"},
                                            of + ", \"table\": the nearest entry, or between two."),
      number<Settings>(prefix + "_narrow", gaussians(&tissue::TwoGaussians::narrow), above(0, 10),
                       of + ", \"two_gaussians\": width of the dent, as a share of the region."),
      number<Settings>(prefix + "_wide", gaussians(&tissue::TwoGaussians::wide), above(0, 10),
                       of + ", \"two_gaussians\": width of the bulge or foot."),
      number<Settings>(prefix + "_wide_weight", gaussians(&tissue::TwoGaussians::wide_weight), between(-1, 1),
                       of + ", \"two_gaussians\": weight of the wide one; below 0 is a bulge."),
      number<Settings>(prefix + "_tail_width", power(&tissue::PowerTail::width), above(0, 10),
                       of + ", \"power\": width, as a share of the region."),
      number<Settings>(prefix + "_tail_exponent", power(&tissue::PowerTail::exponent), above(0, 10),
                       of + ", \"power\": how fast the tail falls."),
      file<Settings>(prefix + "_file", profile_file, of + ", \"user\": table q,value (docs/profiles.md)."),
      choice<Settings, tissue::UserInterpolation>(prefix + "_interpolation", at(&P::interpolation), {"cubic", "linear"},
                                                  of + ", \"user\": smooth without overshoot, or straight."),
  };
}

std::vector<Key<Settings>> otherKeys() {
  return {
      number<Settings>(
          "radial_share", [](Settings& s) -> double& { return s.forms.radial.share; }, between(-1, 1),
          "How far pressed skin is also drawn in sideways, as a share of the depth; layered tissue shows 0.05 to 0.1."),
      number<Settings>(
          "radial_width", [](Settings& s) -> double& { return s.forms.radial.width; }, above(0, 1),
          "Where that is largest, as a share of the region."),
      choice<Settings, deform::Together>(
          "together", [](Settings& s) -> deform::Together& { return s.forms.together; }, {"solved", "summed"},
          "Several fingers: each gets its own depth, or their displacements simply add up (E25)."),
      choice<Settings, deform::Normals>(
          "normals", [](Settings& s) -> deform::Normals& { return s.forms.common.normals; },
          {"analytic", "recomputed", "incremental"},
          "Of the deformed skin: from the formulae (fast), from its triangles, or from those that changed."),
  };
}

void checkProfileFile(const std::string& prefix, const tissue::ProfileSettings& profile,
                      const std::filesystem::path& file, const Entry& entry) {
  const bool is_user = profile.kind == tissue::ProfileKind::user;
  if (is_user && file.empty()) entry.fail(fmt::format("{0} = \"user\" needs {0}_file", prefix));
  if (!is_user && !file.empty()) entry.fail(fmt::format("{0}_file is read only with {0} = \"user\"", prefix));
}

}  // namespace

std::vector<Key<DeformationSettings>> deformationKeys() {
  using F = deform::FormSettings;
  std::vector<Key<Settings>> keys = tissueKeys();
  append(keys, regionKeys());
  append(keys, profileKeys("profile", "Press", &F::normal_profile, &Settings::profile_file));
  append(keys, profileKeys("tangential_profile", "Drag", &F::tangential_profile, &Settings::tangential_profile_file));
  append(keys, otherKeys());
  return keys;
}

void checkDeformation(const DeformationSettings& settings, const Entry& entry) {
  checkProfileFile("profile", settings.forms.normal_profile, settings.profile_file, entry);
  checkProfileFile("tangential_profile", settings.forms.tangential_profile, settings.tangential_profile_file, entry);
  if (!settings.contours.empty() && settings.forms.shape != deform::Shape::contour) {
    entry.fail("contours is read only with shape = \"contour\"");
  }
}

std::vector<Key<StrainSettings>> strainKeys() {
  using S = StrainSettings;
  return {
      choice<S, deform::StrainKind>("kind", &S::kind, {"edges", "principal"},
                                    "Mean of a vertex's edges, or its larger principal strain, which shows shear "
                                    "too (E24)."),
      number<S>("range_percent", &S::range_percent, above(0, 1000),
                "Strain that is drawn in full red (tension) or full blue (compression)."),
  };
}

}  // namespace palpate::scene
