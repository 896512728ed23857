// One lock, one condition for the helpers and one for the caller; parts are taken from a counter. The threads that a
// fork did not copy are known by the process that made them, and their lock is left alone: it may be held for ever.
#include "thread_pool.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace palpate::python {

class ThreadPool::Impl {
 public:
  explicit Impl(std::size_t helpers) {
    try {
      for (std::size_t i = 0; i < helpers; ++i) threads_.emplace_back([this] { run(); });
    } catch (const std::system_error&) {  // no thread is left: those that are there do it
    }
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool belongsToThisProcess() const { return process_ == getpid(); }

  void share(std::size_t parts, const Part& work, Interrupts& interrupts) {
    const Pause pause(interrupts, stop_);
    {
      const std::lock_guard lock(mutex_);
      parts_ = parts;
      next_ = 0;
      stop_ = false;
      work_ = &work;
      pause_ = &pause;
      at_work_ = threads_.size();
      ++job_;
    }
    wake_.notify_all();
    doParts();
    waitForAll(interrupts);
    if (stop_) throw Interrupted();
  }

 private:
  /// The caller checks for Ctrl-C while others work.
  void waitForAll(Interrupts& interrupts) {
    std::unique_lock lock(mutex_);
    while (!done_.wait_for(lock, std::chrono::milliseconds(5), [this] { return at_work_ == 0; })) {
      lock.unlock();
      try {
        if (!stop_) interrupts.check();
      } catch (const Interrupted&) {
        stop_ = true;
      }
      lock.lock();
    }
  }

  void doParts() {
    try {
      for (std::size_t part = next_++; part < parts_; part = next_++) (*work_)(part, *pause_);
    } catch (const Interrupted&) {
      stop_ = true;
    }
  }

  void run() {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [&] { return quit_ || job_ != seen; });
      if (quit_) return;
      seen = job_;
      lock.unlock();
      doParts();
      lock.lock();
      if (--at_work_ == 0) done_.notify_one();
    }
  }

  const pid_t process_ = getpid();
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::uint64_t job_ = 0;
  std::size_t at_work_ = 0;  ///< helpers that have not finished this job
  bool quit_ = false;
  std::atomic<bool> stop_{false};
  std::atomic<std::size_t> next_{0};
  std::size_t parts_ = 0;
  const Part* work_ = nullptr;
  const Pause* pause_ = nullptr;
  std::vector<std::thread> threads_;
};

ThreadPool::ThreadPool(std::size_t threads) : threads_(threads) {}

ThreadPool::~ThreadPool() { close(); }

void ThreadPool::share(std::size_t parts, const Part& work, Interrupts& interrupts) {
  if (threads_ <= 1 || parts <= 1) {
    const std::atomic<bool> never{false};
    const Pause pause(interrupts, never);
    for (std::size_t part = 0; part < parts; ++part) work(part, pause);
    return;
  }
  if (impl_ && !impl_->belongsToThisProcess()) (void)impl_.release();  // the parent's: nothing of it may be touched
  if (!impl_) impl_ = std::make_unique<Impl>(threads_ - 1);
  impl_->share(parts, work, interrupts);
}

void ThreadPool::close() noexcept {
  if (impl_ && !impl_->belongsToThisProcess()) (void)impl_.release();
  impl_.reset();
}

}  // namespace palpate::python
