// One table of names for each kind of settings, read in both directions.
#include "palpate/engine/recording_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/device/back_ends.h"
#include "palpate/scene/scene_writer.h"

namespace palpate::engine {

namespace {

/// A number of some settings, true and false as 1 and 0.
struct Field {
  const char* name;
  std::function<double()> get;
  std::function<void(double)> set;
};

Field number(const char* name, double& value) {
  return {name, [&value] { return value; }, [&value](double read) { value = read; }};
}
Field flag(const char* name, bool& value) {
  return {name, [&value] { return value ? 1.0 : 0.0; }, [&value](double read) { value = read != 0.0; }};
}

std::vector<Field> fieldsOf(contact::FingerSettings& s) {
  return {number("radius_mm", s.radius_mm),
          number("stiffness_ratio", s.stiffness_ratio),
          number("mu_static", s.mu_static),
          number("mu_dynamic", s.mu_dynamic),
          number("max_depth_mm", s.max_depth_mm),
          number("tick_s", s.tick_s),
          number("catch_up_mm_per_s", s.catch_up_mm_per_s),
          flag("force_shading", s.force_shading),
          number("relaxation", s.relaxation.share),
          number("relaxation_s", s.relaxation.time_s),
          number("relaxation_2", s.relaxation.share_2),
          number("relaxation_2_s", s.relaxation.time_2_s)};
}

std::vector<Field> fieldsOf(RecordedLimiter& recorded) {
  servo::LimiterSettings& s = recorded.settings;
  servo::PassivitySettings& p = s.passivity;
  return {flag("closes_loop", recorded.closes_loop),
          flag("limited", s.limited),
          number("force_n", s.force_n),
          number("stiffness_factor", s.stiffness_factor),
          number("cap_n_per_mm", s.cap_n_per_mm),
          number("compared_n", s.compared_n),
          number("stiffness_n_per_mm", s.stiffness_n_per_mm),
          number("steepest", s.steepest),
          number("tick_s", s.tick_s),
          flag("soft_contact", s.soft_contact),
          {"start_ramps", [&s] { return s.start == scene::StartRule::ramp ? 1.0 : 0.0; },
           [&s](double read) { s.start = read != 0.0 ? scene::StartRule::ramp : scene::StartRule::outside; }},
          number("ramp_s", s.ramp_s),
          number("max_age_ticks", s.max_age_ticks),
          number("max_jump_mm", s.max_jump_mm),
          number("max_tip_speed_mm_per_s", s.max_tip_speed_mm_per_s),
          number("max_force_rate_n_per_ms", s.max_force_rate_n_per_ms),
          flag("passivity", p.on),
          number("passivity_delay_ticks", p.delay_ticks),
          number("passivity_damping_n_s_per_mm", p.damping_n_s_per_mm),
          number("passivity_friction_n", p.friction_n),
          number("passivity_mass_kg", p.mass_kg),
          number("passivity_encoder_mm", p.encoder_mm),
          number("passivity_most_n", p.most_n)};
}

/// Written only where it is true: recordings of before have none.
constexpr const char* kUnsafe = "unsafe_stiffness";
/// Of the solver, written always: recordings from before it stepped where a surface was exchanged in contact.
constexpr const char* kFollowsExchange = "follows_exchange";

std::string asText(const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) text += fmt::format("{} = {}\n", field.name, field.get());
  return text;
}

void read(const std::string& text, const std::vector<Field>& fields) {
  for (const std::string_view line : split(text, '\n')) {
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    const std::string_view name = trimmed(line.substr(0, equals));
    const auto value = equals == std::string_view::npos ? std::nullopt : parseNumber(line.substr(equals + 1));
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    if (field == fields.end() || !value) throw Error(fmt::format("recorded settings: '{}' is not understood", line));
    field->set(*value);
  }
}

}  // namespace

std::string asText(const contact::FingerSettings& settings) {
  contact::FingerSettings copy = settings;
  return asText(fieldsOf(copy));
}

std::string asText(const servo::LimiterSettings& settings, bool closes_loop) {
  RecordedLimiter copy{settings, closes_loop, true};
  std::string text = asText(fieldsOf(copy)) + asText({flag(kFollowsExchange, copy.follows_exchange)});
  if (settings.unsafe) text += asText({flag(kUnsafe, copy.settings.unsafe)});
  return text;
}

contact::FingerSettings contactSettingsFrom(const std::string& text) {
  contact::FingerSettings settings;
  read(text, fieldsOf(settings));
  return settings;
}

RecordedLimiter limiterFrom(const std::string& text) {
  RecordedLimiter recorded;
  std::vector<Field> fields = fieldsOf(recorded);
  fields.push_back(flag(kUnsafe, recorded.settings.unsafe));
  fields.push_back(flag(kFollowsExchange, recorded.follows_exchange));
  read(text, fields);
  return recorded;
}

std::string limitsInWords(const servo::LimiterSettings& limits) {
  std::string text = fmt::format("force at most {:.3g} N, all forces times {:.3g}, at most {:.3g} N/mm", limits.force_n,
                                 limits.stiffness_factor, limits.stiffness_factor * limits.stiffness_n_per_mm);
  if (limits.cap_n_per_mm > 0.0) text += fmt::format(", held there above {:.3g} N", limits.compared_n);
  return limits.unsafe ? text + "; UNSAFE: more than is safe for the device, by --unsafe-stiffness" : text;
}

std::vector<FingerLimits> limitsIn(const trace::RecordingWorld& world,
                                   std::span<const trace::RecordingFinger> fingers) {
  std::vector<FingerLimits> all;
  for (std::size_t i = 0; i < std::min(world.fingers.size(), fingers.size()); ++i) {
    try {
      const servo::LimiterSettings limits = limiterFrom(world.fingers[i].limiter).settings;
      if (limits.limited) all.push_back({fingers[i].name, limits});
    } catch (const Error&) {
      continue;  // of another version; a replay refuses it
    }
  }
  return all;
}

std::uint64_t hashOf(const scene::World& world) {
  Hash hash;
  for (const Vec3& position : world.body->skin.positions) hash.add(position);
  for (const auto& triangle : world.body->skin.triangles) {
    for (const Index vertex : triangle) hash.add(static_cast<std::uint64_t>(vertex));
  }
  for (const double stiffness : world.surface.stiffness_n_per_mm) hash.add(stiffness);
  return hash.value();
}

std::string noteOfAnotherWorld(const trace::RecordingWorld& recorded, std::uint32_t number, const scene::World& world) {
  if (hashOf(world) == recorded.hash) return {};
  const std::size_t triangles = world.body->skin.triangles.size();
  std::string why;
  if (triangles != recorded.triangles) {
    why = fmt::format(" ({} triangles instead of {})", triangles, recorded.triangles);
  } else if (world.scene.body.kind != scene::BodyKind::mesh) {
    why = "; the built-in bodies of palpate 0.2 had other last bits";
  }
  return fmt::format("world {} is not the recorded one: its body or its stiffness is another{}", number, why);
}

std::vector<FeltWith> feltWith(const servo::Rig& rig) {
  std::vector<FeltWith> fingers;
  for (const servo::FingerChain& finger : rig.fingers) {
    fingers.push_back({finger.contact_settings, finger.limiter_settings, finger.limiter.closes_loop});
  }
  return fingers;
}

trace::RecordingWorld recordingWorld(const scene::World& world, std::span<const FeltWith> fingers) {
  trace::RecordingWorld recorded;
  const std::filesystem::path folder = world.scene.file.empty() ? "." : world.scene.file.parent_path();
  std::error_code error;
  recorded.folder = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error).generic_string();
  scene::Scene scene = world.scene;
  // A finger that finds its own way has none in the file; where it went is in the samples.
  std::erase_if(scene.fingers, [](const scene::Finger& finger) { return finger.findsItsOwnWay(); });
  recorded.scene = scene::sceneAsToml(scene, pathOf(recorded.folder));
  recorded.body = world.body->name;
  recorded.triangles = world.body->skin.triangles.size();
  recorded.hash = hashOf(world);
  for (const FeltWith& finger : fingers) {
    recorded.fingers.push_back({asText(finger.contact), asText(finger.limiter, finger.closes_loop)});
  }
  return recorded;
}

namespace {

std::string words(const Vec3& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string asText(const device::Capabilities& able) {
  std::string text = fmt::format(
      "takes_force = {}\nmax_force_n = {}\ncontinuous_force_n = {}\nnominal_stiffness_n_per_mm = {}\nrate_hz = {}\n"
      "delay_ticks = {}\nmotion_scale = {}\nmodel = {}\nversion = {}\n",
      able.takes_force ? 1 : 0, able.max_force_n, able.continuous_force_n, able.nominal_stiffness_n_per_mm,
      able.rate_hz, able.delay_ticks, able.motion_scale, able.model, able.version);
  if (able.workspace_mm.isEmpty()) return text;
  return text +
         fmt::format("workspace_mm = {} to {}\n", words(able.workspace_mm.min()), words(able.workspace_mm.max()));
}

std::string asText(const device::DeviceFrame& frame) {
  return fmt::format("x_axis = {}\ny_axis = {}\nz_axis = {}\nscale = {}\norigin_mm = {}\n", words(frame.axes.col(0)),
                     words(frame.axes.col(1)), words(frame.axes.col(2)), frame.mm, words(frame.origin_mm));
}

}  // namespace

trace::RecordingFinger recordingFinger(std::string name, const device::Device& device,
                                       const device::DeviceFrame* frame) {
  return {std::move(name), device::describe(device), asText(device.capabilities),
          frame == nullptr ? std::string() : asText(*frame)};
}

trace::RecordingHeader recordingHeader(double ticks_per_s) {
  trace::RecordingHeader header;
  header.started_utc = trace::utcNow();
  header.software = "palpate " PALPATE_VERSION;
  header.ticks_per_s = ticks_per_s;
  header.machine = system::machineWords();
  return header;
}

}  // namespace palpate::engine
