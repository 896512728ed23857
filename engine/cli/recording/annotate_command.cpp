// `palpate recording annotate`: adds notes, tags, marks, pictures and sound notes to a recording afterwards.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/options.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/own/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_edit.h"

namespace palpate::app {

namespace {

struct AnnotateArguments {
  std::filesystem::path file;
  std::filesystem::path out;
  std::optional<std::string> notes;
  std::optional<std::string> tags;
  std::vector<std::string> marks;
  std::vector<std::string> attached;
};

/// "T6 right@12.5": text, and time in the recording, s.
struct At {
  std::string what;
  std::uint64_t tick = 0;
};

At readAt(const std::string& option, const std::string& words, const trace::RecordingFacts& facts) {
  const std::size_t at = words.rfind('@');
  const std::optional<double> seconds =
      at == std::string::npos ? std::nullopt : parseNumber(std::string_view(words).substr(at + 1));
  if (at == 0 || !seconds || !std::isfinite(*seconds) || *seconds < 0.0) {
    throw Error(fmt::format("{}: '{}' must be WHAT@SECONDS, e.g. 'T6 right@12.5'", option, words));
  }
  const double tick = std::round(*seconds * facts.header.ticks_per_s);
  if (tick < static_cast<double>(facts.first_tick) || tick > static_cast<double>(facts.last_tick)) {
    throw Error(fmt::format("{}: {} s is outside the recording, which lasts from {:.3f} to {:.3f} s", option, *seconds,
                            static_cast<double>(facts.first_tick) / facts.header.ticks_per_s,
                            static_cast<double>(facts.last_tick) / facts.header.ticks_per_s));
  }
  return {words.substr(0, at), static_cast<std::uint64_t>(tick)};
}

struct Media {
  std::string_view extension;
  std::string_view kind;
  std::string_view type;
};
constexpr std::array<Media, 8> kMedia = {{{".png", "picture", "image/png"},
                                          {".jpg", "picture", "image/jpeg"},
                                          {".jpeg", "picture", "image/jpeg"},
                                          {".wav", "sound", "audio/wav"},
                                          {".ogg", "sound", "audio/ogg"},
                                          {".mp3", "sound", "audio/mpeg"},
                                          {".flac", "sound", "audio/flac"},
                                          {".txt", "note", "text/plain"}}};

trace::RecordingAttachment attachmentOf(const At& at) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
  const std::filesystem::path file = pathOf(at.what);
  const std::string extension = file.extension().string();
  for (const Media& media : kMedia) {
    if (extension != media.extension) continue;
    return {at.tick, std::string(media.kind), file.filename().string(), std::string(media.type),
            readFile(file, kMaxBytes)};
  }
  throw Error::inFile(at.what, "must be a picture (png, jpg), a sound (wav, ogg, mp3, flac) or a note (txt)");
}

void runAnnotate(const AnnotateArguments& arguments) {
  if (!arguments.notes && !arguments.tags && arguments.marks.empty() && arguments.attached.empty()) {
    throw Error("annotate: nothing to add; use --notes, --tags, --mark or --attach");
  }
  trace::refuseSame(arguments.out, arguments.file);
  ProgressLine progress;
  const trace::ReadingWatch watch(throwIfInterrupted);
  trace::RecordingReader recording(arguments.file);
  const trace::RecordingFacts& facts = recording.facts();
  trace::RecordingHeader header = facts.header;
  if (arguments.notes) header.notes = *arguments.notes;
  if (arguments.tags) header.tags = *arguments.tags;
  std::vector<At> marks;
  for (const std::string& words : arguments.marks) marks.push_back(readAt("--mark", words, facts));
  std::vector<trace::RecordingAttachment> attached;
  for (const std::string& words : arguments.attached) {
    attached.push_back(attachmentOf(readAt("--attach", words, facts)));
  }
  trace::RecordingWriter writer(arguments.out, header, facts.fingers);
  for (const At& mark : marks) writer.add(trace::RecordingEvent{mark.tick, std::nullopt, "mark", mark.what});
  trace::copyInto(writer, recording, {}, progress.callback());
  for (const trace::RecordingAttachment& attachment : attached) writer.add(attachment);
  writer.setDropped(facts.dropped);
  writer.finish(facts.ended_by.empty() ? "not finished" : facts.ended_by);
  progress.clear();
  fmt::print("{}: {} marks and {} attachments added\n", arguments.out.string(), marks.size(), attached.size());
}

}  // namespace

void addAnnotateCommand(Command& recording) {
  const auto [command, a] =
      addCommand(recording, "annotate",
                 "Write a copy of a recording with your own notes, tags, marks, pictures and sound notes", runAnnotate);
  command.add_option("RECORDING", a.file, "Recording file")->required();
  command.add_option("--notes", a.notes, "Description of the recording, in place of its notes");
  command.add_option("--tags", a.tags, "Search words, separated by spaces, in place of its tags");
  command.add_option("--mark", a.marks, "Set a mark: WORDS@SECONDS; repeatable")->allow_extra_args(false);
  command
      .add_option(
          "--attach", a.attached,
          "Attach a picture (png, jpg), a sound (wav, ogg, mp3, flac) or a note (txt): FILE@SECONDS; repeatable")
      ->allow_extra_args(false);
  namesFileToWrite(command.add_option("-o,--out", a.out, "Recording file to write"))->required();
}

}  // namespace palpate::app
