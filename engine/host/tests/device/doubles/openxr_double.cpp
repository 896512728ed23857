// A double of OpenXR's loader with a runtime behind it that sees one headset. Headless: it has no frame loop at all. It
// holds its caller to the order and the arguments that the specification wants, and counts what breaks them.
#include <cstring>
#include <ctime>

#include "host/tests/device/doubles/openxr_control.h"
#include "palpate/device/head/openxr_api.h"

namespace xr = palpate::device::openxr;
using palpate::doubles::OpenXrControl;

namespace {

constexpr xr::Handle kInstance = 0x1100000001;
constexpr xr::Handle kSession = 0x2200000002;
constexpr xr::Handle kView = 0x3300000003;
constexpr xr::Handle kLocal = 0x4400000004;
constexpr xr::SystemId kSystem = 0x5500000005;
/// A runtime's clock need not begin where the machine's does.
constexpr xr::Time kClockOffset = 1'000'000'000'000;

OpenXrControl& control() {
  static OpenXrControl only;
  return only;
}

struct State {
  bool session = false;
  bool ready_said = false;
  bool ready = false;
  bool running = false;
  bool stopping = false;
};
State& state() {
  static State only;
  return only;
}

/// What is asserted of a caller; false, and counted, where it does not hold.
bool held(bool is_so, const char* what) {
  if (is_so) return true;
  ++control().breaches;
  control().last_breach = what;
  return false;
}

xr::Time toXrTime(const std::timespec& clock) {
  return kClockOffset + static_cast<xr::Time>(clock.tv_sec) * 1'000'000'000 + clock.tv_nsec;
}
xr::Time timeNow() {
  std::timespec clock{};
  ::clock_gettime(CLOCK_MONOTONIC, &clock);
  return toXrTime(clock);
}

template <class Structure>
bool isWhole(const Structure* given, xr::StructureType type) {
  return held(given != nullptr && given->type == type && given->next == nullptr, "type or next of a structure");
}

xr::Result enumerateExtensions(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                               xr::ExtensionProperties* extensions) {
  if (!control().runtime) return xr::kRuntimeUnavailable;
  if (!held(layer == nullptr && count != nullptr, "arguments of xrEnumerate...")) return xr::kValidationFailure;
  const char* names[] = {"XR_EXT_hand_tracking", control().headless ? "XR_MND_headless" : "XR_KHR_opengl_enable",
                         control().timespec ? "XR_KHR_convert_timespec_time" : "XR_EXT_debug_utils"};
  *count = 3;
  if (capacity == 0) return xr::kSuccess;
  if (capacity < 3) return xr::kSizeInsufficient;
  for (int i = 0; i < 3; ++i) {
    if (!isWhole(&extensions[i], static_cast<xr::StructureType>(2))) return xr::kValidationFailure;
    std::strncpy(extensions[i].name.data(), names[i], extensions[i].name.size() - 1);
    extensions[i].version = 1;
  }
  return xr::kSuccess;
}

xr::Result createInstance(const xr::InstanceCreateInfo* info, xr::Handle* instance) {
  if (!control().runtime) return xr::kRuntimeUnavailable;
  if (!control().starts) return xr::kRuntimeFailure;
  if (!isWhole(info, static_cast<xr::StructureType>(3))) return xr::kValidationFailure;
  held(info->application_name[0] != '\0', "a program without a name");
  held(info->api_version >> 48 == 1, "version of the interface");
  bool headless = false;
  bool timespec = false;
  for (std::uint32_t i = 0; i < info->extension_count; ++i) {
    headless |= std::strcmp(info->extensions[i], "XR_MND_headless") == 0;
    timespec |= std::strcmp(info->extensions[i], "XR_KHR_convert_timespec_time") == 0;
  }
  held(headless && timespec, "an extension that is used is switched on");
  if ((headless && !control().headless) || (timespec && !control().timespec)) return xr::kExtensionNotPresent;
  state() = {};
  ++control().instances;
  *instance = kInstance;
  return xr::kSuccess;
}

xr::Result destroyInstance(xr::Handle instance) {
  held(instance == kInstance && control().instances > 0, "an instance that lives is destroyed");
  --control().instances;
  return xr::kSuccess;
}

xr::Result getSystem(xr::Handle instance, const xr::SystemGetInfo* info, xr::SystemId* system) {
  if (!isWhole(info, static_cast<xr::StructureType>(4))) return xr::kValidationFailure;
  held(instance == kInstance && info->form_factor == 1, "arguments of xrGetSystem");
  if (!control().headset) return xr::kFormFactorUnavailable;
  *system = kSystem;
  return xr::kSuccess;
}

xr::Result createSession(xr::Handle instance, const xr::SessionCreateInfo* info, xr::Handle* session) {
  if (!isWhole(info, static_cast<xr::StructureType>(8))) return xr::kValidationFailure;
  held(instance == kInstance && info->system == kSystem && !state().session, "arguments of xrCreateSession");
  state().session = true;
  *session = kSession;
  return xr::kSuccess;
}

xr::Result beginSession(xr::Handle session, const xr::SessionBeginInfo* info) {
  if (!isWhole(info, static_cast<xr::StructureType>(10))) return xr::kValidationFailure;
  held(session == kSession && state().ready && !state().running, "a session that is ready begins");
  state().ready = false;
  state().running = true;
  ++control().begun;
  return xr::kSuccess;
}

xr::Result endSession(xr::Handle session) {
  held(session == kSession && state().running && state().stopping, "a session that is stopping ends");
  state().running = state().stopping = false;
  ++control().ended;
  return xr::kSuccess;
}

xr::Result createReferenceSpace(xr::Handle session, const xr::ReferenceSpaceCreateInfo* info, xr::Handle* space) {
  if (!isWhole(info, static_cast<xr::StructureType>(37))) return xr::kValidationFailure;
  held(session == kSession && (info->kind == 1 || info->kind == 2), "arguments of xrCreateReferenceSpace");
  held(info->pose.turn[3] == 1.0f, "a turn has the length 1");
  *space = info->kind == 1 ? kView : kLocal;
  return xr::kSuccess;
}

xr::Result locateSpace(xr::Handle space, xr::Handle base, xr::Time time, xr::SpaceLocation* location) {
  if (!isWhole(location, static_cast<xr::StructureType>(42))) return xr::kValidationFailure;
  held(space == kView && base == kLocal && state().running, "VIEW is located in LOCAL while the session runs");
  const xr::Time now = timeNow();
  held(time <= now && time > now - 1'000'000'000, "a place is asked for now");
  ++control().located;
  location->flags = control().flags;
  location->pose.turn = {0.0f, 0.6f, 0.0f, 0.8f};
  location->pose.place = control().place_m;  // also where it fails: then nobody may look at it
  return static_cast<xr::Result>(control().locating);
}

template <class Event>
xr::Result say(xr::EventDataBuffer* buffer, const Event& event) {
  std::memcpy(static_cast<void*>(buffer), &event, sizeof(event));
  return xr::kSuccess;
}

xr::Result sayState(xr::EventDataBuffer* buffer, xr::SessionState said) {
  state().ready = said == 2;
  state().stopping = said == 6;
  xr::SessionStateChanged event;
  event.session = kSession;
  event.state = said;
  event.time = timeNow();
  return say(buffer, event);
}

xr::Result pollEvent(xr::Handle instance, xr::EventDataBuffer* buffer) {
  held(instance == kInstance, "events of an instance that lives");
  if (!isWhole(buffer, static_cast<xr::StructureType>(16))) return xr::kValidationFailure;
  OpenXrControl& told = control();
  ++told.questions;
  if (told.instance_lost) {
    told.instance_lost = false;
    xr::EventDataBuffer event;
    event.type = static_cast<xr::StructureType>(17);
    return say(buffer, event);
  }
  if (!state().ready_said && told.questions_before_ready-- <= 0) {
    state().ready_said = true;
    return sayState(buffer, static_cast<xr::SessionState>(2));
  }
  if (told.next_state != 0) {
    const auto said = static_cast<xr::SessionState>(told.next_state);
    told.next_state = 0;
    return sayState(buffer, said);
  }
  if (told.centred_in_ns >= 0) {
    xr::ReferenceSpaceChangePending event;
    event.session = kSession;
    event.kind = static_cast<xr::ReferenceSpace>(2);
    event.time = timeNow() + told.centred_in_ns;
    told.centred_in_ns = -1;
    return say(buffer, event);
  }
  return xr::kEventUnavailable;
}

xr::Result convertTime(xr::Handle instance, const std::timespec* clock, xr::Time* time) {
  held(instance == kInstance && clock != nullptr && time != nullptr, "arguments of xrConvertTimespecTimeToTimeKHR");
  *time = toXrTime(*clock);
  return xr::kSuccess;
}

struct Named {
  const char* name;
  xr::Function function;
  bool without_instance;
};

template <class Pointer>
Named named(const char* name, Pointer function, bool without_instance = false) {
  return {name, reinterpret_cast<xr::Function>(function), without_instance};
}

}  // namespace

extern "C" {

OpenXrControl* palpateOpenXrDouble() { return &control(); }

xr::Result xrGetInstanceProcAddr(xr::Handle instance, const char* name, xr::Function* function) {
  static const Named all[] = {
      named("xrEnumerateInstanceExtensionProperties", enumerateExtensions, true),
      named("xrCreateInstance", createInstance, true),
      named("xrDestroyInstance", destroyInstance),
      named("xrGetSystem", getSystem),
      named("xrCreateSession", createSession),
      named("xrBeginSession", beginSession),
      named("xrEndSession", endSession),
      named("xrCreateReferenceSpace", createReferenceSpace),
      named("xrLocateSpace", locateSpace),
      named("xrPollEvent", pollEvent),
      named("xrConvertTimespecTimeToTimeKHR", convertTime),
  };
  *function = nullptr;
  for (const Named& each : all) {
    if (std::strcmp(each.name, name) != 0) continue;
    if (!held(instance == (each.without_instance ? 0 : kInstance), "whose function is asked for")) break;
    *function = each.function;
    return xr::kSuccess;
  }
  return xr::kFunctionUnsupported;
}

}  // extern "C"
