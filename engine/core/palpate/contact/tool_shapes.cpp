#include "palpate/contact/tool_shapes.h"

#include <cmath>
#include <numbers>

namespace palpate::contact {

namespace {

/// Radius of the finger that the stiffness in the skin's law is for, mm.
constexpr double kFingertipMm = 8.0;
constexpr int kFingers = 5;
constexpr double kBetweenFingersMm = 22.0;
constexpr double kRowsFromPalmMm = 60.0;
/// sqrt(3) / 2: of the corners of a hexagon.
constexpr double kHexagon = 0.86602540378443865;

/// Gives all pads the same share.
void shareOut(ToolShape& tool, double sum) {
  for (Pad& pad : tool.pads) pad.share = sum / static_cast<double>(tool.pads.size());
}

/// Stiffness of a flat punch relative to a fingertip's.
double sharesOfArea(double width_mm, double length_mm) {
  return std::sqrt(width_mm * length_mm / std::numbers::pi) / kFingertipMm;
}

struct PadRows {
  int across = 1, along = 1;
  double across_mm = 0.0, along_mm = 0.0;  ///< from pad to pad
  double radius_mm = 0.0;
};

/// Rows of pads round the origin.
ToolShape rowsOf(const PadRows& rows) {
  ToolShape tool;
  for (int j = 0; j < rows.along; ++j) {
    for (int i = 0; i < rows.across; ++i) {
      const Vec3 offset((i - 0.5 * (rows.across - 1)) * rows.across_mm, (j - 0.5 * (rows.along - 1)) * rows.along_mm,
                        0.0);
      tool.pads.push_back({offset, rows.radius_mm});
    }
  }
  return tool;
}

/// The pads of one tool as a further part of another.
void addPart(const ToolShape& part, const Vec3& rest, ToolShape& tool) {
  for (Pad pad : part.pads) {
    pad.part = static_cast<Index>(tool.rest.size());
    tool.pads.push_back(pad);
  }
  tool.rest.push_back(rest);
}

/// Adds a fingertip ten times.
void addFingers(const ToolShape& fingertip, ToolShape& tool) {
  for (const double y : {-kRowsFromPalmMm, kRowsFromPalmMm}) {
    for (int i = 0; i < kFingers; ++i)
      addPart(fingertip, {(i - 0.5 * (kFingers - 1)) * kBetweenFingersMm, y, 0.0}, tool);
  }
}

}  // namespace

ToolShape sphereTool(double radius_mm) { return {{{Vec3::Zero(), radius_mm}}}; }

ToolShape fingertipTool() {
  constexpr double kRadius = 4.0, kRing = 4.5, kHigher = 0.8;
  ToolShape tool = sphereTool(kRadius);
  for (const Vec2& corner : {Vec2(1, 0), Vec2(0.5, kHexagon), Vec2(-0.5, kHexagon), Vec2(-1, 0), Vec2(-0.5, -kHexagon),
                             Vec2(0.5, -kHexagon)}) {
    tool.pads.push_back({Vec3(kRing * corner.x(), kRing * corner.y(), kHigher), kRadius});
  }
  shareOut(tool, 1.0);
  return tool;
}

ToolShape knuckleTool() {
  ToolShape tool = rowsOf({.across = 3, .across_mm = 3.0, .radius_mm = 7.0});
  shareOut(tool, 1.0);
  return tool;
}

ToolShape palmTool() {
  constexpr double kHollow = 2.0, kHalfWidth = 27.0, kHalfLength = 45.0;
  ToolShape tool = rowsOf({.across = 4, .along = 6, .across_mm = 18.0, .along_mm = 18.0, .radius_mm = 8.0});
  for (Pad& pad : tool.pads) {
    const double x = pad.offset.x() / kHalfWidth;
    const double y = pad.offset.y() / kHalfLength;
    pad.offset.z() = kHollow * (1.0 - 0.5 * (x * x + y * y));
  }
  shareOut(tool, sharesOfArea(70.0, 106.0));
  return tool;
}

ToolShape headTool() {
  constexpr double kLength = 60.0, kWidth = 12.0, kRadius = 3.0;
  ToolShape tool = rowsOf({.across = 11,
                           .along = 3,
                           .across_mm = (kLength - 2.0 * kRadius) / 10.0,
                           .along_mm = (kWidth - 2.0 * kRadius) / 2.0,
                           .radius_mm = kRadius});
  shareOut(tool, sharesOfArea(kLength, kWidth));
  return tool;
}

ToolShape fingertipsTool() {
  ToolShape tool;
  tool.rest.clear();
  addFingers(sphereTool(kFingertipMm), tool);
  return tool;
}

ToolShape handTool() {
  ToolShape tool;
  tool.rest.clear();
  addFingers(fingertipTool(), tool);
  addPart(palmTool(), Vec3::Zero(), tool);
  return tool;
}

}  // namespace palpate::contact
