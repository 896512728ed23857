// Tools as plain data: parts of a hand and an ultrasound head, made of pads.
//
// Frame of a part: the skin is below, z points away from it; x across the hand or along the head, y towards the
// fingertips. The origin is what the device holds. Sizes are those of an adult, rounded; each says what it stands for.
// None was measured on a person: change the data for another hand.
//
// Shares. On an elastic half-space a flat punch is as stiff as the root of its area (k = 2 E* a, a the radius of a
// circle of that area; Sneddon 1965, within a few per cent for other outlines that are not much longer than wide). So
// the shares of a tool add up to the radius of such a circle over that of a fingertip of 8 mm, whose stiffness the law
// of the skin has, and are alike for all pads. That is an assumption about even pressing: one pad alone on the skin is
// softer than a finger of its radius would be.
#pragma once

#include "palpate/contact/tool.h"

namespace palpate::contact {

/// One sphere at the origin, counted whole: the finger of contact::step.
ToolShape sphereTool(double radius_mm = 8.0);

/// The pulp of a fingertip pressed flat: 7 pads of 4 mm, one in the middle and six round it at 4.5 mm, these 0.8 mm
/// higher. 17 mm wide, where pulps of adults are 15 to 20; curved as a ball of 13 mm at its lowest. Shares add up to 1.
ToolShape fingertipTool();

/// A bent finger's middle knuckle: three pads of 7 mm side by side, 20 mm wide. Shares add up to 1.
ToolShape knuckleTool();

/// A palm laid flat: 4 x 6 pads of 8 mm, 18 mm apart, 70 x 106 mm with its heel, the middle 2 mm hollow. Shares add up
/// to those of an area of 70 x 106 mm, 6.1.
ToolShape palmTool();

/// The face of a linear ultrasound head of 60 x 12 mm: 11 x 3 pads of 3 mm, flat. Shares add up to 1.9.
ToolShape headTool();

/// Ten fingertips of one sphere of 8 mm, a part each, counted whole: two rows of five, 22 mm apart, the rows 120.
ToolShape fingertipsTool();

/// Ten fingertips of 7 pads and a palm between them, a part each: 94 pads in 11 parts.
ToolShape handTool();

}  // namespace palpate::contact
