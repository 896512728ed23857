// The used part of OpenXR 1.0, in declarations of our own: its loader is opened at run time, no SDK is needed to build.
// Layouts and numbers: the specification; widths are held to those of 64 bits. Metres, nanoseconds; x right, y up, z
// backward.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "palpate/base/system/clock.h"
#include "palpate/device/hardware/shared_library.h"

namespace palpate::device::openxr {

/// Instances, sessions and spaces; 64 bits everywhere, pointers where those are as wide.
using Handle = std::uint64_t;
inline constexpr Handle kNoHandle = 0;
using SystemId = std::uint64_t;
using Time = std::int64_t;

/// Below zero an error, above it a remark. Runtimes may give other numbers than these.
enum Result : std::int32_t {
  kSuccess = 0,
  kEventUnavailable = 4,
  kValidationFailure = -1,
  kRuntimeFailure = -2,
  kInitializationFailed = -6,
  kFunctionUnsupported = -7,
  kExtensionNotPresent = -9,
  kSizeInsufficient = -11,
  kInstanceLost = -13,
  kSessionLost = -17,
  kFormFactorUnsupported = -34,
  kFormFactorUnavailable = -35,
  kRuntimeUnavailable = -51,
};

/// The first word of every structure; behind it a pointer to more, null here.
enum StructureType : std::int32_t {
  kExtensionPropertiesType = 2,
  kInstanceCreateInfoType = 3,
  kSystemGetInfoType = 4,
  kSessionCreateInfoType = 8,
  kSessionBeginInfoType = 10,
  kEventDataBufferType = 16,
  kInstanceLossPendingType = 17,
  kSessionStateChangedType = 18,
  kReferenceSpaceCreateInfoType = 37,
  kReferenceSpaceChangePendingType = 40,
  kSpaceLocationType = 42,
};

enum SessionState : std::int32_t {
  kIdle = 1,
  kReady = 2,
  kSynchronized = 3,
  kVisible = 4,
  kFocused = 5,
  kStopping = 6,
  kLossPending = 7,
  kExiting = 8,
};

enum FormFactor : std::int32_t { kHeadMountedDisplay = 1 };
enum ViewConfiguration : std::int32_t { kPrimaryStereo = 2 };
enum ReferenceSpace : std::int32_t { kViewSpace = 1, kLocalSpace = 2 };
inline constexpr std::uint64_t kPositionValid = 2;  ///< a bit of SpaceLocation::flags

inline constexpr const char* kHeadlessExtension = "XR_MND_headless";
#ifdef _WIN32
inline constexpr const char* kClockExtension = "XR_KHR_win32_convert_performance_counter_time";
inline constexpr const char* kClockFunction = "xrConvertWin32PerformanceCounterToTimeKHR";
#else
inline constexpr const char* kClockExtension = "XR_KHR_convert_timespec_time";
inline constexpr const char* kClockFunction = "xrConvertTimespecTimeToTimeKHR";
#endif

/// 1.0: major in the upper 16 bits.
inline constexpr std::uint64_t kApiVersion = std::uint64_t{1} << 48;

inline constexpr std::size_t kNameLength = 128;
using Name = std::array<char, kNameLength>;  ///< ends with a zero

struct ExtensionProperties {
  StructureType type = kExtensionPropertiesType;
  void* next = nullptr;
  Name name{};
  std::uint32_t version = 0;
};

struct InstanceCreateInfo {
  StructureType type = kInstanceCreateInfoType;
  const void* next = nullptr;
  std::uint64_t flags = 0;
  Name application_name{};
  std::uint32_t application_version = 0;
  Name engine_name{};
  std::uint32_t engine_version = 0;
  std::uint64_t api_version = kApiVersion;
  std::uint32_t layer_count = 0;
  const char* const* layers = nullptr;
  std::uint32_t extension_count = 0;
  const char* const* extensions = nullptr;
};

struct SystemGetInfo {
  StructureType type = kSystemGetInfoType;
  const void* next = nullptr;
  FormFactor form_factor = kHeadMountedDisplay;
};

/// Without a graphics binding behind `next`: a headless session.
struct SessionCreateInfo {
  StructureType type = kSessionCreateInfoType;
  const void* next = nullptr;
  std::uint64_t flags = 0;
  SystemId system = 0;
};

struct SessionBeginInfo {
  StructureType type = kSessionBeginInfoType;
  const void* next = nullptr;
  ViewConfiguration views = kPrimaryStereo;
};

struct Pose {
  std::array<float, 4> turn = {0.0f, 0.0f, 0.0f, 1.0f};  ///< x, y, z, w
  std::array<float, 3> place{};                          ///< m
};

struct ReferenceSpaceCreateInfo {
  StructureType type = kReferenceSpaceCreateInfoType;
  const void* next = nullptr;
  ReferenceSpace kind = kLocalSpace;
  Pose pose;
};

struct SpaceLocation {
  StructureType type = kSpaceLocationType;
  void* next = nullptr;
  std::uint64_t flags = 0;
  Pose pose;
};

/// Room for any event; its type says which of the structures below it is.
struct EventDataBuffer {
  StructureType type = kEventDataBufferType;
  const void* next = nullptr;
  std::array<unsigned char, 4000> rest{};
};

struct SessionStateChanged {
  StructureType type = kSessionStateChangedType;
  const void* next = nullptr;
  Handle session = kNoHandle;
  SessionState state = kIdle;
  Time time = 0;
};

/// A user centres a space again: from `time` on its origin is elsewhere.
struct ReferenceSpaceChangePending {
  StructureType type = kReferenceSpaceChangePendingType;
  const void* next = nullptr;
  Handle session = kNoHandle;
  ReferenceSpace kind = kLocalSpace;
  Time time = 0;
  std::uint32_t pose_valid = 0;
  Pose pose_in_previous;
};

/// Sizes as the specification's C has them, where a pointer has 64 bits.
template <class Structure>
constexpr bool hasSize(std::size_t bytes) {
  return sizeof(void*) != 8 || sizeof(Structure) == bytes;
}
static_assert(hasSize<ExtensionProperties>(152) && hasSize<InstanceCreateInfo>(328) && hasSize<SystemGetInfo>(24));
static_assert(hasSize<SessionCreateInfo>(32) && hasSize<SessionBeginInfo>(24) && hasSize<Pose>(28));
static_assert(hasSize<ReferenceSpaceCreateInfo>(48) && hasSize<SpaceLocation>(56) && hasSize<EventDataBuffer>(4016));
static_assert(hasSize<SessionStateChanged>(40) && hasSize<ReferenceSpaceChangePending>(72));

using Function = void (*)();

struct Api {
  Result (*get_function)(Handle instance, const char* name, Function* function) = nullptr;
  // Without an instance.
  Result (*enumerate_extensions)(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                                 ExtensionProperties* extensions) = nullptr;
  Result (*create_instance)(const InstanceCreateInfo* info, Handle* instance) = nullptr;
  // With an instance.
  Result (*destroy_instance)(Handle instance) = nullptr;  ///< with all that was made in it
  Result (*get_system)(Handle instance, const SystemGetInfo* info, SystemId* system) = nullptr;
  Result (*create_session)(Handle instance, const SessionCreateInfo* info, Handle* session) = nullptr;
  Result (*begin_session)(Handle session, const SessionBeginInfo* info) = nullptr;
  Result (*end_session)(Handle session) = nullptr;
  Result (*create_reference_space)(Handle session, const ReferenceSpaceCreateInfo* info, Handle* space) = nullptr;
  Result (*locate_space)(Handle space, Handle base, Time time, SpaceLocation* location) = nullptr;
  Result (*poll_event)(Handle instance, EventDataBuffer* event) = nullptr;
  Result (*convert_time)(Handle instance, const system::RawClock* clock, Time* time) = nullptr;
};

/// The environment variable that names the loader's file.
inline constexpr const char* kLibraryVariable = "PALPATE_OPENXR_LOADER";

/// The names that are tried, in order; only `file` where it is not empty.
std::vector<std::string> libraryNames(const std::string& file);

/// Fill in the functions without an instance, and those of an instance; return the names of functions that are missing.
std::vector<std::string> resolveLoader(const SharedLibrary& library, Api& api);
std::vector<std::string> resolveInstance(Handle instance, Api& api);

}  // namespace palpate::device::openxr
