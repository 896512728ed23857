// Which tissue and law a scene comes to. That every key that changes them is announced is tried key by key, on what a
// finger feels and the skin does, not on what the choice says of itself.
#include "palpate/scene/tissue_choice.h"
#include "palpate/scene/world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "host/tests/scene/dome_scene.h"
#include "host/tests/scene/scene_text.h"
#include "palpate/base/text.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/deformation_settings.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/scene/words.h"
#include "support/mesh_zoo.h"

namespace palpate::scene {
namespace {

constexpr double kBoneMm = 20.0;

/// A sheet over bone at one depth, under the settings of a scene.
std::shared_ptr<const World> onBone(const Scene& scene) {
  std::vector<Index> source_vertex;
  BodyParts body = mendedBody(zoo::wavyGrid(20, 200.0, 0.0), "slab", {}, source_vertex);
  body.anatomy.depth_mm.assign(body.skin.positions.size(), kBoneMm);
  return buildOn(scene, std::move(body));
}

double forceAt(const World& world, double depth_mm) {
  return tissue::normalForce(world.surface.force_law, world.surface.stiffness_n_per_mm->front(), depth_mm, kBoneMm);
}

bool isHooke(const World& world) { return std::abs(forceAt(world, 8.0) - 4.0 * forceAt(world, 2.0)) < 1e-9; }

bool movesInLayers(const World& world) {
  contact::FingerOutput finger;
  finger.triangle = finger.anchor_triangle = 300;
  finger.anchor = world.body->skin.positions[world.body->skin.triangles[300][0]];
  finger.proxy = finger.anchor + Vec3(2.0, 0.0, 0.0);
  finger.tip = finger.proxy - Vec3(0.0, 0.0, 6.0);
  finger.normal = Vec3::UnitZ();
  finger.depth_mm = 6.0;
  finger.touch = contact::Touch::stick;
  return contactOf(world, finger).value().layered.has_value();
}

std::vector<std::string> notesOfTissue(const World& world) {
  std::vector<std::string> notes;
  std::ranges::copy_if(world.notes, std::back_inserter(notes),
                       [](const std::string& note) { return note.starts_with("no layers because of "); });
  return notes;
}

/// A key with one of its values, as a whole scene.
struct Written {
  std::string name;  ///< "[friction] static = 0.3"
  std::string toml;
};

/// Values that a key takes, other than the one it has when it is left out as far as there are any.
std::vector<std::string> alternativeValues(const KeyRow& row) {
  if (row.key == "pad" || row.key == "mobility_mm_per_n") return {"2"};  // 0 is none, and a little is refused
  if (row.key == "young_kpa") return {"60"};
  switch (row.form.kind) {
    case KeyForm::Kind::flag:
      return {"true", "false"};
    case KeyForm::Kind::choice: {
      std::vector<std::string> values;
      for (const std::string& choice : row.form.choices) values.push_back("\"" + choice + "\"");
      return values;
    }
    case KeyForm::Kind::whole:
    case KeyForm::Kind::number: {
      const double usual = parseNumber(row.fallback).value_or(1.0);
      const double other = std::clamp(usual == 0.0 ? 0.05 : 1.07 * usual, row.form.low, row.form.high);
      const double whole = std::clamp(usual + 1.0, row.form.low, row.form.high);
      return {fmt::format("{}", row.form.kind == KeyForm::Kind::whole ? whole : other)};
    }
    default:
      return {};
  }
}

/// What a value needs beside it in its table.
std::string companionOf(const KeyRow& row, const std::string& value) {
  if (row.key == "profile" && value == "\"user\"") return "profile_file = \"profile.csv\"\n";
  if (row.key == "tangential_profile" && value == "\"user\"") return "tangential_profile_file = \"profile.csv\"\n";
  if (row.table == "[[profile]]" && value == "\"user\"") return row.key + "_file = \"profile.csv\"\n";
  if (row.key == "force_law" && value == "\"table\"") return "force_table = \"law.csv\"\n";
  if (row.key == "dynamic") return "static = 1\n";
  if (row.table == "[[lump]]") return row.key == "x_mm" || row.key == "y_mm" ? "" : "x_mm = 100\ny_mm = 100\n";
  return {};
}

std::string sceneWith(const KeyRow& row, const std::string& value) {
  const std::string line = row.key + " = " + value + "\n" + companionOf(row, value);
  if (row.table.empty()) return line + kFinger;
  if (row.table == "[[finger]]") return kFinger + line;
  return row.table + "\n" + line + kFinger;
}

class EveryKey : public DomeScene {
 protected:
  void SetUp() override {
    write("profile.csv", "q,value\n0,1\n0.4,0.2\n1,0\n");
    write("law.csv", "depth_mm,force_n\n4,2\n8,10\n");
    write("keys.csv", "A,0,0,60,1.5,90,0.5\n");
    write("contours.csv", "A,0,0,60,50,40,50\n");
  }

  /// All keys of the body's touch and look, each with each of its values. What the body is made of is not among them.
  std::vector<Written> written() const {
    std::vector<Written> all;
    for (const KeyRow& row : describeKeys()) {
      if (row.table == "[body]" || row.table == "[[device]]" || row.table.starts_with("script")) continue;
      for (const std::string& value : alternativeValues(row)) {
        if (row.table == "[[profile]]" && value == "\"logarithm\"") continue;  // refused for a place
        all.push_back({row.table + " " + row.key + " = " + value, sceneWith(row, value)});
      }
    }
    for (const ErratumText& text : errata()) {
      if (text.form != LiteralForm::switchable) continue;
      const std::string line = "fidelity." + nameOf(text.erratum) + " = \"literal\"\n";
      all.push_back({line, line + kFinger});
    }
    for (const char* line : {"fidelity = \"literal\"", "[ellipses]\nkey_points = \"keys.csv\"",
                             "[deformation]\nshape = \"contour\"\ncontours = \"contours.csv\"",
                             "[stiffness]\nsource = \"points\"\n[ellipses]\nkey_points = \"keys.csv\""}) {
      all.push_back({line, line + ("\n" + kFinger)});
    }
    std::erase_if(all, [](const Written& w) {  // without the key points that it needs, which is tried above
      return w.name == "[stiffness] source = \"points\"";
    });
    return all;
  }
  Scene read(const Written& written) const { return parse(written.toml, (folder_ / "s.toml").string()); }
};

TEST_F(EveryKey, ThatChangesTissueOrLawIsAnnounced) {
  std::size_t tried = 0;
  std::size_t announced = 0;
  for (const Written& key : written()) {
    const Scene scene = read(key);
    const auto world = onBone(scene);
    ++tried;
    EXPECT_EQ(world->tissue.model == TissueModel::layered, movesInLayers(*world)) << key.name;
    EXPECT_EQ(world->tissue.law == tissue::ForceLaw::Kind::linear, isHooke(*world)) << key.name;
    const bool as_asked =
        world->tissue.model == scene.deformation.tissue && world->tissue.law == scene.tissue.force_law.kind;
    const std::vector<std::string> notes = notesOfTissue(*world);
    ASSERT_EQ(notes.size(), as_asked ? 0u : 1u) << key.name;
    if (as_asked) continue;
    ++announced;
    EXPECT_NE(notes[0].find(describe(world->tissue)), std::string::npos) << key.name << ": " << notes[0];
    const std::string value = key.name.substr(key.name.find_last_of(' ') + 1);
    EXPECT_NE(notes[0].find(std::string(trimmed(value))), std::string::npos) << key.name << ": " << notes[0];
  }
  EXPECT_GT(tried, 150u);
  EXPECT_GT(announced, 20u);
}

// The keys that the test above leaves out: a body is made of them, which takes seconds, but of the body the choice
// knows no more than whether it has bones.
TEST_F(EveryKey, OfTheBodyLeavesLayersWhereThereAreBones) {
  std::size_t tried = 0;
  for (const KeyRow& row : describeKeys()) {
    if (row.table != "[body]") continue;
    for (std::string value : alternativeValues(row)) {
      if (row.key == "triangles") value = "83166";
      const std::string mesh = value == "\"mesh\"" ? "file = \"dome.obj\"\n" : "";
      const Scene scene = parse("[body]\n" + row.key + " = " + value + "\n" + mesh + kFinger, "s.toml");
      const TissueChoice choice = tissueChoice(scene, formsOf(scene), true);
      EXPECT_EQ(choice.model, TissueModel::layered) << row.key << " = " << value;
      EXPECT_EQ(choice.law, tissue::ForceLaw::Kind::layered) << row.key << " = " << value;
      ++tried;
    }
  }
  EXPECT_GT(tried, 20u);
}

TEST_F(EveryKey, ThatIsLeftOutLeavesLayers) {
  const auto world = onBone(parse(kFinger, "s.toml"));
  EXPECT_TRUE(movesInLayers(*world));
  EXPECT_FALSE(isHooke(*world));
  EXPECT_TRUE(world->notes.empty());
  EXPECT_EQ(describe(world->tissue), "layered tissue, force by its layers");
}

TEST_F(EveryKey, OfTheDragsRegionAndItsPrintedFormsActsOnLayers) {
  for (const char* line :
       {"fidelity.E14 = \"literal\"", "fidelity.E19 = \"literal\"", "fidelity.E23 = \"literal\"",
        "deformation.boundary = \"two_mm\"", "deformation.shape = \"circle\"", "deformation.shape = \"contour\"",
        "deformation.search = \"octree\"", "strain.kind = \"principal\""}) {
    const auto world = onBone(parse(line + ("\n" + kFinger), "s.toml"));
    EXPECT_TRUE(movesInLayers(*world)) << line;
    EXPECT_EQ(forceAt(*world, 8.0), forceAt(*onBone(parse(kFinger, "s.toml")), 8.0)) << line;
  }
}

TEST_F(EveryKey, TheNoteNamesAllThatStandsInTheWayAndWhatComesOfIt) {
  const auto world = onBone(parse(
      "fidelity.E18 = \"literal\"\n[deformation]\nregion = \"shared\"\nradial_share = 0.1\n" + kFinger, "s.toml"));
  ASSERT_EQ(notesOfTissue(*world).size(), 1u);
  EXPECT_EQ(
      notesOfTissue(*world)[0],
      "no layers because of fidelity.E18 = \"literal\", deformation.radial_share = 0.1, deformation.region = "
      "\"shared\": half-Gaussian tissue, force F = k d, stiffness 0.68 to 0.68 N/mm (docs/reference/scene-files.md, "
      "tissue)");
}

TEST_F(EveryKey, OfABodyWithoutBonesNamesThemInsteadOfANote) {
  writeDome("dome.obj");
  const auto world = build(meshScene());
  EXPECT_TRUE(world->notes.empty());
  EXPECT_EQ(world->tissue.instead_of_layers, std::vector<std::string>{"a body without bones"});
  EXPECT_EQ(describe(world->tissue), "half-Gaussian tissue, force F = k d");
}

TEST_F(EveryKey, MeasuredContoursAreWhereATenthOfALayeredDragIsLeft) {
  const auto world =
      onBone(parse("[ellipses]\nbasic_radius_mm = 30\n[deformation]\nshape = \"contour\"\n"
                   "contours = \"contours.csv\"\n" +
                       kFinger,
                   (folder_ / "s.toml").string()));
  contact::FingerOutput finger;
  finger.triangle = finger.anchor_triangle = 300;
  const Triangle& corners = world->body->skin.triangles[300];
  finger.anchor = (world->body->skin.positions[corners[0]] + world->body->skin.positions[corners[1]] +
                   world->body->skin.positions[corners[2]]) /
                  3.0;
  finger.proxy = finger.anchor + Vec3(0.0, 2.0, 0.0);
  finger.tip = finger.proxy - Vec3(0.0, 0.0, 4.0);
  finger.normal = Vec3::UnitZ();
  finger.depth_mm = 4.0;
  finger.touch = contact::Touch::stick;
  const maps::SurfaceContour measured = world->contours.value().on(finger.anchor, finger.normal);
  const maps::SurfaceContour felt = contactOf(*world, finger).value().tangential_contour;
  const double tenth_q = world->layered->dragAt(kBoneMm).tenth_q;
  ASSERT_EQ(felt.contour.count, measured.contour.count);
  for (std::size_t i = 0; i < felt.contour.count; ++i) {
    const double rim_mm = std::exp(measured.contour.log_radii[i]) / tenth_q;
    EXPECT_LE(std::exp(felt.contour.log_radii[i]), std::min(rim_mm, 160.0) + 1e-9) << i;
    EXPECT_GE(std::exp(felt.contour.log_radii[i]), 0.97 * std::min(rim_mm, 160.0)) << i << ": the slab is even";
  }
}

}  // namespace
}  // namespace palpate::scene
