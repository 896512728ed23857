// The file is gone through twice: once for everything that is not a tick, and for which blocks there are; then part by
// part. What was lost is told from three sides: rows whose bytes are damaged, the two indices of the blocks, and holes
// in their numbers, which count without one.
#include "palpate/trace/recording_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "palpate/base/error.h"
#include "palpate/trace/recording_edit.h"
#include "palpate/trace/recording_remains.h"

namespace palpate::trace {

namespace {

/// A longer hole, 35 years at 1 kHz, can only come from a damaged tick number.
constexpr std::uint64_t kLongestHole = 1ull << 40;

/// A block as it is put together: its samples are in the new file, or lost.
struct Piece {
  std::int64_t id = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t rows = 0;
  bool salvaged = false;
};

/// Finds the missing ticks of one finger from its blocks in order.
class Holes {
 public:
  /// `ids_lost` are numbers of blocks of which nothing is known.
  Holes(std::uint32_t finger, const std::vector<std::int64_t>& ids_lost) : finger_(finger), ids_lost_(ids_lost) {}

  void add(const Piece& piece) {
    if (!is_first_) addHole(before_, piece);
    if (!piece.salvaged) lose(piece.first_tick, piece.last_tick, piece.rows);
    before_ = piece;
    is_first_ = false;
  }
  void addGap(std::uint64_t first, std::uint64_t last) { gaps.push_back({finger_, first, last, last - first + 1}); }

  std::vector<MissingTicks> lost;
  std::vector<MissingTicks> gaps;

 private:
  void addHole(const Piece& before, const Piece& after) {
    if (after.first_tick <= before.last_tick + 1 || after.first_tick - before.last_tick > kLongestHole) return;
    const std::uint64_t first = before.last_tick + 1;
    const std::uint64_t last = after.first_tick - 1;
    const auto lost_between = std::upper_bound(ids_lost_.begin(), ids_lost_.end(), before.id);
    if (lost_between != ids_lost_.end() && *lost_between < after.id) {
      lose(first, last, last - first + 1);
    } else {
      addGap(first, last);
    }
  }

  void lose(std::uint64_t first, std::uint64_t last, std::uint64_t count) {
    if (!lost.empty() && lost.back().last + 1 == first) {
      lost.back().last = last;
      lost.back().count += count;
    } else {
      lost.push_back({finger_, first, last, count});
    }
  }

  std::uint32_t finger_;
  const std::vector<std::int64_t>& ids_lost_;
  Piece before_;
  bool is_first_ = true;
};

class Repair {
 public:
  Repair(const std::filesystem::path& file, SqlitePages& pages, const Progress& progress)
      : name_(file.string()), pages_(pages), progress_(progress), remains_(remainsIn(pages, progress)) {
    if (remains_.blocks.empty() && !remains_.facts && remains_.worlds.empty()) {
      throw Error::inFile(name_, "contains no recoverable part of a recording");
    }
    chooseColumns();
    chooseFingers();
  }

  RecordingRepair run(const std::filesystem::path& target) {
    const RecordingFacts facts = remains_.facts.value_or(RecordingFacts());
    result_.header_lost = !remains_.facts;
    result_.bytes_missing = pages_.bytesMissing();
    result_.ticks_per_s = facts.header.ticks_per_s;
    sortBlocks();
    addMissing();
    noteTheEnds();
    if (samples_there_ == 0 && result_.header_lost) throw Error::inFile(name_, "contains no readable ticks");
    RecordingHeader header = facts.header;
    if (result_.header_lost) header.software = "unknown";
    WholeOrNothing whole;
    RecordingWriter writer(target, header, fingers_);
    whole.watch(writer);
    addEvents(writer);
    addAttachments(writer);
    addSamples(writer);
    writer.setDropped(facts.dropped);
    writer.finish(facts.ended_by.empty() ? "not finished, repaired" : facts.ended_by, facts.ended_utc);
    whole.commit();
    return std::move(result_);
  }

 private:
  // --- what the blocks need ---

  /// The file's own; where they are lost, or one has an invalid name, first those of each version: a row of one has
  /// another length than that of another.
  void chooseColumns() {
    std::vector<SampleColumn> own;
    for (const auto& [position, column] : remains_.columns) {
      if (position == static_cast<std::int64_t>(own.size())) own.push_back(column);
    }
    const bool whole = own.size() == remains_.columns.size() && !own.empty();
    const bool known = std::ranges::none_of(own, [](const SampleColumn& column) { return column.name.empty(); });
    if (whole && known) columns_.push_back(own);
    const auto now = sampleColumns();
    std::vector<SampleColumn> columns(now.begin(), now.end());
    columns_.push_back(columns);
    std::erase_if(columns, [](const SampleColumn& column) { return column.name.starts_with("lump"); });
    columns_.push_back(columns);
    std::erase_if(columns, [](const SampleColumn& column) {
      return column.name == "rest_mm" || column.name.starts_with("dent_");
    });
    columns_.push_back(columns);
    std::erase_if(columns, [](const SampleColumn& column) { return column.name == "buttons"; });
    columns_.push_back(std::move(columns));
    if (whole && !known) columns_.push_back(std::move(own));
  }

  void chooseFingers() {
    std::size_t count = 0;
    for (const auto& [id, block] : remains_.blocks) {
      if (block.finger) count = std::max<std::size_t>(count, *block.finger + 1);
    }
    if (!remains_.fingers.empty()) {
      count = std::max(count, static_cast<std::size_t>(remains_.fingers.rbegin()->first) + 1);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto found = remains_.fingers.find(static_cast<std::int64_t>(i));
      const bool lost = found == remains_.fingers.end();
      fingers_.push_back(lost ? RecordingFinger{fmt::format("finger_{}", i + 1), "unknown"} : found->second);
      if (lost) result_.other.push_back(fmt::format("name and device of finger {}", i + 1));
      result_.fingers.push_back(fingers_.back().name);
    }
  }

  std::vector<Sample> samplesAt(const CellPlace& place) {
    const RawRow row = pages_.rowAt(place);
    std::string why;
    for (const std::vector<SampleColumn>& columns : columns_) {
      try {
        return samplesOf(row, columns);
      } catch (const Error& error) {
        why = error.what();
      }
    }
    throw Error(why);
  }

  /// No samples: they are lost.
  std::vector<Sample> samplesOfBlock(const BlockRemains& block) {
    for (const CellPlace& place : block.places) {
      try {
        return samplesAt(place);
      } catch (const Error&) {  // perhaps there is another copy
      }
    }
    return {};
  }

  // --- what is lost ---

  /// Every block is read once to know whether it can be.
  void sortBlocks() {
    findFingers();
    std::int64_t before = remains_.blocks.empty() ? 0 : remains_.blocks.begin()->first - 1;
    std::size_t done = 0;
    std::uint64_t samples_of_nobody = 0;
    for (auto& [id, block] : remains_.blocks) {
      report(progress_, "reading", 0.5 * static_cast<double>(done++) / static_cast<double>(remains_.blocks.size()));
      for (std::int64_t lost = before + 1; lost < id && lost - before < kMaxIdsLost; ++lost) ids_lost_.push_back(lost);
      result_.blocks_lost += static_cast<std::uint64_t>(id - before - 1);
      before = id;
      const std::vector<Sample> samples = samplesOfBlock(block);
      Piece piece{id, block.first_tick, block.last_tick, block.rows, !samples.empty()};
      if (samples.empty()) {
        ++result_.blocks_lost;
        block.places.clear();
      } else {
        samples_there_ += samples.size();
        piece.first_tick = samples.front().tick;
        piece.last_tick = samples.back().tick;
        noteGapsWithin(samples);
        block.part = block.part.value_or(0);
        block.finger = samples.front().finger;
      }
      if (block.finger && *block.finger < fingers_.size()) {
        pieces_[*block.finger].push_back(piece);
      } else {
        samples_of_nobody += block.rows;
      }
    }
    if (samples_of_nobody > 0) {
      result_.other.push_back(fmt::format("{} samples of a finger that is not known", samples_of_nobody));
    }
  }

  /// For blocks of which only the time is known. Unless something was dropped, every part has one block per finger, so
  /// the blocks' numbers cycle through the fingers.
  void findFingers() {
    const auto count = static_cast<std::int64_t>(fingers_.size());
    std::set<std::int64_t> offsets;
    for (const auto& [id, block] : remains_.blocks) {
      if (block.finger) offsets.insert((id - std::int64_t{*block.finger}) % count);
    }
    if (offsets.size() != 1) return;
    for (auto& [id, block] : remains_.blocks) {
      if (!block.finger) block.finger = static_cast<std::uint32_t>((id - *offsets.begin() + count) % count);
    }
  }

  void noteGapsWithin(const std::vector<Sample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const std::uint64_t expected = samples[i - 1].tick + 1;
      if (samples[i].tick <= expected || samples[i].tick - expected > kLongestHole) continue;
      result_.gaps.push_back({samples[i].finger, expected, samples[i].tick - 1, samples[i].tick - expected});
    }
  }

  void addMissing() {
    for (auto& [finger, pieces] : pieces_) {
      Holes holes(finger, ids_lost_);
      for (const Piece& piece : pieces) holes.add(piece);
      result_.lost.insert(result_.lost.end(), holes.lost.begin(), holes.lost.end());
      result_.gaps.insert(result_.gaps.end(), holes.gaps.begin(), holes.gaps.end());
    }
    std::sort(result_.gaps.begin(), result_.gaps.end(), [](const MissingTicks& a, const MissingTicks& b) {
      return std::pair(a.first, a.finger) < std::pair(b.first, b.finger);
    });
  }

  /// Notes what may be missing before the first block and after the last one.
  void noteTheEnds() {
    if (remains_.blocks.empty()) return;
    const auto& [first_id, first] = *remains_.blocks.begin();
    const double rate = result_.ticks_per_s;
    if (first_id > 1) {
      result_.notes.push_back(fmt::format("data before {:.3f} s was not kept while recording, or is lost",
                                          static_cast<double>(first.first_tick) / rate));
    }
    if (result_.bytes_missing > 0) {
      result_.notes.push_back(fmt::format("data after {:.3f} s is lost: the end of the file is missing",
                                          static_cast<double>(remains_.blocks.rbegin()->second.last_tick) / rate));
    }
    if (pages_.damagedFramesOfLog() > 0) {
      result_.notes.push_back(fmt::format("{} pages of the write-ahead log are damaged", pages_.damagedFramesOfLog()));
    }
  }

  // --- what goes into the new file ---

  void addEvents(RecordingWriter& writer) {
    std::vector<RecordingEvent> events;
    for (const auto& [id, event] : remains_.events) events.push_back(event);
    result_.events = events.size();
    for (const MissingTicks& lost : result_.lost) {
      events.push_back({lost.last + 1, lost.finger, std::string(kCutEvent),
                        fmt::format("{}: ticks {} to {} were lost; nothing is proven until it rests",
                                    fingers_[lost.finger].name, lost.first, lost.last)});
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const RecordingEvent& a, const RecordingEvent& b) { return a.tick < b.tick; });
    for (const RecordingEvent& event : events) writer.add(event);
  }

  void addAttachments(RecordingWriter& writer) {
    for (const auto& [id, place] : remains_.attachments) {
      try {
        writer.add(attachmentOf(pages_.rowAt(place)));
        ++result_.attachments;
      } catch (const Error& error) {
        if (!error.file().empty()) throw;  // it is the new file that cannot be written
        result_.other.push_back(fmt::format("attachment {}", id));
      }
    }
    for (const auto& [id, name] : remains_.lost_attachments) result_.other.push_back("attachment " + name);
  }

  /// Worlds keep their numbers; one that is lost leaves an empty place.
  void addWorldsUpTo(RecordingWriter& writer, std::uint32_t number) {
    for (; next_world_ <= number; ++next_world_) {
      const auto found = remains_.worlds.find(next_world_);
      const bool lost = found == remains_.worlds.end();
      RecordingWorld world = lost ? RecordingWorld{} : found->second;
      if (lost) world.body = "lost";
      if (lost) world.scene = "# this scene was lost\n";
      for (std::size_t i = 0; i < fingers_.size(); ++i) {
        const auto settings = remains_.settings.find({next_world_, static_cast<std::int64_t>(i)});
        const bool has_none = settings == remains_.settings.end();
        world.fingers.push_back(has_none ? RecordingSettings{} : settings->second);
        if (has_none && !lost) {
          result_.other.push_back(fmt::format("what {} was felt with in world {}", fingers_[i].name, next_world_));
        }
      }
      if (lost) result_.other.push_back(fmt::format("world {}: the scene that it was felt in", next_world_));
      result_.worlds += lost ? 0 : 1;
      writer.add(world);
    }
  }

  void addSamples(RecordingWriter& writer) {
    std::map<std::int64_t, std::vector<const BlockRemains*>> parts;
    for (const auto& [id, block] : remains_.blocks) {
      if (!block.places.empty()) parts[block.part.value_or(0)].push_back(&block);
    }
    const bool begins_later = !remains_.worlds.empty() && remains_.worlds.begin()->first > 0;
    std::size_t done = 0;
    for (const auto& [part, blocks] : parts) {
      report(progress_, "writing", 0.5 + 0.5 * static_cast<double>(done++) / static_cast<double>(parts.size()));
      std::map<std::pair<std::uint64_t, std::uint32_t>, Sample> samples;
      for (const BlockRemains* block : blocks) {
        ++result_.blocks;
        for (const Sample& sample : samplesOfBlock(*block)) samples[{sample.tick, sample.finger}] = sample;
      }
      for (auto& [place, sample] : samples) addSample(writer, sample, begins_later);
    }
  }

  /// A recording whose beginning was forgotten has no world 0: there they are counted again.
  void addSample(RecordingWriter& writer, Sample sample, bool begins_later) {
    if (begins_later && result_.samples == 0) {
      first_world_ = std::min(sample.world, static_cast<std::uint32_t>(remains_.worlds.begin()->first));
      next_world_ = first_world_;
    }
    if (sample.world > next_world_ + kMaxWorldsAhead) throw Error::inFile(name_, "refers to missing worlds");
    addWorldsUpTo(writer, sample.world);
    sample.world -= std::min(sample.world, first_world_);
    writer.add(sample);
    ++result_.samples;
  }

  static constexpr std::int64_t kMaxIdsLost = 1'000'000;
  static constexpr std::uint32_t kMaxWorldsAhead = 100'000;

  std::string name_;
  SqlitePages& pages_;
  const Progress& progress_;
  RecordingRemains remains_;
  std::vector<std::vector<SampleColumn>> columns_;
  std::vector<RecordingFinger> fingers_;
  std::vector<std::int64_t> ids_lost_;
  std::map<std::uint32_t, std::vector<Piece>> pieces_;  ///< by finger
  std::uint64_t samples_there_ = 0;
  std::uint32_t next_world_ = 0;
  std::uint32_t first_world_ = 0;
  RecordingRepair result_;
};

}  // namespace

std::uint64_t RecordingRepair::samplesLost() const {
  std::uint64_t count = 0;
  for (const MissingTicks& missing : lost) count += missing.count;
  return count;
}

bool RecordingRepair::nothingLost() const {
  return lost.empty() && blocks_lost == 0 && !header_lost && bytes_missing == 0 && other.empty();
}

RecordingRepair repairRecording(const std::filesystem::path& file, const std::filesystem::path& target,
                                const Progress& progress) {
  refuseSame(target, file);
  SqlitePages pages(file);
  return Repair(file, pages, progress).run(target);
}

}  // namespace palpate::trace
