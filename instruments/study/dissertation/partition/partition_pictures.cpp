// A partition as coloured PLY files: each leaf in a colour of its own, and the triangles in a box.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dissertation/partition/partition_report.h"
#include "palpate/mesh/files/save.h"

namespace palpate::app {

using hdb::Node;
using hdb::Partition;
using hdb::Piece;

namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kGrey = {170, 170, 170};
constexpr Colour kGreen = {90, 190, 90};
constexpr Colour kOrange = {240, 140, 40};

/// Triangles that share no vertices, so that each can have one colour.
struct ColouredSoup {
  mesh::TriangleMesh mesh;
  mesh::VertexChannels channels;

  void add(const Piece& corners, const Colour& colour) {
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    channels.colours.insert(channels.colours.end(), 3, colour);
  }
};

Piece cornersOf(const mesh::TriangleMesh& mesh, Index triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

}  // namespace

/// Hues by the golden angle: whatever the number, those of neighbours in the list lie far apart.
std::array<std::uint8_t, 3> leafColour(std::size_t number) {
  const double hue = 2.0 * std::numbers::pi * std::fmod(static_cast<double>(number) * std::numbers::phi, 1.0);
  const auto channel = [&](double phase) {
    return static_cast<std::uint8_t>(150.0 + 90.0 * std::cos(hue - phase * 2.0 * std::numbers::pi / 3.0));
  };
  return {channel(0.0), channel(1.0), channel(2.0)};
}

void writeLeafColours(const std::filesystem::path& file, const mesh::TriangleMesh& mesh, const Partition& partition) {
  ColouredSoup soup;
  for (std::size_t l = 0; l < partition.leaves.size(); ++l) {
    const Node& leaf = partition.nodes[partition.leaves[l]];
    for (Index e = leaf.first_entry; e < leaf.first_entry + leaf.entry_count; ++e) {
      soup.add(partition.pieces.empty() ? cornersOf(mesh, partition.triangles[e]) : partition.pieces[e], leafColour(l));
    }
  }
  mesh::save(file, soup.mesh, soup.channels);
}

void writeSelection(const std::filesystem::path& file, const mesh::TriangleMesh& mesh, const Partition& partition,
                    const std::vector<Index>& leaves, const std::vector<Index>& exact) {
  std::vector<Colour> colours(mesh.triangles.size(), kGrey);
  for (const Index leaf : leaves) {
    for (const Index triangle : trianglesOf(partition, partition.nodes[leaf])) colours[triangle] = kGreen;
  }
  for (const Index triangle : exact) colours[triangle] = kOrange;
  ColouredSoup soup;
  for (Index t = 0; t < mesh.triangles.size(); ++t) soup.add(cornersOf(mesh, t), colours[t]);
  mesh::save(file, soup.mesh, soup.channels);
}

}  // namespace palpate::app
