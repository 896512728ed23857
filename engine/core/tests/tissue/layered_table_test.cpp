#include "palpate/tissue/layered_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::tissue {
namespace {

LayeredTable smallTable() {
  LayeredTable table;
  table.stack.layers = {{"skin", 2.0, 150.0}, {"fat", 8.0, 10.0}, {"muscle", 30.0, 27.0}};
  table.radii_mm = {0.0, 5.0, 40.0};
  table.shapes = {{2.0, 1.99, 0.31, 3.0, {1.0, 0.4, 1.0 / 3.0}, {0.0, -0.05, 0.01}},
                  {10.0, 9.97, 4.16, 7.5, {1.0, 0.9, 0.0}, {0.0, 0.1, -0.02}}};
  table.drag = DragShape{.exponent = 0.8,
                         .along_mm = 17.0,
                         .across_mm = 9.5,
                         .tangential_over_normal = 0.6,
                         .on_along = {1.0, 0.8, 0.1},
                         .on_across = {}};
  return table;
}

std::string errorMessage(const LayeredTable& table) {
  return support::thrownMessage([&] { check(table); });
}

/// What is said of the small table after this change.
template <class Change>
std::string faultAfter(const Change& change) {
  LayeredTable table = smallTable();
  change(table);
  return errorMessage(table);
}

std::string faultOfText(const std::string& json) {
  return support::thrownMessage([&] { parseLayeredTable(json, "t.json"); });
}

/// The text of the small table with a piece of it exchanged.
std::string changedText(const std::string& before, const std::string& after) {
  std::string text = layeredTableText(smallTable());
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(LayerStack, IsAsThickAsItsLayers) { EXPECT_EQ(totalThickness(smallTable().stack), 40.0); }

TEST(LayerStack, NamesTheLayerAndTheNumberThatMakeNoSense) {
  const auto fault = [](Layer layer, double poisson = 0.48) {
    const LayerStack stack{.layers = {{"skin", 2.0, 150.0}, layer}, .poisson = poisson};
    return support::thrownMessage([&] { check(stack); });
  };
  EXPECT_EQ(fault({"fat", 8.0, 10.0}), "no error");
  EXPECT_EQ(fault({"fat", 0.05, 10.0}), "layer 2: thickness = 0.05 is out of range: 0.1 to 500 mm");
  EXPECT_EQ(fault({"fat", 8.0, 0.0}), "layer 2: Young's modulus = 0 is out of range: 0.01 to 1,000,000 kPa");
  EXPECT_EQ(fault({"fat", std::nan(""), 10.0}), "layer 2: thickness = nan is out of range: 0.1 to 500 mm");
  EXPECT_EQ(fault({"fat", 8.0, 10.0}, 0.5), "stack: Poisson's ratio = 0.5 is out of range: 0 to 0.499");
  EXPECT_NE(fault({"f\"at", 8.0, 10.0}).find("layer 2: 'f\"at' is not a valid name"), std::string::npos);
  EXPECT_NE(fault({std::string(41, 'a'), 8.0, 10.0}).find("is not a valid name"), std::string::npos);
  EXPECT_EQ(support::thrownMessage([] { check(LayerStack{}); }), "stack: at least one layer is required");
  LayerStack many{.layers = std::vector<Layer>(17, Layer{"fat", 8.0, 10.0})};
  EXPECT_EQ(support::thrownMessage([&] { check(many); }), "stack: expected at most 16 layers");
  many.layers.pop_back();
  EXPECT_EQ(support::thrownMessage([&] { check(many); }), "no error");
}

TEST(ParseLayer, ReadsNameThicknessAndModulus) {
  const Layer skin = parseLayer("skin:2mm:150kPa");
  EXPECT_EQ(skin.name, "skin");
  EXPECT_EQ(skin.thickness_mm, 2.0);
  EXPECT_EQ(skin.young_kpa, 150.0);
  const Layer other = parseLayer(" fat : 0.8 cm : 0.01 MPa ");
  EXPECT_EQ(other.name, "fat");
  EXPECT_DOUBLE_EQ(other.thickness_mm, 8.0);
  EXPECT_DOUBLE_EQ(other.young_kpa, 10.0);
  EXPECT_EQ(parseLayer("30:27").thickness_mm, 30.0);
  EXPECT_EQ(parseLayer("30:27").name, "");
  EXPECT_EQ(parseLayer("gluteal fat:1.5e1:27KPA").young_kpa, 27.0);
}

TEST(ParseLayer, SaysTheForm) {
  for (const char* text : {"", "skin", "skin:2mm", "skin:2mm:150kPa:9", "skin:2mm:150mm", "skin:2kPa:150kPa",
                           "skin::150kPa", "skin:2mm:", "skin:two:150", ":::", "skin:2 3mm:150kPa"}) {
    EXPECT_EQ(support::thrownMessage([&] { parseLayer(text); }),
              std::string("layer '") + text + "': expected NAME:THICKNESS:MODULUS, e.g. skin:2mm:150kPa");
  }
  EXPECT_EQ(support::thrownMessage([] { parseLayer("skin:900mm:150"); }),
            "layer 'skin:900mm:150': thickness = 900 is out of range: 0.1 to 500 mm");
  EXPECT_EQ(support::thrownMessage([] { parseLayer("skin:2:nan"); }),
            "layer 'skin:2:nan': Young's modulus = nan is out of range: 0.01 to 1,000,000 kPa");
}

TEST(LayeredTable, NamesWhatMakesNoSense) {
  EXPECT_EQ(errorMessage(smallTable()), "no error");
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faultAfter([](auto& t) { t.radii_mm = {0.0}; }), "radii_mm: at least two values are required");
  EXPECT_EQ(faultAfter([](auto& t) { t.radii_mm[0] = 0.5; }), "radii_mm: the first must be 0, not 0.5");
  EXPECT_EQ(faultAfter([](auto& t) { t.radii_mm[2] = 5.0; }), "radii_mm: must increase, but 5 follows 5");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes.clear(); }), "shapes: at least one is required");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[1].down.pop_back(); }), "shape 2: down has 2 numbers for 3 radii");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[1].depth_mm = 2.0; }),
            "shape 2: depth_mm must increase, but 2 follows 2");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[1].force_n = 0.3; }),
            "shape 2: force_n must not decrease, but 0.3 follows 0.31");
  EXPECT_EQ(faultAfter([&](auto& t) { t.shapes[0].outward[1] = not_a_number; }),
            "shape 1: outward, number 2, = nan is out of range: -100 to 100");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[0].down[0] = 0.9; }), "shape 1: down begins at 0.9 instead of 1");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[0].outward[0] = 0.1; }), "shape 1: outward begins at 0.1 instead of 0");
  EXPECT_EQ(faultAfter([](auto& t) { t.shapes[0].surface_mm = 0.0; }),
            "shape 1: surface_mm = 0 is out of range: above 0 and at most 500 mm");
  EXPECT_EQ(faultAfter([](auto& t) { t.indenter_radius_mm = -8.0; }),
            "table: indenter_radius_mm = -8 is out of range: 0.1 to 1,000 mm");
  EXPECT_EQ(faultAfter([](auto& t) { t.drag->exponent = 0.0; }),
            "drag: exponent = 0 is out of range: above 0 and at most 10");
  EXPECT_EQ(faultAfter([](auto& t) { t.drag->on_across = {1.0}; }), "drag: on_across has 1 numbers for 3 radii");
  EXPECT_EQ(faultAfter([](auto& t) { t.stack.layers[1].young_kpa = 0.0; }),
            "layer 2: Young's modulus = 0 is out of range: 0.01 to 1,000,000 kPa");
}

TEST(LayeredTable, OfAMeasurementMayNotKnowItsLayers) {
  EXPECT_EQ(faultAfter([](auto& t) { t.stack.layers.clear(); }), "no error");
}

TEST(LayeredTable, ComesBackFromItsTextWithEveryDigit) {
  const LayeredTable table = smallTable();
  const LayeredTable read = parseLayeredTable(layeredTableText(table), "t.json");
  ASSERT_EQ(read.stack.layers.size(), 3u);
  EXPECT_EQ(read.stack.layers[1].name, "fat");
  EXPECT_EQ(read.stack.layers[1].young_kpa, 10.0);
  EXPECT_EQ(read.stack.poisson, table.stack.poisson);
  EXPECT_EQ(read.radii_mm, table.radii_mm);
  ASSERT_EQ(read.shapes.size(), 2u);
  EXPECT_EQ(read.shapes[0].down, table.shapes[0].down);
  EXPECT_EQ(read.shapes[0].down[2], 1.0 / 3.0);
  EXPECT_EQ(read.shapes[1].outward, table.shapes[1].outward);
  EXPECT_EQ(read.shapes[1].force_n, 4.16);
  EXPECT_EQ(read.shapes[1].surface_mm, 9.97);
  EXPECT_EQ(read.shapes[1].contact_radius_mm, 7.5);
  ASSERT_TRUE(read.drag.has_value());
  EXPECT_EQ(read.drag->along_mm, 17.0);
  EXPECT_EQ(read.drag->tangential_over_normal, 0.6);
  EXPECT_EQ(read.drag->on_along, table.drag->on_along);
  EXPECT_TRUE(read.drag->on_across.empty());
  LayeredTable pressed_only = table;
  pressed_only.drag.reset();
  EXPECT_FALSE(parseLayeredTable(layeredTableText(pressed_only), "t.json").drag.has_value());
}

TEST(LayeredTable, IsJsonAsOthersReadIt) {
  const nlohmann::json json = nlohmann::json::parse(layeredTableText(smallTable()));
  EXPECT_EQ(json["stack"]["layers"][2]["thickness_mm"], 30.0);
  EXPECT_EQ(json["shapes"][1]["down"][1], 0.9);
  EXPECT_EQ(json["drag"]["across_mm"], 9.5);
  // And written by others: in another order, with more in it.
  nlohmann::json other = json;
  other["made_by"] = {{"program", "x"}};
  EXPECT_EQ(parseLayeredTable(other.dump(), "t.json").shapes.size(), 2u);
}

TEST(LayeredTable, IsWrittenAndReadAsAFile) {
  const support::TemporaryFolder folder;
  writeLayeredTable(folder / "t.json", smallTable());
  EXPECT_EQ(layeredTableText(readLayeredTable(folder / "t.json")), layeredTableText(smallTable()));
  LayeredTable broken = smallTable();
  broken.shapes.clear();
  EXPECT_EQ(support::thrownMessage([&] { writeLayeredTable(folder / "none.json", broken); }),
            "shapes: at least one is required");
  EXPECT_FALSE(std::filesystem::exists(folder / "none.json"));
  EXPECT_NE(support::thrownMessage([&] { readLayeredTable(folder / "none.json"); }).find("none.json"),
            std::string::npos);
}

TEST(LayeredTable, NamesFileAndKeyOfWhatItCannotRead) {
  EXPECT_EQ(faultOfText("{}"), "t.json:1: is not a table of layered tissue: it has no \"palpate_layered_table\"");
  EXPECT_EQ(faultOfText(changedText("table\": 1", "table\": 2")), "t.json:2: is a table of another version");
  EXPECT_EQ(faultOfText(changedText("\"force_n\": 4.16, ", "")), "t.json:15: has no \"force_n\"");
  EXPECT_EQ(faultOfText(changedText("\"force_n\": 4.16", "\"force_n\": \"4\"")),
            "t.json:15: \"force_n\" must be a number");
  EXPECT_EQ(faultOfText(changedText("[0, 5, 40]", "[0, [5], 40]")),
            "t.json:10: \"radii_mm\" must be a list of numbers");
  EXPECT_EQ(faultOfText(changedText("[0, 5, 40]", "[0, 50, 40]")),
            "t.json: radii_mm: must increase, but 40 follows 50");
  EXPECT_EQ(faultOfText(changedText("0.31", "1e999")).substr(0, 7), "t.json:");
  EXPECT_EQ(faultOfText("not json"), "t.json:1: not a JSON value");
}

}  // namespace
}  // namespace palpate::tissue
