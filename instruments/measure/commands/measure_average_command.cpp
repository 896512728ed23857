// `palpate measure average ROWS.csv...`: presses of several drags and people become key points, with how sure they are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/json.h"
#include "cli/kit/output_place.h"
#include "measure/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/measure/average.h"
#include "report/charts/figure.h"
#include "report/charts/picture_file.h"

namespace palpate::app {

namespace {

// Averaged ellipses with their 95 % bands, as a picture.

using measure::MeanEllipse;
using measure::PointMean;

constexpr double kShare = 0.2;  ///< share of the true size, over the back
constexpr std::size_t kMaxPanels = 24;

std::vector<Vec2> outlineOf(const maps::Ellipse& ellipse, const Vec2& centre, double share) {
  return figures::ellipseOutline(centre, share * ellipse.half_major_mm, share * ellipse.half_major_mm * ellipse.aspect,
                                 ellipse.direction_rad);
}

/// Between the band's two rims: one outline, there and back again.
figures::Shape makeBandShape(const MeanEllipse& mean, const Vec2& centre, double share, const std::string& name) {
  const auto rims = confidenceBand(mean);
  figures::Shape band{.name = name,
                      .stroke = figures::Stroke::none,
                      .colour = figures::kBlue,
                      .fill = figures::withAlpha(figures::kBlue, 0.2)};
  if (rims[0].empty()) return band;
  std::vector<Vec2> path;
  const std::size_t rays = rims[0].size();
  for (std::size_t i = 0; i <= rays; ++i) path.emplace_back(centre + share * rims[1][i % rays]);
  for (std::size_t i = 0; i <= rays; ++i) path.emplace_back(centre + share * rims[0][(2 * rays - i) % rays]);
  band.paths.push_back(std::move(path));
  return band;
}

figures::Plot overview(const measure::Averages& averages) {
  figures::Plot plot{.title = "over the back, at a fifth of their size",
                     .x = {.label = "to the right", .unit = "mm"},
                     .y = {.label = "towards the head", .unit = "mm"},
                     .equal_aspect = true};
  figures::Shape means{.name = "mean", .colour = figures::kBlue, .width_px = 1.8};
  for (const PointMean& point : averages.points) {
    plot.shapes.push_back(makeBandShape(point.mean, point.place_mm, kShare, ""));
    means.paths.push_back(outlineOf(point.mean.ellipse, point.place_mm, kShare));
    plot.places.push_back({point.place_mm, point.name});
  }
  plot.shapes.push_back(std::move(means));
  return plot;
}

std::string formatPlusMinus(const measure::Estimate& estimate, int digits) {
  if (!std::isfinite(estimate.sd)) return fmt::format("{:.{}f}", estimate.value, digits);
  return fmt::format("{:.{}f} \u00b1 {:.{}f}", estimate.value, digits, estimate.sd, digits);
}

figures::Plot makePointPanel(const PointMean& point) {
  figures::Plot plot{.title = fmt::format(
                         "{}: {} mm, ratio {}, {}\u00b0{}", point.name, formatPlusMinus(point.mean.half_major_mm, 1),
                         formatPlusMinus(point.mean.major_over_minor, 2), formatPlusMinus(point.mean.direction_deg, 0),
                         point.mean.hardly_determined ? " (hardly determined)" : ""),
                     .x = {.label = "to the right", .unit = "mm"},
                     .y = {.label = "towards the head", .unit = "mm"},
                     .equal_aspect = true};
  plot.shapes.push_back(makeBandShape(point.mean, Vec2::Zero(), 1.0, "95 % band"));
  plot.shapes.push_back({.name = point.knowsTissue() ? "the tissue's" : "mean",
                         .paths = {outlineOf(point.mean.ellipse, Vec2::Zero(), 1.0)},
                         .colour = figures::kBlue,
                         .width_px = 2.0});
  for (std::size_t i = 0; point.drags.size() > 1 && i < point.drags.size(); ++i) {
    const measure::DragMean& drag = point.drags[i];
    plot.shapes.push_back(
        {.name = drag.drag_deg ? "pulled " + measure::dragDirectionName(*drag.drag_deg) : "pulled some way",
         .paths = {outlineOf(drag.mean.ellipse, Vec2::Zero(), 1.0)},
         .stroke = figures::Stroke::dashed,
         .colour = figures::seriesColour(i + 1)});
  }
  return plot;
}

/// All points over the back at a fifth of their size, then a panel a point: the mean, its band, the means of its drags.
figures::Figure averageFigure(const measure::Averages& averages) {
  figures::Figure figure{.title = "measured ellipses", .columns = 2};
  figure.panels.emplace_back(overview(averages));
  for (const PointMean& point : averages.points) {
    if (figure.panels.size() > kMaxPanels) break;
    if (point.mirrored_from.empty()) figure.panels.emplace_back(makePointPanel(point));
  }
  figure.note = "Where the skin moves 2 mm. Bands: standard errors of the mean, 95 %.";
  return figure;
}

struct MeasureAverageArguments {
  std::vector<std::string> files;
  measure::AverageSettings settings;
  bool by_drag = false;
  std::string drag;
  std::vector<std::string> mirrors;
  std::string output;
  std::string plot;
  bool json = false;
};

/// Each of several files is one person's where its rows do not name a subject.
std::vector<measure::PressRow> pressesFrom(const std::vector<std::string>& files) {
  std::vector<measure::PressRow> all;
  for (const std::string& file : files) {
    for (measure::PressRow& press : measure::readPresses(file)) {
      if (press.subject.empty() && files.size() > 1) press.subject = file;
      all.push_back(std::move(press));
    }
  }
  return all;
}

measure::AverageSettings settingsOf(const MeasureAverageArguments& arguments) {
  measure::AverageSettings settings = arguments.settings;
  if (!arguments.drag.empty()) settings.drag_deg = measure::dragNamed(arguments.drag);
  for (const std::string& mirror : arguments.mirrors) {
    const auto parts = split(mirror, ':');
    if (parts.size() != 2 || parts[0].empty() || parts[1].empty()) {
      throw Error("--mirror: '" + oneLine(mirror) + "' must be FROM:TO, such as P4:P6");
    }
    settings.mirrors.emplace_back(parts[0], parts[1]);
  }
  return settings;
}

// --- text

std::string withError(const measure::Estimate& estimate, int digits) {
  const std::string value = fmt::format("{:.{}f}", estimate.value, digits);
  return std::isfinite(estimate.sd) ? fmt::format("{} +- {:.{}f}", value, estimate.sd, digits) : value;
}

std::string formatEllipseRow(const std::string& name, const std::string& pulled, const measure::MeanEllipse& mean) {
  return fmt::format("{:<10}{:<16}{:<17}{:<16}{:<13}{:>7}{:>7}{}\n", name, pulled, withError(mean.half_major_mm, 1),
                     withError(mean.major_over_minor, 3), withError(mean.direction_deg, 1), mean.presses, mean.subjects,
                     mean.hardly_determined ? "  direction hardly determined" : "");
}

std::string describeDrag(const measure::DragMean& drag) {
  return drag.drag_deg ? measure::dragDirectionName(*drag.drag_deg) : std::string("not said");
}

std::string textOf(const measure::Averages& averages) {
  std::string text = fmt::format("{:<10}{:<16}{:<17}{:<16}{:<13}{:>7}{:>7}\n", "point", "pulled", "half major, mm",
                                 "ratio", "direction", "presses", "people");
  std::string remarks;
  for (const measure::PointMean& point : averages.points) {
    const bool one = point.drags.size() == 1;
    if (!one) {
      for (const measure::DragMean& drag : point.drags)
        text += formatEllipseRow(point.name, describeDrag(drag), drag.mean);
    }
    const std::string which = one ? describeDrag(point.drags.front()) : point.knowsTissue() ? "the tissue's" : "all";
    text += formatEllipseRow(point.name, which, point.mean);
    if (point.along_drag) {
      remarks += fmt::format("{}: a drag stretches the ellipse along itself by {}\n", point.name,
                             withError(*point.along_drag, 2));
    }
    if (!point.mirrored_from.empty()) {
      remarks += fmt::format("{}: not measured, the mirror image of {}\n", point.name, point.mirrored_from);
    } else if (const std::string remark = dragRemark(point); !remark.empty()) {
      remarks += point.name + ": " + remark + "\n";
    }
  }
  return text + (remarks.empty() ? "" : "\n" + remarks);
}

// --- JSON

/// null where it is not known.
Json estimateJson(const measure::Estimate& estimate) {
  return {{"value", estimate.value}, {"sd", std::isfinite(estimate.sd) ? Json(estimate.sd) : Json(nullptr)}};
}

Json meanJson(const measure::MeanEllipse& mean) {
  return {{"half_major_mm", estimateJson(mean.half_major_mm)},
          {"major_over_minor", estimateJson(mean.major_over_minor)},
          {"direction_deg", estimateJson(mean.direction_deg)},
          {"hardly_determined", mean.hardly_determined},
          {"resultant", mean.resultant},
          {"presses", mean.presses},
          {"subjects", mean.subjects},
          {"degrees_of_freedom", mean.freedom}};
}

Json pointJson(const measure::PointMean& point) {
  Json json = {{"name", point.name}, {"x_mm", point.place_mm.x()}, {"y_mm", point.place_mm.y()}};
  json.update(meanJson(point.mean));
  json["is_the_tissues"] = point.knowsTissue();
  json["stretch_along_drag"] = point.along_drag ? estimateJson(*point.along_drag) : Json(nullptr);
  json["drags"] = Json::array();
  for (const measure::DragMean& drag : point.drags) {
    Json one = {{"drag_deg", orNull(drag.drag_deg)}};
    one.update(meanJson(drag.mean));
    json["drags"].push_back(std::move(one));
  }
  json["remark"] = dragRemark(point);
  json["mirrored_from"] = point.mirrored_from;
  return json;
}

Json toJson(const measure::Averages& averages, const std::vector<std::string>& written) {
  const bool plain = averages.settings.averaging == maps::Averaging::plain;
  Json json = {{"mean", plain ? "plain" : "tensorial"}, {"points", Json::array()}};
  for (const measure::PointMean& point : averages.points) json["points"].push_back(pointJson(point));
  json["written"] = written;
  return json;
}

void runMeasureAverage(const MeasureAverageArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  const measure::Averages averages = averagePresses(pressesFrom(arguments.files), settingsOf(arguments));
  std::vector<std::string> written;
  if (!arguments.output.empty()) {
    writeFile(arguments.output, keyPointTable(averages, arguments.by_drag));
    written.push_back(arguments.output);
  }
  if (!arguments.plot.empty()) {
    writePicture(averageFigure(averages), arguments.plot);
    written.push_back(arguments.plot);
  }
  if (arguments.json) return fmt::print("{}\n", jsonDump(toJson(averages, written), 2));
  fmt::print("{}", textOf(averages));
  for (const std::string& file : written) fmt::print("-> {}\n", file);
}

std::string faultOfDrag(const std::string& words) {
  return measure::dragNamed(words) ? "" : "'" + oneLine(words) + "' is neither up, down, left, right nor degrees";
}

}  // namespace

void addMeasureAverageCommand(Command& parent) {
  const auto [command, a] =
      addCommand(parent, "average", "Average presses over drags and people into key points", runMeasureAverage);
  command.add_option("rows", a.files, "Tables of presses (docs/howto/measure-a-person.md), one per person")->required();
  addChoice(command, "--mean", a.settings.averaging,
            Choices<maps::Averaging>{{"tensorial", maps::Averaging::tensorial}, {"plain", maps::Averaging::plain}},
            "Average the ellipses as tensors, or the numbers, rounded as the dissertation prints them");
  addChoice(command, "--by", a.by_drag, Choices<bool>{{"point", false}, {"point,drag", true}},
            "Write one row per point, or one per drag direction there");
  command.add_option("--drag", a.drag, "Use only presses dragged this way: up, down, left, right, or degrees from +x")
      ->check(faultOfDrag)
      ->type_name("up|down|left|right|DEG");
  command.add_option("--mirror", a.mirrors, "Unmeasured points to mirror from the other side: P4:P6,P5:P7")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("FROM:TO");
  namesFileToWrite(
      command.add_option("-o,--out", a.output, "Table of key points to write, as scenes and palpate body map read it"));
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
