// One table of names for each kind of settings, read in both directions.
#include "palpate/engine/recording_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/fields.h"
#include "palpate/base/hash.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/contact/finger_fields.h"
#include "palpate/device/back_ends.h"
#include "palpate/scene/scene_writer.h"

namespace palpate::engine {

namespace {

/// Recordings name the terms of relaxation in their own way.
constexpr auto kFingerFields = [] {
  auto fields = contact::kFingerFields;
  for (Field<contact::FingerSettings>& field : fields) {
    if (field.name == "relaxation_share") field.name = "relaxation";
    if (field.name == "relaxation_time_s") field.name = "relaxation_s";
    if (field.name == "relaxation_share_2") field.name = "relaxation_2";
    if (field.name == "relaxation_time_2_s") field.name = "relaxation_2_s";
  }
  return fields;
}();

using LimiterField = Field<RecordedLimiter>;
using Limits = servo::LimiterSettings;

template <auto Member>
constexpr LimiterField limit(std::string_view name) {
  return field<RecordedLimiter, &RecordedLimiter::settings, Member>(name);
}
template <auto Member>
constexpr LimiterField passivity(std::string_view name) {
  return field<RecordedLimiter, &RecordedLimiter::settings, &Limits::passivity, Member>(name);
}

constexpr std::array kLimiterFields = {
    field<RecordedLimiter, &RecordedLimiter::closes_loop>("closes_loop"),
    limit<&Limits::limited>("limited"),
    limit<&Limits::force_n>("force_n"),
    limit<&Limits::stiffness_factor>("stiffness_factor"),
    limit<&Limits::cap_n_per_mm>("cap_n_per_mm"),
    limit<&Limits::compared_n>("compared_n"),
    limit<&Limits::stiffness_n_per_mm>("stiffness_n_per_mm"),
    limit<&Limits::steepest>("steepest"),
    limit<&Limits::tick_s>("tick_s"),
    limit<&Limits::soft_contact>("soft_contact"),
    LimiterField{"start_ramps",
                 [](const RecordedLimiter& r) { return r.settings.start == scene::StartRule::ramp ? 1.0 : 0.0; },
                 [](RecordedLimiter& r, double read) {
                   r.settings.start = read != 0.0 ? scene::StartRule::ramp : scene::StartRule::outside;
                 }},
    limit<&Limits::ramp_s>("ramp_s"),
    limit<&Limits::max_age_ticks>("max_age_ticks"),
    limit<&Limits::max_jump_mm>("max_jump_mm"),
    limit<&Limits::max_tip_speed_mm_per_s>("max_tip_speed_mm_per_s"),
    limit<&Limits::max_force_rate_n_per_ms>("max_force_rate_n_per_ms"),
    passivity<&servo::PassivitySettings::on>("passivity"),
    passivity<&servo::PassivitySettings::delay_ticks>("passivity_delay_ticks"),
    passivity<&servo::PassivitySettings::damping_n_s_per_mm>("passivity_damping_n_s_per_mm"),
    passivity<&servo::PassivitySettings::friction_n>("passivity_friction_n"),
    passivity<&servo::PassivitySettings::mass_kg>("passivity_mass_kg"),
    passivity<&servo::PassivitySettings::encoder_mm>("passivity_encoder_mm"),
    passivity<&servo::PassivitySettings::most_n>("passivity_most_n"),
    // The solver's: recordings from before it stepped where a surface was exchanged in contact.
    field<RecordedLimiter, &RecordedLimiter::follows_exchange>("follows_exchange"),
    // Written only where it is true: earlier recordings have none.
    limit<&Limits::unsafe>("unsafe_stiffness"),
};

template <class Struct>
std::string asText(const Struct& from, std::span<const Field<Struct>> fields) {
  std::string text;
  for (const Field<Struct>& field : fields) text += fmt::format("{} = {}\n", field.name, field.get(from));
  return text;
}

template <class Struct>
Struct readFrom(const std::string& text, std::span<const Field<Struct>> fields) {
  Struct to;
  for (const std::string_view line : split(text, '\n')) {
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    const std::string_view name = trimmed(line.substr(0, equals));
    const auto value = equals == std::string_view::npos ? std::nullopt : parseNumber(line.substr(equals + 1));
    const auto known =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == name; });
    if (known == fields.end() || !value)
      throw Error(fmt::format("recorded settings: '{}' is not a known setting", line));
    known->set(to, *value);
  }
  return to;
}

}  // namespace

std::string asText(const contact::FingerSettings& settings) {
  return asText<contact::FingerSettings>(settings, kFingerFields);
}

std::string asText(const servo::LimiterSettings& settings, bool closes_loop) {
  const std::span<const LimiterField> fields = kLimiterFields;
  return asText<RecordedLimiter>({settings, closes_loop, true},
                                 settings.unsafe ? fields : fields.first(fields.size() - 1));
}

contact::FingerSettings contactSettingsFrom(const std::string& text) {
  return readFrom<contact::FingerSettings>(text, kFingerFields);
}

RecordedLimiter limiterFrom(const std::string& text) { return readFrom<RecordedLimiter>(text, kLimiterFields); }

std::string describeLimits(const servo::LimiterSettings& limits) {
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
      continue;  // another version; a replay refuses it
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
  for (const double stiffness : *world.surface.stiffness_n_per_mm) hash.add(stiffness);
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

std::vector<FingerSetup> feltWith(const servo::Rig& rig) {
  std::vector<FingerSetup> fingers;
  for (const servo::FingerChain& finger : rig.fingers) {
    fingers.push_back({finger.contact_settings, finger.limiter_settings, finger.limiter.closes_loop});
  }
  return fingers;
}

trace::RecordingWorld recordingWorld(const scene::World& world, std::span<const FingerSetup> fingers) {
  trace::RecordingWorld recorded;
  const std::filesystem::path folder = world.scene.file.empty() ? "." : world.scene.file.parent_path();
  std::error_code error;
  recorded.folder = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error).generic_string();
  recorded.scene = scene::sceneAsToml(world.scene, pathOf(recorded.folder));
  recorded.body = world.body->name;
  recorded.triangles = world.body->skin.triangles.size();
  recorded.hash = hashOf(world);
  for (const FingerSetup& finger : fingers) {
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
  header.machine = system::describeMachine();
  return header;
}

}  // namespace palpate::engine
