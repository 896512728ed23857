// Pictures of the sites: which was taken for which, and how each was felt, on the back.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "palpate/base/language.h"
#include "teach/report/training_figures.h"

namespace palpate::app {

namespace {

using figures::Plot;
using training::SiteAnswers;
using training::SiteFelt;
using training::TrialStatistics;

/// Size of the skin within which a press counts for a site (ExplorationSettings::radius_mm).
constexpr double kDiscMm = 15.0;
/// Back pictures: skin that no disc hides, paler than elsewhere so that colours are distinguished on it.
constexpr figures::Colour kBackColour{0.93, 0.87, 0.83};

std::vector<figures::Tick> siteTicks(int sites, bool upside_down) {
  std::vector<figures::Tick> ticks;
  for (int site = 1; site <= sites; ++site) {
    ticks.push_back({static_cast<double>(upside_down ? sites + 1 - site : site), fmt::format("{}", site)});
  }
  return ticks;
}

/// Sites that were most often taken for others.
std::string mixedUp(const SiteAnswers& answers) {
  int most = 0;
  int of = 0;
  int taken = 0;
  for (int truth = 1; truth <= answers.sites; ++truth) {
    for (int answer = 1; answer <= answers.sites; ++answer) {
      if (answer == truth || answers.at(truth, answer) <= most) continue;
      most = answers.at(truth, answer);
      of = truth;
      taken = answer;
    }
  }
  if (most == 0) return tr("No site was confused with another.");
  return trf("Most often site {} was confused with site {}, {} times.", of, taken, most);
}

figures::MeshView backView(const ReportBack& back, const std::vector<SiteFelt>& felt, std::string title,
                           double SiteFelt::*value, std::string label, std::string unit) {
  figures::MeshView view{.title = std::move(title)};
  view.positions = back.skin.positions;
  view.triangles = back.skin.triangles;
  view.colour = kBackColour;
  view.ambient = 0.75;
  double most = 0.0;
  for (const SiteFelt& site : felt) most = std::max(most, site.*value);
  if (!(most > 0.0)) most = 1.0;
  double top = 0.0;  // discs float over the skin, so that none sinks into it
  for (const Vec3& position : view.positions) top = std::max(top, position.z());
  for (const training::Site& site : back.sites.sites) {
    if (site.number > static_cast<int>(felt.size())) continue;
    const double share = felt[static_cast<std::size_t>(site.number) - 1].*value / most;
    const Vec3 at(site.point_mm.x(), site.point_mm.y(), top);
    view.balls.push_back({at, kDiscMm, figures::mapColour(ColourMap::viridis, share)});
    view.places.push_back({at + Vec3(kDiscMm, 0.0, 0.0), fmt::format("{}", site.number), figures::Marker::none});
  }
  view.colour_key = figures::ColourKey{.label = std::move(label), .unit = std::move(unit), .from = 0.0, .to = most};
  return view;
}

}  // namespace

TrainingPicture answersPicture(const TrialStatistics& trials, const std::string& what) {
  const SiteAnswers& answers = trials.answers;
  Plot plot;
  const int columns = answers.sites + 1;
  figures::Field field{.origin = Vec2(1.0, 1.0), .step = Vec2::Ones(), .columns = columns, .rows = answers.sites};
  field.from = 0.0;
  field.to = 100.0;
  field.cells = true;
  field.label = tr("share of the site's trials");
  field.unit = "%";
  field.colours = ColourMap::cividis;
  for (int row = 1; row <= answers.sites; ++row) {
    const int truth = answers.sites + 1 - row;  // site 1 is on top
    const int all = answers.of(truth);
    for (int column = 1; column <= columns; ++column) {
      const int count = answers.at(truth, column == columns ? 0 : column);
      // Empty cells stay white, so that errors stand out.
      const double share = count > 0 ? static_cast<double>(count) / all : std::numeric_limits<double>::quiet_NaN();
      field.values.push_back(100.0 * share);
      if (count == 0) continue;
      const figures::Colour ink = share < 0.55 ? figures::kPaper : figures::kInk;
      plot.labels.push_back({Vec2(column, row), fmt::format("{}", count), ink});
    }
  }
  plot.field = std::move(field);
  plot.x = {.label = tr("answered site"), .from = 0.5, .to = columns + 0.5, .ticks = siteTicks(answers.sites, false)};
  plot.x.ticks.push_back({static_cast<double>(columns), tr("none")});
  plot.y = {.label = tr("true site"), .from = 0.5, .to = answers.sites + 0.5, .ticks = siteTicks(answers.sites, true)};
  figures::Figure figure;
  figure.panel_width_px = 620.0;
  figure.panel_height_px = 470.0;
  figure.panels.emplace_back(std::move(plot));
  return {
      "answers",
      trf("Counted answers of {}: each row is a true site, each column what was answered. A good row has all on the "
          "diagonal.",
          what),
      trf("Table of sites, {} by {}: {} of {} answers on the diagonal.", answers.sites, answers.sites, trials.correct,
          trials.counted) +
          " " + mixedUp(answers),
      std::move(figure)};
}

TrainingPicture coveragePicture(const TrialStatistics& trials, const ReportBack& back, const std::string& what) {
  figures::Figure figure;
  figure.columns = 2;
  figure.panel_width_px = 430.0;
  figure.panel_height_px = 430.0;
  figure.panels.emplace_back(
      backView(back, trials.felt, tr("time pressed"), &SiteFelt::dwell_s, tr("time a trial"), "s"));
  figure.panels.emplace_back(
      backView(back, trials.felt, tr("peak force"), &SiteFelt::peak_force_n, tr("mean peak of a trial"), "N"));
  const auto least = std::ranges::min_element(trials.felt, {}, &SiteFelt::felt);
  std::string alternative = trf("The back with its sites, {}.", what);
  if (least != trials.felt.end()) {
    alternative += " ";
    alternative += least->felt == least->trials
                       ? tr("Every site was felt in every trial.")
                       : trf("Least often felt: site {}, in {} of {} trials.", least->site, least->felt, least->trials);
  }
  return {"coverage",
          trf("How long and how hard each site was pressed in {}, on average, seen from behind with the head upwards. "
              "Drawn on palpate's built-in body.",
              what),
          alternative, std::move(figure)};
}

}  // namespace palpate::app
