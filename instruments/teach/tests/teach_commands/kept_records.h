// Records of a few sessions, on which the commands of `palpate train results` are tried.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/trace/recording_writer.h"
#include "palpate/training/records/recording_files.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::app {

inline constexpr const char* kAnnasCode = "00000-00000";

/// Two trainees' records beside a locked session of each session.
struct Records {
  support::TemporaryFolder folder;
  training::TraineeRow anna = training::samples::trainee(kAnnasCode);
  std::string file = (folder / "a.results").string();

  Records() {
    training::Store store(file, training::Store::Open::create_too);
    std::vector<training::AnyRow> rows = training::samples::history(1, 2, 6).rows;
    rows.emplace_back(anna);
    const training::SessionRow session = training::samples::session(anna, 50);
    training::BlockRow block = training::samples::block(session, 50);
    Random random(3);
    training::TrialRow trial = training::samples::trial(block, 50, 1, random);
    trial.file_tick_first = 100;
    trial.file_tick_last = 199;
    rows.insert(rows.end(), {session, block, trial});
    store.storeAnyRows(rows);
    training::RecordingFiles files(store);
    std::filesystem::create_directories(files.folder());
    trace::RecordingWriter writer(files.pathOf(training::RecordingFiles::nameFor(session.id)),
                                  {"2026-11-22T10:00:00Z", "test", "test", 1000.0, "", ""}, {{"finger", "hand"}});
    trace::RecordingWorld world;
    world.scene = "scene";
    world.body = "torso";
    world.fingers = {{"", ""}};
    writer.add(world);
    for (std::uint64_t tick = 0; tick < 400; ++tick) {
      trace::Sample sample;
      sample.tick = tick;
      writer.add(sample);
    }
    writer.finish("done");
    files.lock(session.id);
  }
  support::CommandResult results(const std::string& arguments) const {
    return support::runPalpate("train results " + arguments, folder.path());
  }
};

}  // namespace palpate::app
