#include "cli/session/session_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cli/session/npz_file.h"
#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/engine/session_bundle.h"
#include "palpate/engine/session_settings.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/sample_block.h"

namespace palpate::app {

namespace {

/// Names of a stranger's session become names of files and arrays.
std::string plainName(const std::string& name) {
  std::string plain = name;
  for (char& c : plain) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!is_plain) c = '_';
  }
  return plain.empty() ? "unnamed" : plain;
}

std::vector<std::string> plainNames(const trace::SessionFacts& facts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const trace::SessionFinger& finger : facts.fingers) {
    std::string name = plainName(finger.name);
    while (!taken.insert(name).second) name += '_';
    names.push_back(name);
  }
  return names;
}

std::string_view numpyTypeOf(const trace::SampleColumn& column) {
  return column.type == "f64" ? "<f8" : column.type == "u64" ? "<u8" : "<u4";
}

/// The columns of one finger; another pass through the session each, so that memory is for one.
std::uint64_t addFinger(trace::SessionReader& session, const trace::TickSpan& span, std::uint32_t finger,
                        const std::string& name, NpzFile& file) {
  const auto columns = trace::sampleColumns();
  std::vector<std::string> bytes(columns.size());
  std::uint64_t rows = 0;
  session.forEachTick(span, [&](std::span<const trace::Sample> samples) {
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
    file.add(name + "." + std::string(columns[i].name), numpyTypeOf(columns[i]), rows, bytes[i]);
    bytes[i] = std::string();
  }
  return rows;
}

std::string extensionOf(const trace::SessionAttachment& attachment) {
  static const std::map<std::string, std::string, std::less<>> extensions = {{"image/png", ".png"},
                                                                             {"image/jpeg", ".jpg"},
                                                                             {"audio/wav", ".wav"},
                                                                             {"audio/x-wav", ".wav"},
                                                                             {"text/plain", ".txt"}};
  const auto known = extensions.find(attachment.media);
  return known == extensions.end() ? ".bin" : known->second;
}

std::uint64_t tickAt(double time_s, const trace::SessionFacts& facts) {
  return static_cast<std::uint64_t>(std::llround(time_s * facts.header.ticks_per_s));
}

}  // namespace

std::uint64_t writeNpz(trace::SessionReader& session, const trace::TickSpan& span, const std::filesystem::path& file,
                       const Progress& progress) {
  const std::vector<std::string> names = plainNames(session.facts());
  NpzFile npz(file);
  npz.add("ticks_per_s", session.facts().header.ticks_per_s);
  std::uint64_t rows = 0;
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    report(progress, "writing the arrays", static_cast<double>(i) / static_cast<double>(names.size()));
    rows += addFinger(session, span, i, names[i], npz);
  }
  npz.commit();
  return rows;
}

std::uint64_t writeAttachments(trace::SessionReader& session, const trace::TickSpan& span,
                               const std::filesystem::path& folder) {
  std::uint64_t count = 0;
  session.forEachAttachment(span, [&](const trace::SessionAttachment& attachment) {
    if (attachment.kind == trace::kCarriedFile) return;
    if (count == 0) {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error) throw Error::inFile(folder.string(), "cannot be made: " + error.message());
    }
    const double time_s = static_cast<double>(attachment.tick) / session.facts().header.ticks_per_s;
    writeFile(folder / fmt::format("{:04}_{}_{:.3f}s{}", ++count, plainName(attachment.kind), time_s,
                                   extensionOf(attachment)),
              attachment.data);
  });
  return count;
}

std::shared_ptr<const scene::World> worldToSee(trace::SessionReader& session, std::uint32_t number,
                                               const std::filesystem::path& folder,
                                               const std::function<void(scene::Scene&)>& change,
                                               const Progress& progress) {
  const trace::SessionWorld recorded = session.world(number);
  const std::filesystem::path from = folder.empty() ? std::filesystem::path(recorded.folder) : folder;
  scene::Scene scene = scene::parse(recorded.scene, (from / "session.toml").string());
  // A finger that found its own way is not in the scene; who is looked at is in the session.
  const auto& fingers = session.facts().fingers;
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

std::string noteOfAnotherWorld(trace::SessionReader& session, std::uint32_t number, const scene::World& world) {
  const trace::SessionWorld recorded = session.world(number);
  if (engine::hashOf(world) == recorded.hash) return {};
  return fmt::format(
      "world {} is not the recorded one: its body or its stiffness is another ({} triangles instead of {})", number,
      world.body->skin.triangles.size(), recorded.triangles);
}

std::vector<servo::TickSamples> recordedFrames(trace::SessionReader& session, const std::vector<double>& times_s) {
  const trace::SessionFacts& facts = session.facts();
  if (facts.samples == 0) throw Error("the session holds no tick");
  const double rate = facts.header.ticks_per_s;
  for (const double time_s : {times_s.front(), times_s.back()}) {
    if (tickAt(time_s, facts) >= facts.first_tick && tickAt(time_s, facts) <= facts.last_tick) continue;
    throw Error(fmt::format("there is no moment {} s: the session lasts from {:.3f} to {:.3f} s", time_s,
                            static_cast<double>(facts.first_tick) / rate, static_cast<double>(facts.last_tick) / rate));
  }
  std::vector<servo::TickSamples> frames;
  session.forEachTick({tickAt(times_s.front(), facts)}, [&](std::span<const trace::Sample> samples) {
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
    if (!fits) throw Error("the body is not the recorded one: what was touched is not on it");
  }
}

std::uint64_t deepestTick(trace::SessionReader& session) {
  std::uint64_t deepest = session.facts().first_tick;
  double deepest_mm = -1.0;
  session.forEachTick({}, [&](std::span<const trace::Sample> samples) {
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
