// The Multimedia Class Scheduler (avrt.dll, looked for at run time) for the priority, a high-resolution timer (Windows
// 10 1803 and later; else the system's tick at 1 ms) for the sleep. One timer a thread, made at its first sleep.
#include <windows.h>
// After windows.h.
#include <timeapi.h>

#include <cstring>

#include "palpate/base/stopwatch.h"
#include "palpate/base/system/thread.h"

namespace palpate::system {

namespace {

constexpr std::int64_t kNsOfTimer = 100;  // its unit
constexpr DWORD kHighResolution = 0x2;    // CREATE_WAITABLE_TIMER_HIGH_RESOLUTION, newer than some headers

class Timer {
 public:
  Timer() : handle_(::CreateWaitableTimerExW(nullptr, nullptr, kHighResolution, TIMER_ALL_ACCESS)) {
    exact_ = handle_ != nullptr;
    if (!exact_) handle_ = ::CreateWaitableTimerExW(nullptr, nullptr, 0, TIMER_ALL_ACCESS);
  }
  ~Timer() { ::CloseHandle(handle_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  bool isExact() const { return exact_; }

  void sleep(std::int64_t ns) const noexcept {
    LARGE_INTEGER from_now;
    from_now.QuadPart = -(ns / kNsOfTimer);
    if (::SetWaitableTimer(handle_, &from_now, 0, nullptr, nullptr, FALSE) != 0) {
      ::WaitForSingleObject(handle_, INFINITE);
    } else {
      ::Sleep(0);
    }
  }

 private:
  HANDLE handle_;
  bool exact_ = false;
};

/// A thread's own object, made on first use, gone with the thread. Not thread_local: mingw-w64 frees the memory of
/// those before their destructors use it.
template <class Kind>
class OfThread {
 public:
  OfThread() : slot_(::FlsAlloc(remove)) {}
  ~OfThread() { ::FlsFree(slot_); }
  OfThread(const OfThread&) = delete;
  OfThread& operator=(const OfThread&) = delete;

  Kind& get() const {
    auto* object = static_cast<Kind*>(::FlsGetValue(slot_));
    if (object != nullptr) return *object;
    object = new Kind;
    ::FlsSetValue(slot_, object);
    return *object;
  }

 private:
  static void WINAPI remove(void* object) { delete static_cast<Kind*>(object); }

  DWORD slot_;
};

const Timer& timerOfThread() {
  static const OfThread<Timer> timer;
  return timer.get();
}

/// Ends with the thread.
class ProAudio {
 public:
  ProAudio() {
    HMODULE avrt = ::LoadLibraryExW(L"avrt.dll", nullptr, LOAD_LIBRARY_SEARCH_SYSTEM32);
    if (avrt == nullptr) return;
    const auto join = reinterpret_cast<HANDLE(WINAPI*)(const wchar_t*, DWORD*)>(
        reinterpret_cast<void*>(::GetProcAddress(avrt, "AvSetMmThreadCharacteristicsW")));
    leave_ = reinterpret_cast<BOOL(WINAPI*)(HANDLE)>(
        reinterpret_cast<void*>(::GetProcAddress(avrt, "AvRevertMmThreadCharacteristics")));
    DWORD task = 0;
    if (join != nullptr && leave_ != nullptr) task_ = join(L"Pro Audio", &task);
  }
  ~ProAudio() {
    if (task_ != nullptr) leave_(task_);
  }
  ProAudio(const ProAudio&) = delete;
  ProAudio& operator=(const ProAudio&) = delete;
  bool granted() const { return task_ != nullptr; }

 private:
  BOOL(WINAPI* leave_)(HANDLE) = nullptr;
  HANDLE task_ = nullptr;
};

bool askForProAudio() {
  static const OfThread<ProAudio> task;
  return task.get().granted();
}

}  // namespace

ThreadGrant askForRealtime(int) {
  ThreadGrant grant;
  grant.exact_timers = timerOfThread().isExact();
  if (!grant.exact_timers) {
    ::timeBeginPeriod(1);
    grant.note = "high-resolution timer refused";
  }
  grant.realtime = askForProAudio();
  if (!grant.realtime) grant.note += grant.note.empty() ? "MMCSS refused" : "; MMCSS refused";
  return grant;
}

void askForRealtimePriority(int) { (void)askForProAudio(); }

void releaseMemory() {}

void sleepUntil(std::int64_t ns) noexcept {
  for (std::int64_t left = ns - monotonicNs(); left > 0; left = ns - monotonicNs()) {
    if (left < kNsOfTimer) return;
    timerOfThread().sleep(left);
  }
}

void lowerPriority(int) { ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_BELOW_NORMAL); }

}  // namespace palpate::system
