// The pictures of a recording's report: what was felt over time, how often which size, and where on the body.
#pragma once

#include <string>
#include <vector>

#include "report/charts/figure.h"
#include "report/recording/recording_report.h"

namespace palpate::app {

struct ReportPicture {
  std::string id;       ///< in the page
  std::string heading;  ///< heading of its section
  std::string caption;
  figures::Figure figure;
};

/// Force, depth and speed of each finger over time, with its phases below; and their distribution. None of a
/// recording without ticks; distributions only where something was touched.
std::vector<ReportPicture> coursePictures(const RecordingReport& report);

/// Time in contact and peak force on the body's surface, or on a plane without one. Empty without a touch.
std::vector<ReportPicture> bodyPictures(const RecordingReport& report);

}  // namespace palpate::app
