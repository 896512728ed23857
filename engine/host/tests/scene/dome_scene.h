// A scene of a dome from a file, in a folder of its own: for tests of what is made of scenes.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene_file.h"
#include "support/temporary_folder.h"

namespace palpate::scene {

/// A folder with what a scene needs.
class DomeScene : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  /// A dome 200 mm wide and 20 mm high, as an OBJ file.
  void writeDome(const std::string& name) const {
    mesh::TriangleMesh dome;
    constexpr int kCells = 20;
    for (int j = 0; j <= kCells; ++j) {
      for (int i = 0; i <= kCells; ++i) {
        const double x = -100.0 + 10.0 * i;
        const double y = -100.0 + 10.0 * j;
        dome.positions.emplace_back(x, y, 20.0 - 0.001 * (x * x + y * y));
      }
    }
    for (Index j = 0; j < kCells; ++j) {
      for (Index i = 0; i < kCells; ++i) {
        const Index a = j * (kCells + 1) + i;
        dome.triangles.push_back({a, a + 1, a + kCells + 2});
        dome.triangles.push_back({a, a + kCells + 2, a + kCells + 1});
      }
    }
    mesh::save(folder_ / name, dome);
  }
  Scene meshScene(const std::string& more = "") const {
    return parse("[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n" + more +
                     "[[finger]]\nname = \"a\"\nat_mm = [5, 5]\nscript = [{ do = \"press\", depth_mm = 3 }]\n",
                 (folder_ / "s.toml").string());
  }

  support::TemporaryFolder folder_;
};

}  // namespace palpate::scene
