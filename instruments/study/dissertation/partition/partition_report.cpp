#include "dissertation/partition/partition_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/kit/json.h"
#include "lab/commands/bench_arguments.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

double perTriangle(double amount, const PartitionReport& report) {
  return amount / static_cast<double>(std::max<std::size_t>(report.triangles, 1));
}

double nsPerTriangle(const PartitionReport& report) { return perTriangle(1e9 * report.build_seconds, report); }

double bytesPerTriangle(const PartitionReport& report) {
  return perTriangle(static_cast<double>(report.statistics.bytes), report);
}

std::string sizeRange(const bench::LeafSizeBin& bin) {
  return bin.first == bin.last ? fmt::to_string(bin.first) : fmt::format("{}-{}", bin.first, bin.last);
}

std::string histogramText(const bench::LeafSizes& sizes) {
  std::string text;
  for (const auto& bin : sizes.histogram) {
    if (bin.leaves > 0) text += fmt::format("    {:>17} triangles  {} leaves\n", sizeRange(bin), bin.leaves);
  }
  return text;
}

std::string boxText(const PartitionReport::Box& box) {
  const PartitionQuery& q = box.query;
  std::string text = fmt::format("box                   {:.6g} x {:.6g} x {:.6g} mm at ({:.6g}, {:.6g}, {:.6g}), {}\n",
                                 box.edges_mm.x(), box.edges_mm.y(), box.edges_mm.z(), box.centre_mm.x(),
                                 box.centre_mm.y(), box.centre_mm.z(), box.traversal);
  text += fmt::format("  leaves              {} with {} triangles to render ({} different)\n", q.leaves.leaves.size(),
                      q.rendered, q.rendered_triangles);
  text += fmt::format("  nodes               {} tested, {} entered\n", q.leaves.cost.nodes_tested,
                      q.leaves.cost.nodes_entered);
  text += fmt::format("  must be found       {}, missed {}\n", q.must, q.missed);
  text += fmt::format("  exact triangles     {}\n", q.exact.size());
  text += fmt::format("  time, leaves        p50 {:.2f}  p99 {:.2f} us\n", q.leaves_us.p50, q.leaves_us.p99);
  return text + fmt::format("  time, exact         p50 {:.2f}  p99 {:.2f} us\n", q.exact_us.p50, q.exact_us.p99);
}

Json toJson(const bench::LeafSizes& sizes) {
  Json bins = Json::array();
  for (const auto& bin : sizes.histogram) {
    bins.push_back({{"first", bin.first}, {"last", bin.last}, {"leaves", bin.leaves}});
  }
  return {{"min", sizes.least}, {"mean", sizes.mean}, {"max", sizes.most}, {"histogram", bins}};
}

Json toJson(const PartitionReport::Box& box) {
  const PartitionQuery& q = box.query;
  Json json;
  json["center_mm"] = vectorJson(box.centre_mm);
  json["edges_mm"] = vectorJson(box.edges_mm);
  json["traversal"] = box.traversal;
  json["leaves"] = q.leaves.leaves.size();
  json["rendered"] = q.rendered;
  json["rendered_triangles"] = q.rendered_triangles;
  json["must"] = q.must;
  json["missed"] = q.missed;
  json["exact_triangles"] = q.exact.size();
  json["nodes_tested"] = q.leaves.cost.nodes_tested;
  json["nodes_entered"] = q.leaves.cost.nodes_entered;
  json["leaf_query_us"] = {{"p50", q.leaves_us.p50}, {"p99", q.leaves_us.p99}};
  json["exact_query_us"] = {{"p50", q.exact_us.p50}, {"p99", q.exact_us.p99}};
  return json;
}

}  // namespace

std::string textOf(const PartitionReport& report) {
  const bench::PartitionStatistics& s = report.statistics;
  std::string text = fmt::format("partition             {}, assignment {}, threshold {}{}\n",
                                 wordFor(report.settings.tree), wordFor(report.settings.assignment),
                                 report.settings.threshold, report.settings.leaf_below_threshold ? " (below)" : "");
  text += fmt::format("triangles             {}\n", report.triangles);
  if (report.lost) text += fmt::format("lost triangles        {}\n", *report.lost);
  text += fmt::format("height                {}\n", s.height);
  text +=
      fmt::format("nodes                 {}, of them {} leaves; {} empty ones dropped; {} blocks below the leaves\n",
                  s.nodes, s.leaves, s.empty_nodes, s.blocks);
  text += fmt::format("triangles per leaf    min {}  mean {:.1f}  max {}\n", s.leaf_sizes.least, s.leaf_sizes.mean,
                      s.leaf_sizes.most);
  text += histogramText(s.leaf_sizes);
  text += fmt::format("a triangle is stored  {:.4f} times\n", s.entries_per_triangle);
  text += fmt::format("a point is in         {:.4f} leaf boxes\n", s.leaves_per_point);
  text += fmt::format("memory                {:.1f} bytes a triangle\n", bytesPerTriangle(report));
  text += fmt::format("build                 {:.1f} ms, {:.0f} ns a triangle\n", 1e3 * report.build_seconds,
                      nsPerTriangle(report));
  return report.box ? text + boxText(*report.box) : text;
}

Json toJson(const PartitionReport& report) {
  const bench::PartitionStatistics& s = report.statistics;
  Json json;
  json["mesh"] = report.mesh;
  json["triangles"] = report.triangles;
  json["tree"] = wordFor(report.settings.tree);
  json["assign"] = wordFor(report.settings.assignment);
  json["threshold"] = report.settings.threshold;
  json["leaf_rule"] = report.settings.leaf_below_threshold ? "below" : "at-most";
  if (report.lost) json["lost_triangles"] = *report.lost;
  json["height"] = s.height;
  json["nodes"] = s.nodes;
  json["leaves"] = s.leaves;
  json["empty_nodes"] = s.empty_nodes;
  json["blocks"] = s.blocks;
  json["entries"] = s.entries;
  json["triangles_per_leaf"] = toJson(s.leaf_sizes);
  json["entries_per_triangle"] = s.entries_per_triangle;
  json["leaf_boxes_per_point"] = s.leaves_per_point;
  json["bytes_per_triangle"] = bytesPerTriangle(report);
  json["build_ms"] = 1e3 * report.build_seconds;
  json["build_ns_per_triangle"] = nsPerTriangle(report);
  if (report.box) json["box"] = toJson(*report.box);
  return json;
}

}  // namespace palpate::app
