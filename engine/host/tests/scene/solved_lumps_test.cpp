// `[tissue] lumps = "solved"`: where solved lumps come from, how they are kept, and what a table makes of them.
#include "palpate/scene/solved_lumps.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "host/tests/scene/dome_scene.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/tissue/layered_table.h"
#include "support/error_message.h"
#include "support/lump_field.h"

namespace palpate::scene {
namespace {

/// A solver that says 1.5 times what the table of the same layers would, and counts how often it is asked.
class SolvedLumps : public DomeScene {
 protected:
  void SetUp() override {
    ::setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
    writeDome("dome.obj");
    tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
    setLumpSolver([this](const tissue::LumpShape& shape, const tissue::LayerStack&) {
      ++asked_;
      std::vector<SolvedPush> pushes;
      for (const double depth : {1.0, 4.0, 8.0}) {
        pushes.push_back({depth, 1.5 * test::inventedEnergy(shape).at(0.0, depth).d_depth});
      }
      return pushes;
    });
  }
  void TearDown() override {
    setLumpSolver(nullptr);
    ::unsetenv("XDG_STATE_HOME");
  }
  Scene sceneWith(const std::string& force, double ratio = 5.0) const {
    return meshScene("[tissue]\nlayer_table = \"back.json\"\nlumps = \"" + force +
                     "\"\n[[lump]]\ndepth_mm = 5\nstiffness_ratio = " + std::to_string(ratio) + "\n");
  }
  double pushAt(const World& world, double rho_mm, double depth_mm) const {
    return world.lumps.at(0)->unscaled.at(rho_mm, depth_mm).d_depth;
  }
  std::filesystem::path keptFile() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "palpate/lumps")) return entry.path();
    return {};
  }

  int asked_ = 0;
};

TEST_F(SolvedLumps, SetTheForceOfATableRightOverTheMiddleAndKeepItConservative) {
  const auto by_table = build(sceneWith("table"));
  EXPECT_EQ(asked_, 0);
  const auto solved = build(sceneWith("solved"));
  EXPECT_EQ(asked_, 1);
  for (const double depth : {1.0, 3.0, 6.0, 8.0}) {
    EXPECT_NEAR(pushAt(*solved, 0.0, depth), 1.5 * pushAt(*by_table, 0.0, depth), 0.01 * pushAt(*by_table, 0.0, depth));
    EXPECT_NEAR(pushAt(*solved, 4.0, depth), 1.5 * pushAt(*by_table, 4.0, depth), 0.01 * pushAt(*by_table, 0.0, depth));
  }
}

TEST_F(SolvedLumps, AreSolvedOnceAndThenReadByThoseWithoutASolver) {
  const auto first = build(sceneWith("solved"));
  setLumpSolver(nullptr);
  const auto again = build(sceneWith("solved"));
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(pushAt(*first, 0.0, 5.0), pushAt(*again, 0.0, 5.0)) << "to the bit";
  const std::string fault = support::thrownMessage([&] { build(sceneWith("solved", 6.0)); });
  EXPECT_NE(fault.find("s.toml:"), std::string::npos) << fault;
  EXPECT_NE(fault.find("lump 'lump1' is not solved yet; for [tissue] lumps = \"solved\" run `palpate lump solve`"),
            std::string::npos)
      << fault;
}

TEST_F(SolvedLumps, ACorruptedFileIsSolvedAgain) {
  build(sceneWith("solved"));
  const std::string head = "solved lump, version 1: depth_mm extra_n\n";
  for (const std::string& text :
       {std::string(), head, head + "1 nan\n", head + "inf 1\n", head + "1 x\n", head + "x 1\n", head + "1\n",
        head + "1 2 3\n", head + "0 1\n", head + "2 0.1\n1 0.2\n", std::string("something else\n1 2\n")}) {
    asked_ = 0;
    std::ofstream(keptFile()) << text;
    build(sceneWith("solved"));
    EXPECT_EQ(asked_, 1) << text;
  }
  asked_ = 0;
  std::ofstream(keptFile()) << head << "4 0.2\n";
  build(sceneWith("solved"));
  EXPECT_EQ(asked_, 0) << "one press is a solution";
}

TEST_F(SolvedLumps, AFolderThatCannotBeWrittenIsNoReasonToRefuseAWorld) {
  std::ofstream(folder_ / "file") << "";
  ::setenv("XDG_STATE_HOME", (folder_ / "file").c_str(), 1);
  EXPECT_NO_THROW(build(sceneWith("solved")));
  EXPECT_EQ(asked_, 1);
}

TEST(CorrectionOf, ATableWithHardlyAnyForceIsLeftAsItIsAndNoneIsTurnedRound) {
  tissue::LumpShape shape{.half_axes_mm = {2.0, 2.0, 2.0}, .depth_mm = 3.0, .stiffness_ratio = 1.0000001};
  const auto none = correctionOf(std::vector<SolvedPush>{{2.0, 0.1}}, test::inventedEnergy(shape));
  EXPECT_EQ(none.at(0).factor, 1.0);
  shape.stiffness_ratio = 10.0;
  const auto turned = correctionOf(std::vector<SolvedPush>{{4.0, -1.0}}, test::inventedEnergy(shape));
  EXPECT_GT(turned.at(0).factor, 0.0);
}

}  // namespace
}  // namespace palpate::scene
