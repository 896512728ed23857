// Session files: locked so that only their key opens them, whole or not at all; and forgetting somebody, judged by
// reading every byte of the folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_writer.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/store.h"
#include "palpate/training/sha256.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_suite.h"

namespace palpate::training {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kMaxTestBytes = 1u << 26;

std::string noise(std::size_t bytes, std::uint64_t seed = 1) {
  Random random(seed);
  std::string text(bytes, '\0');
  for (char& c : text) c = static_cast<char>(random.below(256));
  return text;
}

/// A file may not be opened, and what it would have become is not there.
std::string refusedUnlock(const fs::path& file, const TraineeKey& key) {
  const fs::path out = file.string() + ".opened";
  const std::string words = support::thrownMessage([&] { unlockFile(file, out, key); });
  EXPECT_FALSE(fs::exists(out));
  return words;
}

TEST(LockedFile, OpensToTheSameBytes) {
  const support::TemporaryFolder folder;
  const TraineeKey key = newTraineeKey();
  // None, one, a piece, about a piece, some pieces.
  for (const std::size_t size : {0u, 1u, 262143u, 262144u, 262145u, 1000000u}) {
    writeFile(folder / "plain", noise(size));
    lockFile(folder / "plain", folder / "locked", key, "k1");
    EXPECT_EQ(lockedWith(folder / "locked"), "k1");
    unlockFile(folder / "locked", folder / "again", key);
    EXPECT_EQ(readFile(folder / "again", kMaxTestBytes), noise(size)) << size;
    if (size > 100) {
      EXPECT_EQ(readFile(folder / "locked", kMaxTestBytes).find(noise(size).substr(50, 16)), std::string::npos);
    }
  }
  EXPECT_FALSE(lockedWith(folder / "plain"));
}

TEST(LockedFile, TheSameBytesAreNeverLockedAlike) {
  const support::TemporaryFolder folder;
  const TraineeKey key = newTraineeKey();
  writeFile(folder / "plain", noise(1000));
  lockFile(folder / "plain", folder / "a", key, "k1");
  lockFile(folder / "plain", folder / "b", key, "k1");
  EXPECT_NE(readFile(folder / "a", kMaxTestBytes), readFile(folder / "b", kMaxTestBytes));
}

TEST(LockedFile, RefusesAnotherKeyEveryChangeAndEveryCut) {
  const support::TemporaryFolder folder;
  const TraineeKey key = newTraineeKey();
  writeFile(folder / "plain", noise(600000));  // three pieces
  lockFile(folder / "plain", folder / "locked", key, "k1");
  const std::string good = readFile(folder / "locked", kMaxTestBytes);
  EXPECT_NE(refusedUnlock(folder / "locked", newTraineeKey()).find("another key"), std::string::npos);
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    const std::size_t at = i < 40 ? static_cast<std::size_t>(i) : random.below(bad.size());
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    writeFile(folder / "bad", bad);
    EXPECT_NE(refusedUnlock(folder / "bad", key), "no error") << "byte " << at;
  }
  constexpr std::size_t kPiece = 262144 + 16;
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{30}, 30 + kPiece, 30 + 2 * kPiece,
                                 good.size() - 1, good.size() - 16}) {
    writeFile(folder / "bad", good.substr(0, size));
    EXPECT_NE(refusedUnlock(folder / "bad", key), "no error") << "first " << size;
  }
  writeFile(folder / "bad", good.substr(0, 30) + good.substr(30 + kPiece, kPiece) + good.substr(30, kPiece) +
                                good.substr(30 + 2 * kPiece));
  EXPECT_NE(refusedUnlock(folder / "bad", key), "no error") << "pieces changed places";
  writeFile(folder / "bad", good + good.substr(good.size() - 100));
  EXPECT_NE(refusedUnlock(folder / "bad", key), "no error") << "longer";
}

TEST(KeyVault, KeepsAKeyUntilItIsDestroyed) {
  const support::TemporaryFolder folder;
  KeyVault vault(folder / "a.results");
  EXPECT_FALSE(vault.find("k1"));
  EXPECT_FALSE(fs::exists(vault.file()));
  const std::string one = vault.make(), two = vault.make();
  EXPECT_NE(one, two);
  EXPECT_EQ(vault.file(), folder / "a.keys");
  EXPECT_EQ(fs::status(vault.file()).permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
  const TraineeKey key = *KeyVault(folder / "a.results").find(one);
  const TraineeKey other = *vault.find(two);
  EXPECT_NE(key, other);
  const std::string secret(key.begin(), key.end());
  EXPECT_NE(readFile(vault.file(), kMaxTestBytes).find(secret), std::string::npos);
  EXPECT_TRUE(vault.destroy(one));
  EXPECT_FALSE(vault.destroy(one));
  EXPECT_FALSE(vault.find(one));
  EXPECT_EQ(*vault.find(two), other);
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_EQ(readFile(entry.path(), kMaxTestBytes).find(secret), std::string::npos) << entry.path();
  }
}

/// A recording of so many ticks, finished or as a killed program leaves it.
void record(const fs::path& file, int ticks, bool finished, std::uint64_t seed = 1) {
  fs::create_directories(file.parent_path());
  trace::RecordingWriter writer(file, {"2026-11-22T10:00:00Z", "test", "test", 1000.0, "", ""}, {{"finger", "hand"}});
  trace::RecordingWorld world;
  world.scene = "scene";
  world.body = "torso";
  world.fingers = {{"", ""}};
  writer.add(world);
  Random noise_of(seed);
  for (int i = 0; i < ticks; ++i) {
    trace::Sample sample;
    sample.tick = static_cast<std::uint64_t>(i);
    sample.contact.tip = noise_of.uniform3();
    writer.add(sample);
  }
  writer.flush();
  if (finished) writer.finish("done");
}

/// What its compressed samples look like: 48 bytes, nearly all of them different.
std::string ownBytes(const std::string& recording) {
  for (std::size_t at = 0; at + 48 <= recording.size(); at += 16) {
    const std::string piece = recording.substr(at, 48);
    if (std::set<char>(piece.begin(), piece.end()).size() > 42) return piece;
  }
  ADD_FAILURE() << "the recording holds nothing of its own";
  return {};
}

/// A store with three trainees whose sessions were recorded and locked.
struct Station {
  support::TemporaryFolder folder;
  samples::History history = samples::history(3, 2, 4);
  Store store{folder / "a.results", Store::Open::create_too};
  RecordingFiles files{store};
  std::vector<std::string> courses;  ///< bytes that only one session's recording holds

  explicit Station(bool joined = false) {
    store.fillOutbox(joined);
    store.storeAnyRows(history.rows);
    for (const TraineeRow& trainee : history.trainees) {
      for (const SessionRow& session : store.sessions(trainee.id)) {
        const fs::path file = files.pathOf(RecordingFiles::nameFor(session.id));
        record(file, 50, true, courses.size() + 2);
        courses.push_back(ownBytes(readFile(file, kMaxTestBytes)));
        EXPECT_TRUE(files.lock(session.id));
      }
    }
  }
};

TEST(RecordingFiles, AreLockedAfterTheSessionAndOpenForAReplay) {
  Station station;
  const SessionRow session = station.store.sessions(station.history.trainees[0].id).front();
  EXPECT_EQ(session.file, "sessions/" + session.id + ".session.locked");
  EXPECT_EQ(session.file_sha256, sha256OfFile(station.files.pathOf(session.file)));
  EXPECT_EQ(station.files.sessionFiles(session.id).size(), 1u);  // the open one is gone
  EXPECT_TRUE(lockedWith(station.files.pathOf(session.file)));
  fs::path where;
  {
    const OpenedRecording opened = station.files.open(session);
    where = opened.file();
    EXPECT_EQ(trace::RecordingReader(where).facts().samples, 50u);
  }
  EXPECT_FALSE(fs::exists(where));
  const auto trainee = station.store.trainee(session.trainee_id);
  EXPECT_EQ(station.files.keyOf(session.trainee_id), trainee->key_ref);  // the same for all of theirs
  station.files.vault().destroy(trainee->key_ref);
  EXPECT_NE(support::thrownMessage([&] { station.files.open(session); }).find("its key is not in"), std::string::npos);
}

TEST(RecordingFiles, WhatAKilledProgramLeftIsFinishedAndLocked) {
  Station station;
  SessionRow session = samples::session(station.history.trainees[0], 77);
  session.file = RecordingFiles::nameFor(session.id);
  const Row row = session;
  station.store.save(std::span(&row, 1));
  record(station.files.pathOf(session.file), 40, false);
  EXPECT_EQ(trace::RecordingReader(station.files.open(session).file()).facts().samples, 40u);
  EXPECT_EQ(station.files.lockLeftBehind(), 0);  // somebody may still be writing
  EXPECT_EQ(station.files.lockLeftBehind(0.0), 1);
  const auto locked = station.store.rows().session(session.id);
  EXPECT_EQ(trace::RecordingReader(station.files.open(*locked).file()).facts().samples, 40u);
  EXPECT_EQ(station.files.sessionFiles(session.id).size(), 1u);
}

TEST(RecordingFiles, NamesDoNotLeadElsewhere) {
  Station station;
  EXPECT_NE(support::thrownMessage([&] { (void)station.files.pathOf("../x"); }).find("leads out"), std::string::npos);
}

std::string blobOf(const Uuid& id) {
  std::string bytes;
  std::string hex = id;
  std::erase(hex, '-');
  for (std::size_t i = 0; i < hex.size(); i += 2) bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

/// Files that hold the text anywhere, or are called so.
int filesWith(const fs::path& folder, const std::string& text) {
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const bool inside = readFile(entry.path(), kMaxTestBytes).find(text) != std::string::npos;
    found += inside || entry.path().string().find(text) != std::string::npos ? 1 : 0;
  }
  return found;
}

TEST(Deletion, LeavesNoByteThatSaysWhoItWas) {
  Station station(true);
  const Uuid gone = station.history.trainees[1].id;
  std::vector<std::string> ids = {gone};
  for (const SessionRow& session : station.store.sessions(gone)) {
    ids.push_back(session.id);
    for (const BlockRow& block : station.store.blocks(session.id)) {
      ids.push_back(block.id);
      for (const TrialRow& trial : station.store.trials(block.id)) ids.push_back(trial.id);
    }
  }
  // What their fingers did was never beside its locked file.
  for (const std::string& course : station.courses) EXPECT_EQ(filesWith(station.folder.path(), course), 0);
  for (const std::string& id : ids) EXPECT_GT(filesWith(station.folder.path(), id), 0) << id;
  const std::string ref = station.store.trainee(gone)->key_ref;
  std::vector<std::string> others;
  for (const std::string& text : samples::saidAll(station.store.rows().all())) others.push_back(text);

  const Deleted deleted = deleteTrainee(station.store, gone, "test");
  EXPECT_TRUE(deleted.found);
  EXPECT_TRUE(deleted.key);
  EXPECT_EQ(deleted.sessions, 2);
  EXPECT_EQ(deleted.trials, 8);
  EXPECT_EQ(deleted.files, 2);
  for (const std::string& id : ids) {
    EXPECT_EQ(filesWith(station.folder.path(), id), 0) << id;
    EXPECT_EQ(filesWith(station.folder.path(), blobOf(id)), 0) << id;
  }
  EXPECT_EQ(filesWith(station.folder.path(), ref), 0);
  // Everybody else's rows are what they were.
  const std::vector<std::string> left = samples::saidAll(station.store.rows().all());
  EXPECT_EQ(left.size(), others.size() - 1 - 2 * 7);
  EXPECT_TRUE(std::ranges::all_of(
      left, [&](const std::string& text) { return std::ranges::find(others, text) != others.end(); }));
  for (const SessionRow& session : station.store.sessions()) station.files.open(session);
  // The class hears of it, by a hash; the audit remembers the same.
  const auto waiting = station.store.waiting(1000);
  ASSERT_EQ(waiting.back().kind, "delete");
  EXPECT_NE(waiting.back().body.find(deletedMark(gone)), std::string::npos);
  EXPECT_TRUE(station.store.rows().noted("deleted", deletedMark(gone)));
  EXPECT_FALSE(deleteTrainee(station.store, gone, "test").found);
}

TEST(Purge, ForgetsWhatAClassHasKeptLongEnough) {
  Station station;
  const auto before = station.store.rows().trialCount();
  constexpr std::int64_t kDay = 86'400'000;
  const std::int64_t monday = samples::kMonday;
  EXPECT_EQ(purge(station.store, monday + 50 * kDay, true).files, 0);
  const Purged counted = purge(station.store, monday + 200 * kDay, false);
  EXPECT_EQ(counted.files, 6);  // after 90 days
  EXPECT_EQ(station.files.sessionFiles(station.store.sessions().front().id).size(), 1u);
  EXPECT_EQ(purge(station.store, monday + 200 * kDay, true).files, 6);
  EXPECT_EQ(station.store.rows().trialCount(), before);
  EXPECT_TRUE(station.store.sessions().front().file.empty());
  const Purged all = purge(station.store, monday + 500 * kDay, true);
  EXPECT_EQ(all.sessions, 6);
  EXPECT_EQ(all.trainees, 3);
  EXPECT_EQ(station.store.rows().trialCount(), 0);
  EXPECT_TRUE(station.store.trainees().empty());
  EXPECT_FALSE(station.store.stations().empty());
}

TEST(Purge, TellsTheClassNothingForWhoIsGoneHereMayHaveSatElsewhereSince) {
  Station station;
  station.store.fillOutbox(true);
  const Uuid gone = station.store.trainees().front().id;
  EXPECT_EQ(purge(station.store, samples::kMonday + 500 * 86'400'000ll, true).trainees, 3);
  for (const OutboxEntry& entry : station.store.waiting(1000)) EXPECT_NE(entry.kind, "delete") << entry.body;
  EXPECT_FALSE(station.store.rows().noted("deleted", deletedMark(gone)));
}

TEST(Purge, OfAClassThatKeepsThingsForLessLeavesLess) {
  Station station;
  ClassRow strict = samples::aClass();
  strict.retain_days = strict.retain_samples_days = 30;
  station.store.save(strict);
  EXPECT_EQ(purge(station.store, samples::kMonday + 50 * 86'400'000ll, true).sessions, 6);
  EXPECT_EQ(station.store.rows().trialCount(), 0);
}

TEST(Store, InMemoryHoldsWhatAFileHoldsAndLeavesNone) {
  const support::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const samples::History history = samples::history(2, 2, 3);
  {
    Store copy = Store::inMemory("database class");
    copy.storeAnyRows(history.rows);
    EXPECT_EQ(samples::saidAll(copy.rows().all()).size(), history.rows.size());
    EXPECT_EQ(copy.file(), "database class");
  }
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(DefaultRecords, LieInTheUsersDataFolder) {
  const char* const before = std::getenv("XDG_DATA_HOME");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("XDG_DATA_HOME", "/tmp/data", 1);
  EXPECT_EQ(defaultRecords(), "/tmp/data/palpate/palpate.results");
  ::setenv("XDG_DATA_HOME", "relative", 1);  // to be ignored, says the standard
  EXPECT_TRUE(defaultRecords().string().ends_with(".local/share/palpate/palpate.results"));
  if (before == nullptr) {
    ::unsetenv("XDG_DATA_HOME");
  } else {
    ::setenv("XDG_DATA_HOME", kept.c_str(), 1);
  }
}

}  // namespace
}  // namespace palpate::training
