// The study of Tables 3.1, 3.2 and Appendix B: drawing, untouched and touched frames against the triangles rendered.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dissertation/numbers/printed_numbers.h"
#include "report/page/study_page.h"

namespace palpate::study {

struct RatesPlan {
  std::vector<std::size_t> models{2915, 6261, 8163, 20389, 41582};  ///< Appendix A
  std::size_t partitioned = 41582;                                  ///< model of Table 3.2 and Appendix B
  int places = 40;
  int runs = 25;
  int width_px = 800;
  int height_px = 600;
};

RatesPlan ratesPlan(bool quick);

/// A model without a partition: Table 3.1.
struct WholeModelRow {
  std::size_t triangles = 0;
  std::optional<double> draw_us;     ///< into the feedback buffer; nothing without OpenGL
  double collide_us = 0.0;           ///< every triangle against the tip's way
  double force_us = 0.0;             ///< the nearest point of every triangle
  std::optional<double> picture_us;  ///< the whole model as a picture, corner by corner
  double tick_us = 0.0;              ///< our finger

  double touchedMicroseconds() const { return draw_us.value_or(0.0) + collide_us + force_us; }
};

/// A frame that renders about as many triangles as a printed one: Table 3.2, Appendix B.
struct FrameRow {
  double triangles = 0.0;
  double edge_mm = 0.0;  ///< edge of the box that met these leaves
  std::optional<double> draw_us{};
  double find_us = 0.0;
  double collide_us = 0.0;
  double force_us = 0.0;
  double exact_us = 0.0;  ///< our list of the triangles in the same box

  double untouchedMicroseconds() const { return draw_us.value_or(0.0) + find_us + collide_us; }
  double touchedMicroseconds() const { return untouchedMicroseconds() + force_us; }
};

/// One tree: a row for each printed one.
struct TreeRates {
  std::vector<FrameRow> drawing{};
  std::vector<FrameRow> untouched{};
  std::vector<FrameRow> touched{};
};

struct RatesMeasurement {
  RatesPlan plan;
  std::string renderer{};     ///< OpenGL's; empty without OpenGL
  std::string no_renderer{};  ///< why OpenGL is missing
  std::vector<WholeModelRow> whole{};
  TreeRates bsp{};
  TreeRates octree{};
  double tick_us = 0.0;  ///< our finger on the partitioned model
};

RatesMeasurement measureRates(const RatesPlan& plan, const Progress& progress);

// Findings from measured against printed rates: sentences made of nothing but the measurement.

/// Paragraphs, most important first. `found` must have rows.
std::vector<std::string> ratesFindings(const RatesMeasurement& found);

}  // namespace palpate::study
