// The list of errata itself, and the words in which files and commands choose among them.
#include "palpate/scene/errata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

constexpr auto kWrong = Severity::wrong;
constexpr auto kAmbiguous = Severity::ambiguous;
constexpr auto kCosmetic = Severity::cosmetic;
constexpr auto kSwitch = LiteralForm::switchable;
constexpr auto kSetting = LiteralForm::setting;
constexpr auto kNone = LiteralForm::none;
constexpr auto kCorrected = ByDefault::corrected;
constexpr auto kAsPrinted = ByDefault::as_printed;
constexpr auto kOwnChoice = ByDefault::own_choice;

// A row: erratum, severity, how to get the printed form, the default; what is printed, what the engine does instead;
// and last what the switch acts on, the name of the setting, or why it cannot be switched (ErratumText::choice).
constexpr std::array<ErratumText, kErrata> kTexts = {{
    {Erratum::E1_anchor, kWrong, kSwitch, kCorrected,
     "(2.5), (2.6): the anchor as P - (F_t/F_n) P_d with all symbols vectors lies on the normal line",
     "the engine keeps the anchor as state, on the skin",
     "the anchor of the deformation: (2.6) of each moment's force, with F_t a vector and F_n, P_d along the normal"},
    {Erratum::E2_drag_spring, kAmbiguous, kSetting, kOwnChoice,
     "20 mm of drag at 10 mm depth are beyond the friction cone",
     "the tangential spring has a stiffness of its own: 1 times the normal one, within the 0.6 to 1.1 of tissue; 0.23 "
     "brings the 20 mm back in half-Gaussian tissue",
     "friction.stiffness_ratio"},
    {Erratum::E3_stiffness_place, kCosmetic, kNone, kCorrected, "1.3.1 sums springs at three nodes, 2.2 says F = k d",
     "2.2, with k interpolated in the triangle", "1.3.1 describes other systems"},
    {Erratum::E4_else_if, kWrong, kSwitch, kCorrected, "the traversal's ELSEIF never visits both children",
     "two independent ifs", "the partition's traversal (contact.source = \"hdb\")"},
    {Erratum::E5_cell_box, kWrong, kSwitch, kCorrected,
     "a triangle may stick out of its leaf's box, which is what the query tests",
     "every node stores the tight box of its triangles", "the partition's traversal (contact.source = \"hdb\")"},
    {Erratum::E6_three_octants, kWrong, kSwitch, kCorrected,
     "a triangle with vertices in three octants belongs to none", "majority axis by axis",
     "the octree's assignment C (contact.source = \"hdb\")"},
    {Erratum::E7_leaf_threshold, kAmbiguous, kSwitch, kCorrected, "the text stops below the threshold, the code at it",
     "a leaf holds at most the threshold; depth limit and a stop without progress",
     "the partition's leaf rule (contact.source = \"hdb\")"},
    {Erratum::E8_empty_child, kWrong, kNone, kCorrected, "mod(level/3); a child is read after it was set to empty",
     "level mod 3; empty children dropped", "the printed code reads a null pointer"},
    {Erratum::E9_vertex_on_plane, kAmbiguous, kNone, kCorrected, "which side a vertex on the plane belongs to",
     "the positive side, in build and query alike", "the text does not say"},
    {Erratum::E10_half_spaces, kWrong, kSwitch, kCorrected,
     "the BSP query asks infinite half spaces and renders far leaves", "the tight box (E5)",
     "the partition's traversal (contact.source = \"hdb\")"},
    {Erratum::E11_sphere_corners, kWrong, kSwitch, kCorrected,
     "a sphere meets a box when a corner of the box lies in it", "nearest-point distance",
     "the octree's traversal (contact.source = \"hdb\")"},
    {Erratum::E12_box_edges, kAmbiguous, kSwitch, kCorrected,
     "the detecting box is a quarter of the model's box, or of its longest edge",
     "a cube of a quarter of the longest edge", "the shape of the detecting box (contact.source = \"hdb\")"},
    {Erratum::E13_misprints, kCosmetic, kNone, kCorrected, "misprints in Table 3.3 and in figure numbers",
     "computed values", "nothing to switch"},
    {Erratum::E14_location_ratio, kWrong, kSwitch, kCorrected,
     "(4.13) uses the eccentric angle as the polar angle: a pedal curve, not the ellipse", "q = hypot(u/a, v/b)",
     "the shape of the deformation regions"},
    {Erratum::E15_aspect, kWrong, kSwitch, kCorrected, "t is minor/major in chapter 4 and major/minor in chapter 5",
     "aspect = minor/major inside, major_over_minor in files", "the aspect of the ellipse map"},
    {Erratum::E16_full_axes, kWrong, kSwitch, kCorrected, "half axes in chapter 4, full axes in Fig 5.3 and Appendix C",
     "half axes in mm", "the size of the built-in key ellipses"},
    {Erratum::E17_depth_or_force, kAmbiguous, kNone, kCorrected,
     "P_n is a depth and a force, P_t a direction, a force and a displacement",
     "displacements: d_n = -M depth n, d_t = M f_adj (P - A)", "(4.5) cannot be evaluated as printed"},
    {Erratum::E18_profile_rim, kAmbiguous, kSwitch, kCorrected, "the table ends at 0.0021 and jumps to 0 at the rim",
     "the curve lowered and stretched to end at 0", "the half-Gaussian profile: 700 entries, nearest, not lowered"},
    {Erratum::E19_drag_cap, kWrong, kSwitch, kCorrected,
     "(4.18) is lost; a cap on each component fits the text as well",
     "the vector's length is capped, a negative depth is none", "the cap on the drag"},
    {Erratum::E20_zero_boundary, kAmbiguous, kSetting, kAsPrinted, "the measured \"zero\" boundary is the 2 mm contour",
     "as measured; or the axes times 1.635, which puts 2 mm where it was measured", "deformation.boundary"},
    {Erratum::E21_press_region, kAmbiguous, kSwitch, kCorrected,
     "the press has a boundary \"linear in P_n\", the same ellipse, or a smaller one", "its own circle R0 + c depth",
     "the region of the press: the map's ellipse"},
    {Erratum::E22_one_ellipse, kAmbiguous, kNone, kAsPrinted, "one measured ellipse covers 63 % of the back",
     "as measured", "nothing to switch"},
    {Erratum::E23_region_search, kAmbiguous, kSwitch, kCorrected,
     "the ring search may stop early and has no test of the facing side",
     "a connected region that faces the finger, from the anchor's triangle, and ends along the normal",
     "the search for the region"},
    {Erratum::E24_pure_shear, kAmbiguous, kSetting, kAsPrinted, "(4.20) averages edge strains, which hides pure shear",
     "(4.20); principal strain beside it", "strain.kind"},
    {Erratum::E25_two_fingers, kCosmetic, kSetting, kCorrected, "how two fingers combine is not said",
     "solved together, so that each depth holds", "deformation.together"},
    {Erratum::E26_weight_formulae, kWrong, kSwitch, kCorrected, "wrong indices and factors in (5.12), (5.14) to (5.16)",
     "the products that make the keys exact", "the weights of the ellipse map"},
    {Erratum::E27_weight_zero_by_zero, kWrong, kSwitch, kCorrected,
     "(5.16) is 0/0 out of all reach and where two keys coincide", "w = a/(1 - a): the base, or the mean of the keys",
     "the weights of the ellipse map: the printed products, and the basic circle where they are 0/0"},
    {Erratum::E28_effect_radius, kAmbiguous, kSwitch, kCorrected,
     "e = 400 is called a radius, but only as a diameter gives Table 5.1", "an effect radius of 200 mm",
     "the reach of the key points: twice as far"},
    {Erratum::E29_mean_of_angles, kWrong, kSwitch, kCorrected,
     "angles are averaged as numbers, though 0 and 180 degree are the same axis", "log-Euclidean tensors",
     "the blend of the ellipse map"},
    {Erratum::E30_key_averages, kAmbiguous, kSwitch, kAsPrinted, "rows with major < minor; plain means of angles",
     "axes swapped where needed; the printed means by default, tensorial ones beside them (ellipses.averaging)",
     "the built-in key points: the printed means, whatever ellipses.averaging says"},
    {Erratum::E31_down_like_up, kAmbiguous, kSetting, kAsPrinted,
     "\"down\" is said to be similar to \"up\", and is not",
     "both are built in; \"up\" by default, as in the text's maps", "ellipses.data"},
    {Erratum::E32_vertical_skin, kAmbiguous, kSwitch, kCorrected,
     "(5.3) lengthens the axis by 1/cos and fails on a vertical surface", "the direction kept, the length restored",
     "the ellipse on the surface"},
    {Erratum::E33_unnamed_radii, kAmbiguous, kNone, kOwnChoice,
     "base radius, effect radius and key coordinates of the real back are not given",
     "assumed, and said so (docs/explanation/maps.md)", "nothing is printed"},
    {Erratum::E34_drag_direction, kAmbiguous, kNone, kAsPrinted,
     "the direction of the drag is confounded with the ellipse", "as measured", "the data cannot separate them"},
}};

const ErratumText& textOf(Erratum erratum) { return kTexts[static_cast<std::size_t>(numberOf(erratum) - 1)]; }

/// The whole of `words` is quoted to a user who misspelled one of them.
Erratum requireErratum(std::string_view name, std::string_view words) {
  const Erratum erratum = erratumNamed(name);
  if (erratum != Erratum::none) return erratum;
  throw Error(fmt::format("fidelity must be \"{}\" or errata such as E14,E29; got '{}'",
                          fmt::join(enumNames<Reading>(), "\", \""), words));
}

}  // namespace

std::span<const ErratumText> errata() { return kTexts; }

std::vector<Erratum> errataByDefault(ByDefault by_default) {
  std::vector<Erratum> errata;
  for (const ErratumText& text : kTexts) {
    if (text.by_default == by_default) errata.push_back(text.erratum);
  }
  return errata;
}

std::string nameOf(Erratum erratum) { return fmt::format("E{}", numberOf(erratum)); }

Erratum erratumNamed(std::string_view name) {
  if (name.size() < 2 || (name[0] != 'E' && name[0] != 'e')) return Erratum::none;
  int number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + 1, end, number);
  return error == std::errc() && stop == end ? erratumOf(number) : Erratum::none;
}

void requireSwitchable(Erratum erratum) {
  const ErratumText& text = textOf(erratum);
  switch (text.form) {
    case LiteralForm::switchable:
      return;
    case LiteralForm::setting:
      throw Error(fmt::format("fidelity: {} cannot be switched here; see {}", nameOf(erratum), text.choice));
    case LiteralForm::none:
      throw Error(fmt::format("{} has no literal form: {}", nameOf(erratum), text.choice));
  }
}

Fidelity parseFidelity(std::string_view words) {
  Fidelity fidelity;
  if (const auto all = valueNamed<Reading>(trimmed(words))) {
    fidelity.setAll(*all == Reading::literal);
    return fidelity;
  }
  for (const std::string_view name : split(words, ',')) {
    const Erratum erratum = requireErratum(name, words);
    requireSwitchable(erratum);
    fidelity.setLiteral(erratum);
  }
  return fidelity;
}

std::string wordsOf(const Fidelity& fidelity) {
  if (!fidelity.anyLiteral()) return std::string(wordFor(Reading::corrected));
  if (fidelity == literalFidelity()) return std::string(wordFor(Reading::literal));
  std::string words;
  for (const ErratumText& text : errata()) {
    if (!fidelity.literal(text.erratum)) continue;
    if (!words.empty()) words += ',';
    words += nameOf(text.erratum);
  }
  return words;
}

}  // namespace palpate::scene
