// A recording in which no two things are the same, and all that a recording holds but its ticks, as one text: what any
// way through a file loses or puts under another name is a line of difference.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_writer.h"

namespace palpate::trace {

/// More than a page of a file, and no two parts of it alike.
inline std::string longText(const std::string& word) {
  std::string text;
  for (int i = 0; i < 4000; ++i) text += word + std::to_string(i);
  return text;
}

/// A recording of two fingers and two worlds, 400 ticks each finger, with events and attachments.
inline void writeWholeRecording(const std::filesystem::path& file) {
  RecordingWriter writer(file,
                         {.started_utc = "2026-11-21T12:00:00Z",
                          .software = "the software",
                          .machine = "the machine",
                          .ticks_per_s = 500.0,
                          .notes = "the notes",
                          .tags = "the tags"},
                         {{"index", "mouse", "max_force_n = 3", "scale = 2"}, {"middle", "touch", "rate_hz = 4", ""}});
  writer.add(RecordingWorld{"# first\n", "/one", "trunk", 11, 0xa1, {{"radius_mm = 8", "limited = 1"}, {"c", "l"}}});
  writer.add(RecordingWorld{"# second\n", "/two", "dome", 22, 0xb2, {{"radius_mm = 4", ""}, {"", "limited = 0"}}});
  writer.add(RecordingAttachment{5, "file", "body.obj", "", longText("v")});
  for (std::uint64_t tick = 0; tick < 400; ++tick) {
    for (std::uint32_t finger = 0; finger < 2; ++finger) {
      Sample sample;
      sample.tick = tick;
      sample.finger = finger;
      sample.world = tick < 200 ? 0 : 1;
      sample.contact.tip = {static_cast<double>(tick), 0.1 * finger, 1.0 / (1.0 + static_cast<double>(tick))};
      writer.add(sample);
    }
  }
  writer.add(RecordingEvent{7, 1u, "mark", "here"});
  writer.add(RecordingEvent{9, std::nullopt, "note", longText("n")});
  writer.add(RecordingAttachment{30, "picture", "seen.png", "image/png", "bytes"});
  writer.setDropped(3);
  writer.finish("a fault", "2026-11-21T12:00:09Z");
}

/// A thing a line.
inline std::string contentOf(const std::filesystem::path& file) {
  RecordingReader reader(file);
  const RecordingFacts& facts = reader.facts();
  const RecordingHeader& header = facts.header;
  std::string content = fmt::format("{} to {}: {}; {} on {}, {} a second, {} dropped; {}; {}\n", header.started_utc,
                                    facts.ended_utc, facts.ended_by, header.software, header.machine,
                                    header.ticks_per_s, facts.dropped, header.notes, header.tags);
  for (const RecordingFinger& finger : facts.fingers) {
    content += fmt::format("finger {}, {}, {}, {}\n", finger.name, finger.device, finger.capabilities, finger.placed);
  }
  for (std::uint64_t number = facts.first_world; number < facts.first_world + facts.worlds; ++number) {
    const RecordingWorld world = reader.world(number);
    content +=
        fmt::format("world {}, {}, {}, {:x}, {}", world.folder, world.body, world.triangles, world.hash, world.scene);
    for (const RecordingSettings& settings : world.fingers) {
      content += fmt::format("  felt with {}; {}\n", settings.contact, settings.limiter);
    }
  }
  for (const RecordingEvent& event : reader.events()) {
    const std::string finger = event.finger ? std::to_string(*event.finger) : "all";
    content += fmt::format("{} {} {}: {}\n", event.kind, event.tick, finger, event.text);
  }
  reader.forEachAttachment({}, [&](const RecordingAttachment& a) {
    content += fmt::format("{} {}: {}, {}, {}\n", a.kind, a.tick, a.name, a.media, a.data);
  });
  content += fmt::format("{} samples from {} to {}, {} events, {} attachments\n", facts.samples, facts.first_tick,
                         facts.last_tick, facts.events, facts.attachments);
  return content;
}

}  // namespace palpate::trace
