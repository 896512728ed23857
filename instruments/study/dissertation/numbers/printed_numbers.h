// The numbers that the dissertation prints, as printed: what the study holds ours against.
//
// Numbers are kept as the text has them, because their digits show their precision. Data only; the measured ellipses
// themselves are the engine's (maps/measured_data.h).
// Source: Ji, "Spatial Partitioning and Functional Shape Matched Deformation Algorithm for Interactive Haptic
// Modeling", Ohio University 2008.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace palpate::study {

/// Table 3.1: rates of whole models without a partition.
struct PrintedRate {
  int triangles = 0;
  double haptic_fps = 0.0;
  double graphic_fps = 0.0;
};

/// Table 3.2 and Appendix B: one cell group.
struct PrintedTiming {
  int triangles = 0;
  std::string ms;
  std::string fps;
};

struct PrintedTimings {
  std::vector<PrintedTiming> drawing;    ///< no haptic interface
  std::vector<PrintedTiming> untouched;  ///< and collision detection
  std::vector<PrintedTiming> touched;    ///< and force generation
};

/// A column of Tables 3.3 and 3.4.
struct PrintedTree {
  int height = 0;
  std::string leaf_share;  ///< r, a fraction
  std::string node_share;  ///< r_Bin or r_Oct, a fraction
  std::string w;
};

/// Appendix C: the ratio of a row, in the order of the measured rows.
struct PrintedMean {
  std::string major_cm;
  std::string minor_cm;
  std::string ratio;
  std::string degree;
};

/// A point of Figure 5.3 and the last table of Appendix C.
struct PrintedKey {
  std::string figure_major_cm;
  std::string figure_ratio;
  std::string figure_degree;
  std::string table_major_mm;
  std::string table_ratio;
  std::string table_degree;
};

struct PrintedNumbers {
  std::vector<PrintedRate> table_3_1{};
  PrintedTimings table_3_2{};   ///< BSP tree
  PrintedTimings appendix_b{};  ///< octree
  std::vector<PrintedTree> table_3_3{};
  std::vector<PrintedTree> table_3_4{};
  std::string bsp_cost_over_n = "0.8";          ///< (3.5)
  std::string octree_cost_over_n = "0.4";       ///< (3.9)
  std::string largest_share_of_leaves = "0.1";  ///< 3.3.4, the r of (3.5) and (3.9)
  std::string back_grid_mm = "5";               ///< 2.1, 5.1: "about 5 x 5 mm"
  std::string bunny_fps = "28";                 ///< 3.3.3: without a partition
  std::string hand_triangles = "2814";          ///< 4.5
  double hand_triangles_appendix_a = 2818.0;
  std::string bsp_height = "7";          ///< 3.3.4: of 100k triangles
  std::string octree_height = "3";       ///< 3.4.2
  std::string fewest_touched_fps = "7";  ///< 3.3.4, of Table 3.2
  std::string most_touched_fps = "91";
  std::string gaussian_variance = "0.1592";  ///< 4.2.1
  std::string gaussian_sigma = "0.4";
  std::string gaussian_end = "0.0021";           ///< y(1.4)
  std::string gaussian_end_part = "500";         ///< y(1.4) is "around 1/500"
  std::array<int, 3> array_sizes{20, 130, 700};  ///< Figure 4.9
  std::string stiffness_left = "0.5";            ///< (2.3): of a surface that yields by as much as the finger goes in
  std::string effect_levels_r = "112";           ///< 5.2.2: (5.10) at P1 with the levels 1, 0.26, 0.18
  std::string literal_r_e1 = "115";              ///< Figure 5.9
  std::string literal_r_e2 = "112";
  std::string exact_r = "120";  ///< Figure 5.10, at E1, E2 and E3
  std::vector<std::string> appendix_c_ratios{};
  std::vector<PrintedMean> appendix_c_means{};  ///< up P1 to P5, down P1 to P5
  std::vector<PrintedKey> keys{};               ///< P1 to P5
};

PrintedNumbers printedNumbers();

// ---- measured rates compared at equal numbers of triangles

/// ms at that many triangles, linear between the measured ones; beyond them NaN.
double timeAt(const std::vector<PrintedTiming>& timings, double triangles);

struct Gain {
  double least = 0.0;
  double most = 0.0;
};

/// By what share the rate of `fast` exceeds that of `slow` at the triangle counts where both are known.
Gain rateGain(const std::vector<PrintedTiming>& fast, const std::vector<PrintedTiming>& slow);

}  // namespace palpate::study
