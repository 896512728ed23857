// `palpate tissue show TABLE...`: what layered tissue answers to a press, in numbers and as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "report/charts/picture_file.h"
#include "solve/commands/commands.h"
#include "solve/commands/layered_figure.h"
#include "solve/realism/pressed_numbers.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;
using tissue::LayeredTable;
using tissue::PressedNumbers;
using tissue::PressedShape;

struct ShowArguments {
  std::vector<std::string> files;
  std::string output;
  std::string title;
  std::optional<double> depth_mm;
  double radius_mm = 60.0;
  double png_scale = 1.5;
  bool json = false;
};

/// Stems of the files; whole where two share a stem.
std::vector<NamedTable> tablesFrom(const std::vector<std::string>& files) {
  std::vector<NamedTable> tables;
  for (const std::string& file : files) {
    const std::string stem = fs::path(file).stem().string();
    const auto same_stem =
        std::ranges::count_if(files, [&](const std::string& other) { return fs::path(other).stem().string() == stem; });
    tables.push_back({same_stem == 1 ? stem : file, tissue::readLayeredTable(file)});
  }
  return tables;
}

/// Checks the requested depth, which every table must have.
void checkDepth(const ShowArguments& arguments, const std::vector<NamedTable>& tables) {
  if (!arguments.depth_mm) return;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& shapes = tables[i].table.shapes;
    const double from = shapes.front().depth_mm;
    const double to = shapes.back().depth_mm;
    if (*arguments.depth_mm >= from && *arguments.depth_mm <= to) continue;
    throw Error::inFile(arguments.files[i], fmt::format("has no shape at --depth {}; it covers {} to {} mm",
                                                        *arguments.depth_mm, from, to));
  }
}

Json shapeJson(const LayeredTable& table, const PressedShape& shape) {
  const PressedNumbers numbers = numbersOf(table, shape);
  return {{"depth_mm", shape.depth_mm},
          {"surface_mm", shape.surface_mm},
          {"force_n", shape.force_n},
          {"secant_n_per_mm", numbers.secant_n_per_mm},
          {"contact_radius_mm", shape.contact_radius_mm},
          {"half_radius_mm", orNull(numbers.half_radius_mm)},
          {"tenth_radius_mm", orNull(numbers.tenth_radius_mm)},
          {"bulge_mm", numbers.bulge_mm},
          {"drawn_in_mm", numbers.drawn_in_mm},
          {"pushed_out_mm", numbers.pushed_out_mm}};
}

Json tableJson(const std::string& file, const NamedTable& one) {
  const LayeredTable& table = one.table;
  Json json = {{"file", file}, {"name", one.name}};
  json["layers"] = Json::array();
  for (const tissue::Layer& layer : table.stack.layers) {
    json["layers"].push_back(
        {{"name", layer.name}, {"thickness_mm", layer.thickness_mm}, {"young_kpa", layer.young_kpa}});
  }
  json["total_mm"] = totalThickness(table.stack);
  json["poisson"] = table.stack.poisson;
  json["indenter_radius_mm"] = table.indenter_radius_mm;
  json["shapes"] = Json::array();
  for (const PressedShape& shape : table.shapes) json["shapes"].push_back(shapeJson(table, shape));
  json["drag"] = nullptr;
  if (table.drag) {
    json["drag"] = {{"exponent", table.drag->exponent},
                    {"along_mm", table.drag->along_mm},
                    {"across_mm", table.drag->across_mm},
                    {"tangential_over_normal", table.drag->tangential_over_normal}};
  }
  return json;
}

std::string radiusText(const std::optional<double>& radius_mm) {
  return radius_mm ? fmt::format("{:.1f}", *radius_mm) : std::string("-");
}

std::string tableText(const NamedTable& one) {
  const LayeredTable& table = one.table;
  std::string text = fmt::format("{}: {}", one.name, formatStack(table.stack));
  if (!table.stack.layers.empty()) text += fmt::format(" (mm x kPa), {:.4g} mm in all", totalThickness(table.stack));
  text += fmt::format(", sphere of {:.4g} mm\n", table.indenter_radius_mm);
  text += "   depth    skin   force   secant  touches  half at  tenth at   bulge  drawn in  pushed out\n";
  text += "      mm      mm       N     N/mm       mm       mm        mm      mm        mm          mm\n";
  for (const PressedShape& shape : table.shapes) {
    const PressedNumbers numbers = numbersOf(table, shape);
    text += fmt::format("{:8.2f}{:8.2f}{:8.3f}{:9.3f}{:9.1f}{:>9}{:>10}{:8.2f}{:10.2f}{:12.2f}\n", shape.depth_mm,
                        shape.surface_mm, shape.force_n, numbers.secant_n_per_mm, shape.contact_radius_mm,
                        radiusText(numbers.half_radius_mm), radiusText(numbers.tenth_radius_mm), numbers.bulge_mm,
                        numbers.drawn_in_mm, numbers.pushed_out_mm);
  }
  if (table.drag) {
    text += fmt::format("drag: (1 + q^2)^-{:.3g}, {:.1f} mm along, {:.1f} mm across, tangential over normal {:.2f}\n",
                        table.drag->exponent, table.drag->along_mm, table.drag->across_mm,
                        table.drag->tangential_over_normal);
  }
  return text;
}

void drawTables(const ShowArguments& arguments, const std::vector<NamedTable>& tables) {
  LayeredFigureSettings settings{
      .title = arguments.title, .depth_mm = arguments.depth_mm, .to_radius_mm = arguments.radius_mm};
  if (settings.title.empty()) {
    settings.title = tables.size() == 1 ? tables.front().name : "stacks of layers under the same press";
  }
  writePicture(layeredFigure(tables, settings), arguments.output, arguments.png_scale);
}

void runShow(const ShowArguments& arguments) {
  if (!arguments.output.empty()) checkPictureName(arguments.output);
  const std::vector<NamedTable> tables = tablesFrom(arguments.files);
  checkDepth(arguments, tables);
  if (!arguments.output.empty()) drawTables(arguments, tables);
  if (arguments.json) {
    Json json;
    json["tables"] = Json::array();
    for (std::size_t i = 0; i < tables.size(); ++i) json["tables"].push_back(tableJson(arguments.files[i], tables[i]));
    fmt::print("{}\n", jsonDump(json, 2));
    return;
  }
  for (std::size_t i = 0; i < tables.size(); ++i) fmt::print("{}{}", i > 0 ? "\n" : "", tableText(tables[i]));
  if (!arguments.output.empty()) fmt::print("-> {}\n", arguments.output);
}

}  // namespace

void addTissueShowCommand(Command& parent) {
  const auto [command, a] =
      addCommand(parent, "show", "Show tables of layered tissue: the pressed skin, force, stacks", runShow);
  command.add_option("TABLE", a.files, "Tables of `palpate tissue solve` or `palpate tissue fit profile`")->required();
  namesFileToWrite(command.add_option("-o,--out", a.output, "Picture to write: .png or .svg"));
  addNumber(command, "--depth", a.depth_mm, above(0.0, 500.0, "mm"),
            "Draw the skin at this depth (default: at every depth of one table, at the deepest that several share)");
  addNumber(command, "--radius-mm", a.radius_mm, between(1.0, 10'000.0, "mm"), "Draw the skin up to this radius");
  command.add_option("--title", a.title, "Title above the picture");
  addSetting(command, "--png-scale", a.png_scale, between(0.2, 8.0), "PNG: pixels per CSS pixel");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
