#include "dissertation/numbers/printed_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dissertation/numbers/number_row.h"

namespace palpate::study {

namespace {

PrintedTimings table32() {
  return {.drawing = {{1387, "2.6", "378"},
                      {3503, "4.9", "204"},
                      {6541, "8.1", "124"},
                      {8944, "11.6", "86"},
                      {10134, "13.2", "76"},
                      {13171, "16.4", "61"},
                      {14722, "17.2", "58"}},
          .untouched = {{1357, "7.6", "132"},
                        {3620, "18.5", "54"},
                        {6688, "33.3", "30"},
                        {8679, "47.6", "21"},
                        {10488, "58.8", "17"},
                        {13354, "76.9", "13"},
                        {14478, "90.9", "11"}},
          .touched = {{1671, "11.0", "91"},
                      {3284, "21.7", "46"},
                      {6688, "43.5", "23"},
                      {9138, "66.7", "15"},
                      {10347, "71.4", "14"},
                      {13530, "111.1", "9"},
                      {14842, "142.9", "7"}}};
}

PrintedTimings appendixB() {
  return {.drawing = {{1373, "2.6", "385"},
                      {3507, "5.4", "184"},
                      {6580, "9.6", "104"},
                      {8415, "11.8", "85"},
                      {10830, "14.9", "67"},
                      {12987, "17.9", "56"},
                      {14481, "19.2", "52"}},
          .untouched = {{1373, "6.3", "160"},
                        {3675, "13.9", "72"},
                        {6466, "24.4", "41"},
                        {8550, "35.7", "28"},
                        {10928, "43.5", "23"},
                        {13219, "55.6", "18"},
                        {14615, "62.5", "16"}},
          .touched = {{1696, "9.5", "105"},
                      {3552, "15.6", "64"},
                      {6488, "30.3", "33"},
                      {8482, "40.0", "25"},
                      {10464, "55.6", "18"},
                      {12788, "71.4", "14"},
                      {13981, "83.3", "12"}}};
}

std::vector<PrintedTree> table33() {
  return {{3, "1/8", "4/15", "2.13"},      {4, "1/16", "5/31", "2.58"},      {5, "1/32", "6/63", "3.04"},
          {6, "1/64", "7/127", "3.53"},    {7, "1/128", "8/255", "4.02"},    {8, "1/256", "9/511", "4.51"},
          {9, "1/512", "10/1023", "5.01"}, {10, "1/1024", "11/2047", "5.50"}};
}

std::vector<PrintedTree> table34() {
  return {{2, "1/64", "3/73", "2.63"}, {3, "1/512", "4/585", "3.50"}, {4, "1/4096", "5/4681", "4.38"}};
}

std::vector<std::string> appendixCRatios() {
  return {"1.313", "1.061", "1.063", "1.091", "1.143",  // up P1
          "1.222", "1.000", "0.821", "1.129", "1.071",  // up P2
          "1.444", "1.000", "1.381", "1.238", "1.091",  // up P3
          "1.440", "1.207", "1.414", "1.407", "1.318",  // up P4
          "1.300", "1.250", "1.417", "1.350", "1.250",  // up P5
          "0.964", "1.143", "0.920",                    // down P1
          "1.258", "1.161", "1.269",                    // down P2
          "1.333", "0.969", "1.000",                    // down P3
          "1.296", "1.267", "1.280",                    // down P4
          "1.000", "1.353", "1.542"};                   // down P5
}

std::vector<PrintedMean> appendixCMeans() {
  return {{"35.8", "31.6", "1.134", "90.0"}, {"29.8", "28.4", "1.049", "90.0"},  {"26.6", "22.0", "1.231", "180.0"},
          {"35.8", "26.4", "1.357", "99.4"}, {"28.4", "21.6", "1.313", "121.0"}, {"27.3", "27.0", "1.009", "90.0"},
          {"36.0", "29.3", "1.230", "90.0"}, {"28.0", "26.0", "1.101", "180.0"}, {"35.0", "27.3", "1.281", "68.3"},
          {"38.7", "30.3", "1.298", "88.3"}};
}

std::vector<PrintedKey> keys() {
  return {{"35.8", "1.13", "90.0", "358", "1.134", "90.0"},
          {"29.8", "1.05", "90.0", "298", "1.049", "90.0"},
          {"26.6", "1.23", "180.0", "266", "1.231", "180.0"},
          {"35.8", "1.36", "99.4", "358", "1.357", "99.4"},
          {"28.4", "1.31", "121.0", "284", "1.313", "121.0"}};
}

}  // namespace

PrintedNumbers printedNumbers() {
  return {.table_3_1 = {{2915, 104, 198}, {6261, 51, 92}, {8163, 34, 65}, {20389, 12, 25}, {41582, 6, 11}},
          .table_3_2 = table32(),
          .appendix_b = appendixB(),
          .table_3_3 = table33(),
          .table_3_4 = table34(),
          .appendix_c_ratios = appendixCRatios(),
          .appendix_c_means = appendixCMeans(),
          .keys = keys()};
}

double timeAt(const std::vector<PrintedTiming>& timings, double triangles) {
  for (std::size_t i = 1; i < timings.size(); ++i) {
    const PrintedTiming& low = timings[i - 1];
    const PrintedTiming& high = timings[i];
    if (triangles < low.triangles || triangles > high.triangles) continue;
    const double share = (triangles - low.triangles) / (high.triangles - low.triangles);
    const double from = parsePrinted(low.ms).value;
    return from + share * (parsePrinted(high.ms).value - from);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Gain rateGain(const std::vector<PrintedTiming>& fast, const std::vector<PrintedTiming>& slow) {
  Gain gain{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto* table : {&fast, &slow}) {
    for (const PrintedTiming& timing : *table) {
      const double more = timeAt(slow, timing.triangles) / timeAt(fast, timing.triangles) - 1.0;
      if (!std::isfinite(more)) continue;
      gain.least = std::min(gain.least, more);
      gain.most = std::max(gain.most, more);
    }
  }
  return gain;
}

}  // namespace palpate::study
