#include "palpate/scene/errata.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "support/error_message.h"

namespace palpate::scene {
namespace {

Fidelity fidelityOf(const std::string& lines) {
  return parse(lines + "\n[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n", "s.toml").fidelity;
}

Fidelity only(std::initializer_list<Erratum> literal) {
  Fidelity fidelity;
  for (const Erratum e : literal) fidelity.setLiteral(e);
  return fidelity;
}

TEST(Errata, AreNumberedFromOneWithoutGaps) {
  ASSERT_EQ(errata().size(), static_cast<std::size_t>(kErrata));
  for (int number = 1; number <= kErrata; ++number) {
    const ErratumText& text = errata()[static_cast<std::size_t>(number - 1)];
    EXPECT_EQ(text.erratum, erratumOf(number));
    EXPECT_FALSE(text.printed.empty() || text.ours.empty() || text.choice.empty()) << number;
  }
}

/// Whether an empty scene takes the printed form of an erratum that is a setting, or one that a switch cannot show.
bool emptySceneTakesPrinted(Erratum erratum) {
  const Scene scene;
  switch (erratum) {
    case Erratum::E20_zero_boundary:
      return scene.deformation.forms.boundary == deform::Boundary::zero;
    case Erratum::E24_pure_shear:
      return scene.strain.kind == deform::StrainKind::edges;
    case Erratum::E25_two_fingers:
      return scene.deformation.forms.together != deform::Together::solved;
    case Erratum::E30_key_averages:
      return scene.ellipses.measured.averaging == maps::Averaging::plain;
    case Erratum::E31_down_like_up:
      return scene.ellipses.measured.force == maps::ForceDirection::up;
    default:
      return scene.fidelity.literal(erratum);
  }
}

TEST(Errata, StandByDefaultAsTheListSays) {
  for (const ErratumText& text : errata()) {
    if (text.form == LiteralForm::none || text.by_default == ByDefault::own_choice) continue;
    EXPECT_EQ(emptySceneTakesPrinted(text.erratum), text.by_default == ByDefault::as_printed) << nameOf(text.erratum);
  }
  EXPECT_EQ(Scene().contact.finger.stiffness_ratio, 1.0)
      << "E2: ours, within the 0.6 to 1.1 of tissue; 0.23 is the text's";
  EXPECT_EQ(errataByDefault(ByDefault::own_choice), (std::vector{Erratum::E2_drag_spring, Erratum::E33_unnamed_radii}));
}

TEST(Errata, AreNamedWithALetterAndANumber) {
  EXPECT_EQ(erratumNamed("E14"), Erratum::E14_location_ratio);
  EXPECT_EQ(erratumNamed("e1"), Erratum::E1_anchor);
  for (const char* name : {"", "E", "E0", "E35", "E1x", "14", "F3", "E-1", "E99999999999"}) {
    EXPECT_EQ(erratumNamed(name), Erratum::none) << name;
  }
}

TEST(Fidelity, IsCorrectedUnlessSaidOtherwise) {
  EXPECT_EQ(fidelityOf(""), Fidelity());
  EXPECT_EQ(fidelityOf("fidelity = \"corrected\""), Fidelity());
  EXPECT_EQ(parseFidelity("corrected"), Fidelity());
}

TEST(Fidelity, SwitchesAllErrataAtOnceOrSingleOnes) {
  EXPECT_EQ(fidelityOf("fidelity = \"literal\""), literalFidelity());
  EXPECT_EQ(fidelityOf("fidelity.E14 = \"literal\"\nfidelity.E29 = \"literal\""),
            only({Erratum::E14_location_ratio, Erratum::E29_mean_of_angles}));
  EXPECT_EQ(parseFidelity("E14, E29"), only({Erratum::E14_location_ratio, Erratum::E29_mean_of_angles}));
  Fidelity all_but_one = literalFidelity();
  all_but_one.setLiteral(Erratum::E14_location_ratio, false);
  EXPECT_EQ(fidelityOf("[fidelity]\nE14 = \"corrected\"\nall = \"literal\""), all_but_one);
}

TEST(Fidelity, SaysWhatItCannotSwitch) {
  const auto message = [](const std::string& lines) { return support::thrownMessage([&] { fidelityOf(lines); }); };
  EXPECT_EQ(message("title = \"x\"\nfidelity.E99 = \"literal\""),
            "s.toml:2: fidelity.E99 is not an erratum; expected E1 to E34, or \"all\"");
  EXPECT_EQ(message("fidelity.E22 = \"literal\""), "s.toml:1: E22 has no literal form: nothing to switch");
  EXPECT_EQ(message("fidelity.E24 = \"literal\""), "s.toml:1: fidelity: E24 cannot be switched here; see strain.kind");
  EXPECT_EQ(message("fidelity.E14 = \"printed\""),
            "s.toml:1: fidelity.E14 must be \"corrected\" or \"literal\", not \"printed\"");
  EXPECT_EQ(message("fidelity = 3"), "s.toml:1: fidelity must be a text in quotes, not a number");
  EXPECT_EQ(support::thrownMessage([] { parseFidelity("E14,E15x"); }),
            "fidelity must be \"corrected\", \"literal\" or errata such as E14,E29; got 'E14,E15x'");
}

TEST(Fidelity, IsWrittenInTheWordsThatAreRead) {
  for (const char* words : {"corrected", "literal", "E14", "E1,E14,E29"}) {
    EXPECT_EQ(wordsOf(parseFidelity(words)), words);
  }
}

}  // namespace
}  // namespace palpate::scene
