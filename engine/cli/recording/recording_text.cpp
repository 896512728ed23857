#include "cli/recording/recording_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>

#include "cli/kit/number_option.h"
#include "cli/kit/readable_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/engine/recording_settings.h"

namespace palpate::app {

namespace {

std::string describeEnd(const trace::RecordingFacts& facts) {
  return facts.ended_by.empty() ? "no end: it is being written, or its program was killed"
                                : "ended: " + readableLine(facts.ended_by);
}

double bytesPerSample(const std::filesystem::path& file, const trace::RecordingFacts& facts) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  return error || facts.samples == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(facts.samples);
}

/// The limits of each finger in a world; one line where they are the same for all.
std::string limitsText(const trace::RecordingWorld& world, const trace::RecordingFacts& facts) {
  std::vector<std::pair<std::string, std::string>> lines;  // names of fingers, limits
  for (const auto& [finger, limits] : engine::limitsIn(world, facts.fingers)) {
    const std::string words = engine::describeLimits(limits);
    if (!lines.empty() && lines.back().second == words) {
      lines.back().first += ", " + finger;
    } else {
      lines.emplace_back(finger, words);
    }
  }
  std::string text;
  for (const auto& [names, words] : lines) text += fmt::format("limits      {}: {}\n", readableLine(names), words);
  return text;
}

Json limitsJson(trace::RecordingReader& reader) {
  const trace::RecordingFacts& facts = reader.facts();
  Json json = Json::array();
  for (std::uint64_t i = 0; i < facts.worlds; ++i) {
    const trace::RecordingWorld world = reader.world(facts.first_world + i);
    for (const auto& [finger, limits] : engine::limitsIn(world, facts.fingers)) {
      json.push_back({{"world", facts.first_world + i},
                      {"finger", finger},
                      {"force_n", limits.force_n},
                      {"stiffness_factor", limits.stiffness_factor},
                      {"stiffness_n_per_mm", limits.stiffness_factor * limits.stiffness_n_per_mm},
                      {"ratios_kept_to_n", limits.cap_n_per_mm > 0.0 ? limits.compared_n : limits.force_n},
                      {"unsafe_stiffness", limits.unsafe}});
    }
  }
  return json;
}

}  // namespace

void addTimeSpan(Command& command, TimeSpan& span) {
  addNumber(command, "--from", span.from_s, between(0.0, 1e9, "s"), "Start time");
  addNumber(command, "--to", span.to_s, between(0.0, 1e9, "s"), "End time (default: the end)");
}

trace::TickSpan toTickSpan(const TimeSpan& span, double ticks_per_s) {
  if (!(span.from_s <= span.to_s)) throw Error("--from must be below --to");
  trace::TickSpan ticks;
  ticks.from = static_cast<std::uint64_t>(std::llround(span.from_s * ticks_per_s));
  if (std::isfinite(span.to_s)) ticks.to = static_cast<std::uint64_t>(std::llround(span.to_s * ticks_per_s));
  return ticks;
}

bool isRecordingFile(const std::filesystem::path& file) {
  if (file.extension() == ".session") return true;
  constexpr std::string_view kMagic = "SQLite format 3";
  std::array<char, kMagic.size()> begin{};
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == kMagic;
}

std::string recordingLine(const trace::RecordingFacts& facts) {
  std::string fingers;
  for (const trace::RecordingFinger& finger : facts.fingers)
    fingers += (fingers.empty() ? "" : ", ") + readableLine(finger.name);
  std::string text = fmt::format("{}  {:8.1f} s  {}; {}", readableLine(facts.header.started_utc), facts.seconds(),
                                 fingers, describeEnd(facts));
  if (facts.dropped > 0) text += fmt::format("; {} samples were dropped", facts.dropped);
  if (!facts.header.notes.empty()) text += "; " + readableLine(facts.header.notes);
  return text;
}

Json factsJson(const trace::RecordingFacts& facts) {
  Json fingers = Json::array();
  for (const trace::RecordingFinger& finger : facts.fingers) {
    fingers.push_back({{"name", finger.name}, {"device", finger.device}});
  }
  return {{"started_utc", facts.header.started_utc},
          {"ended_utc", facts.ended_utc},
          {"ended_by", facts.ended_by},
          {"software", facts.header.software},
          {"machine", facts.header.machine},
          {"ticks_per_s", facts.header.ticks_per_s},
          {"seconds", facts.seconds()},
          {"samples", facts.samples},
          {"dropped", facts.dropped},
          {"worlds", facts.worlds},
          {"first_world", facts.first_world},
          {"events", facts.events},
          {"attachments", facts.attachments},
          {"notes", facts.header.notes},
          {"tags", facts.header.tags},
          {"fingers", fingers}};
}

std::string recordingInfo(const std::filesystem::path& file) {
  trace::RecordingReader reader(file);
  const trace::RecordingFacts& facts = reader.facts();
  std::string text =
      fmt::format("recording     begun {}, {}\n", readableLine(facts.header.started_utc), describeEnd(facts));
  text += fmt::format("length      {:.3f} s, {} samples at {:.0f} a second, {:.0f} bytes each\n", facts.seconds(),
                      facts.samples, facts.header.ticks_per_s, bytesPerSample(file, facts));
  if (facts.dropped > 0) text += fmt::format("dropped     {} samples found no room\n", facts.dropped);
  for (const trace::RecordingFinger& finger : facts.fingers) {
    text += fmt::format("finger      {}, held by {}\n", readableLine(finger.name), readableLine(finger.device));
  }
  for (std::uint64_t i = 0; i < facts.worlds; ++i) {
    const trace::RecordingWorld world = reader.world(facts.first_world + i);
    text += fmt::format("world       {}, {} triangles\n", readableLine(world.body), world.triangles);
    text += limitsText(world, facts);
  }
  for (const trace::RecordingEvent& event : reader.events()) {
    text += fmt::format("event       {:.3f} s, {}: {}\n", static_cast<double>(event.tick) / facts.header.ticks_per_s,
                        readableLine(event.kind), readableLine(event.text));
  }
  text +=
      fmt::format("software    {} on {}\n", readableLine(facts.header.software), readableLine(facts.header.machine));
  if (!facts.header.notes.empty()) text += "notes       " + readableLine(facts.header.notes) + "\n";
  if (!facts.header.tags.empty()) text += "tags        " + readableLine(facts.header.tags) + "\n";
  for (const auto& [block, why] : reader.damagedBlocks()) text += fmt::format("damaged     block {}: {}\n", block, why);
  return text;
}

Json recordingInfoJson(const std::filesystem::path& file) {
  trace::RecordingReader reader(file);
  Json json = {{"file", file.string()}};
  json.update(factsJson(reader.facts()));
  json["limits"] = limitsJson(reader);
  json["bytes_per_sample"] = bytesPerSample(file, reader.facts());
  json["damaged_blocks"] = reader.damagedBlocks().size();
  return json;
}

}  // namespace palpate::app
