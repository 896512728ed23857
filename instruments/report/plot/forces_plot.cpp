// Panels are stacked and share their time axis, so their frames must begin at the same place: all leave room for the
// longest name of a state.
#include "report/plot/forces_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/servo/limiter.h"

namespace palpate::app {

namespace {

using figures::Plot;

struct Quantity {
  std::string_view label;
  std::string_view unit;
};

Quantity feltQuantity(Felt felt) {
  switch (felt) {
    case Felt::force:
      return {"force", "N"};
    case Felt::device:
      return {"force to device", "N"};
    case Felt::depth:
      return {"depth", "mm"};
    case Felt::lag:
      return {"lag of the skin", "mm"};
    case Felt::speed:
      return {"speed", "mm/s"};
  }
  return {};
}

struct Span {
  double from_s = 0.0;
  double to_s = 1.0;
};

Span findTimeSpan(std::span<const RunStrip> strips) {
  Span span{strips.front().steps().front().from_s, strips.front().steps().back().to_s};
  for (const RunStrip& strip : strips) {
    span.from_s = std::min(span.from_s, strip.steps().front().from_s);
    span.to_s = std::max(span.to_s, strip.steps().back().to_s);
  }
  if (!(span.to_s > span.from_s)) span.to_s = span.from_s + 1e-3;  // a lone tick
  return span;
}

/// Down and up within each step, so that the line fills the range between.
figures::Series makeSeries(const RunStrip& strip, Felt felt, const figures::Colour& colour) {
  const auto i = static_cast<std::size_t>(felt);
  figures::Series curve{.name = {}, .colour = colour, .width_px = 1.3};
  for (const StripStep& step : strip.steps()) {
    const bool one = step.least[i] == step.greatest[i];
    for (const double value : {step.greatest[i], step.least[i]}) {
      curve.x.push_back(0.5 * (step.from_s + step.to_s));
      curve.y.push_back(value);
      if (one) break;
    }
  }
  return curve;
}

// ---- states

/// A line of the panel of states: a bar while it holds.
struct State {
  std::string name;
  figures::Colour colour;
  std::vector<Span> bars;
};

template <class Holds>
State collectStateBars(const RunStrip& strip, std::string_view name, const figures::Colour& colour,
                       const Holds& holds) {
  State state{fmt::format("{} {}", strip.finger(), name), colour, {}};
  bool before = false;
  for (const StripStep& step : strip.steps()) {
    const bool now = holds(step);
    if (now && !before) state.bars.push_back({step.from_s, step.to_s});
    if (now) state.bars.back().to_s = step.to_s;
    before = now;
  }
  return state;
}

void addBits(const RunStrip& strip, std::span<const StatusName> names, std::uint32_t StripStep::*bits,
             std::vector<State>& states) {
  for (const StatusName& name : names) {
    State state = collectStateBars(strip, name.name, figures::kInk,
                                   [&](const StripStep& step) { return (step.*bits & name.bit) != 0; });
    if (!state.bars.empty()) states.push_back(std::move(state));
  }
}

/// Sticking and slipping of every finger, and of the status bits those that were set.
std::vector<State> collectStates(std::span<const RunStrip> strips) {
  std::vector<State> states;
  for (std::size_t f = 0; f < strips.size(); ++f) {
    const figures::Colour colour = figures::seriesColour(f);
    const figures::Colour pale = figures::mixed(colour, figures::kPaper, 0.55);
    states.push_back(collectStateBars(strips[f], "sticks", pale, [](const StripStep& step) { return step.sticks; }));
    states.push_back(collectStateBars(strips[f], "slips", colour, [](const StripStep& step) { return step.slips; }));
    addBits(strips[f], contactStatusNames(), &StripStep::contact_status, states);
    addBits(strips[f], safetyStatusNames(), &StripStep::safety_status, states);
  }
  return states;
}

/// States from the top down, in order.
Plot statePlot(const std::vector<State>& states, const Span& span) {
  Plot plot;
  plot.y.from = -0.5;
  plot.y.to = static_cast<double>(states.size()) - 0.5;
  const double least_s = 0.001 * (span.to_s - span.from_s);  // a bar of a single tick is still seen
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double y = static_cast<double>(states.size() - 1 - i);
    plot.y.ticks.push_back({y, states[i].name});
    figures::Shape bars{.stroke = figures::Stroke::none, .colour = states[i].colour, .fill = states[i].colour};
    for (const Span& bar : states[i].bars) {
      const double to_s = std::max(bar.to_s, bar.from_s + least_s);
      bars.paths.push_back(figures::rectangleOutline({bar.from_s, y - 0.32}, {to_s, y + 0.32}));
    }
    plot.shapes.push_back(std::move(bars));
  }
  return plot;
}

std::string makeFigureNote(std::span<const RunStrip> strips) {
  std::size_t ticks = 1;
  for (const RunStrip& strip : strips) ticks = std::max(ticks, strip.ticksPerStep());
  std::string note = "lag: from the tip to the place of the skin that friction holds.";
  if (ticks > 1) note += fmt::format(" Each step of a line shows the least and the greatest of {} ticks.", ticks);
  return note;
}

/// Width of the names left of the frames, about: letters differ in width.
double roomFor(const std::vector<State>& states) {
  constexpr double kPixelsALetter = 7.8;
  constexpr double kLabelAndTicks = 40.0;
  std::size_t letters = 6;
  for (const State& state : states) letters = std::max(letters, state.name.size());
  return kLabelAndTicks + kPixelsALetter * static_cast<double>(letters);
}

}  // namespace

std::span<const StatusName> contactStatusNames() {
  using namespace contact;
  static constexpr std::array kNames = {
      StatusName{kTipLost, "tip lost"},       StatusName{kCatchingUp, "catching up"},
      StatusName{kTooDeep, "too deep"},       StatusName{kLettingGo, "letting go"},
      StatusName{kAtBorder, "at the border"}, StatusName{kStartedInside, "started inside"},
      StatusName{kUnsettled, "unsettled"},    StatusName{kShadingFailed, "shading failed"}};
  return kNames;
}

std::span<const StatusName> safetyStatusNames() {
  static const auto names = [] {
    std::array<StatusName, servo::kSafetyBits> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {std::uint32_t{1} << i, servo::safetyNames()[i]};
    return all;
  }();
  return names;
}

figures::Figure forcesFigure(const ForcesPlot& plot, std::span<const RunStrip> strips) {
  const Span span = findTimeSpan(strips);
  const std::vector<State> states = plot.states ? collectStates(strips) : std::vector<State>();
  std::vector<Plot> panels;
  for (const Felt felt : plot.felts) {
    const Quantity quantity = feltQuantity(felt);
    Plot& panel = panels.emplace_back();
    panel.y = {.label = std::string(quantity.label), .unit = std::string(quantity.unit)};
    for (std::size_t f = 0; f < strips.size(); ++f) {
      panel.series.push_back(makeSeries(strips[f], felt, figures::seriesColour(f)));
      if (panels.size() == 1) panel.series.back().name = strips[f].finger();
    }
  }
  if (plot.states) panels.push_back(statePlot(states, span));

  figures::Figure figure;
  figure.title = plot.title;
  figure.note = makeFigureNote(strips);
  figure.panel_width_px = 900.0;
  constexpr double kRowPx = 17.0;
  figure.panel_height_px = std::max(180.0, 60.0 + kRowPx * static_cast<double>(states.size()));
  for (Plot& panel : panels) {
    panel.x.from = span.from_s;
    panel.x.to = span.to_s;
    panel.least_left_px = roomFor(states);
  }
  panels.back().x.label = "time";
  panels.back().x.unit = "s";
  figure.panels.assign(panels.begin(), panels.end());
  return figure;
}

}  // namespace palpate::app
