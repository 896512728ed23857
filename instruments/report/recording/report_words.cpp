// The numbers of a recording in sentences, and the names of its bits.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/language.h"
#include "palpate/servo/limiter.h"
#include "report/page/study_page.h"
#include "report/plot/forces_plot.h"
#include "report/recording/recording_report.h"

namespace palpate::app {

namespace {

using study::counted;
using study::percent;
using study::rounded;
using trace::Measured;

/// By the number of the bit.
constexpr std::array<const char*, servo::kSafetyBits> kSafetyMeanings = {
    toTranslate("the device sent no valid number: no force"),
    toTranslate("the tip moved farther than a hand can: no force"),
    toTranslate("the computed force was not a number: no force"),
    toTranslate("a force that grows slowly after a start inside"),
    toTranslate("the passivity controller removed force"),
    toTranslate("shortened to the largest force"),
    toTranslate("the force would have grown too fast: no force"),
    toTranslate("the loop had stopped for too long: no force"),
    toTranslate("the device's last place was too old: no force"),
    toTranslate("no force until the tip has been outside once"),
    toTranslate("the soft first moment of a fast touch"),
    toTranslate("pressed: no force until it is released"),
    toTranslate("a warning: the controller removes much of the force"),
    toTranslate("the device is moved apart from its finger: no force")};

constexpr std::array<const char*, 8> kContactMeanings = {
    toTranslate("the tip had no valid position: no force"),
    toTranslate("the skin's side of the finger was on its way, or the force grew as fast as it may"),
    toTranslate("deeper than the contact feels: the force no longer grew"),
    toTranslate("the contact had ended and its force faded"),
    toTranslate("the force faded because the sheet ends"),
    toTranslate("a finger that began inside was pushed out"),
    toTranslate("the finger's place on the skin took more than a tick"),
    toTranslate("smoothing of facets fell back to the facets")};

double computeShare(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<StatusLine> linesOf(const RecordingReport& report, std::span<const StatusName> names,
                                std::span<const char* const> meanings,
                                trace::BitTallies trace::FingerStatistics::*tallies) {
  std::vector<StatusLine> lines;
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    for (std::size_t bit = 0; bit < 32; ++bit) {
      const trace::BitTally& tally = (report.statistics.fingers[f].*tallies)[bit];
      if (tally.ticks == 0) continue;
      const bool known = bit < names.size();
      lines.push_back({f, known ? std::string(names[bit].name) : trf("bit {}", bit),
                       tr(known && bit < meanings.size() ? meanings[bit] : toTranslate("not known to this version")),
                       tally});
    }
  }
  return lines;
}

// ---- sentences

std::string lengthSentence(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  if (ticks.recorded == 0) return tr("Nothing was recorded: there is not a single tick.");
  const std::string length = formatDuration(report.statistics.seconds(ticks.expected()));
  const std::string fingers =
      trnf("{} finger", "{} fingers", report.statistics.fingers.size(), report.statistics.fingers.size());
  return report.whole ? trf("The recording lasts {} and has {}.", length, fingers)
                      : trf("This part of the recording lasts {} and has {}.", length, fingers);
}

const trace::Contact* strongestContact(const RecordingReport& report, std::size_t finger) {
  const trace::Contact* strongest = nullptr;
  for (const trace::Contact& contact : report.statistics.contacts) {
    if (contact.finger != finger) continue;
    if (strongest == nullptr || contact.peak_force_n > strongest->peak_force_n) strongest = &contact;
  }
  return strongest;
}

std::string touchSentence(const RecordingReport& report, std::size_t f) {
  const trace::FingerStatistics& finger = report.statistics.fingers[f];
  const std::string& name = report.facts.fingers[f].name;
  if (finger.ticks == 0) return trf("Nothing was recorded of {}.", name);
  if (finger.contacts == 0) return trf("{} touched nothing.", name);
  const trace::FixedHistogram& force = finger.of(Measured::force);
  const trace::FixedHistogram& depth = finger.of(Measured::depth);
  std::string text = trf(
      "{} touched the skin in {}, {} in all ({} of its time).", name,
      trnf("{} contact", "{} contacts", finger.contacts, counted(static_cast<double>(finger.contacts))),
      formatDuration(report.statistics.seconds(finger.touching)), percent(computeShare(finger.touching, finger.ticks)));
  text += " " + trf("It pressed with {} N on average and {} N at most, {} mm deep on average and {} mm at most.",
                    formatFixed(force.mean(), 2), formatFixed(force.greatest(), 2), formatFixed(depth.mean(), 1),
                    formatFixed(depth.greatest(), 1));
  const trace::Contact* strongest = strongestContact(report, f);
  if (strongest != nullptr && finger.contacts > 1 && report.statistics.contact_count <= trace::kMaxListed) {
    text += " " + trf("The hardest contact began at {:.2f} s.", report.secondsAt(strongest->first_tick));
  }
  return text;
}

std::string phaseSentence(const RecordingReport& report, std::size_t f) {
  const trace::FingerStatistics& finger = report.statistics.fingers[f];
  if (finger.contacts == 0) return {};
  const std::uint64_t all = finger.phase_ticks[0] + finger.phase_ticks[1] + finger.phase_ticks[2];
  const auto share = [&](trace::Phase phase) {
    return percent(computeShare(finger.phase_ticks[static_cast<std::size_t>(phase)], all));
  };
  return trf("{} spent {} of its time in search, {} in palpation and {} off the skin; it went {} mm over the skin.",
             report.facts.fingers[f].name, share(trace::Phase::search), share(trace::Phase::palpation),
             share(trace::Phase::away), formatFixed(finger.path_mm, 0));
}

std::string coverageSentence(const RecordingReport& report) {
  if (!report.body.surface) return report.body.why_not;
  const trace::TouchedSurface& surface = *report.body.surface;
  if (surface.touched_dorsal_mm2 == 0.0) {
    return trf("The fingers reached {} mm² of the skin, none of it on the back.", rounded(surface.touched_mm2, 3));
  }
  return trf("The fingers reached {} mm² of the back, {} of its {} mm².", rounded(surface.touched_dorsal_mm2, 3),
             percent(surface.touched_dorsal_mm2 / surface.dorsal_mm2), rounded(surface.dorsal_mm2, 3));
}

/// Empty for a recording within the safe limits.
std::string unsafeSentence(const RecordingReport& report) {
  return report.unsafe.empty()
             ? ""
             : trf("Recorded with --unsafe-stiffness ({}).", fmt::format("{}", fmt::join(report.unsafe, "; "))) + " ";
}

std::string safetySentence(const RecordingReport& report) {
  const std::uint64_t stops = emergencyStops(report);
  if (safetyLines(report).empty()) return unsafeSentence(report) + tr("The safety limits never had to act.");
  std::string words;
  for (std::size_t bit = 0; bit < servo::kSafetyBits; ++bit) {
    std::uint64_t ticks = 0;
    for (const trace::FingerStatistics& finger : report.statistics.fingers) ticks += finger.safety[bit].ticks;
    if (ticks == 0) continue;
    words += fmt::format("{}{} ({} s)", words.empty() ? "" : ", ", servo::safetyNames()[bit],
                         rounded(report.statistics.seconds(ticks)));
  }
  const std::string stopped = stops == 0 ? std::string(tr("The emergency stop was not pressed."))
                                         : trnf("The emergency stop was pressed {} time.",
                                                "The emergency stop was pressed {} times.", stops, stops);
  return unsafeSentence(report) + trf("The safety limits acted: {}.", words) + " " + stopped;
}

std::string servoSentence(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  const std::string expected = counted(static_cast<double>(ticks.expected()));
  std::string text = trf("All {} ticks were recorded.", expected);
  if (ticks.missing() > 0) {
    text = trf("{} of {} ticks are missing ({}), in {}; the longest gap is {} ms, at {:.2f} s.",
               counted(static_cast<double>(ticks.missing())), expected,
               percent(computeShare(ticks.missing(), ticks.expected())),
               trnf("{} gap", "{} gaps", ticks.gaps, counted(static_cast<double>(ticks.gaps))),
               rounded(1000.0 * report.statistics.seconds(ticks.longest_gap.missing), 3),
               report.secondsAt(ticks.longest_gap.after_tick));
  }
  if (report.facts.dropped > 0) {
    text +=
        " " + trnf("{} sample was dropped on its way to the file.", "{} samples were dropped on their way to the file.",
                   report.facts.dropped, counted(static_cast<double>(report.facts.dropped)));
  }
  return text;
}

}  // namespace

std::vector<std::string> reportSentences(const RecordingReport& report) {
  std::vector<std::string> sentences = {lengthSentence(report)};
  if (report.statistics.ticks.recorded > 0) {
    for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
      sentences.push_back(touchSentence(report, f));
      sentences.push_back(phaseSentence(report, f));
    }
    sentences.push_back(coverageSentence(report));
    sentences.push_back(safetySentence(report));
    sentences.push_back(servoSentence(report));
  }
  std::erase(sentences, std::string());
  return sentences;
}

std::vector<StatusLine> safetyLines(const RecordingReport& report) {
  return linesOf(report, safetyStatusNames(), kSafetyMeanings, &trace::FingerStatistics::safety);
}

std::vector<StatusLine> contactLines(const RecordingReport& report) {
  return linesOf(report, contactStatusNames(), kContactMeanings, &trace::FingerStatistics::contact_status);
}

std::uint64_t emergencyStops(const RecordingReport& report) {
  std::uint64_t most = 0;
  for (const trace::FingerStatistics& finger : report.statistics.fingers) {
    most = std::max(most, finger.safety[std::countr_zero(std::uint32_t{servo::kEmergencyStop})].times);
  }
  return most;
}

std::string formatDuration(double seconds) {
  if (!(seconds < 120.0)) {
    const auto whole = static_cast<std::uint64_t>(std::min(std::round(seconds), 1e15));
    const std::uint64_t hours = whole / 3600;
    const std::string below = trf("{:02} s", whole % 60);
    return hours == 0 ? trf("{} min {}", whole / 60, below) : trf("{} h {:02} min {}", hours, whole / 60 % 60, below);
  }
  return trf("{:.{}f} s", seconds, seconds < 1.0 ? 3 : 1);
}

std::string formatFixed(double value, int decimals) {
  constexpr double kLong = 1e7;
  return std::abs(value) < kLong ? fmt::format("{:.{}f}", WrittenNumber{value}, decimals)
                                 : fmt::format("{:.3g}", WrittenNumber{value});
}

std::string_view phaseWord(trace::Phase phase) {
  constexpr std::array kWords = {toTranslate("off the skin"), toTranslate("search"), toTranslate("palpation")};
  return tr(kWords[static_cast<std::size_t>(phase)]);
}

}  // namespace palpate::app
