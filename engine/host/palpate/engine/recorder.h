// A recording of a servo that runs: every tick goes into the file while it is felt, on a thread of its own.
//
//   servo thread ─ samples (ring of its own) ─┐
//   owner ─ worlds, events, attachments ──────┴─► writer thread ─ trace::RecordingWriter ─► NAME.session.partial
//
// The servo copies a sample and continues, whatever the disk does. Samples without room are counted, and an event says
// where. When the disk is full or gone the recording ends, `failure` says why, and what was written stays readable.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "palpate/base/background.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/engine/servo_thread.h"
#include "palpate/trace/recording_writer.h"

namespace palpate::engine {

struct RecorderSettings {
  std::filesystem::path file;
  trace::RecordingHeader header;
  std::vector<trace::RecordingFinger> fingers;  ///< one for each of the servo's
  /// Older samples are forgotten, s: a file of the last hour does not grow for ever.
  double keep_s = std::numeric_limits<double>::infinity();
};

/// State of a recording.
struct RecorderState {
  std::uint64_t samples = 0;  ///< written
  double seconds = 0.0;       ///< from the first tick that is kept to the newest
  std::uint64_t dropped = 0;
  std::string failure;  ///< why it ended before its time; empty: it continues
};

/// Result of a copy.
struct KeptRecording {
  std::filesystem::path file;
  double seconds = 0.0;
  std::string failure;  ///< empty: it is there
};

/// Belongs to the owner of the servo thread, which must outlive it.
class Recorder {
 public:
  /// Begins at once. Throws Error where the file cannot be made.
  Recorder(ServoThread& servo, RecorderSettings settings);
  /// Without `finish` the file stays under its partial name, readable.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// At the newest tick.
  void event(std::string kind, std::string text, std::optional<std::uint32_t> finger = {});
  void mark(std::string text) { event("mark", std::move(text)); }
  /// A picture or a sound, at the newest tick.
  void attach(trace::RecordingAttachment attachment);
  /// Copies what there is into a finished file of its own and continues; `collectSaved` says when it is there. Nothing
  /// happens while another copy is being made: false.
  bool save(const std::filesystem::path& file);
  std::optional<KeptRecording> collectSaved();

  RecorderState state() const;
  /// Where it is written until it is finished.
  const std::filesystem::path& partial() const { return partial_; }
  /// A finger has touched the skin since it began.
  bool anyTouch() const { return touched_.load(std::memory_order_relaxed); }

  /// Writes all that the servo gave, and gives the file its name. Throws Error, also for what ended it before. The last
  /// call.
  void finish(std::string_view ended_by);
  /// Ends it; no file is left. The last call.
  void discard();

 private:
  /// Messages to the writer, in order.
  struct Command {
    std::optional<FeltWorld> world = {};
    std::optional<trace::RecordingEvent> event = {};
    std::optional<trace::RecordingAttachment> attachment = {};
    std::optional<std::filesystem::path> save = {};
  };
  void queue(Command command);
  void end();
  void run();
  void work();
  void recordSample(const servo::NumberedSample& numbered);
  void run(Command& command);
  void runPending();
  void note(const trace::Sample& sample);
  void noteDropped(std::uint64_t count, std::uint64_t tick);

  ServoThread& servo_;
  const RecorderSettings settings_;
  std::optional<trace::RecordingWriter> writer_;
  std::filesystem::path partial_;

  mutable std::mutex mutex_;       // never the servo's
  std::vector<Command> commands_;  // with the mutex, like what follows
  std::string failure_;
  bool keeping_ = false;
  std::optional<KeptRecording> kept_;

  // The writer thread's.
  struct FingerNotes {
    std::uint32_t buttons = 0;
    std::array<std::uint64_t, servo::kSafetyBits> last_tick{};  ///< tick of each safety bit
  };
  std::vector<FingerNotes> notes_;
  std::optional<std::uint32_t> first_world_;  ///< first world of the samples; the file counts from 0
  std::uint32_t worlds_ = 0;
  std::uint64_t next_number_ = 0;  ///< number of the next sample
  std::uint64_t dropped_noted_ = 0;
  std::optional<Background> copying_;

  std::uint64_t dropped_before_ = 0;  ///< by others who recorded
  std::atomic<std::uint64_t> first_tick_{0};
  std::atomic<std::uint64_t> newest_tick_{0};
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<bool> touched_{false};
  std::atomic<bool> ends_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace palpate::engine
