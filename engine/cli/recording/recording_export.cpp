#include "cli/recording/recording_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "cli/recording/npz_file.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/sample_block.h"

namespace palpate::app {

namespace {

/// Names in a foreign recording become names of files and arrays.
std::string plainName(const std::string& name) {
  std::string plain = name;
  for (char& c : plain) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!is_plain) c = '_';
  }
  return plain.empty() ? "unnamed" : plain;
}

std::vector<std::string> plainNames(const trace::RecordingFacts& facts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const trace::RecordingFinger& finger : facts.fingers) {
    std::string name = plainName(finger.name);
    while (!taken.insert(name).second) name += '_';
    names.push_back(name);
  }
  return names;
}

std::string_view numpyType(const trace::SampleColumn& column) {
  return column.type == "f64" ? "<f8" : column.type == "u64" ? "<u8" : "<u4";
}

/// The columns of one finger; each takes another pass through the recording, so that memory is for one.
std::uint64_t addFinger(trace::RecordingReader& recording, const trace::TickSpan& span, std::uint32_t finger,
                        const std::string& name, NpzFile& file) {
  const auto columns = trace::sampleColumns();
  std::vector<std::string> bytes(columns.size());
  std::uint64_t rows = 0;
  recording.forEachTick(span, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) {
      if (sample.finger != finger) continue;
      ++rows;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::uint64_t bits = columns[i].bits(sample);
        for (std::size_t byte = 0; byte < columns[i].width(); ++byte) {
          bytes[i] += static_cast<char>((bits >> (8 * byte)) & 0xffu);
        }
      }
    }
    return true;
  });
  for (std::size_t i = 0; i < columns.size(); ++i) {
    file.add(name + "." + std::string(columns[i].name), numpyType(columns[i]), rows, bytes[i]);
    bytes[i] = std::string();
  }
  return rows;
}

std::string attachmentExtension(const trace::RecordingAttachment& attachment) {
  static const std::map<std::string, std::string, std::less<>> extensions = {{"image/png", ".png"},
                                                                             {"image/jpeg", ".jpg"},
                                                                             {"audio/wav", ".wav"},
                                                                             {"audio/x-wav", ".wav"},
                                                                             {"text/plain", ".txt"}};
  const auto known = extensions.find(attachment.media);
  return known == extensions.end() ? ".bin" : known->second;
}

std::uint64_t tickAt(double time_s, const trace::RecordingFacts& facts) {
  return static_cast<std::uint64_t>(std::llround(time_s * facts.header.ticks_per_s));
}

}  // namespace

std::uint64_t writeNpz(trace::RecordingReader& recording, const trace::TickSpan& span,
                       const std::filesystem::path& file, const engine::RecordedPressure* pressure,
                       const Progress& progress) {
  const std::vector<std::string> names = plainNames(recording.facts());
  NpzFile npz(file);
  npz.add("ticks_per_s", recording.facts().header.ticks_per_s);
  std::uint64_t rows = 0;
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    report(progress, "writing the arrays", static_cast<double>(i) / static_cast<double>(names.size()));
    const std::uint64_t ticks = addFinger(recording, span, i, names[i], npz);
    rows += ticks;
    if (pressure != nullptr) npz.addSquares(names[i] + ".pressure_kpa", ticks, pressure->taxels, pressure->kpa.at(i));
  }
  npz.commit();
  return rows;
}

trace::MoreColumns pressureColumns(const engine::RecordedPressure* pressure) {
  if (pressure == nullptr) return {};
  trace::MoreColumns more;
  for (std::size_t row = 1; row <= pressure->taxels; ++row) {
    for (std::size_t column = 1; column <= pressure->taxels; ++column) {
      more.header += fmt::format(",pressure_{}_{}_kpa", row, column);
    }
  }
  std::vector<std::size_t> next(pressure->kpa.size(), 0);  // per finger's taxels
  more.append = [pressure, next](const trace::Sample& sample, std::string& text) mutable {
    const std::vector<float>& of_finger = pressure->kpa.at(sample.finger);
    for (std::size_t taxel = 0; taxel < pressure->taxels * pressure->taxels; ++taxel) {
      fmt::format_to(std::back_inserter(text), ",{}", of_finger.at(next[sample.finger]++));
    }
  };
  return more;
}

std::uint64_t writeAttachments(trace::RecordingReader& recording, const trace::TickSpan& span,
                               const std::filesystem::path& folder) {
  std::uint64_t count = 0;
  recording.forEachAttachment(span, [&](const trace::RecordingAttachment& attachment) {
    if (attachment.kind == trace::kCarriedFile) return;
    if (count == 0) {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error) throw Error::inFile(folder.string(), "cannot be created: " + error.message());
    }
    const double time_s = static_cast<double>(attachment.tick) / recording.facts().header.ticks_per_s;
    writeFile(folder / fmt::format("{:04}_{}_{:.3f}s{}", ++count, plainName(attachment.kind), time_s,
                                   attachmentExtension(attachment)),
              attachment.data);
  });
  return count;
}

std::shared_ptr<const scene::World> worldToSee(trace::RecordingReader& recording, std::uint32_t number,
                                               const std::filesystem::path& folder,
                                               const std::function<void(scene::Scene&)>& change,
                                               const Progress& progress) {
  const trace::RecordingWorld recorded = recording.world(number);
  const std::filesystem::path from = folder.empty() ? pathOf(recorded.folder) : folder;
  scene::Scene scene = scene::parse(recorded.scene, (from / "session.toml").string());
  // A finger with an automatic path is not in the scene; the recording has all.
  const auto& fingers = recording.facts().fingers;
  std::vector<scene::Finger> all;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const auto known = std::find_if(scene.fingers.begin(), scene.fingers.end(),
                                    [&](const scene::Finger& finger) { return finger.name == fingers[i].name; });
    all.push_back(known == scene.fingers.end() ? scene::Finger() : *known);
    all.back().name = fingers[i].name;
    if (i < recorded.fingers.size()) {
      all.back().radius_mm = engine::contactSettingsFrom(recorded.fingers[i].contact).radius_mm;
    }
  }
  scene.fingers = std::move(all);
  if (change) change(scene);
  return scene::build(scene, progress);
}

std::vector<servo::TickSamples> recordedFrames(trace::RecordingReader& recording, const std::vector<double>& times_s) {
  const trace::RecordingFacts& facts = recording.facts();
  if (facts.samples == 0) throw Error("the recording has no ticks");
  const double rate = facts.header.ticks_per_s;
  for (const double time_s : {times_s.front(), times_s.back()}) {
    if (tickAt(time_s, facts) >= facts.first_tick && tickAt(time_s, facts) <= facts.last_tick) continue;
    throw Error(fmt::format("{} s is outside the recording, which lasts from {:.3f} to {:.3f} s", time_s,
                            static_cast<double>(facts.first_tick) / rate, static_cast<double>(facts.last_tick) / rate));
  }
  std::vector<servo::TickSamples> frames;
  recording.forEachTick({tickAt(times_s.front(), facts)}, [&](std::span<const trace::Sample> samples) {
    while (frames.size() < times_s.size() && samples.front().tick >= tickAt(times_s[frames.size()], facts)) {
      frames.emplace_back(samples.begin(), samples.end());
    }
    return frames.size() < times_s.size();
  });
  return frames;
}

void requireFitting(const servo::TickSamples& frame, const scene::World& world) {
  for (const trace::Sample& sample : frame) {
    const contact::FingerOutput& contact = sample.contact;
    if (contact.touch == contact::Touch::free) continue;
    bool fits = contact.triangle < world.body->skin.triangles.size() &&
                contact.anchor_triangle < world.body->skin.triangles.size();
    for (const Vec3* place :
         {&contact.tip, &contact.proxy, &contact.anchor, &contact.hold, &contact.normal, &contact.force}) {
      fits = fits && place->allFinite();
    }
    if (!fits)
      throw Error("the body differs from the recorded one; name the folder of the recorded body's files with --folder");
  }
}

std::uint64_t deepestTick(trace::RecordingReader& recording) {
  std::uint64_t deepest = recording.facts().first_tick;
  double deepest_mm = -1.0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    double depth_mm = 0.0;
    for (const trace::Sample& sample : samples) depth_mm += sample.contact.depth_mm;
    if (depth_mm > deepest_mm) {
      deepest_mm = depth_mm;
      deepest = samples.front().tick;
    }
    return true;
  });
  return deepest;
}

}  // namespace palpate::app
