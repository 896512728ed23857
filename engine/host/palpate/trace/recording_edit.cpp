// A copy goes through the samples once, in memory for a part only; worlds are copied when a sample first names them.
#include "palpate/trace/recording_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/path_text.h"
#include "palpate/trace/recording_rest.h"

namespace palpate::trace {

namespace {

/// How many samples are copied between two reports of progress.
constexpr std::uint64_t kSamplesPerReport = 20000;

double secondsAt(std::uint64_t tick, const RecordingFacts& facts) {
  return static_cast<double>(tick) / facts.header.ticks_per_s;
}

std::uint32_t firstWorldNumber(const RecordingReader& recording) {
  return static_cast<std::uint32_t>(recording.facts().first_world);
}

class Copy {
 public:
  Copy(RecordingWriter& writer, RecordingReader& recording, const CopySettings& settings)
      : writer_(writer), recording_(recording), settings_(settings), begun_(recording.facts().fingers.size(), false) {}

  Copied run(const Progress& progress) {
    addEvents();
    recording_.forEachTick(settings_.span, [&](std::span<const Sample> samples) {
      for (const Sample& sample : samples) add(sample);
      if (copied_.samples % kSamplesPerReport < samples.size()) reportProgress(progress);
      return true;
    });
    addAttachments();
    return copied_;
  }

 private:
  std::uint64_t later(std::uint64_t tick) const { return tick + static_cast<std::uint64_t>(settings_.later_ticks); }

  void reportProgress(const Progress& progress) const {
    const auto all = static_cast<double>(std::max<std::uint64_t>(1, recording_.facts().samples));
    report(progress, "copying", static_cast<double>(copied_.samples) / all);
  }

  void addEvents() {
    for (RecordingEvent event : recording_.events(settings_.span)) {
      event.tick = later(event.tick);
      if (settings_.change_event) settings_.change_event(event);
      writer_.add(event);
    }
  }

  void addAttachments() {
    recording_.forEachAttachment({}, [&](const RecordingAttachment& attachment) {
      const bool is_file = attachment.kind == kCarriedFile;
      if (is_file && !settings_.keeps_files) return;
      if (!is_file && (attachment.tick < settings_.span.from || attachment.tick > settings_.span.to)) return;
      RecordingAttachment moved = attachment;
      moved.tick = is_file ? std::max(copied_.first_tick, later(attachment.tick)) : later(attachment.tick);
      writer_.add(moved);
    });
  }

  void add(Sample sample) {
    sample.tick = later(sample.tick);
    sample.world = copyWorld(sample.world);
    if (!begun_[sample.finger]) sample.forgot |= settings_.forgets;
    begun_[sample.finger] = true;
    if (copied_.samples == 0) copied_.first_tick = sample.tick;
    copied_.last_tick = sample.tick;
    ++copied_.samples;
    writer_.add(sample);
  }

  std::uint32_t copyWorld(std::uint32_t number) {
    const auto known = worlds_.find(number);
    if (known != worlds_.end()) return known->second;
    if (settings_.has_worlds) return settings_.first_world + (number - firstWorldNumber(recording_));
    RecordingWorld world = recording_.world(number);
    if (settings_.change_world) settings_.change_world(world);
    writer_.add(world);
    return worlds_[number] = settings_.first_world + copied_.worlds++;
  }

  RecordingWriter& writer_;
  RecordingReader& recording_;
  const CopySettings& settings_;
  std::vector<bool> begun_;
  std::map<std::uint32_t, std::uint32_t> worlds_;
  Copied copied_;
};

// --- where a part may begin ---

struct Beginning {
  std::uint64_t tick = 0;
  std::vector<std::uint32_t> not_at_rest;  ///< fingers
};

/// Goes through the samples before a tick and looks where every finger was at rest.
class BeginningSearch {
 public:
  BeginningSearch(const RecordingFacts& facts, std::uint64_t from)
      : from_(from), fingers_(facts.fingers.size()), seen_(facts.fingers.size(), false) {}

  /// Until the tick after the one that is asked for has been seen: a finger must rest in it, too.
  bool add(std::span<const Sample> samples) {
    const std::uint64_t tick = samples.front().tick;
    for (const Sample& sample : samples) {
      fingers_[sample.finger].add(sample);
      seen_[sample.finger] = true;
    }
    if (!first_) first_ = at_rest_ = tick;
    if (before_ && *before_ <= from_ && restless().empty()) at_rest_ = *before_;
    if (before_ && *before_ >= from_) {
      exact_ = Beginning{*before_, restless()};
      return false;
    }
    before_ = tick;
    return true;
  }

  /// The last tick before at which every finger was at rest; the first one there is, if they never were.
  Beginning atRest() const { return {at_rest_.value_or(from_), {}}; }
  Beginning exactly() const { return exact_ ? *exact_ : Beginning{before_.value_or(from_), restless()}; }

 private:
  /// Fingers that did not rest in the tick before and for long enough until then, or not in this one.
  std::vector<std::uint32_t> restless() const {
    std::vector<std::uint32_t> fingers;
    for (std::uint32_t i = 0; i < fingers_.size(); ++i) {
      if (seen_[i] && fingers_[i].ticks() <= kRestTicks) fingers.push_back(i);
    }
    return fingers;
  }

  std::uint64_t from_;
  std::vector<RestWatch> fingers_;
  std::vector<bool> seen_;
  std::optional<std::uint64_t> first_;
  std::optional<std::uint64_t> before_;
  std::optional<std::uint64_t> at_rest_;
  std::optional<Beginning> exact_;
};

Beginning findBeginning(RecordingReader& recording, const TrimSettings& settings) {
  const std::uint64_t first = recording.facts().first_tick;
  if (settings.span.from <= first) return {first, {}};
  BeginningSearch search(recording.facts(), settings.span.from);
  recording.forEachTick({}, [&](std::span<const Sample> samples) { return search.add(samples); });
  return settings.exact ? search.exactly() : search.atRest();
}

void requireTicks(RecordingReader& recording, const TickSpan& span) {
  bool any = false;
  recording.forEachTick(span, [&](std::span<const Sample>) {
    any = true;
    return false;
  });
  if (any) return;
  const RecordingFacts& facts = recording.facts();
  throw Error(facts.samples == 0 ? std::string("the recording has no ticks")
                                 : fmt::format("no ticks in this range; the recording lasts from {:.3f} to {:.3f} s",
                                               secondsAt(facts.first_tick, facts), secondsAt(facts.last_tick, facts)));
}

std::string added(const std::string& notes, const std::string& more) {
  return notes.empty() ? more : notes + "; " + more;
}

// --- one after another ---

std::string joinFingerNames(const RecordingFacts& facts) {
  std::string names;
  for (const RecordingFinger& finger : facts.fingers) names += (names.empty() ? "" : ", ") + finger.name;
  return names;
}

void requireSameFingers(const RecordingFacts& first, const RecordingFacts& next, const std::filesystem::path& file) {
  if (next.header.ticks_per_s != first.header.ticks_per_s) {
    throw Error::inFile(file.string(), fmt::format("has {} ticks per second, but the first recording has {}",
                                                   next.header.ticks_per_s, first.header.ticks_per_s));
  }
  if (joinFingerNames(next) != joinFingerNames(first) || next.fingers.size() != first.fingers.size()) {
    throw Error::inFile(file.string(), fmt::format("has the fingers {}, but the first recording has {}",
                                                   joinFingerNames(next), joinFingerNames(first)));
  }
}

/// The same name for two different files would build another world than was felt.
class FilesOfAll {
 public:
  /// True if none of them is there yet.
  bool add(RecordingReader& recording, const std::filesystem::path& file) {
    bool fresh = true;
    recording.forEachAttachment({}, [&](const RecordingAttachment& attachment) {
      if (attachment.kind != kCarriedFile) return;
      Hash hash;
      for (const char byte : attachment.data) hash.add(std::uint64_t{static_cast<unsigned char>(byte)});
      const auto [known, is_new] = hashes_.try_emplace(attachment.name, hash.value());
      fresh = fresh && is_new;
      if (known->second == hash.value()) return;
      throw Error::inFile(file.string(),
                          fmt::format("contains a '{}' that differs from an earlier recording's", attachment.name));
    });
    return fresh;
  }

 private:
  std::map<std::string, std::uint64_t> hashes_;
};

/// One recording after the other into the writer.
class Chain {
 public:
  Chain(RecordingWriter& writer, const RecordingFacts& first) : writer_(writer), first_(first) {}

  /// Before any tick: what everything depends on is at the beginning of the file, where a cut does not reach it.
  void addWorlds(RecordingReader& recording) {
    first_worlds_.push_back(worlds_);
    const std::uint64_t first = firstWorldNumber(recording);
    for (std::uint64_t i = 0; i < recording.facts().worlds; ++i) writer_.add(recording.world(first + i));
    worlds_ += static_cast<std::uint32_t>(recording.facts().worlds);
  }

  /// In the order in which their worlds were added.
  void add(RecordingReader& recording, const std::filesystem::path& file, const Progress& progress) {
    const std::uint32_t first_world = first_worlds_.at(next_++);
    const RecordingFacts& facts = recording.facts();
    const std::string name = file.filename().string();
    if (facts.samples == 0) {
      joined_.notes.push_back(name + " has no ticks and is skipped");
      return;
    }
    const bool is_first = joined_.begins.empty();
    CopySettings settings;
    settings.first_world = first_world;
    settings.has_worlds = true;
    settings.forgets = is_first ? 0u : kForgotTouch | kForgotLimiter;
    const std::uint64_t begin = is_first ? facts.first_tick : joined_.last_tick + 1;
    settings.later_ticks = static_cast<std::int64_t>(begin - facts.first_tick);
    settings.keeps_files = files_.add(recording, file);
    joined_.begins.push_back(begin);
    writer_.add(RecordingEvent{begin, std::nullopt, std::string(kJoinEvent),
                               fmt::format("{}, begun {}, its {:.3f} to {:.3f} s", name, facts.header.started_utc,
                                           secondsAt(facts.first_tick, facts), secondsAt(facts.last_tick, facts))});
    noteOtherDevices(facts, name);
    const Copied copied = copyInto(writer_, recording, settings, progress);
    writer_.flush();  // a part holds ticks of one recording
    joined_.samples += copied.samples;
    joined_.last_tick = copied.last_tick;
    dropped_ += facts.dropped;
    writer_.setDropped(dropped_);
  }

  Joined joined() const { return joined_; }

 private:
  void noteOtherDevices(const RecordingFacts& facts, const std::string& name) {
    for (std::size_t i = 0; i < facts.fingers.size(); ++i) {
      if (facts.fingers[i].device == first_.fingers[i].device) continue;
      const std::string note =
          fmt::format("in {} {} was moved by {}", name, facts.fingers[i].name, facts.fingers[i].device);
      writer_.add(RecordingEvent{joined_.begins.back(), static_cast<std::uint32_t>(i), "device", note});
      joined_.notes.push_back(note);
    }
  }

  RecordingWriter& writer_;
  const RecordingFacts& first_;
  FilesOfAll files_;
  std::vector<std::uint32_t> first_worlds_;
  std::size_t next_ = 0;
  std::uint32_t worlds_ = 0;
  std::uint64_t dropped_ = 0;
  Joined joined_;
};

}  // namespace

Copied copyInto(RecordingWriter& writer, RecordingReader& recording, const CopySettings& settings,
                const Progress& progress) {
  return Copy(writer, recording, settings).run(progress);
}

WholeOrNothing::~WholeOrNothing() {
  if (partial_.empty()) return;
  std::error_code ignored;
  for (const char* companion : {"", "-wal", "-shm"}) {
    std::filesystem::remove(withEnding(partial_, companion), ignored);
  }
}

void refuseSame(const std::filesystem::path& target, const std::filesystem::path& source) {
  std::error_code error;
  if (std::filesystem::equivalent(target, source, error)) {
    throw Error::inFile(target.string(), "is the recording being read; write to another file");
  }
}

Trimmed trim(RecordingReader& recording, const TrimSettings& settings, const std::filesystem::path& target,
             const Progress& progress) {
  const RecordingFacts& facts = recording.facts();
  requireTicks(recording, settings.span);
  const Beginning begin = findBeginning(recording, settings);
  RecordingHeader header = facts.header;
  const bool is_whole = begin.tick <= facts.first_tick && settings.span.to >= facts.last_tick;
  if (!is_whole) {
    header.notes = added(header.notes, fmt::format("cut to {:.3f} to {:.3f} s", secondsAt(begin.tick, facts),
                                                   secondsAt(std::min(settings.span.to, facts.last_tick), facts)));
  }
  WholeOrNothing whole;
  RecordingWriter writer(target, header, facts.fingers);
  whole.watch(writer);
  Trimmed result;
  if (begin.tick > facts.first_tick) {
    writer.add(RecordingEvent{begin.tick, std::nullopt, std::string(kTrimEvent),
                              fmt::format("what was before {:.3f} s is cut off", secondsAt(begin.tick, facts))});
    for (const std::uint32_t finger : begin.not_at_rest) {
      result.not_at_rest.push_back(facts.fingers[finger].name);
      writer.add(RecordingEvent{begin.tick, finger, std::string(kCutEvent),
                                facts.fingers[finger].name + " was not at rest: nothing is proven until it is"});
    }
  }
  result.earlier_ticks = settings.span.from > begin.tick ? settings.span.from - begin.tick : 0;
  CopySettings copy;
  copy.span = {begin.tick, settings.span.to};
  result.copied = copyInto(writer, recording, copy, progress);
  if (is_whole) writer.setDropped(facts.dropped);
  writer.finish(facts.ended_by.empty() ? "cut" : facts.ended_by, facts.ended_utc);
  whole.commit();
  return result;
}

Joined join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& target,
            const Progress& progress) {
  if (files.size() < 2) throw Error("joining requires at least two recordings");
  RecordingReader first(files.front());
  for (const std::filesystem::path& file : files) {
    refuseSame(target, file);
    requireSameFingers(first.facts(), RecordingReader(file).facts(), file);
  }
  RecordingHeader header = first.facts().header;
  header.notes = added(header.notes, fmt::format("{} recordings joined", files.size()));
  WholeOrNothing whole;
  RecordingWriter writer(target, header, first.facts().fingers);
  whole.watch(writer);
  Chain chain(writer, first.facts());
  for (const std::filesystem::path& file : files) {
    RecordingReader recording(file);
    chain.addWorlds(recording);
  }
  std::string ended_by;
  std::string ended_utc;
  for (std::size_t i = 0; i < files.size(); ++i) {
    RecordingReader recording(files[i]);
    chain.add(recording, files[i], [&](std::string_view, double done) {
      report(progress, "joining", (static_cast<double>(i) + done) / static_cast<double>(files.size()));
    });
    ended_by = recording.facts().ended_by;
    ended_utc = recording.facts().ended_utc;
  }
  if (chain.joined().samples == 0) throw Error("none of the recordings has any ticks");
  writer.finish(ended_by.empty() ? "joined" : ended_by, ended_utc);
  whole.commit();
  return chain.joined();
}

}  // namespace palpate::trace
