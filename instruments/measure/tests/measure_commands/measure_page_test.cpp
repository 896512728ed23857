// docs/howto/measure-a-person.md does what it says: its commands, one after the other, in a folder of their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "palpate/maps/key_points.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

struct PageCommand {
  std::string arguments;
  int exit_code = 0;
};

/// Lines "palpate ..." of its blocks of sh; "# exits 1" says how one ends.
std::vector<PageCommand> commandsOfPage() {
  std::istringstream page(support::contentOf(support::sourceFolder() / "docs/howto/measure-a-person.md"));
  const std::regex ending("# exits ([0-9]+)");
  std::vector<PageCommand> commands;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) inside = line == "```sh";
    if (!inside || !line.starts_with("palpate ")) continue;
    PageCommand command{line.substr(8, line.find('#') - 8)};
    std::smatch match;
    if (std::regex_search(line, match, ending)) command.exit_code = std::stoi(match[1]);
    commands.push_back(std::move(command));
  }
  return commands;
}

/// Half as many pixels as on the page are painted and read in half the time, and say the same.
std::string smallerPicture(const std::string& arguments) {
  return arguments.starts_with("measure synthesize ") ? " --megapixels 1" : "";
}

TEST(MeasureAPerson, EveryCommandOfThePageDoesWhatThePageSays) {
  const support::TemporaryFolder folder;
  fs::copy_file(support::sourceFolder() / "examples/scenes/measured/appendix_c.csv", folder / "appendix_c.csv");
  std::ofstream forces(folder / "forces.csv");
  forces << "place,x_mm,y_mm,press,depth_mm,force_n\n";
  for (int i = 1; i <= 12; ++i) forces << fmt::format("P1,0,73,1,{},{:.4f}\n", i, 0.4 * i * std::pow(i / 8.0, 0.6));
  forces.close();

  const std::vector<PageCommand> commands = commandsOfPage();
  ASSERT_GE(commands.size(), 14u) << "the page has lost its commands";
  for (const PageCommand& command : commands) {
    const auto result = support::runPalpate(command.arguments + smallerPicture(command.arguments), folder.path());
    ASSERT_EQ(result.exit_code, command.exit_code) << command.arguments << "\n" << result.out << result.err;
  }

  // What was painted is what was measured: no direction of the tissue's own, pulls that stretch it by 1.3.
  const auto keys = maps::readKeyPoints(folder / "P07/person.csv");
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_NEAR(keys[0].ellipse.half_major_mm, 80.0 / std::sqrt(1.3), 3.0);
  EXPECT_NEAR(keys[1].ellipse.half_major_mm, 70.0 / std::sqrt(1.3), 3.0);
  for (const auto& key : keys) EXPECT_GT(key.ellipse.aspect, 0.93) << key.name;
  for (const char* file : {"stencil.svg", "one.png", "P07/P1_up_1_overlay.png", "P07/P1_up_1.json", "P07/scene.toml",
                           "stiff.csv", "map.png", "seen.png", "everybody.csv", "keys.csv", "felt/forces.csv"}) {
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  }
  EXPECT_EQ(maps::readKeyPoints(folder / "keys.csv").size(), 7u);
}

}  // namespace
}  // namespace palpate
