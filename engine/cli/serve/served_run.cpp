// The owner's thread: the servo's outputs, sixty times a second, as one frame for the network thread.
#include "cli/serve/served_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "cli/kit/families.h"
#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/progress_line.h"
#include "cli/run/playback.h"
#include "cli/serve/wire.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/system/process.h"
#include "palpate/base/system/thread.h"
#include "palpate/body/places.h"
#include "palpate/device/back_ends.h"
#include "palpate/engine/contact_stream.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/engine/recorder.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::app::serving {

namespace fs = std::filesystem;

namespace {

constexpr int kFramesPerS = 60;
/// Frames per touch message to subscribers: a reader could not follow more.
constexpr int kRoundsPerTouch = 3;
/// Interval of frames without changes: watchers see that the server lives.
constexpr double kStillS = 0.25;
/// Kind, version and tick of a frame, which always differ.
constexpr std::size_t kFrameStamp = 12;

// --- tokens and their file

/// Removes a file with a name of our own choice.
struct MadeFile {
  fs::path path;
  bool remove = false;
  ~MadeFile() {
    std::error_code ignored;
    if (remove) fs::remove(path, ignored);
  }
};

Tokens tokensFor(const ServeOptions& options) {
  const bool given = !options.tokens.control.empty();
  const bool from_file = !options.token_file.empty() && fs::exists(options.token_file);
  if (given && from_file) {
    throw Error::inFile(options.token_file.string(), "already contains tokens; use either this file or --token");
  }
  if (!isLoopback(options.host) && !given && !from_file) {
    throw Error(
        fmt::format("--host {}: others than this computer can reach it: give --token, or a --token-file that "
                    "is there",
                    options.host));
  }
  return from_file ? readTokens(options.token_file) : completed(options.tokens);
}

/// The file of the tokens for --json, which does not print them.
std::unique_ptr<MadeFile> tokenFileFor(const ServeOptions& options, const Tokens& tokens) {
  auto file = std::make_unique<MadeFile>();
  file->path = options.token_file;
  if (file->path.empty() && !options.json) return file;
  if (file->path.empty()) {
    file->path = freshTokenFile();
    file->remove = true;
  }
  if (!fs::exists(file->path)) writeTokens(file->path, tokens);
  return file;
}

// --- exhibits

Site siteFor(const ServeOptions& options) {
  if (!options.site.empty()) return Site(options.site);
  std::error_code error;
  for (const char* place : {"../share/palpate/web", "../web/site"}) {
    const fs::path folder = (system::ownProgram().parent_path() / pathOf(place)).lexically_normal();
    if (fs::exists(folder / "index.html", error)) return Site(folder);
  }
  return {};
}

/// The hands of the servo, as pages see them.
std::vector<ControlledFinger> fingersOf(const scene::World& world, const ServeOptions& options) {
  std::vector<ControlledFinger> fingers;
  for (std::size_t i = 0; i < viewer::kFingers; ++i) {
    fingers.push_back({std::string(viewer::kFingerNames[i]), viewer::fingerRadius(world.scene, i),
                       i < options.devices.size() ? options.devices[i] : std::string()});
  }
  return fingers;
}

Json worldFactsJson(const scene::World& world, const std::vector<ControlledFinger>& fingers, const std::string& skin) {
  Hash hash;
  for (const char byte : skin) hash.add(std::uint64_t{static_cast<unsigned char>(byte)});
  Json hands = Json::array();
  for (const ControlledFinger& finger : fingers) {
    const std::size_t number = hands.size();
    const scene::Finger own = number < world.scene.fingers.size() ? world.scene.fingers[number] : scene::Finger();
    hands.push_back({{"name", finger.name},
                     {"radius_mm", finger.radius_mm},
                     {"device", finger.device},
                     {"pad", own.pad},
                     {"pad_mm", own.pad_mm}});
  }
  Json landmarks = Json::array();
  for (const body::SkinLandmark& landmark : world.body->anatomy.landmarks) {
    landmarks.push_back({{"name", body::spokenName(landmark.name)},
                         {"at", vectorJson(landmark.position)},
                         {"normal", vectorJson(landmark.normal)}});
  }
  return {{"title", world.scene.title.empty() ? world.body->name : world.scene.title},
          {"ticks_per_s", world.scene.ticks_per_s},
          {"frames_per_s", kFramesPerS},
          {"vertices", world.body->skin.positions.size()},
          {"triangles", world.body->skin.triangles.size()},
          {"closed", world.body->closed},
          {"skin", fmt::format("{:016x}", hash.value())},
          {"fingers", std::move(hands)},
          {"landmarks", std::move(landmarks)}};
}

/// Null where the tissue has no patterns: a request for a pad is then refused.
std::shared_ptr<const engine::FeltPressure> makePressure(const std::shared_ptr<const scene::World>& world) {
  try {
    return std::make_shared<const engine::FeltPressure>(world);
  } catch (const Error&) {
    return nullptr;
  }
}

Box3 computeBodyBox(const scene::World& world) {
  Box3 box;
  for (const Vec3& place : world.body->skin.positions) box.extend(place);
  return box;
}

// --- the servo

viewer::LiveServo servoFor(const std::shared_ptr<const scene::World>& world, const ServeOptions& options) {
  std::vector<viewer::OpenedDevice> devices = openedFor(*world, options.devices);
  std::vector<device::Capabilities> able;
  for (const viewer::OpenedDevice& device : devices) able.push_back(viewer::scaledCapabilities(device));
  return viewer::LiveServo(viewer::planFor(world, world->scene, true, able), std::move(devices));
}

std::vector<device::Device> devicesOf(const viewer::LiveServo& servo) {
  std::vector<device::Device> devices;
  for (std::size_t i = 0; i < viewer::kFingers; ++i) {
    if (servo.isHeld(i)) devices.push_back(servo.device(i));
  }
  return devices;
}

/// Presses the emergency stop for instructors, and releases only its own press.
FingerControl::HaltDevices makeHaltCallback(viewer::LiveServo& servo) {
  if (!servo.anyHeld()) return {};
  return [stop = &servo.thread().emergencyStop(), pressed = false](bool halted) mutable {
    if (halted && !stop->pressed()) {
      stop->press();
      pressed = true;
    } else if (!halted && std::exchange(pressed, false)) {
      stop->release();
    }
  };
}

std::unique_ptr<engine::Recorder> recorderFor(const ServeOptions& options, const scene::World& world,
                                              viewer::LiveServo& servo) {
  if (options.recording.empty()) return nullptr;
  if (!options.overwrite && fs::exists(options.recording)) {
    throw Error::inFile(options.recording.string(), "already exists; use another name, or --overwrite");
  }
  engine::RecorderSettings settings;
  settings.file = options.recording;
  settings.header = engine::recordingHeader(world.scene.ticks_per_s);
  settings.header.notes = world.scene.title;
  for (std::size_t i = 0; i < viewer::kFingers; ++i) {
    device::Device page;
    page.name = "page";
    settings.fingers.push_back(
        engine::recordingFinger(std::string(viewer::kFingerNames[i]), servo.isHeld(i) ? servo.device(i) : page));
  }
  return std::make_unique<engine::Recorder>(servo.thread(), settings);
}

// --- sixty times a second

class FrameMaker {
 public:
  explicit FrameMaker(const scene::World& world) : world_(world), frame_(engine::frameFor(viewer::kFingers)) {}

  /// Null without news.
  std::shared_ptr<const std::string> next(std::span<const trace::Sample> samples, double now_s) {
    engine::fillFrame(world_, samples, frame_);
    engine::encodeFrame(frame_, bytes_);
    const std::string_view said = std::string_view(bytes_).substr(kFrameStamp);
    if (said == said_ && now_s - said_at_s_ < kStillS) return nullptr;
    said_ = said;
    said_at_s_ = now_s;
    return std::make_shared<const std::string>(bytes_);
  }

 private:
  const scene::World& world_;
  engine::StreamedFrame frame_;
  std::string bytes_, said_;
  double said_at_s_ = -1.0;
};

Json vitalsJson(const servo::LoopVitals& vitals) {
  return {{"ticks_per_s", vitals.ticks_per_s},
          {"ticks", vitals.ticks},
          {"overruns", vitals.overruns},
          {"compute_us", percentilesJson(vitals.compute)},
          {"lateness_us", percentilesJson(vitals.lateness)}};
}

void showUntilTheEnd(const ServeOptions& options, const scene::World& world, viewer::LiveServo& servo, Network& network,
                     const engine::Recorder* recorder) {
  FrameMaker frames(world);
  const std::vector<device::Device> devices = devicesOf(servo);
  const Clock::time_point began = Clock::now();
  constexpr std::int64_t kStepNs = 1'000'000'000 / kFramesPerS;
  std::int64_t due = monotonicNs();
  for (int round = 1; endingSignal() == 0; ++round) {
    const double now_s = secondsSince(began);
    if (options.input.seconds > 0.0 && now_s >= options.input.seconds) return;
    if (recorder != nullptr && !recorder->state().failure.empty()) return;  // `finish` says why
    servo.thread().exchange();
    const std::span<const trace::Sample> felt = servo.thread().contacts();
    if (auto frame = frames.next(felt, now_s)) network.show(std::move(frame));
    if (round % kRoundsPerTouch == 0 && network.hasSubscribers()) network.publishTouch({felt.begin(), felt.end()});
    trace::Sample sample;
    while (servo.thread().pop(sample)) {  // they are not plotted here
    }
    if (round % kFramesPerS == 0) {
      network.publishStats(vitalsJson(servo.thread().vitals()));
      for (const std::string& trouble : device::reviveDevices(devices)) say(trouble + "\n");
    }
    due = std::max(due + kStepNs, monotonicNs());
    system::sleepUntil(due);
  }
}

// --- printed text

constexpr std::string_view kPlainWarning =
    "warning: plain HTTP: everybody on the way can read the tokens and the body that is shown; use --tls-cert and "
    "--tls-key, or a proxy with TLS (docs/howto/serve.md)\n";

void printAddress(const ServeOptions& options, const Network& network, const Tokens& tokens, const fs::path& file,
                  const std::string& title) {
  const std::vector<std::string> addresses = network.addresses();
  if (!isLoopback(options.host) && options.tls_cert.empty()) say(kPlainWarning);
  if (options.json) {
    const Json line = {{"event", "serving"},     {"address", addresses.front()},     {"addresses", addresses},
                       {"port", network.port()}, {"tls", !options.tls_cert.empty()}, {"token_file", file.string()}};
    fmt::print("{}\n", jsonDump(line));
  } else {
    fmt::print("Palpate serves \"{}\" on {}\n", title, fmt::join(addresses, ", "));
    for (const auto& [what, token] : {std::pair("look on ", &tokens.look), std::pair("touch   ", &tokens.control),
                                      std::pair("instruct", &tokens.instruct)}) {
      fmt::print("  to {}  {}/#token={}\n", what, addresses.front(), *token);
    }
    fmt::print("Ctrl+C ends it.\n");
  }
  std::fflush(stdout);
}

Json reportJson(const NetworkCounts& counts, const servo::LoopReport& loop) {
  return {{"event", "ended"},
          {"ended_by", endingSignal() == 0 ? "done" : std::string(nameOfSignal(endingSignal()))},
          {"most_onlookers", counts.most_watchers},
          {"frames_sent", counts.frames_sent},
          {"frames_skipped", counts.frames_skipped},
          {"bytes_sent", counts.bytes_sent},
          {"refused_token", counts.refused_token},
          {"refused_origin", counts.refused_origin},
          {"refused_full", counts.refused_full},
          {"malformed", counts.malformed},
          {"dropped", counts.dropped},
          {"hung_up", counts.hung_up},
          {"ticks", loop.ticks},
          {"overruns", loop.overruns},
          {"compute_us", percentilesJson(loop.compute)},
          {"lateness_us", percentilesJson(loop.lateness)}};
}

void printReport(const ServeOptions& options, const NetworkCounts& counts, const servo::LoopReport& loop) {
  if (options.json) {
    fmt::print("{}\n", jsonDump(reportJson(counts, loop)));
    return;
  }
  fmt::print("{} viewers at most, {} frames; {} ticks, {} deadlines missed\n", counts.most_watchers, counts.frames_sent,
             loop.ticks, loop.overruns);
  const std::uint64_t refused = counts.refused_token + counts.refused_origin + counts.refused_full + counts.malformed +
                                counts.dropped + counts.hung_up;
  if (refused == 0) return;
  fmt::print(
      "refused: {} wrong tokens, {} other origins, {} for whom there was no room, {} malformed; {} dropped, {} stalled "
      "requests hung up on\n",
      counts.refused_token, counts.refused_origin, counts.refused_full, counts.malformed, counts.dropped,
      counts.hung_up);
}

std::vector<std::string> parseOrigins(const ServeOptions& options) {
  std::vector<std::string> origins;
  for (const std::string& words : options.origins) {
    origins.push_back(parseOrigin(words));
    if (origins.back().empty())
      throw Error(fmt::format("--origin {}: expected an origin such as https://place.example", words));
  }
  return origins;
}

}  // namespace

void serve(const ServeOptions& options) {
  NetworkSettings settings;
  settings.host = options.host;
  settings.port = options.port;
  settings.tokens = tokensFor(options);
  settings.origins = parseOrigins(options);
  if (!options.tls_cert.empty()) settings.tls = tlsFrom(options.tls_cert, options.tls_key);
  settings.watchers = options.watchers;
  ServedContent exhibits;
  exhibits.site = siteFor(options);
  ProgressLine progress;
  const auto world = scene::build(sceneFor(options.input), progress.callback());
  progress.clear();
  const FinishesInOrder in_order;
  exhibits.skin = engine::encodedSkinOf(*world);
  exhibits.forms = engine::encodedFormsOf(*world, viewer::kFingers);
  exhibits.facts = worldFactsJson(*world, fingersOf(*world, options), exhibits.skin);
  exhibits.pressure = makePressure(world);
  const std::string title = exhibits.facts["title"].text();

  viewer::LiveServo servo = servoFor(world, options);
  const StoppedBySignal stopped(servo.thread().emergencyStop());
  const auto recorder = recorderFor(options, *world, servo);
  FingerControl control(
      fingersOf(*world, options), computeBodyBox(*world),
      [&servo](std::size_t finger, const device::FingerTarget& target) { servo.point(finger, target); },
      makeHaltCallback(servo));
  std::optional<Network> network(std::in_place, settings, std::move(exhibits), std::move(control));
  const auto token_file = tokenFileFor(options, settings.tokens);
  printAddress(options, *network, settings.tokens, token_file->path, title);
  showUntilTheEnd(options, *world, servo, *network, recorder.get());
  const NetworkCounts counts = network->counts();
  network.reset();
  const servo::LoopReport loop = servo.thread().stop();
  if (recorder) recorder->finish(endingSignal() == 0 ? "done" : nameOfSignal(endingSignal()));
  printReport(options, counts, loop);
}

}  // namespace palpate::app::serving
