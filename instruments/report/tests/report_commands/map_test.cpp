// `palpate body map` from the outside: what it writes is read back and compared with the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "palpate/base/csv.h"
#include "palpate/maps/contour_map.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/maps/measured_stiffness.h"
#include "palpate/maps/stiffness_map.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

/// Columns of a table by name.
using Table = std::map<std::string, std::vector<double>>;

Table tableOf(const std::filesystem::path& file) {
  Table table;
  std::vector<std::string> names;
  const std::string text = contentOf(file);
  forEachCsvRow(text, file.string(), [&](const CsvRow& row) {
    if (names.empty()) {
      names.assign(row.fields.begin(), row.fields.end());
      return;
    }
    ASSERT_EQ(row.fields.size(), names.size());
    for (std::size_t c = 0; c < names.size(); ++c) table[names[c]].push_back(csvNumber(row, c, names[c]));
  });
  return table;
}

class Map : public ::testing::Test {
 protected:
  void SetUp() override { writeHill(); }

  /// A hill 400 mm wide and 60 mm high under the seven key points.
  void writeHill() const { mesh::save(folder_ / "hill.obj", zoo::dome({-200.0, -250.0}, 20.0, 60.0)); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CommandResult map(const std::string& arguments) const { return runPalpate("body map " + arguments, folder_.path()); }
  nlohmann::json runForJson(const std::string& arguments) const {
    const CommandResult result = map(arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }
  /// The error of a run that must end with exit code 2 and exactly one line.
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = map(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(!result.err.empty() && result.err.find('\n') == result.err.size() - 1) << "one line: " << result.err;
    return result.err;
  }

  support::TemporaryFolder folder_;
};

TEST_F(Map, EllipsesAsATableAreThoseOfTheLibrary) {
  runForJson("ellipses hill.obj -o e.csv");
  const Table table = tableOf(folder_ / "e.csv");
  const maps::EllipseMap ellipses(maps::dissertationKeyPoints());
  ASSERT_EQ(table.at("x_mm").size(), 441u);
  for (std::size_t v = 0; v < 441; ++v) {
    const maps::Ellipse e = ellipses.at(table.at("x_mm")[v], table.at("y_mm")[v]);
    EXPECT_NEAR(table.at("half_major_mm")[v], e.half_major_mm, 1e-9);
    EXPECT_NEAR(table.at("aspect")[v] * table.at("major_over_minor")[v], 1.0, 1e-12);
    EXPECT_NEAR(table.at("direction_deg")[v], e.direction_rad * kDegPerRad, 1e-9);
    const Vec3 axis(table.at("axis_x_mm")[v], table.at("axis_y_mm")[v], table.at("axis_z_mm")[v]);
    EXPECT_NEAR(axis.norm(), e.half_major_mm, 1e-9);  // lifted, its length restored
  }
}

TEST_F(Map, AGridHasARowAtEveryNodeOverTheSkin) {
  runForJson("ellipses hill.obj -o g.csv --grid-mm 50 --data down --averaging tensorial");
  const Table table = tableOf(folder_ / "g.csv");
  ASSERT_EQ(table.at("x_mm").size(), 81u);  // 9 x 9 of 400 mm
  const maps::EllipseMap ellipses(
      maps::dissertationKeyPoints({maps::ForceDirection::down, maps::Averaging::tensorial}));
  for (std::size_t i = 0; i < 81; ++i) {
    EXPECT_NEAR(table.at("half_major_mm")[i], ellipses.at(table.at("x_mm")[i], table.at("y_mm")[i]).half_major_mm,
                1e-9);
  }
}

TEST_F(Map, PrintedFormsAreThoseOfTheLibrary) {
  const nlohmann::json exact = runForJson("ellipses hill.obj -o e.csv");
  EXPECT_LT(exact["fit_error"]["half_major_mm"]["max"], 1e-9);
  const nlohmann::json misses = runForJson("ellipses hill.obj -o n.csv --interpolation single-effects");
  EXPECT_GT(misses["fit_error"]["half_major_mm"]["max"], 3.0);  // (5.7) misses its keys
  runForJson("ellipses hill.obj -o l.csv --fidelity E28,E29");
  Fidelity fidelity;
  fidelity.setLiteral(Erratum::E28_effect_radius);
  fidelity.setLiteral(Erratum::E29_mean_of_angles);
  const maps::LiteralEllipseMap literal(maps::dissertationKeyPoints(), {}, fidelity);
  const Table table = tableOf(folder_ / "l.csv");
  for (std::size_t v = 0; v < 441; ++v) {
    const maps::Ellipse e = literal.at(table.at("x_mm")[v], table.at("y_mm")[v]);
    EXPECT_NEAR(table.at("half_major_mm")[v], e.half_major_mm, 1e-9);
    EXPECT_NEAR(table.at("direction_deg")[v], e.direction_rad * kDegPerRad, 1e-9);
  }
}

TEST_F(Map, TheColouredSurfaceIsTheSkin) {
  runForJson("ellipses hill.obj -o e.ply --quantity aspect");
  const mesh::TriangleMesh before = mesh::load(folder_ / "hill.obj");
  const mesh::TriangleMesh after = mesh::load(folder_ / "e.ply");
  EXPECT_EQ(after.positions, before.positions);
  EXPECT_EQ(after.triangles, before.triangles);
  const std::string header = contentOf(folder_ / "e.ply").substr(0, 2000);
  for (const char* property : {"half_major_mm", "aspect", "direction_deg", "axis_z_mm", "red", "green", "blue"}) {
    EXPECT_NE(header.find(std::string(" ") + property + "\n"), std::string::npos) << property;
  }
}

TEST_F(Map, PicturesHaveAxesALegendAndTheKeyPoints) {
  runForJson("ellipses hill.obj -o e.svg -o e.png --range 120,180");
  const std::string svg = contentOf(folder_ / "e.svg");
  for (const char* text :
       {"Deformation ellipses: half-major axis", "half-major axis (mm)", "(mm)", "P1", "P7", "150"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(contentOf(folder_ / "e.png").substr(1, 3), "PNG");
}

TEST_F(Map, TheRangeIsThatOfTheDataOrAsAskedFor) {
  EXPECT_EQ(runForJson("ellipses hill.obj -o e.csv --range 100,200")["range"], nlohmann::json({100.0, 200.0}));
  const auto range = runForJson("ellipses hill.obj -o e.csv")["range"];
  EXPECT_NEAR(range[0].get<double>() + range[1].get<double>(), 300.0, 1e-9);  // the basic circle is in the middle
  EXPECT_EQ(runForJson("ellipses hill.obj -o e.csv --quantity direction")["range"], nlohmann::json({0.0, 180.0}));
}

TEST_F(Map, SaysWhatOfTheMeshIsLeftOut) {
  std::ofstream(folder_ / "hill.obj", std::ios::app) << "l 1 2\nl 2 3\n";
  EXPECT_EQ(runForJson("ellipses hill.obj -o e.csv")["notes"], nlohmann::json({"hill.obj: left out: lines (2)"}));
  EXPECT_NE(map("ellipses hill.obj -o e.csv").out.find("note: hill.obj: left out: lines (2)"), std::string::npos);
}

TEST_F(Map, ContoursFromATableAndFromTheBuiltInEllipses) {
  write("contours.csv", "name,x_mm,y_mm,r0_mm,r1_mm,r2_mm,r3_mm\nA,0,-50,100,50,80,60\n");
  const nlohmann::json summary = runForJson("contours hill.obj --keys contours.csv -o c.csv -o c.svg");
  EXPECT_EQ(summary["radii"], 4);
  EXPECT_LT(summary["fit_error"]["radius_mm"]["max"], 1e-9);
  const maps::PolarContourMap contours(maps::readContourPoints(folder_ / "contours.csv"));
  const Table table = tableOf(folder_ / "c.csv");
  for (std::size_t v = 0; v < 441; ++v) {
    const maps::PolarContour here = contours.at(table.at("x_mm")[v], table.at("y_mm")[v]);
    EXPECT_NEAR(table.at("r3_mm")[v], std::exp(here.log_radii[3]), 1e-9);
  }
  EXPECT_EQ(runForJson("contours hill.obj --radii 8 -o c.csv")["radii"], 8);
}

TEST_F(Map, StiffnessByEachInterpolationWithItsFitError) {
  write("keys.csv",
        "A,-100,-150,100,1,90,0.3\nB,100,-150,100,1,90,0.5\nC,-100,100,100,1,90,0.6\nD,100,100,100,1,90,0.9\n"
        "E,0,0,100,1,90,0.4\n");
  const auto keys = maps::readKeyPoints(folder_ / "keys.csv");
  const auto check = [&](const std::string& word, maps::StiffnessInterpolation interpolation) {
    const nlohmann::json summary =
        runForJson("stiffness hill.obj --keys keys.csv --degree 1 -o s.csv --interpolation " + word);
    maps::MeasuredStiffness settings;
    settings.interpolation = interpolation;
    settings.polynomial_degree = 1;
    const maps::MeasuredStiffnessField field(keys, settings);
    EXPECT_NEAR(summary["fit_error_n_per_mm"]["max"], field.fitError().max, 1e-12) << word;
    const Table table = tableOf(folder_ / "s.csv");
    for (std::size_t v = 0; v < 441; ++v) {
      EXPECT_NEAR(table.at("stiffness_n_per_mm")[v], field.at(Vec2(table.at("x_mm")[v], table.at("y_mm")[v])), 1e-12);
    }
  };
  check("gri", maps::StiffnessInterpolation::gri);
  check("thin-plate", maps::StiffnessInterpolation::thin_plate);
  check("polynomial", maps::StiffnessInterpolation::polynomial);
}

TEST_F(Map, StiffnessOfTheTorsoComesFromItsBones) {
  const nlohmann::json summary = runForJson("stiffness --triangles 8163 -o s.ply -o s.svg");
  EXPECT_EQ(summary["source"], "depth of the bones");
  EXPECT_GT(summary["range"][1], 0.8);
  const nlohmann::json fit = runForJson("stiffness --triangles 8163 -o s.csv --interpolation thin-plate");
  EXPECT_EQ(fit["keys"].size(), 7u);
  EXPECT_LT(fit["fit_error_n_per_mm"]["max"], 1e-9);
}

TEST_F(Map, OfASceneHasItsDysfunctionsInIt) {
  write("scene.toml",
        "title = \"Monday\"\n[body]\nkind = \"mesh\"\nfile = \"hill.obj\"\n[stiffness]\nconstant_n_per_mm = 0.4\n"
        "[[dysfunction]]\nx_mm = 40\ny_mm = -50\nradius_mm = 70\nchange_percent = 150\nedge_softness = 0.3\n");
  const nlohmann::json summary = runForJson("stiffness --scene scene.toml -o s.csv -o s.svg -o s.ply");
  EXPECT_EQ(summary["scene"], "Monday");
  EXPECT_EQ(summary["dysfunctions"][0]["change_percent"], 150.0);
  EXPECT_NEAR(summary["range"][1], 1.0, 1e-9);  // 0.4 N/mm and 150 % more
  const maps::Dysfunction hard{.x_mm = 40, .y_mm = -50, .radius_mm = 70, .change_percent = 150, .edge_softness = 0.3};
  const Table table = tableOf(folder_ / "s.csv");
  ASSERT_EQ(table.at("x_mm").size(), 441u);
  for (std::size_t v = 0; v < 441; ++v) {
    const double factor = maps::stiffnessFactor(hard, {table.at("x_mm")[v], table.at("y_mm")[v]});
    EXPECT_NEAR(table.at("stiffness_n_per_mm")[v], 0.4 * factor, 1e-12);
  }
  const std::string svg = contentOf(folder_ / "s.svg");
  for (const char* text : {"Stiffness of the body", "Scene: Monday", "stiffness (N/mm)", "dysfunctions", "+150 %"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST_F(Map, OfASceneTakesItsKeyPointsAndBones) {
  write("keys.csv", "A,-100,-150,90,1.2,80\nB,100,100,120,1.1,100\n");
  write("hill.toml",
        "[body]\nkind = \"mesh\"\nfile = \"hill.obj\"\n[ellipses]\nkey_points = \"keys.csv\"\nbasic_radius_mm = 100\n");
  const nlohmann::json summary = runForJson("ellipses --scene hill.toml -o e.csv");
  EXPECT_NEAR(summary["basic_radius_mm"].get<double>(), 100.0, 1e-9);
  const maps::EllipseMap ellipses(maps::readKeyPoints(folder_ / "keys.csv"), {.basic_radius_mm = 100.0});
  const Table table = tableOf(folder_ / "e.csv");
  for (std::size_t v = 0; v < 441; ++v) {
    const double at_vertex = ellipses.at(table.at("x_mm")[v], table.at("y_mm")[v]).half_major_mm;
    EXPECT_NEAR(table.at("half_major_mm")[v], at_vertex, 1e-9);
  }
  EXPECT_EQ(runForError("contours --scene hill.toml -o c.csv"),
            "palpate: map contours: the scene's drags have ellipses; set [deformation] shape = \"contour\"\n");
  write("torso.toml", "[body]\nkind = \"torso\"\ntriangles = 8163\n");
  runForJson("depth --scene torso.toml -o d.csv");
  runForJson("depth --triangles 8163 -o bare.csv");
  std::vector<double> of_scene = tableOf(folder_ / "d.csv").at("bone_depth_mm");
  std::vector<double> bare = tableOf(folder_ / "bare.csv").at("bone_depth_mm");
  std::ranges::sort(of_scene);  // the scene's skin is ordered in space
  std::ranges::sort(bare);
  EXPECT_EQ(of_scene, bare);
  EXPECT_EQ(runForError("depth --scene hill.toml -o d.csv"),
            "palpate: map depth: needs bones, which only the built-in torso has\n");
  EXPECT_NE(runForError("stiffness hill.obj --scene hill.toml -o s.csv").find("mesh excludes --scene"),
            std::string::npos);
  EXPECT_NE(runForError("ellipses --keys keys.csv --scene hill.toml -o s.csv").find("--keys excludes --scene"),
            std::string::npos);
}

TEST_F(Map, OfASceneHasTheContoursThatFollowBonesAndFolds) {
  const std::string trunk = "[body]\nkind = \"trunk\"\ntriangles = 20000\n";  // with a cleft, armpits and stumps
  write("ellipses.toml", trunk);
  write("contours.toml", trunk + "[deformation]\nshape = \"contour\"\ntissue = \"gaussian\"\n");
  write("layers.toml", trunk + "[deformation]\nshape = \"contour\"\n");
  runForJson("ellipses --scene ellipses.toml -o e.csv");
  const nlohmann::json summary = runForJson("contours --scene contours.toml -o c.csv");
  EXPECT_EQ(summary["map"], "contours");
  const Table measured = tableOf(folder_ / "e.csv");
  const Table bent = tableOf(folder_ / "c.csv");
  runForJson("contours --scene layers.toml -o l.csv");
  const std::vector<double> rims = tableOf(folder_ / "l.csv").at("mean_radius_mm");
  EXPECT_LE(*std::ranges::max_element(rims), 160.0 + 1e-9) << "the rim of a tenth lies beyond what was measured";
  EXPECT_LT(*std::ranges::min_element(rims), 0.5 * 160.0);
  std::size_t shorter = 0;
  std::size_t lopsided = 0;
  const std::size_t vertices = bent.at("mean_radius_mm").size();
  for (std::size_t v = 0; v < vertices; ++v) {
    EXPECT_LE(bent.at("mean_radius_mm")[v], 1.001 * measured.at("half_major_mm")[v]);
    shorter += bent.at("mean_radius_mm")[v] < 0.8 * measured.at("half_major_mm")[v] ? 1 : 0;
    lopsided += std::abs(std::log(bent.at("r0_mm")[v] / bent.at("r6_mm")[v])) > 0.2 ? 1 : 0;
  }
  EXPECT_GT(shorter, vertices / 50);
  EXPECT_GT(lopsided, vertices / 50) << "an ellipse is the same both ways";
}

TEST_F(Map, WrongInputIsOneLine) {
  EXPECT_EQ(runForError("ellipses hill.obj -o e.txt"),
            "palpate: e.txt: a map's name must end in one of .csv, .ply, .png, .svg\n");
  EXPECT_EQ(runForError("ellipses hill.obj -o e.csv --range 5,2"),
            "palpate: map: --range must be LOW,HIGH with LOW below HIGH\n");
  EXPECT_EQ(runForError("stiffness hill.obj -o e.csv"),
            "palpate: map stiffness: needs --keys with a stiffness, or the torso's bones\n");
  write("keys.csv", "A,0,0,100,1,90\n");
  EXPECT_EQ(runForError("stiffness hill.obj --keys keys.csv -o e.csv"),
            "palpate: keys.csv: no key point has a stiffness_n_per_mm; at least one is needed\n");
  write("keys.csv", "A,0,0,100,1,90,0.5\n");
  EXPECT_EQ(runForError("stiffness hill.obj --keys keys.csv -o e.csv --interpolation polynomial"),
            "palpate: polynomial of degree 2: requires 6 key points, got 1\n");
  write("keys.csv", "A,0,0,100\n");
  EXPECT_NE(runForError("contours hill.obj --keys keys.csv -o e.csv").find("keys.csv:1: expected name"),
            std::string::npos);
  EXPECT_NE(runForError("ellipses hill.obj --fidelity E99 -o e.csv").find("E99"), std::string::npos);
  EXPECT_NE(runForError("ellipses hill.obj").find("--out is required"), std::string::npos);
}

}  // namespace
}  // namespace palpate
