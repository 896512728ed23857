// Recordings cut, joined and salvaged: every bit that is there comes out, and what is not there is told.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "host/tests/trace/whole_recording.h"
#include "host/tests/trace/wild_sample.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_edit.h"
#include "palpate/trace/recording_repair.h"
#include "palpate/trace/recording_rest.h"
#include "palpate/trace/sample_block.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::trace {
namespace {

using Place = std::pair<std::uint64_t, std::uint32_t>;  // tick, finger

/// Of the only world that there is.
Sample incompressibleSample(Random& random, std::uint64_t tick, std::uint32_t finger) {
  Sample sample = wildSample(random, tick, finger);
  sample.world = 0;
  return sample;
}

bool sameBits(const Sample& a, const Sample& b) {
  return a.finger == b.finger && std::ranges::all_of(sampleColumns(), [&](const SampleColumn& column) {
           return column.bits(a) == column.bits(b);
         });
}

/// A recording's file as somebody else's program opens it: with all that SQLite can.
class OtherProgram {
 public:
  explicit OtherProgram(const std::filesystem::path& file) { EXPECT_EQ(::sqlite3_open(file.c_str(), &database_), 0); }
  OtherProgram(const OtherProgram&) = delete;
  ~OtherProgram() { ::sqlite3_close(database_); }
  void run(const std::string& sql) const {
    EXPECT_EQ(::sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr), 0) << ::sqlite3_errmsg(database_);
  }
  void reserveBytes(int bytes) const { ::sqlite3_file_control(database_, "main", SQLITE_FCNTL_RESERVE_BYTES, &bytes); }

 private:
  sqlite3* database_ = nullptr;
};

class RecordingEdit : public testing::Test {
 protected:
  static RecordingHeader header(const std::string& notes = "of a test") {
    RecordingHeader header;
    header.started_utc = "2026-11-21T12:00:00Z";
    header.software = "test";
    header.machine = "bench";
    header.notes = notes;
    return header;
  }
  static std::vector<RecordingFinger> fingers() { return {{"index", "script"}, {"middle", "mouse"}}; }
  static RecordingWorld world(const std::string& scene) {
    return {scene, "/tmp", "torso", 100, 0xfeedull, {{"radius_mm = 8", "limited = 1"}, {"radius_mm = 4", ""}}};
  }

  /// Two fingers; the first one touches in the ticks of `contact`.
  std::filesystem::path record(const std::string& name, std::uint64_t first, std::uint64_t last,
                               const TickSpan& contact) const {
    RecordingWriter writer(folder_ / name, header(), fingers());
    writer.add(world("# scene 0 of " + name + "\n"));
    writer.add(world("# scene 1 of " + name + "\n"));
    for (std::uint64_t tick = first; tick <= last; ++tick) {
      for (std::uint32_t finger = 0; finger < 2; ++finger) {
        Sample sample;
        sample.tick = tick;
        sample.finger = finger;
        sample.world = tick < (first + last) / 2 ? 0 : 1;
        sample.contact.tip = {static_cast<double>(tick), 1.0 / (1.0 + static_cast<double>(tick)), 0.1 * finger};
        if (finger == 0 && tick >= contact.from && tick <= contact.to) sample.contact.touch = contact::Touch::stick;
        writer.add(sample);
      }
      if (tick % 100 == 0) writer.add(RecordingEvent{tick, 1u, "mark", std::to_string(tick)});
      if (tick % 500 == 0) writer.add(RecordingAttachment{tick, "sound", std::to_string(tick), "audio/wav", "bytes"});
    }
    writer.add(RecordingAttachment{first, "file", "body.obj", "", "v 0 0 0\n"});
    writer.finish("done");
    return folder_ / name;
  }

  /// As large as several parts of several pages of wild bits.
  std::map<Place, Sample> recordWild(const std::string& name, std::uint64_t ticks, std::uint64_t seed) const {
    Random random(seed);
    std::map<Place, Sample> all;
    RecordingWriter writer(folder_ / name, header(), fingers());
    writer.add(world(std::string(5000, '#') + "\n"));
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      for (std::uint32_t finger = 0; finger < 2; ++finger) {
        const Sample sample = incompressibleSample(random, tick, finger);
        all[{tick, finger}] = sample;
        writer.add(sample);
      }
      if (tick % 700 == 0) writer.add(RecordingEvent{tick, std::nullopt, "mark", "m" + std::to_string(tick)});
    }
    writer.finish("done");
    return all;
  }

  static std::map<Place, Sample> samplesOf(const std::filesystem::path& file, const TickSpan& span = {}) {
    RecordingReader reader(file);
    std::map<Place, Sample> all;
    reader.forEachTick(span, [&](std::span<const Sample> tick) {
      for (const Sample& sample : tick) all[{sample.tick, sample.finger}] = sample;
      return true;
    });
    return all;
  }

  static std::vector<RecordingEvent> eventsOfKind(const std::filesystem::path& file, std::string_view kind) {
    std::vector<RecordingEvent> events = RecordingReader(file).events();
    std::erase_if(events, [&](const RecordingEvent& event) { return event.kind != kind; });
    return events;
  }

  std::string bytesOf(const std::string& name) const { return readFile(folder_ / name, 1 << 26); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << bytes;
  }

  support::TemporaryFolder folder_;
};

// --- trim ---

TEST_F(RecordingEdit, ATrimKeepsEveryBitOfItsSpanAndNothingElse) {
  const auto source = record("a.session", 100, 2099, {400, 600});
  RecordingReader reader(source);
  const Trimmed trimmed = trim(reader, {{900, 1499}}, folder_ / "b.session");
  EXPECT_EQ(trimmed.earlier_ticks, 0u) << "every finger rests there";
  const auto was = samplesOf(source, {900, 1499});
  const auto is = samplesOf(folder_ / "b.session");
  ASSERT_EQ(is.size(), was.size());
  for (const auto& [place, sample] : was) ASSERT_TRUE(sameBits(sample, is.at(place))) << place.first;
  RecordingReader part(folder_ / "b.session");
  EXPECT_EQ(part.facts().worlds, 2u);
  EXPECT_EQ(part.facts().header.notes, "of a test; cut to 0.900 to 1.499 s");
  EXPECT_EQ(eventsOfKind(folder_ / "b.session", "mark").size(), 6u);
  std::vector<std::string> attachments;
  part.forEachAttachment({}, [&](const RecordingAttachment& a) { attachments.push_back(a.kind + " " + a.name); });
  EXPECT_EQ(attachments, (std::vector<std::string>{"file body.obj", "sound 1000"}));
  ASSERT_EQ(eventsOfKind(folder_ / "b.session", kTrimEvent).size(), 1u);
  EXPECT_TRUE(eventsOfKind(folder_ / "b.session", kCutEvent).empty());
}

TEST_F(RecordingEdit, WorldsThatNoTickOfATrimWasFeltInAreLeftOut) {
  RecordingReader reader(record("a.session", 0, 1999, {1, 0}));
  trim(reader, {{1500, 1600}}, folder_ / "b.session");
  RecordingReader part(folder_ / "b.session");
  ASSERT_EQ(part.facts().worlds, 1u);
  EXPECT_EQ(part.world(0).scene, "# scene 1 of a.session\n");
  EXPECT_EQ(samplesOf(folder_ / "b.session").begin()->second.world, 0u);
}

TEST_F(RecordingEdit, ATrimInAContactBeginsWhereEveryFingerWasLastAtRest) {
  const auto source = record("a.session", 0, 999, {300, 600});
  RecordingReader reader(source);
  const Trimmed trimmed = trim(reader, {{450, 800}}, folder_ / "b.session");
  EXPECT_EQ(trimmed.copied.first_tick, 298u) << "the next tick is one of rest, too";
  EXPECT_EQ(trimmed.earlier_ticks, 152u);
  EXPECT_EQ(trimmed.copied.last_tick, 800u);
  // Just after the contact it has not rested for long enough.
  EXPECT_EQ(trim(reader, {{610, 800}}, folder_ / "b.session").copied.first_tick, 298u);
  EXPECT_EQ(trim(reader, {{601 + kRestTicks - 1, 800}}, folder_ / "b.session").copied.first_tick, 616u);
}

TEST_F(RecordingEdit, AnExactTrimNamesTheFingersOfWhichNothingIsProven) {
  RecordingReader reader(record("a.session", 0, 999, {300, 600}));
  const Trimmed trimmed = trim(reader, {{450, 800}, true}, folder_ / "b.session");
  EXPECT_EQ(trimmed.copied.first_tick, 450u);
  EXPECT_EQ(trimmed.not_at_rest, std::vector<std::string>{"index"});
  const auto cuts = eventsOfKind(folder_ / "b.session", kCutEvent);
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_EQ(cuts[0].tick, 450u);
  EXPECT_EQ(cuts[0].finger, 0u);
  EXPECT_TRUE(trim(reader, {{700, 800}, true}, folder_ / "c.session").not_at_rest.empty());
}

TEST_F(RecordingEdit, ATrimOfAllIsACopy) {
  const auto source = record("a.session", 0, 999, {300, 600});
  RecordingReader reader(source);
  Database(source, Database::Mode::write).run("UPDATE session SET ended_utc = '2026-11-21T12:00:01Z'");
  RecordingReader ended(source);
  trim(ended, {}, folder_ / "b.session");
  EXPECT_EQ(RecordingReader(folder_ / "b.session").facts().ended_utc, "2026-11-21T12:00:01Z") << "not when it was cut";
  EXPECT_EQ(RecordingReader(folder_ / "b.session").facts().header.notes, "of a test");
  EXPECT_EQ(samplesOf(folder_ / "b.session").size(), 2000u);
}

TEST_F(RecordingEdit, ATrimOfNothingSaysWhereTheRecordingIsAndLeavesNothing) {
  RecordingReader reader(record("a.session", 100, 999, {1, 0}));
  EXPECT_EQ(support::thrownMessage([&] {
              trim(reader, {{5000, 6000}}, folder_ / "b.session");
            }),
            "no ticks in this range; the recording lasts from 0.100 to 0.999 s");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.session"));
}

TEST_F(RecordingEdit, ATrimThatMeetsADamagedBlockLeavesNothing) {
  const auto source = record("a.session", 0, 1999, {1, 0});
  OtherProgram(source).run("UPDATE blocks SET data = zeroblob(9) WHERE id = (SELECT max(id) FROM blocks)");
  RecordingReader reader(source);
  EXPECT_THROW(trim(reader, {{500, 1999}}, folder_ / "b.session"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.session"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.session.partial"));
}

// --- join ---

TEST_F(RecordingEdit, JoinedRecordingsFollowEachOtherAndForgetWhatWasBefore) {
  const auto a = record("a.session", 100, 699, {300, 400});
  const auto b = record("b.session", 5000, 5999, {5100, 5200});
  const Joined joined = join({a, b, a}, folder_ / "all.session");
  EXPECT_EQ(joined.begins, (std::vector<std::uint64_t>{100, 700, 1700}));
  EXPECT_EQ(joined.last_tick, 2299u);
  const auto was = samplesOf(b);
  const auto is = samplesOf(folder_ / "all.session");
  ASSERT_EQ(is.size(), 2u * (600 + 1000 + 600));
  for (const auto& [place, sample] : was) {
    Sample there = is.at({place.first - 5000 + 700, place.second});
    EXPECT_EQ(there.forgot, place.first == 5000 ? kForgotTouch | kForgotLimiter : 0u);
    EXPECT_EQ(there.world, sample.world + 2);
    there.tick = sample.tick;
    there.world = sample.world;
    there.forgot = sample.forgot;
    ASSERT_TRUE(sameBits(there, sample)) << place.first;
  }
  RecordingReader reader(folder_ / "all.session");
  EXPECT_EQ(reader.facts().worlds, 6u);
  EXPECT_EQ(reader.world(2).scene, "# scene 0 of b.session\n");
  const auto joins = eventsOfKind(folder_ / "all.session", kJoinEvent);
  ASSERT_EQ(joins.size(), 3u);
  EXPECT_EQ(joins[1].tick, 700u);
  EXPECT_EQ(joins[1].text, "b.session, begun 2026-11-21T12:00:00Z, its 5.000 to 5.999 s");
  EXPECT_EQ(eventsOfKind(folder_ / "all.session", "mark").size(), 6u + 10u + 6u);
  std::vector<std::string> attachments;
  reader.forEachAttachment({}, [&](const RecordingAttachment& t) {
    attachments.push_back(std::to_string(t.tick) + " " + t.kind + " " + t.name);
  });
  EXPECT_EQ(attachments, (std::vector<std::string>{"100 file body.obj", "500 sound 500", "700 sound 5000",
                                                   "1200 sound 5500", "2100 sound 500"}));
}

TEST_F(RecordingEdit, JoinedRecordingsLackWhatEachOfThemLacked) {
  writeWholeRecording(folder_ / "a.session");
  join({folder_ / "a.session", folder_ / "a.session", folder_ / "a.session"}, folder_ / "all.session");
  EXPECT_EQ(RecordingReader(folder_ / "all.session").facts().dropped, 3u * 3u);
}

TEST_F(RecordingEdit, WhatDoesNotBelongTogetherIsNotJoined) {
  const auto a = record("a.session", 0, 99, {1, 0});
  const auto file_error = [&](const std::filesystem::path& other) {
    return support::thrownMessage([&] { join({a, other}, folder_ / "all.session"); });
  };
  RecordingHeader slow = header();
  slow.ticks_per_s = 500.0;
  RecordingWriter(folder_ / "slow.session", slow, fingers()).finish("done");
  EXPECT_NE(file_error(folder_ / "slow.session").find("has 500 ticks per second"), std::string::npos);
  RecordingWriter(folder_ / "thumb.session", header(), {{"thumb", "script"}}).finish("done");
  EXPECT_NE(file_error(folder_ / "thumb.session").find("has the fingers thumb"), std::string::npos);
  {
    RecordingWriter writer(folder_ / "body.session", header(), fingers());
    writer.add(RecordingAttachment{0, "file", "body.obj", "", "v 1 1 1\n"});
    writer.add(world("#\n"));
    writer.add(Sample{});
    writer.finish("done");
  }
  EXPECT_NE(file_error(folder_ / "body.session").find("contains a 'body.obj' that differs"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "all.session.partial")) << "whole or not at all";
  EXPECT_NE(support::thrownMessage([&] { join({a, a}, a); }).find("write to another file"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "all.session"));
}

// --- repair ---

/// What is really missing, of each finger, told by a comparison with what there was.
std::set<Place> missingFrom(const std::map<Place, Sample>& all, const std::map<Place, Sample>& is) {
  std::set<Place> missing;
  for (const auto& [place, sample] : all) {
    if (!is.contains(place)) missing.insert(place);
  }
  return missing;
}

std::set<Place> placesOf(const std::vector<MissingTicks>& spans) {
  std::set<Place> places;
  for (const MissingTicks& span : spans) {
    for (std::uint64_t tick = span.first; tick <= span.last; ++tick) places.insert({tick, span.finger});
  }
  return places;
}

TEST_F(RecordingEdit, ASoundFileIsSalvagedWhole) {
  const auto all = recordWild("a.session", 3000, 1);
  const RecordingRepair repair = repairRecording(folder_ / "a.session", folder_ / "b.session");
  EXPECT_TRUE(repair.nothingLost());
  EXPECT_EQ(repair.samples, all.size());
  const auto is = samplesOf(folder_ / "b.session");
  ASSERT_EQ(is.size(), all.size());
  for (const auto& [place, sample] : all) ASSERT_TRUE(sameBits(sample, is.at(place)));
  RecordingReader was(folder_ / "a.session");
  RecordingReader now(folder_ / "b.session");
  EXPECT_EQ(now.facts().header.notes, was.facts().header.notes);
  EXPECT_EQ(now.facts().ended_by, "done");
  EXPECT_EQ(now.facts().fingers[1].device, "mouse");
  EXPECT_EQ(now.world(0).scene, was.world(0).scene);
  EXPECT_EQ(now.world(0).hash, was.world(0).hash);
  EXPECT_EQ(now.world(0).fingers[1].contact, "radius_mm = 4");
  EXPECT_EQ(now.facts().events, was.facts().events);
}

TEST_F(RecordingEdit, ASalvagedRecordingAndACopyTellWhatTheFileTold) {
  writeWholeRecording(folder_ / "a.session");
  const std::string told = contentOf(folder_ / "a.session");
  const RecordingRepair repair = repairRecording(folder_ / "a.session", folder_ / "b.session");
  EXPECT_TRUE(repair.nothingLost());
  EXPECT_EQ(repair.attachments, 2u);
  EXPECT_EQ(contentOf(folder_ / "b.session"), told);
  RecordingReader reader(folder_ / "a.session");
  trim(reader, {}, folder_ / "c.session");
  EXPECT_EQ(contentOf(folder_ / "c.session"), told);
}

TEST_F(RecordingEdit, LettersOfASalvagedTextThatAreNoneAreShownAsSuch) {
  writeWholeRecording(folder_ / "a.session");
  OtherProgram(folder_ / "a.session")
      .run(
          "UPDATE session SET notes = 'gr' || char(252) || 'n', tags = CAST(x'67fc6e' AS TEXT), "
          "software = 'a' || char(7) || 'b' || char(9) || char(10), machine = 'a' || char(127)");
  repairRecording(folder_ / "a.session", folder_ / "b.session");
  const RecordingReader reader(folder_ / "b.session");
  EXPECT_EQ(reader.facts().header.notes, "gr\u00fcn");
  EXPECT_EQ(reader.facts().header.tags, "g?n");
  EXPECT_EQ(reader.facts().header.software, "a?b\t\n");
  EXPECT_EQ(reader.facts().header.machine, "a?");
}

TEST_F(RecordingEdit, ADamagedNameOfAColumnTakesNothingAway) {
  const auto all = recordWild("a.session", 300, 5);
  OtherProgram(folder_ / "a.session").run("UPDATE columns SET name = 'd?pth_mm' WHERE name = 'depth_mm'");
  repairRecording(folder_ / "a.session", folder_ / "b.session");
  const auto is = samplesOf(folder_ / "b.session");
  ASSERT_EQ(is.size(), all.size());
  for (const auto& [place, sample] : all) ASSERT_TRUE(sameBits(sample, is.at(place))) << place.first;
}

TEST_F(RecordingEdit, PagesOfAnySizeAndWithReservedBytesAreSalvagedWhole) {
  writeWholeRecording(folder_ / "a.session");
  const std::string told = contentOf(folder_ / "a.session");
  for (const int page : {512, 1024, 65536}) {
    const OtherProgram other(folder_ / "a.session");
    other.run("PRAGMA journal_mode = DELETE; PRAGMA page_size = " + std::to_string(page));
    other.reserveBytes(page == 512 ? 32 : 200);  // as a program that encrypts them or adds checksums keeps
    other.run("VACUUM");
    EXPECT_TRUE(repairRecording(folder_ / "a.session", folder_ / "b.session").nothingLost()) << page;
    EXPECT_EQ(contentOf(folder_ / "b.session"), told) << page;
  }
}

TEST_F(RecordingEdit, WhatALogHeldBeforeItWasUsedAgainDoesNotComeBack) {
  writeWholeRecording(folder_ / "a.session");
  const OtherProgram other(folder_ / "a.session");
  other.run("PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0");
  for (const char* notes : {"first", "second", "third"}) {
    other.run("UPDATE session SET notes = '" + std::string(notes) + "'");
  }
  // The next change begins the log anew; behind it lie the frames of the three before.
  other.run("PRAGMA wal_checkpoint(RESTART); UPDATE session SET notes = 'last'");
  repairRecording(folder_ / "a.session", folder_ / "b.session");
  EXPECT_EQ(RecordingReader(folder_ / "b.session").facts().header.notes, "last");
}

TEST_F(RecordingEdit, ALossIsToldOfItsFingerWhereOnlyTheTimeOfABlockIsLeft) {
  const auto all = recordWild("a.session", 900, 8);
  {
    const OtherProgram other(folder_ / "a.session");
    other.run(
        "PRAGMA secure_delete = ON; DROP INDEX blocks_by_part; PRAGMA writable_schema = ON; "
        "DELETE FROM sqlite_schema WHERE name = 'blocks_by_tick'");
  }
  OtherProgram(folder_ / "a.session").run("PRAGMA secure_delete = ON; DELETE FROM blocks WHERE id IN (4, 7)");
  const RecordingRepair repair = repairRecording(folder_ / "a.session", folder_ / "b.session");
  const std::set<Place> missing = missingFrom(all, samplesOf(folder_ / "b.session"));
  EXPECT_EQ(missing.size(), 300u);
  EXPECT_EQ(placesOf(repair.lost), missing);
  EXPECT_TRUE(repair.other.empty()) << repair.other.front();
}

TEST_F(RecordingEdit, GapsAreNoLoss) {
  {
    RecordingWriter writer(folder_ / "a.session", header(), fingers());
    writer.add(world("#\n"));
    for (std::uint64_t tick = 0; tick < 1000; ++tick) {
      Sample sample;
      sample.tick = tick;
      if (tick < 200 || tick >= 210) writer.add(sample);
      sample.finger = 1;
      if (tick < 300 || tick >= 800) writer.add(sample);
    }
    writer.finish("done");
  }
  const RecordingRepair repair = repairRecording(folder_ / "a.session", folder_ / "b.session");
  EXPECT_TRUE(repair.nothingLost());
  ASSERT_EQ(repair.gaps.size(), 2u);
  EXPECT_EQ(repair.gaps[0].first, 200u);
  EXPECT_EQ(repair.gaps[0].last, 209u);
  EXPECT_EQ(repair.gaps[1].finger, 1u);
  EXPECT_EQ(repair.gaps[1].count, 500u);
}

class SalvagedRecording : public RecordingEdit {
 protected:
  struct Loss {
    std::uint64_t samples = 0;
    int headers = 0;
  };
  /// Of so many rounds, each with one page more overwritten in a recording of so many ticks.
  Loss overwritePages(int rounds, std::uint64_t ticks);
  /// Every so many of two hundred rounds, each with five bytes more changed; how many could be salvaged.
  int bendBytes(int every);
};

SalvagedRecording::Loss SalvagedRecording::overwritePages(int rounds, std::uint64_t ticks) {
  const auto all = recordWild("a.session", ticks, 2);
  const std::string sound = bytesOf("a.session");
  const std::size_t pages = sound.size() / 4096;
  Random random(77);
  Loss loss;
  for (int round = 0; round < rounds; ++round) {
    std::string bent = sound;
    for (int i = 0; i < 1 + round; ++i) {
      // The first page in every fourth round: no header, no names of tables.
      const std::size_t page = i == 0 && round % 4 == 3 ? 0 : random.below(static_cast<std::uint32_t>(pages));
      for (std::size_t at = 0; at < 4096; ++at) bent[page * 4096 + at] = static_cast<char>(random.below(256));
    }
    write("bent.session", bent);
    const RecordingRepair repair = repairRecording(folder_ / "bent.session", folder_ / "mended.session");
    EXPECT_EQ(bytesOf("bent.session"), bent) << "the file itself is only read";
    const auto is = samplesOf(folder_ / "mended.session");
    for (const auto& [place, sample] : is) EXPECT_TRUE(all.contains(place) && sameBits(sample, all.at(place)));
    const std::set<Place> missing = missingFrom(all, is);
    EXPECT_EQ(placesOf(repair.lost), missing) << "round " << round;
    EXPECT_EQ(repair.samplesLost(), missing.size());
    EXPECT_EQ(repair.samples, is.size());
    loss.samples += missing.size();
    loss.headers += repair.header_lost ? 1 : 0;
    for (const MissingTicks& lost : repair.lost) {
      const auto cuts = eventsOfKind(folder_ / "mended.session", kCutEvent);
      EXPECT_TRUE(std::ranges::any_of(
          cuts, [&](const RecordingEvent& cut) { return cut.tick == lost.last + 1 && cut.finger == lost.finger; }));
    }
  }
  return loss;
}

TEST_F(SalvagedRecording, OfOverwrittenPagesHasEverySoundBlockAndTheLossIsToldTickByTick) {
  EXPECT_GT(overwritePages(8, 3000).samples, 100u);
}

class SalvagedRecordingOfManyRounds : public SalvagedRecording {};

TEST_F(SalvagedRecordingOfManyRounds, HasEverySoundBlockAndTheLossIsToldTickByTick) {
  const Loss loss = overwritePages(40, 9000);
  EXPECT_GT(bytesOf("a.session").size(), 3u << 20) << "several MB";
  EXPECT_GT(loss.samples, 10000u);
  EXPECT_LT(loss.headers, 10) << "it stands on one page of a thousand";
}

TEST_F(RecordingEdit, OfAFileThatIsCutTheBeginningIsSalvaged) {
  const auto all = recordWild("a.session", 6000, 3);
  const std::string sound = bytesOf("a.session");
  Random random(5);
  for (int round = 0; round < 12; ++round) {
    const std::size_t size = sound.size() * (1 + random.below(98)) / 100 + random.below(4096);
    write("bent.session", sound.substr(0, size));
    const RecordingRepair repair = repairRecording(folder_ / "bent.session", folder_ / "mended.session");
    EXPECT_GT(repair.bytes_missing, 0u);
    EXPECT_LE(repair.bytes_missing, sound.size() - size + 4096);
    const auto is = samplesOf(folder_ / "mended.session");
    for (const auto& [place, sample] : is) ASSERT_TRUE(sameBits(sample, all.at(place)));
    EXPECT_EQ(repair.worlds, is.empty() ? 0u : 1u) << "it was written first";
    // What the file still names is told; of what came later nothing is left but the number of bytes.
    const std::set<Place> missing = missingFrom(all, is);
    for (const Place& place : placesOf(repair.lost)) ASSERT_TRUE(missing.contains(place));
    // SQLite writes the rows of a page after what overflows from them: of some ten blocks before the cut only that.
    EXPECT_GT(is.size() + 10 * 150, all.size() * size / sound.size());
    ASSERT_FALSE(repair.notes.empty());
    EXPECT_NE(repair.notes.back().find("the end of the file is missing"), std::string::npos);
  }
}

TEST_F(RecordingEdit, OfAWriterThatWasKilledTheLogIsSalvagedToo) {
  std::map<Place, Sample> all;
  std::filesystem::path partial = folder_ / "a.session.partial";
  const pid_t child = ::fork();
  if (child == 0) {
    Random random(9);
    RecordingWriter writer(folder_ / "a.session", header(), fingers());
    writer.add(world("#\n"));
    for (std::uint64_t tick = 0; tick < 3000; ++tick) writer.add(incompressibleSample(random, tick, 0));
    writer.flush();
    ::_exit(0);  // no destructor runs, as if it had been killed
  }
  ::waitpid(child, nullptr, 0);
  Random random(9);
  for (std::uint64_t tick = 0; tick < 3000; ++tick) all[{tick, 0}] = incompressibleSample(random, tick, 0);
  ASSERT_TRUE(std::filesystem::exists(partial.string() + "-wal"));
  const std::string before = readFile(partial.string() + "-wal", 1 << 26);
  const RecordingRepair repair = repairRecording(partial, folder_ / "b.session");
  EXPECT_TRUE(repair.nothingLost());
  EXPECT_EQ(readFile(partial.string() + "-wal", 1 << 26), before);
  EXPECT_FALSE(std::filesystem::exists(partial.string() + "-shm-2"));
  const auto is = samplesOf(folder_ / "b.session");
  ASSERT_EQ(is.size(), all.size());
  for (const auto& [place, sample] : all) ASSERT_TRUE(sameBits(sample, is.at(place)));
  EXPECT_EQ(RecordingReader(folder_ / "b.session").facts().ended_by, "not finished, repaired");
  // A frame of the log that is damaged takes its own page only.
  std::string bent = before;
  for (std::size_t at = bent.size() / 2; at < bent.size() / 2 + 3000; ++at) bent[at] = 'x';
  std::ofstream(partial.string() + "-wal", std::ios::binary | std::ios::trunc) << bent;
  const RecordingRepair second = repairRecording(partial, folder_ / "c.session");
  EXPECT_GT(second.samples, 2000u);
  const auto left = samplesOf(folder_ / "c.session");
  for (const auto& [place, sample] : left) ASSERT_TRUE(sameBits(sample, all.at(place)));
  EXPECT_EQ(placesOf(second.lost), missingFrom(all, left));
}

int SalvagedRecording::bendBytes(int every) {
  const auto all = recordWild("a.session", 900, 4);
  const std::string sound = bytesOf("a.session");
  Random random(6);
  int salvaged = 0;
  for (int round = 0; round < 200; round += every) {
    std::string bent = sound;
    for (int i = 0; i < 1 + round * 5; ++i) {
      bent[random.below(static_cast<std::uint32_t>(bent.size()))] = static_cast<char>(random.below(256));
    }
    if (round % 5 == 0) bent.resize(1 + random.below(static_cast<std::uint32_t>(bent.size())));
    write("bent.session", bent);
    std::filesystem::remove(folder_ / "mended.session");
    try {
      repairRecording(folder_ / "bent.session", folder_ / "mended.session");
      for (const auto& [place, sample] : samplesOf(folder_ / "mended.session")) {
        EXPECT_TRUE(all.contains(place) && sameBits(sample, all.at(place)));
      }
      ++salvaged;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("session: "), std::string::npos) << error.what();
    }
  }
  return salvaged;
}

TEST_F(SalvagedRecording, OfAnyBytesHasWhatCanBeAndNothingIsInvented) { EXPECT_GT(bendBytes(4), 25); }

TEST_F(SalvagedRecordingOfManyRounds, OfAnyBytesHasWhatCanBeAndNothingIsInvented) { EXPECT_GT(bendBytes(1), 100); }

TEST_F(RecordingEdit, OfWhatIsNoRecordingNothingIsSalvagedAndNothingWritten) {
  write("text.session", std::string(100000, 'x'));
  write("empty.session", "");
  for (const char* name : {"text.session", "empty.session", "none.session"}) {
    EXPECT_THROW(repairRecording(folder_ / name, folder_ / "b.session"), Error) << name;
  }
  EXPECT_THROW(repairRecording(folder_.path(), folder_ / "b.session"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.session"));
  record("a.session", 0, 99, {1, 0});
  EXPECT_THROW(repairRecording(folder_ / "a.session", folder_ / "a.session"), Error);
  EXPECT_EQ(samplesOf(folder_ / "a.session").size(), 200u);
}

}  // namespace
}  // namespace palpate::trace
