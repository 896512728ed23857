// Pictures are worked on one core while this lives: for work that is shared among threads by pairs, and for its times.
#pragma once

namespace palpate::measure {

/// OpenCV's number of threads is one for the whole process: one of these at a time.
class OneThread {
 public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = 0;
};

}  // namespace palpate::measure
