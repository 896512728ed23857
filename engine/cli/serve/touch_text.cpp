// Numbers are rounded below what a finger can distinguish: four digits behind the point for N, two for kPa.
#include "cli/serve/touch_text.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "palpate/base/json.h"

namespace palpate::app::serving {

namespace {

double rounded(double value, double parts) { return std::round(value * parts) / parts; }
double newton(double force) { return rounded(force, 1e4); }

Json forceJson(const Vec3& force) { return {newton(force.x()), newton(force.y()), newton(force.z())}; }

std::string_view touchName(contact::Touch touch) {
  constexpr std::array<std::string_view, 3> kWords = {"free", "stick", "slip"};
  return kWords[static_cast<std::size_t>(touch)];
}

Json pressuresJson(const engine::FeltPressure& pressure, const trace::Sample& sample, const Listen& asked) {
  std::vector<double> kpa(asked.pad * asked.pad);
  pressure.at(sample.contact, sample.tick, {asked.pad, asked.pad_mm}, kpa);
  Json all = Json::array();
  for (const double taxel : kpa) all.push_back(rounded(taxel, 1e2));
  return all;
}

}  // namespace

TouchTexts::TouchTexts(std::shared_ptr<const engine::FeltPressure> pressure, std::vector<trace::Sample> felt)
    : pressure_(std::move(pressure)), felt_(std::move(felt)) {}

Frame TouchTexts::of(const Listen& asked, bool instructs) {
  Frame& text = made_[{asked.pad, asked.pad_mm, instructs}];
  if (!text) text = std::make_shared<const std::string>(composeText(asked, instructs));
  return text;
}

std::string TouchTexts::composeText(const Listen& asked, bool instructs) const {
  Json fingers = Json::array();
  for (const trace::Sample& sample : felt_) {
    const contact::FingerOutput& felt = sample.contact;
    Json finger = {{"state", std::string(touchName(felt.touch))},
                   {"depth_mm", newton(felt.depth_mm)},
                   {"force_n", forceJson(felt.force)}};
    if (instructs) {
      finger["lump_force_n"] = forceJson(felt.lump_force);
      finger["lump_share"] = newton(felt.lump_share);
    }
    if (asked.pad > 0 && pressure_) finger["kpa"] = pressuresJson(*pressure_, sample, asked);
    fingers.push_back(std::move(finger));
  }
  Json json = {{"type", "touch"}, {"tick", felt_.empty() ? 0 : felt_.front().tick}};
  if (asked.pad > 0) {
    json["pad"] = asked.pad;
    json["pad_mm"] = asked.pad_mm;
  }
  json["fingers"] = std::move(fingers);
  return jsonDump(json);
}

}  // namespace palpate::app::serving
