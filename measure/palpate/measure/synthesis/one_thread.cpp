#include "palpate/measure/synthesis/one_thread.h"

#include <opencv2/core.hpp>

namespace palpate::measure {

OneThread::OneThread() : before_(cv::getNumThreads()) { cv::setNumThreads(1); }
OneThread::~OneThread() { cv::setNumThreads(before_); }

}  // namespace palpate::measure
