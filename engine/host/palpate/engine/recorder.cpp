// The writer thread looks at the ring every few milliseconds. A world is announced before any sample names it, so a
// sample of a world that the file lacks makes the thread run its commands first.
#include "palpate/engine/recorder.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::engine {

namespace {

/// Between two looks at the ring: with a part of the file (150 ms) well below the 200 ms that a killed program may
/// lose.
constexpr std::chrono::milliseconds kPause{10};

/// An intervention that comes again sooner is the same one.
constexpr double kInterventionS = 1.0;

}  // namespace

Recorder::Recorder(ServoThread& servo, RecorderSettings settings)
    : servo_(servo), settings_(std::move(settings)), notes_(settings_.fingers.size()) {
  writer_.emplace(settings_.file, settings_.header, settings_.fingers);
  partial_ = writer_->partial();
  servo::NumberedSample stale;
  while (servo_.popRecorded(stale)) {
  }
  dropped_before_ = servo_.droppedRecorded();
  servo_.record([this](const FeltWorld& world) { queue({.world = world}); });
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() { end(); }

void Recorder::queue(Command command) {
  const std::lock_guard lock(mutex_);
  commands_.push_back(std::move(command));
}

void Recorder::event(std::string kind, std::string text, std::optional<std::uint32_t> finger) {
  queue({.event = trace::RecordingEvent{newest_tick_, finger, std::move(kind), std::move(text)}});
}

void Recorder::attach(trace::RecordingAttachment attachment) {
  attachment.tick = newest_tick_;
  queue({.attachment = std::move(attachment)});
}

bool Recorder::save(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  if (keeping_) return false;
  keeping_ = true;
  commands_.push_back({.save = file});
  return true;
}

std::optional<KeptRecording> Recorder::collectSaved() {
  const std::lock_guard lock(mutex_);
  if (kept_) keeping_ = false;
  return std::exchange(kept_, std::nullopt);
}

RecorderState Recorder::state() const {
  RecorderState state;
  state.samples = samples_;
  if (state.samples > 0) {
    state.seconds = static_cast<double>(newest_tick_ - first_tick_ + 1) / settings_.header.ticks_per_s;
  }
  state.dropped = servo_.droppedRecorded() - dropped_before_;
  const std::lock_guard lock(mutex_);
  state.failure = failure_;
  return state;
}

void Recorder::end() {
  if (!thread_.joinable()) return;
  servo_.record({});
  ends_ = true;
  thread_.join();
}

void Recorder::finish(std::string_view ended_by) {
  end();
  if (!failure_.empty()) throw Error(failure_);
  if (const std::uint64_t last = state().dropped - dropped_noted_; last > 0) noteDropped(last, newest_tick_ + 1);
  writer_->finish(ended_by);
}

void Recorder::discard() {
  end();
  writer_->discard();
}

// --- on the writer's thread ---

/// After a failure it continues to empty the ring, so that samples which could not be written do not count as dropped.
void Recorder::run() {
  for (bool ends = false; !ends;) {
    ends = ends_;
    try {
      if (failure_.empty()) work();
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      failure_ = error.what();
      if (keeping_ && !kept_) kept_ = KeptRecording{{}, 0.0, failure_};
    }
    servo::NumberedSample lost;
    while (!failure_.empty() && servo_.popRecorded(lost)) {
    }
    if (!ends) std::this_thread::sleep_for(kPause);
  }
  copying_.reset();
}

void Recorder::work() {
  servo::NumberedSample sample;
  while (servo_.popRecorded(sample)) recordSample(sample);
  runPending();
  const double kept_ticks = settings_.keep_s * settings_.header.ticks_per_s;
  const std::uint64_t newest = newest_tick_;
  if (static_cast<double>(newest - first_tick_) <= kept_ticks) return;
  first_tick_ = newest - static_cast<std::uint64_t>(kept_ticks);
  writer_->forgetBefore(first_tick_);
}

void Recorder::recordSample(const servo::NumberedSample& numbered) {
  const trace::Sample& sample = numbered.sample;
  const std::uint64_t missing = samples_ == 0 ? 0 : numbered.number - next_number_;
  next_number_ = numbered.number + 1;
  if (!first_world_ || sample.world - *first_world_ >= worlds_) runPending();
  if (!first_world_ || sample.world < *first_world_) return;  // before it began
  if (samples_ == 0) {
    first_tick_ = sample.tick;
    if (sample.tick > 0)
      writer_->add({sample.tick, std::nullopt, std::string(trace::kCutEvent), "begun while the loop ran"});
  }
  if (missing > 0) noteDropped(missing, sample.tick);
  newest_tick_ = sample.tick;
  trace::Sample kept = sample;
  kept.world = sample.world - *first_world_;
  writer_->add(kept);
  note(sample);
  ++samples_;
  if (sample.contact.touch != contact::Touch::free) touched_.store(true, std::memory_order_relaxed);
}

void Recorder::noteDropped(std::uint64_t count, std::uint64_t tick) {
  writer_->add({tick, std::nullopt, std::string(trace::kDroppedEvent),
                fmt::format("{} samples before here found no room: the disk was too slow", count)});
  dropped_noted_ += count;
  writer_->setDropped(dropped_noted_);
}

/// Buttons and interventions of a tick.
void Recorder::note(const trace::Sample& sample) {
  FingerNotes& notes = notes_[sample.finger];
  if (sample.buttons != notes.buttons) {
    writer_->add({sample.tick, sample.finger, "button",
                  sample.buttons == 0 ? "released" : fmt::format("down: {:b}", sample.buttons)});
    notes.buttons = sample.buttons;
  }
  const auto again = static_cast<std::uint64_t>(kInterventionS * settings_.header.ticks_per_s);
  for (std::size_t bit = 0; bit < notes.last_tick.size(); ++bit) {
    if ((sample.safety & (1u << bit)) == 0) continue;
    const std::uint64_t last = std::exchange(notes.last_tick[bit], sample.tick + 1);
    if (last != 0 && sample.tick < last + again) continue;
    writer_->add({sample.tick, sample.finger, "safety", servo::safetyNames()[bit]});
  }
}

void Recorder::runPending() {
  std::vector<Command> commands;
  {
    const std::lock_guard lock(mutex_);
    commands.swap(commands_);
  }
  for (Command& command : commands) run(command);
}

void Recorder::run(Command& command) {
  if (command.world) {
    if (!first_world_) first_world_ = command.world->number;
    writer_->add(recordingWorld(*command.world->world, command.world->fingers));
    if (samples_ > 0) writer_->add({newest_tick_, std::nullopt, "world", fmt::format("world {}", worlds_)});
    ++worlds_;
  }
  if (command.event) writer_->add(*command.event);
  if (command.attachment) writer_->add(*command.attachment);
  if (!command.save) return;
  writer_->flush();
  const double seconds = state().seconds;
  // On its own thread, because an hour takes longer than the ring holds.
  copying_.emplace([this, file = *command.save, seconds] {
    KeptRecording kept{file, seconds, {}};
    try {
      trace::copyRecording(partial_, file, "kept");
    } catch (const std::exception& error) {
      kept.failure = error.what();
    }
    const std::lock_guard lock(mutex_);
    kept_ = std::move(kept);
  });
}

}  // namespace palpate::engine
