// Closed forms against counts on complete trees, then each search counted on real models for all thresholds and boxes.
// Based on: Ji, dissertation 2008, 3.3.4 and 3.4.2, Tables 3.3 and 3.4.
#include "dissertation/complexity/complexity_results.h"

#include <fmt/format.h>

#include <iterator>

#include "dissertation/cost/complexity.h"
#include "lab/measured/model_meshes.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

// w from a search that ends in one leaf of a complete tree, node by node.
double countedW(TreeKind tree, int height) {
  const mesh::TriangleMesh mesh = completeTreeMesh(tree, height);
  const hdb::Partition built = hdb::buildPartition(mesh, {.tree = tree, .threshold = 1});
  SearchCounter counter(built);
  const SearchCount count = counter.count(hdb::hapticBox(mesh.positions[0], 1e-4));
  const auto leaves = static_cast<double>(built.leaves.size());
  return (count.on_paths / built.tree_node_count) / (count.leaves_found / leaves);
}

std::vector<WorstColumn> worstColumns() {
  std::vector<WorstColumn> columns;
  const auto add = [&](TreeKind tree, int height, double printed) {
    columns.push_back({tree, height, printed, worstSearch(treeArity(tree), height).w, countedW(tree, height)});
  };
  for (std::size_t i = 0; i < std::size(kTable33Heights); ++i) {
    add(TreeKind::Bsp, kTable33Heights[i], kTable33PrintedW[i]);
  }
  for (std::size_t i = 0; i < std::size(kTable34Heights); ++i) {
    add(TreeKind::Octree, kTable34Heights[i], kTable34PrintedW[i]);
  }
  return columns;
}

struct Model {
  std::string name;
  mesh::TriangleMesh mesh;
};

std::vector<Model> models(bool quick) {
  std::vector<Model> all;
  all.push_back({fmt::format("back of {}", counted(kBackTriangles)), backModel()});
  if (quick) return all;
  all.push_back({fmt::format("hand of {}", counted(kHandTriangles)), handModel()});
  all.push_back({"back of 20,389", backModel(20389)});
  all.push_back({"back of 41,582", backModel(41582)});
  return all;
}

void sweepModel(const Model& model, std::size_t most_places, std::vector<SearchCase>& cases) {
  for (const TreeKind tree : kTrees) {
    for (const int threshold : kStudiedThresholds) {
      if (static_cast<std::size_t>(threshold) >= model.mesh.triangles.size()) continue;
      const auto most = static_cast<Index>(threshold);
      const hdb::Partition built = hdb::buildPartition(model.mesh, {.tree = tree, .threshold = most});
      const double longest = built.bounds.sizes().maxCoeff();
      for (const int part : kBoxParts) {
        cases.push_back({model.name, tree, most, part, sweepSearches(model.mesh, built, longest / part, most_places)});
      }
    }
  }
}

}  // namespace

double printedCost(TreeKind tree) { return tree == TreeKind::Bsp ? 0.8 : 0.4; }

ComplexityResults measureComplexity(const StudySettings& settings) {
  ComplexityResults results;
  report(settings.progress, "complete trees", 0.0);
  results.columns = worstColumns();
  const std::vector<Model> all = models(settings.quick);
  for (std::size_t i = 0; i < all.size(); ++i) {
    report(settings.progress, "searches in the " + all[i].name,
           0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(all.size()));
    sweepModel(all[i], settings.quick ? 100 : 1500, results.cases);
  }
  results.largest_model = all.back().name;
  return results;
}

std::vector<const SearchCase*> casesWhere(const ComplexityResults& results,
                                          const std::function<bool(const SearchCase&)>& wanted) {
  std::vector<const SearchCase*> found;
  for (const SearchCase& one : results.cases) {
    if (wanted(one)) found.push_back(&one);
  }
  return found;
}

const SearchCase& printedCase(const ComplexityResults& results, const std::string& model, TreeKind tree) {
  return *casesWhere(results, [&](const SearchCase& one) {
            return one.model == model && one.tree == tree && one.threshold == kPrintedThreshold &&
                   one.part == kPrintedPart;
          }).front();
}

}  // namespace palpate::study
