#include "study/misprints.h"

#include <array>

namespace palpate::study {

namespace {

constexpr std::array kMisprints{
    Misprint{"Table 3.3, height 5", "w", "3.04", 13, "6/63 over 1/32 is 3.0476: cut off instead of rounded"},
    Misprint{"Table 3.3, height 9", "w", "5.01", 13, "10/1023 over 1/512 is 5.0049"},
    Misprint{"5.2.2, (5.10) at P1", "R for the levels 1, 0.26, 0.18", "112", 28,
             "112.92 was cut off; with the levels of any one effect radius Table 5.1 gives neither"},
    Misprint{"Figure 5.9, e = 400 as radius", "R(E1)", "115", 28,
             "115 and 112 need the radius 200: 400 is the diameter"},
    Misprint{"Figure 5.9, e = 400 as radius", "R(E2)", "112", 28,
             "115 and 112 need the radius 200: 400 is the diameter"},
};

}  // namespace

std::span<const Misprint> misprints() { return kMisprints; }

}  // namespace palpate::study
