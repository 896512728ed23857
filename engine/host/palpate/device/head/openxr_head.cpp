// Loader -> runtime -> instance -> session -> two spaces; then events and a place at every picture. The frame loop of
// OpenXR (xrWaitFrame and what follows it) is left out: a headless session has no pictures, and waiting is forbidden
// here.
#include "palpate/device/head/openxr_head.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <string_view>
#include <type_traits>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/device/hardware/library_report.h"
#include "palpate/device/head/head_stream.h"
#include "palpate/device/head/openxr_api.h"

namespace palpate::device {

namespace {

constexpr double kMmInM = 1000.0;
constexpr std::array kExtensions = {openxr::kHeadlessExtension, openxr::kClockExtension};

/// A runtime sends a handful in its whole life; a flood must not keep a picture from being drawn.
constexpr int kMaxEvents = 64;

Error headsetError(const std::string& cause) { return Error("head tracker openxr: " + cause); }

void requireSuccess(openxr::Result result, const char* call) {
  if (result < 0) throw headsetError(fmt::format("{} failed: result {}", call, static_cast<int>(result)));
}

void requireNone(const std::vector<std::string>& missing, const char* who) {
  if (!missing.empty()) throw headsetError(fmt::format("{} lacks {}", who, fmt::join(missing, ", ")));
}

openxr::Api loadedApi(const std::string& file) {
  openxr::Api api;
  std::vector<std::string> missing;
  const SharedLibrary library = openLibrary(openxr::libraryNames(file));
  if (library) missing = openxr::resolveLoader(library, api);
  const LibraryRemedies remedies{.variable = openxr::kLibraryVariable,
                                 .install = "install Debian's package libopenxr-loader1",
                                 .dependencies = {}};
  Probe probe;
  reportLibrary({"the OpenXR loader", library, missing, remedies}, probe);
  if (!probe.reason.empty()) throw headsetError(fmt::format("{}; {}", probe.reason, probe.remedy));
  return api;
}

/// The loader answers for the runtime, which it loads for this question.
void requireExtensions(const openxr::Api& api) {
  std::uint32_t count = 0;
  openxr::Result result = api.enumerate_extensions(nullptr, 0, &count, nullptr);
  std::vector<openxr::ExtensionProperties> offered(count);
  if (result >= 0 && count > 0) result = api.enumerate_extensions(nullptr, count, &count, offered.data());
  if (result < 0) {
    throw headsetError(
        fmt::format("no OpenXR runtime is active (result {}); install one, e.g. Monado, or set "
                    "XR_RUNTIME_JSON=/path/to/openxr_monado.json",
                    static_cast<int>(result)));
  }
  offered.resize(std::min<std::size_t>(count, offered.size()));
  for (const char* wanted : kExtensions) {
    const bool found = std::any_of(offered.begin(), offered.end(), [wanted](const auto& extension) {
      return std::strncmp(extension.name.data(), wanted, extension.name.size()) == 0;
    });
    if (found) continue;
    throw headsetError(fmt::format(
        "the active OpenXR runtime lacks {}, needed to track a head without drawing to the headset; Monado has it",
        wanted));
  }
}

openxr::Handle madeInstance(const openxr::Api& api) {
  openxr::InstanceCreateInfo info;
  constexpr std::string_view kProgram = "palpate";
  std::copy(kProgram.begin(), kProgram.end(), info.application_name.begin());
  info.extension_count = static_cast<std::uint32_t>(kExtensions.size());
  info.extensions = kExtensions.data();
  openxr::Handle instance = openxr::kNoHandle;
  const openxr::Result result = api.create_instance(&info, &instance);
  // The loader's answers for a runtime whose service it does not reach.
  if (result == openxr::kRuntimeFailure || result == openxr::kRuntimeUnavailable ||
      result == openxr::kInitializationFailed || result == openxr::kInstanceLost) {
    throw headsetError(fmt::format(
        "the active OpenXR runtime does not start (result {}); start its service first, e.g. monado-service",
        static_cast<int>(result)));
  }
  requireSuccess(result, "xrCreateInstance");
  return instance;
}

openxr::SystemId headset(const openxr::Api& api, openxr::Handle instance) {
  const openxr::SystemGetInfo info;
  openxr::SystemId system = 0;
  const openxr::Result result = api.get_system(instance, &info, &system);
  if (result == openxr::kFormFactorUnavailable || result == openxr::kFormFactorUnsupported) {
    throw headsetError("the OpenXR runtime finds no headset; connect one and switch it on");
  }
  requireSuccess(result, "xrGetSystem");
  return system;
}

openxr::Handle madeSpace(const openxr::Api& api, openxr::Handle session, openxr::ReferenceSpace kind) {
  openxr::ReferenceSpaceCreateInfo info;
  info.kind = kind;
  openxr::Handle space = openxr::kNoHandle;
  requireSuccess(api.create_reference_space(session, &info, &space), "xrCreateReferenceSpace");
  return space;
}

template <class Event>
Event toEvent(const openxr::EventDataBuffer& buffer) noexcept {
  static_assert(std::is_trivially_copyable_v<Event> && sizeof(Event) <= sizeof(buffer));
  Event event;
  std::memcpy(static_cast<void*>(&event), &buffer, sizeof(event));
  return event;
}

}  // namespace

struct OpenXrHead::Impl {
  openxr::Api api;
  openxr::Handle instance = openxr::kNoHandle;
  openxr::Handle session = openxr::kNoHandle;
  openxr::Handle local = openxr::kNoHandle;
  openxr::Handle view = openxr::kNoHandle;
  bool running = false;
  bool lost = false;  ///< for good
  std::optional<Vec3> centre_mm;
  std::optional<openxr::Time> centred_at;  ///< by the user, from then on

  Impl() = default;
  ~Impl() {
    if (api.destroy_instance != nullptr) api.destroy_instance(instance);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void follow(openxr::SessionState state) noexcept {
    switch (state) {
      case openxr::kReady: {
        const openxr::SessionBeginInfo info;
        running = api.begin_session(session, &info) >= 0;
        break;
      }
      case openxr::kStopping:
        api.end_session(session);
        running = false;
        break;
      case openxr::kLossPending:
      case openxr::kExiting:
        lost = true;
        break;
      default:
        break;
    }
  }

  void pollEvents() noexcept {
    for (int i = 0; i < kMaxEvents && !lost; ++i) {
      openxr::EventDataBuffer buffer;
      const openxr::Result result = api.poll_event(instance, &buffer);
      if (result == openxr::kInstanceLost) lost = true;
      if (result != openxr::kSuccess) return;
      if (buffer.type == openxr::kSessionStateChangedType) {
        follow(toEvent<openxr::SessionStateChanged>(buffer).state);
      } else if (buffer.type == openxr::kReferenceSpaceChangePendingType) {
        const auto change = toEvent<openxr::ReferenceSpaceChangePending>(buffer);
        if (change.kind == openxr::kLocalSpace) centred_at = change.time;
      } else if (buffer.type == openxr::kInstanceLossPendingType) {
        lost = true;
      }
    }
  }

  std::optional<openxr::Time> now() const noexcept {
    system::RawClock clock{};
    openxr::Time time = 0;
    if (!system::readRawClock(clock)) return std::nullopt;
    if (api.convert_time(instance, &clock, &time) != openxr::kSuccess) return std::nullopt;
    return time;
  }

  /// In LOCAL, mm.
  std::optional<Vec3> placeAt(openxr::Time time) noexcept {
    openxr::SpaceLocation location;
    const openxr::Result result = api.locate_space(view, local, time, &location);
    if (result == openxr::kSessionLost || result == openxr::kInstanceLost) lost = true;
    if (result != openxr::kSuccess || (location.flags & openxr::kPositionValid) == 0) return std::nullopt;
    const auto& [x, y, z] = location.pose.place;
    const Vec3 place = kMmInM * Vec3(x, y, z);
    if (!place.allFinite()) return std::nullopt;
    return place;
  }
};

OpenXrHead::OpenXrHead(const std::string& loader) : impl_(std::make_unique<Impl>()) {
  openxr::Api& api = impl_->api;
  api = loadedApi(loader);
  requireExtensions(api);
  impl_->instance = madeInstance(api);
  requireNone(openxr::resolveInstance(impl_->instance, api), "the active OpenXR runtime");
  openxr::SessionCreateInfo info;
  info.system = headset(api, impl_->instance);
  requireSuccess(api.create_session(impl_->instance, &info, &impl_->session), "xrCreateSession");
  impl_->local = madeSpace(api, impl_->session, openxr::kLocalSpace);
  impl_->view = madeSpace(api, impl_->session, openxr::kViewSpace);
}

OpenXrHead::~OpenXrHead() = default;

std::optional<Vec3> OpenXrHead::newest() noexcept {
  if (impl_->lost) return std::nullopt;
  impl_->pollEvents();
  if (!impl_->running || impl_->lost) return std::nullopt;
  const std::optional<openxr::Time> now = impl_->now();
  if (!now) return std::nullopt;
  const std::optional<Vec3> place = impl_->placeAt(*now);
  if (!place) return std::nullopt;
  if (impl_->centred_at && *now >= *impl_->centred_at) {
    impl_->centre_mm.reset();
    impl_->centred_at.reset();
  }
  if (!impl_->centre_mm) impl_->centre_mm = place;
  const Vec3 from_centre = *place - *impl_->centre_mm;
  if (!(from_centre.norm() <= kFarthestHeadMm)) return std::nullopt;
  return from_centre;
}

}  // namespace palpate::device
