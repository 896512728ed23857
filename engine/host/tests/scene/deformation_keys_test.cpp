#include <gtest/gtest.h>

#include <fstream>

#include "host/tests/scene/scene_text.h"
#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

TEST(DeformationKeys, EveryFormHasAName) {
  const Scene scene = parse(R"(
[deformation]
profile = "two_gaussians"
profile_wide_weight = -0.1
tangential_profile = "power"
tangential_profile_tail_exponent = 0.7
shape = "circle"
search = "octree"
region = "shared"
boundary = "two_mm"
together = "summed"
normals = "incremental"
radial_share = 0.08
[strain]
kind = "principal"
)" + kFinger,
                            "s.toml");
  const deform::FormSettings& forms = scene.deformation.forms;
  EXPECT_EQ(forms.normal_profile.kind, tissue::ProfileKind::two_gaussians);
  EXPECT_EQ(forms.normal_profile.two_gaussians.wide_weight, -0.1);
  EXPECT_EQ(forms.tangential_profile.kind, tissue::ProfileKind::power);
  EXPECT_EQ(forms.tangential_profile.power.exponent, 0.7);
  EXPECT_EQ(forms.shape, deform::Shape::circle);
  EXPECT_EQ(forms.search, deform::Search::octree);
  EXPECT_EQ(forms.region, deform::NormalRegion::shared);
  EXPECT_EQ(forms.boundary, deform::Boundary::two_mm);
  EXPECT_EQ(forms.together, deform::Together::summed);
  EXPECT_EQ(forms.common.normals, deform::Normals::incremental);
  EXPECT_EQ(forms.radial.share, 0.08);
  EXPECT_EQ(formsOf(scene).strain_kind, deform::StrainKind::principal);
}

TEST(DeformationKeys, TheTableOfTheDissertation) {
  const Scene scene = parse(R"(
[deformation]
profile = "table"
profile_rim = "step"
profile_entries = 130
profile_lookup = "linear"
)" + kFinger,
                            "s.toml");
  const tissue::ProfileSettings& profile = scene.deformation.forms.normal_profile;
  EXPECT_EQ(profile.kind, tissue::ProfileKind::table);
  EXPECT_EQ(profile.rim, tissue::ProfileRim::step);
  EXPECT_EQ(profile.table_entries, 130u);
  EXPECT_EQ(profile.lookup, tissue::TableLookup::linear);
}

TEST(DeformationKeys, NothingSaidIsTheFastPath) { EXPECT_FALSE(deform::needsForms(formsOf(parse(kFinger, "s.toml")))); }

TEST(DeformationKeys, FidelityReachesTheForms) {
  const Scene scene = parse("fidelity.E14 = \"literal\"\n" + kFinger, "s.toml");
  EXPECT_TRUE(formsOf(scene).fidelity.literal(Erratum::E14_location_ratio));
  EXPECT_TRUE(deform::needsForms(formsOf(scene)));
}

TEST(DeformationKeys, NamesWhatDoesNotGoTogether) {
  support::expectEach(
      messageWithFinger,
      {{"[deformation]\nprofile = \"user\"\n", "s.toml:1: [deformation] profile = \"user\" needs profile_file"},
       {"[deformation]\ntangential_profile_file = \"mine.csv\"\n",
        "s.toml:1: [deformation] tangential_profile_file is read only with tangential_profile = \"user\""},
       {"[deformation]\ncontours = \"c.csv\"\n",
        "s.toml:1: [deformation] contours is read only with shape = \"contour\""}});
  EXPECT_TRUE(messageFor("[deformation]\nprofile = \"gauss\"\n" + kFinger)
                  .starts_with("s.toml:2: [deformation] profile must be \"half_gaussian\" or"));
  EXPECT_EQ(messageFor("[deformation]\nprofile_entries = 1\n" + kFinger),
            "s.toml:2: [deformation] profile_entries = 1 is out of range: 2 to 1,000,000");
  EXPECT_EQ(messageFor("[strain]\nkind = \"shear\"\n" + kFinger),
            "s.toml:2: [strain] kind must be \"edges\" or \"principal\", not \"shear\"");
}

TEST(DeformationKeys, UserProfileIsReadBesideTheScene) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "mine.csv") << "q,value\n0,1\n0.4,0.2\n1,0\n";
  std::ofstream(folder / "s.toml") << "[deformation]\nprofile = \"user\"\nprofile_file = \"mine.csv\"\n" << kFinger;
  const deform::FormSettings forms = formsOf(load(folder / "s.toml"));
  ASSERT_EQ(forms.normal_profile.knots.size(), 3u);
  EXPECT_EQ(forms.normal_profile.knots[1].value, 0.2);
}

TEST(DeformationKeys, FaultyUserProfileNamesFileAndLine) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "mine.csv") << "0,1\n0.4,0.2\n0.3,0\n";
  std::ofstream(folder / "s.toml") << "[deformation]\nprofile = \"user\"\nprofile_file = \"mine.csv\"\n" << kFinger;
  try {
    formsOf(load(folder / "s.toml"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), (folder / "mine.csv").string() + ":3: q must ascend: 0.3 after 0.4");
  }
}

}  // namespace
}  // namespace palpate::scene
