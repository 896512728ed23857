// A partition as a picture that needs no other program: drawn by instruments/report/charts, in parallel projection.
#include <fmt/format.h>

#include <algorithm>

#include "dissertation/partition/partition_report.h"
#include "palpate/base/error.h"
#include "palpate/scene/words.h"

namespace palpate::app {

namespace {

constexpr figures::Colour kRest{0.80, 0.80, 0.80};
constexpr figures::Colour kInLeaves{0.35, 0.74, 0.35};
constexpr figures::Colour kExact{0.94, 0.55, 0.16};
/// More boxes than this are a tangle that hides the body.
constexpr std::size_t kMaxBoxes = 400;

figures::Colour figureColour(const std::array<std::uint8_t, 3>& bytes) {
  return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0, 1.0};
}

figures::MeshView seenFrom(const PartitionSight& sight, const std::string& title) {
  figures::MeshView view{.title = title};
  view.towards_viewer = sight.towards_viewer;
  view.up = sight.up;
  view.ambient = 0.6;
  return view;
}

/// Cut triangles by their pieces. A triangle that several leaves hold has the colour of the first.
void addLeaves(const mesh::TriangleMesh& mesh, const hdb::Partition& partition, figures::MeshView& view) {
  const bool cut = !partition.pieces.empty();
  if (!cut) view.positions = mesh.positions;
  std::vector<bool> drawn(mesh.triangles.size(), false);
  for (std::size_t l = 0; l < partition.leaves.size(); ++l) {
    const hdb::Node& leaf = partition.nodes[partition.leaves[l]];
    for (Index e = leaf.first_entry; e < leaf.first_entry + leaf.entry_count; ++e) {
      if (cut) {
        const auto first = static_cast<Index>(view.positions.size());
        view.positions.insert(view.positions.end(), partition.pieces[e].begin(), partition.pieces[e].end());
        view.triangles.push_back({first, first + 1, first + 2});
      } else {
        const Index triangle = partition.triangles[e];
        if (drawn[triangle]) continue;
        drawn[triangle] = true;
        view.triangles.push_back(mesh.triangles[triangle]);
      }
      view.colours.push_back(figureColour(leafColour(l)));
    }
  }
}

/// Boxes that queries test.
figures::Segments leafBoxEdges(const hdb::Partition& partition, std::span<const Index> leaves,
                               const std::string& name) {
  figures::Segments boxes{.name = name, .segments = {}, .colour = figures::withAlpha(figures::kBlue, 0.55)};
  boxes.width_px = 0.8;
  for (const Index leaf : leaves) {
    const auto edges = figures::boxEdges(partition.nodes[leaf].tight);
    boxes.segments.insert(boxes.segments.end(), edges.begin(), edges.end());
  }
  return boxes;
}

figures::MeshView leavesView(const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                             const PartitionSight& sight) {
  const std::size_t count = partition.leaves.size();
  figures::MeshView view = seenFrom(sight, fmt::format("{} leaves, a colour each", count));
  addLeaves(mesh, partition, view);
  if (count <= kMaxBoxes) view.lines.push_back(leafBoxEdges(partition, partition.leaves, "boxes of the leaves"));
  return view;
}

figures::MeshView boxView(const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                          const PartitionReport::Box& box, const PartitionSight& sight) {
  const PartitionQuery& query = box.query;
  figures::MeshView view = seenFrom(
      sight, fmt::format("{} leaves, {} triangles in the box", query.leaves.leaves.size(), query.exact.size()));
  view.positions = mesh.positions;
  view.triangles = mesh.triangles;
  view.colours.assign(mesh.triangles.size(), kRest);
  for (const Index leaf : query.leaves.leaves) {
    for (const Index triangle : hdb::trianglesOf(partition, partition.nodes[leaf])) view.colours[triangle] = kInLeaves;
  }
  for (const Index triangle : query.exact) view.colours[triangle] = kExact;
  view.legend = {{"in the leaves found", kInLeaves}, {"meet the box", kExact}};
  view.lines.push_back(leafBoxEdges(partition, query.leaves.leaves, "boxes of these leaves"));
  figures::Segments edges{.name = "haptic detecting box",
                          .segments = figures::boxEdges(hdb::hapticBox(box.centre_mm, box.edges_mm)),
                          .colour = figures::kVermilion};
  edges.width_px = 1.8;
  edges.on_top = true;
  view.lines.push_back(std::move(edges));
  return view;
}

}  // namespace

figures::Figure partitionFigure(const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                                const PartitionReport& report, const PartitionSight& sight) {
  figures::Figure figure;
  figure.title = fmt::format("{}: {}, assignment {}, threshold {}", report.mesh, wordFor(report.settings.tree),
                             wordFor(report.settings.assignment), report.settings.threshold);
  figure.panels.emplace_back(leavesView(mesh, partition, sight));
  if (report.box) figure.panels.emplace_back(boxView(mesh, partition, *report.box, sight));
  figure.columns = 2;
  figure.panel_width_px = 560.0;
  figure.panel_height_px = 640.0;
  if (partition.leaves.size() > kMaxBoxes)
    figure.note = fmt::format("Boxes of more than {} leaves are left out.", kMaxBoxes);
  return figure;
}

bool isSvgPicture(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".png" || extension == ".svg") return extension == ".svg";
  throw Error::inFile(file.string(), "a partition's picture must end in .png or .svg");
}

}  // namespace palpate::app
