// Names of OpenXR's functions. The loader gives them out by xrGetInstanceProcAddr, those of extensions only so. Cold
// path.
#include "palpate/device/head/openxr_api.h"
#include "palpate/base/system/process.h"

namespace palpate::device::openxr {

namespace {

template <class Pointer>
void askFor(const Api& api, Handle instance, const char* name, Pointer& pointer, std::vector<std::string>& missing) {
  Function function = nullptr;
  if (api.get_function(instance, name, &function) != kSuccess || function == nullptr) {
    missing.emplace_back(name);
    return;
  }
  pointer = reinterpret_cast<Pointer>(function);
}

}  // namespace

std::vector<std::string> libraryNames(const std::string& file) {
  if (system::kIsWindows) return namesToTry(file, kLibraryVariable, {"openxr_loader.dll"});
  return namesToTry(file, kLibraryVariable, {"libopenxr_loader.so.1", "libopenxr_loader.so"});
}

std::vector<std::string> resolveLoader(const SharedLibrary& library, Api& api) {
  std::vector<std::string> missing;
  resolveNeeded(library, "xrGetInstanceProcAddr", api.get_function, missing);
  if (!missing.empty()) return missing;
  askFor(api, kNoHandle, "xrEnumerateInstanceExtensionProperties", api.enumerate_extensions, missing);
  askFor(api, kNoHandle, "xrCreateInstance", api.create_instance, missing);
  return missing;
}

std::vector<std::string> resolveInstance(Handle instance, Api& api) {
  std::vector<std::string> missing;
  askFor(api, instance, "xrDestroyInstance", api.destroy_instance, missing);
  askFor(api, instance, "xrGetSystem", api.get_system, missing);
  askFor(api, instance, "xrCreateSession", api.create_session, missing);
  askFor(api, instance, "xrBeginSession", api.begin_session, missing);
  askFor(api, instance, "xrEndSession", api.end_session, missing);
  askFor(api, instance, "xrCreateReferenceSpace", api.create_reference_space, missing);
  askFor(api, instance, "xrLocateSpace", api.locate_space, missing);
  askFor(api, instance, "xrPollEvent", api.poll_event, missing);
  askFor(api, instance, kClockFunction, api.convert_time, missing);
  return missing;
}

}  // namespace palpate::device::openxr
