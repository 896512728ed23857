#include "palpate/trace/recording_writer.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/trace/recording_schema.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

namespace {

/// Length of a part: long enough to be packed well, short enough that a killed program loses next to nothing.
constexpr double kPartS = 0.15;

Database databaseWithTables(const std::filesystem::path& file, const std::filesystem::path& called) {
  Database database(file, Database::Mode::write, called);
  makeRecordingTables(database);
  return database;
}

/// Makes the file complete without its log. A concurrent reader keeps SQLite from changing the journal mode, but not
/// from completing the file. Throws Error if even that fails.
void mergeWriteAheadLog(Database& database) {
  try {
    database.run("PRAGMA journal_mode = DELETE");
  } catch (const Error&) {
    if (database.integer("PRAGMA wal_checkpoint(TRUNCATE)") != 0) {
      throw Error::inFile(database.name(),
                          "cannot be completed while another program is reading it; close that program");
    }
  }
}

/// Removes the files that SQLite keeps next to one being written; a full disk or a reader may leave them there.
void removeCompanions(const std::filesystem::path& file) {
  std::error_code ignored;
  for (const char* companion : {"-wal", "-shm"}) std::filesystem::remove(withEnding(file, companion), ignored);
}

std::string hexadecimal(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace

/// The database, and what is asked of it all the time.
struct RecordingWriter::Impl {
  Impl(const std::filesystem::path& file, const std::filesystem::path& called)
      : database(databaseWithTables(file, called)) {}
  Database database;
  Statement insert_block{database,
                         "INSERT INTO blocks(part, finger, first_tick, last_tick, rows, crc32, data) "
                         "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)"};
  Statement insert_event{database, "INSERT INTO events(tick, finger, kind, text) VALUES (?1, ?2, ?3, ?4)"};
  Statement count_samples{database, "UPDATE session SET samples = samples + ?1"};
};

RecordingWriter::~RecordingWriter() {
  impl_.reset();
  if (samples_ == 0) removeCompanions(file_.partial());  // the file goes too: nothing was written
}

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const RecordingHeader& header,
                                 const std::vector<RecordingFinger>& fingers)
    : file_(file, OutputFile::Unfinished::remove, OutputFile::Access::owner_only),
      impl_(std::make_unique<Impl>(file_.partial(), file)),
      waiting_(fingers.size()),
      part_ticks_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(kPartS * header.ticks_per_s)))) {
  Database& database = impl_->database;
  Transaction transaction(database);
  Statement(database,
            "INSERT INTO session(id, started_utc, software, machine, ticks_per_s, notes, tags) "
            "VALUES (1, ?1, ?2, ?3, ?4, ?5, ?6)")
      .with(header.started_utc)
      .with(header.software)
      .with(header.machine)
      .with(header.ticks_per_s)
      .with(header.notes)
      .with(header.tags)
      .run();
  Statement insert(database, "INSERT INTO fingers VALUES (?1, ?2, ?3, ?4, ?5)");
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    insert.with(static_cast<std::int64_t>(i))
        .with(fingers[i].name)
        .with(fingers[i].device)
        .with(fingers[i].capabilities)
        .with(fingers[i].placed)
        .run();
    waiting_[i].reserve(part_ticks_ + 1);
  }
  transaction.commit();
}

void RecordingWriter::add(const RecordingWorld& world) {
  Database& database = impl_->database;
  Transaction transaction(database);
  Statement(database, "INSERT INTO worlds VALUES (?1, ?2, ?3, ?4, ?5, ?6)")
      .with(worlds_)
      .with(world.scene)
      .with(world.folder)
      .with(world.body)
      .with(static_cast<std::int64_t>(world.triangles))
      .with(hexadecimal(world.hash))
      .run();
  Statement insert(database, "INSERT INTO settings VALUES (?1, ?2, ?3, ?4)");
  for (std::size_t i = 0; i < world.fingers.size(); ++i) {
    insert.with(worlds_)
        .with(static_cast<std::int64_t>(i))
        .with(world.fingers[i].contact)
        .with(world.fingers[i].limiter)
        .run();
  }
  transaction.commit();
  ++worlds_;
}

void RecordingWriter::add(const Sample& sample) {
  if (sample.finger >= waiting_.size()) throw Error(fmt::format("the recording has no finger {}", sample.finger));
  std::vector<Sample>& waiting = waiting_[sample.finger];
  if (!waiting.empty() && sample.tick >= waiting.front().tick + part_ticks_) flush();
  waiting.push_back(sample);
}

void RecordingWriter::add(const RecordingEvent& event) { events_.push_back(event); }

void RecordingWriter::flush() {
  // Writes to an unlinked file succeed, but their data is lost.
  std::error_code error;
  if (!std::filesystem::exists(file_.partial(), error))
    throw Error::inFile(file_.partial().string(), "was deleted while it was being written");
  const auto waits = [](const std::vector<Sample>& samples) { return !samples.empty(); };
  if (events_.empty() && std::none_of(waiting_.begin(), waiting_.end(), waits)) return;
  Transaction transaction(impl_->database);
  std::uint64_t written = 0;
  WrittenPart about{part_, std::numeric_limits<std::uint64_t>::max(), 0, 0, std::numeric_limits<std::uint32_t>::max()};
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const std::vector<Sample>& samples = waiting_[i];
    if (samples.empty()) continue;
    const SampleBlock block = packSamples(samples);
    impl_->insert_block.with(part_)
        .with(static_cast<std::int64_t>(i))
        .with(static_cast<std::int64_t>(samples.front().tick))
        .with(static_cast<std::int64_t>(samples.back().tick))
        .with(static_cast<std::int64_t>(samples.size()))
        .with(static_cast<std::int64_t>(block.crc32))
        .withBlob(block.bytes)
        .run();
    written += samples.size();
    about.first_tick = std::min(about.first_tick, samples.front().tick);
    about.last_tick = std::max(about.last_tick, samples.back().tick);
    about.world = std::min(about.world, samples.front().world);
  }
  for (const RecordingEvent& event : events_) {
    Statement& insert = impl_->insert_event.with(static_cast<std::int64_t>(event.tick));
    if (event.finger) {
      insert.with(static_cast<std::int64_t>(*event.finger));
    } else {
      insert.withNull();
    }
    insert.with(event.kind).with(event.text).run();
  }
  impl_->count_samples.with(static_cast<std::int64_t>(written)).run();
  transaction.commit();
  for (std::vector<Sample>& samples : waiting_) samples.clear();
  events_.clear();
  samples_ += written;
  about.samples = written;
  if (written > 0) written_.push_back(about);
  ++part_;
  file_.retainUnfinished();
}

void RecordingWriter::add(const RecordingAttachment& attachment) {
  Statement(impl_->database, "INSERT INTO attachments(tick, kind, name, media, data) VALUES (?1, ?2, ?3, ?4, ?5)")
      .with(static_cast<std::int64_t>(attachment.tick))
      .with(attachment.kind)
      .with(attachment.name)
      .with(attachment.media)
      .withBlob(attachment.data)
      .run();
}

void RecordingWriter::forgetBefore(std::uint64_t tick) {
  std::int64_t parts = -1;
  std::int64_t samples = 0;
  while (written_.size() > 1 && written_.front().last_tick < tick) {
    samples += static_cast<std::int64_t>(written_.front().samples);
    parts = written_.front().part;
    written_.pop_front();
  }
  if (parts < 0) return;
  Transaction transaction(impl_->database);
  const auto before = static_cast<std::int64_t>(written_.front().first_tick);
  Statement(impl_->database, "DELETE FROM blocks WHERE part <= ?1").with(parts).run();
  Statement(impl_->database, "DELETE FROM events WHERE tick < ?1").with(before).run();
  Statement(impl_->database, "DELETE FROM attachments WHERE tick < ?1 AND kind <> ?2")
      .with(before)
      .with(kCarriedFile)
      .run();
  for (const char* table : {"DELETE FROM worlds WHERE id < ?1", "DELETE FROM settings WHERE world < ?1"}) {
    Statement(impl_->database, table).with(static_cast<std::int64_t>(written_.front().world)).run();
  }
  impl_->count_samples.with(-samples).run();
  transaction.commit();
  add(RecordingEvent{written_.front().first_tick, std::nullopt, std::string(kCutEvent),
                     "what was before is forgotten"});
}

void RecordingWriter::setDropped(std::uint64_t dropped) {
  if (dropped == dropped_) return;
  dropped_ = dropped;
  Statement(impl_->database, "UPDATE session SET dropped = ?1").with(static_cast<std::int64_t>(dropped)).run();
}

void RecordingWriter::finish(std::string_view ended_by, std::string_view ended_utc) {
  flush();
  const std::string ended = ended_utc.empty() ? utcNow() : std::string(ended_utc);
  Statement(impl_->database, "UPDATE session SET ended_utc = ?1, ended_by = ?2").with(ended).with(ended_by).run();
  mergeWriteAheadLog(impl_->database);
  impl_.reset();
  file_.commit();
  removeCompanions(file_.partial());
}

void RecordingWriter::discard() {
  impl_.reset();
  removeCompanions(file_.partial());
  std::error_code ignored;
  std::filesystem::remove(file_.partial(), ignored);
}

void copyRecording(const std::filesystem::path& recording, const std::filesystem::path& copy,
                   std::string_view ended_by) {
  OutputFile file(copy, OutputFile::Unfinished::remove, OutputFile::Access::owner_only);
  {
    Database source(recording, Database::Mode::read);
    checkRecording(source);
    source.copyInto(file.partial());
  }
  {
    Database copied(file.partial(), Database::Mode::write, copy);
    Statement(copied, "UPDATE session SET ended_utc = ?1, ended_by = ?2 WHERE ended_by IS NULL")
        .with(utcNow())
        .with(ended_by)
        .run();
    copied.run("PRAGMA journal_mode = DELETE");
  }
  file.commit();
}

std::string utcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

}  // namespace palpate::trace
