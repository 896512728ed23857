// `palpate tissue realism`: the distance of feel and look from finite elements, case by case.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/json.h"
#include "report/charts/picture_file.h"
#include "report/page/figures_text.h"
#include "solve/commands/commands.h"
#include "solve/commands/realism_reports.h"
#include "solve/realism/living_tests.h"
#include "solve/realism/realism_stacks.h"

namespace palpate::app {

namespace {

using lab::JudgedDrag;
using lab::JudgedPress;
using lab::PressError;
using lab::RealismFigures;

struct RealismArguments {
  std::string cases;
  std::string living;
  std::string plot;
  double png_scale = 1.5;
  bool radius = false;
  bool json = false;
};

Json errorJson(const PressError& error) {
  return {{"normal_rms", error.shape.normal_rms},
          {"vector_rms", error.shape.vector_rms},
          {"worst_point", error.shape.worst},
          {"force_n", error.force_n},
          {"force_error", error.force_error}};
}

Json figuresJson(const RealismFigures& figures) {
  Json json;
  json["cases"] = Json::array();
  for (const JudgedPress& press : figures.presses) {
    json["cases"].push_back({{"name", press.name},
                             {"depth", press.depth_mm},
                             {"layered_stack", press.layered_stack},
                             {"true_force_n", press.true_force_n},
                             {"layered", errorJson(press.layered)},
                             {"gaussian", errorJson(press.gaussian)},
                             {"literal", errorJson(press.literal)}});
  }
  json["drags"] = Json::array();
  for (const JudgedDrag& drag : figures.drags) {
    json["drags"].push_back({{"name", drag.name},
                             {"layered_stack", drag.layered_stack},
                             {"layered_rms", drag.layered_rms},
                             {"gaussian_rms", drag.gaussian_rms}});
  }
  const lab::WorstErrors worst = figures.worst(&JudgedPress::layered, lab::kJudgedFromMm);
  json["normal_rms_worst"] = worst.normal_rms;
  json["vector_rms_worst"] = worst.vector_rms;
  json["force_error_worst"] = worst.force_error;
  json["tangential_rms_worst"] = figures.worstDrag(&JudgedDrag::layered_rms);
  json["force_error_worst_from_2_mm"] = figures.worst(&JudgedPress::layered, 2.0).force_error;
  for (const auto& [name, member] :
       {std::pair{"gaussian", &JudgedPress::gaussian}, {"literal", &JudgedPress::literal}}) {
    const lab::WorstErrors other = figures.worst(member, lab::kJudgedFromMm);
    json[std::string(name) + "_worst"] = {
        {"normal_rms", other.normal_rms}, {"vector_rms", other.vector_rms}, {"force_error", other.force_error}};
  }
  json["left_out"] = figures.left_out;
  return json;
}

figures::Plot errorPlot(const RealismFigures& figures, const std::string& title, const std::string& label,
                        double (*value)(const PressError&)) {
  figures::Plot plot{.title = title, .x = {.label = "depth", .unit = "mm"}, .y = {.label = label, .unit = "%"}};
  const auto add = [&](const char* name, PressError JudgedPress::*of, figures::Marker marker, std::size_t colour) {
    figures::Series series{
        .name = name, .stroke = figures::Stroke::none, .marker = marker, .colour = figures::seriesColour(colour)};
    for (const JudgedPress& press : figures.presses) {
      series.x.push_back(press.depth_mm);
      series.y.push_back(100.0 * value(press.*of));
    }
    plot.series.push_back(std::move(series));
  };
  add("layered", &JudgedPress::layered, figures::Marker::circle, 0);
  add("gaussian", &JudgedPress::gaussian, figures::Marker::square, 1);
  add("literal", &JudgedPress::literal, figures::Marker::triangle, 2);
  return plot;
}

figures::Figure figuresPicture(const RealismFigures& figures) {
  figures::Figure figure;
  figure.title = "how far the skin and the force are from finite elements";
  figure.columns = 2;
  figure.panels = {errorPlot(figures, "shape, a mark a stack and depth", "RMS over 40 mm, of the depth",
                             [](const PressError& error) { return error.shape.vector_rms; }),
                   errorPlot(figures, "force", "force against finite elements",
                             [](const PressError& error) { return error.force_error; })};
  return figure;
}

/// Runs the work with a progress line; returns its result.
template <class Work>
auto withProgress(const Work& work) {
  ProgressLine progress;
  return work(progress.callback());
}

void runRealism(const RealismArguments& arguments) {
  const auto print = [&](const Json& json, const std::string& text) {
    fmt::print("{}", arguments.json ? jsonText(json) : text);
  };
  const auto print_figures = [&](const Json& json) { print(json, study::figuresText(json)); };
  if (arguments.radius) return print_figures(withProgress(judgeRadius));
  if (!arguments.living.empty()) {
    const auto [json, text] =
        withProgress([&](const Progress& progress) { return judgeLiving(arguments.living, progress); });
    return print(json, text);
  }
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  const RealismFigures figures = withProgress([&](const Progress& progress) {
    return lab::judgeRealism(
        arguments.cases.empty() ? lab::stacksOfBody(progress) : lab::stacksOfFile(arguments.cases, progress), progress);
  });
  if (!arguments.plot.empty()) writePicture(figuresPicture(figures), arguments.plot, arguments.png_scale);
  print_figures(figuresJson(figures));
  if (!arguments.plot.empty() && !arguments.json) fmt::print("-> {}\n", arguments.plot);
}

}  // namespace

void addRealismCommand(Command& tissue) {
  const auto [command, a] = addCommand(
      tissue, "realism",
      "Compare the skin and the force with finite elements of layered tissue (docs/explanation/tissue.md)", runRealism);
  command.add_option("--cases", a.cases,
                     "Solved presses to compare with, JSON (default: six places of a body, solved now, about 30 s)");
  Option& living =
      *command.add_option("--living", a.living,
                          "Compare with presses of an ultrasound probe on living limbs instead (N/mm): the list " +
                              std::string(lab::kLivingList) + " or its folder (about two minutes)");
  living.excludes("--cases");
  Option& radius = *command.add_flag(
      "--radius", a.radius,
      "Compare the force on fingers of 2 to 16 mm with spheres of their radius instead (about two minutes)");
  radius.excludes("--cases");
  radius.excludes(&living);
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg")->excludes(&living)->excludes(&radius);
  addSetting(command, "--png-scale", a.png_scale, between(0.2, 8.0), "PNG: pixels per CSS pixel");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
