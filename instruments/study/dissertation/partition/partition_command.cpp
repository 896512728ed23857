// `palpate study partition MESH`: builds the dissertation's partition of a mesh, describes it, and queries it for the
// triangles in a haptic detecting box.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "dissertation/command/commands.h"
#include "dissertation/partition/partition_report.h"
#include "lab/commands/bench_arguments.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"
#include "palpate/hdb/literal_octree.h"

namespace palpate::app {

namespace {

using hdb::HdbSize;

constexpr const char* kBox = "--box";

struct BoxArgument {
  Vec3 centre;
  std::optional<double> edge_mm;
};

/// x,y,z or x,y,z,edge
BoxArgument parseBox(const std::string& text) {
  const std::vector<double> numbers = numbersFrom(kBox, text, between(-kFarthestMm, kFarthestMm, "mm"));
  if (numbers.size() != 3 && numbers.size() != 4) throw UsageError(kBox, "expected x,y,z or x,y,z,edge in mm");
  BoxArgument box{{numbers[0], numbers[1], numbers[2]}, {}};
  if (numbers.size() == 4) box.edge_mm = numbers[3];
  if (box.edge_mm && !(*box.edge_mm > 0.0)) throw UsageError(kBox, "the edge must be larger than 0 mm");
  return box;
}

struct PartitionArguments {
  MeshArguments mesh;
  hdb::BuildSettings settings;
  bool two_of_three = false;
  std::optional<BoxArgument> box;
  HdbSize box_size = HdbSize::QuarterOfLongestEdge;
  LeafSearch traversal;
  std::string leaves_file, selection_file;
  std::vector<std::string> pictures;
  std::string side = "oblique";
  bool json = false;
};

const Choices<LeafSearch>& traversals() {
  static const Choices<LeafSearch> all = [] {
    Choices<LeafSearch> choices;
    for (const auto& [word, literal] : makeChoices<std::optional<hdb::LiteralTraversal>>()) {
      choices.push_back({word, {false, literal}});
    }
    choices.insert(choices.begin() + 1, {"sphere", {true, {}}});
    return choices;
  }();
  return all;
}

std::string nameOf(const LeafSearch& search) {
  for (const auto& [name, choice] : traversals()) {
    if (choice == search) return name;
  }
  return {};
}

/// Checks options before a large mesh is loaded.
void checkChoices(const PartitionArguments& arguments) {
  for (const std::string& picture : arguments.pictures) isSvgPicture(picture);
  const bool octree = arguments.settings.tree == hdb::TreeKind::Octree;
  const bool majority = arguments.settings.assignment == hdb::Assignment::Majority;
  if (arguments.two_of_three && !(octree && majority)) {
    throw Error("--octree-rule two-of-three is a rule of the octree with assignment C");
  }
  const LeafSearch& search = arguments.traversal;
  if (search.literal && !suits(*search.literal, arguments.settings.tree)) {
    throw Error("--traversal " + nameOf(search) + " needs --tree bsp, for its planes");
  }
  if (!arguments.box && !arguments.selection_file.empty()) throw Error("--selection needs a --box");
}

struct Built {
  hdb::Partition partition;
  std::optional<std::size_t> lost;
  double seconds = 0.0;
};

Built build(const mesh::TriangleMesh& mesh, const PartitionArguments& arguments, const Progress& progress) {
  const auto start = Clock::now();
  Built built;
  if (arguments.two_of_three) {
    hdb::LiteralOctree literal = hdb::buildLiteralOctree(mesh, arguments.settings, progress);
    built.partition = std::move(literal.partition);
    built.lost = literal.lost.size();
  } else {
    built.partition = hdb::buildPartition(mesh, arguments.settings, progress);
  }
  built.seconds = secondsSince(start);
  return built;
}

PartitionReport::Box askBox(const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                            const PartitionArguments& arguments) {
  const BoxArgument& wanted = *arguments.box;
  PartitionReport::Box box;
  box.centre_mm = wanted.centre;
  box.edges_mm =
      wanted.edge_mm ? Vec3(Vec3::Constant(*wanted.edge_mm)) : hdb::hdbEdges(partition.bounds, arguments.box_size);
  box.traversal = nameOf(arguments.traversal);
  box.query = askPartition(mesh, partition, hdb::hapticBox(box.centre_mm, box.edges_mm), arguments.traversal);
  return box;
}

const Choices<PartitionSight>& sights() {
  static const Choices<PartitionSight> all = {{"oblique", {}},
                                              {"back", {Vec3::UnitZ(), Vec3::UnitY()}},
                                              {"left", {-Vec3::UnitX(), Vec3::UnitY()}},
                                              {"right", {Vec3::UnitX(), Vec3::UnitY()}},
                                              {"above", {Vec3::UnitY(), Vec3::UnitZ()}},
                                              {"front", {-Vec3::UnitZ(), Vec3::UnitY()}}};
  return all;
}

void writePictures(const PartitionArguments& arguments, const figures::Figure& figure) {
  for (const std::string& file : arguments.pictures) {
    isSvgPicture(file) ? figures::writeSvg(figure, file) : figures::writePng(figure, file);
  }
}

void runPartition(const PartitionArguments& arguments) {
  checkChoices(arguments);
  ProgressLine progress;
  const mesh::TriangleMesh mesh = meshFrom(arguments.mesh.file, arguments.mesh.options, progress.callback());
  const Built built = build(mesh, arguments, progress.callback());
  PartitionReport report{.mesh = arguments.mesh.file,
                         .triangles = mesh.triangles.size(),
                         .settings = arguments.settings,
                         .statistics = bench::statisticsOf(built.partition),
                         .build_seconds = built.seconds,
                         .lost = built.lost,
                         .box = {}};
  if (arguments.box) report.box = askBox(mesh, built.partition, arguments);
  if (!arguments.leaves_file.empty()) writeLeafColours(arguments.leaves_file, mesh, built.partition);
  if (!arguments.selection_file.empty()) {
    const PartitionQuery& query = report.box->query;
    writeSelection(arguments.selection_file, mesh, built.partition, query.leaves.leaves, query.exact);
  }
  if (!arguments.pictures.empty()) {
    progress.show("drawing", 0.0);
    const auto sight = std::ranges::find(sights(), arguments.side, &Choices<PartitionSight>::value_type::first);
    writePictures(arguments, partitionFigure(mesh, built.partition, report, sight->second));
  }
  progress.clear();
  fmt::print("{}", arguments.json ? jsonDump(toJson(report), 2) + "\n" : textOf(report));
}

void addBoxOptions(Command& command, PartitionArguments& arguments) {
  const auto read = [&arguments](const std::string& text) { arguments.box = parseBox(text); };
  command
      .add_option_function(kBox, read,
                           "Haptic detecting box: centre and edge (mm) (default edge: a quarter of the model)")
      ->type_name("X,Y,Z[,EDGE]");
  addChoice<HdbSize>(command, "--box-size", arguments.box_size,
                     {{"longest-edge", HdbSize::QuarterOfLongestEdge}, {"box", HdbSize::QuarterOfBox}},
                     "Size that the quarter refers to: the model's longest edge, for a cube, or its box (E12)");
  addChoice<LeafSearch>(command, "--traversal", arguments.traversal, traversals(),
                        "How leaves are found: by tight boxes, which misses nothing; by a sphere in the box; or as "
                        "printed: else-if (E4), half-space (E10), cell-box (E5), sphere-corners (E11)");
}

}  // namespace

void addPartitionCommand(Command& study) {
  const auto [command, arguments] = addCommand(
      study, "partition", "Divide a mesh by a BSP tree or an octree and find the triangles in a box", runPartition);
  addMeshArguments(command, arguments.mesh);
  command.get_option("mesh")->description(kMeshNamesHelp);
  addPartitionSettings(command, arguments.settings);
  addChoice<bool>(command, "--octree-rule", arguments.two_of_three, {{"majority", false}, {"two-of-three", true}},
                  "Assignment C in the octree: majority by axes, or two of three vertices in an octant as printed, "
                  "which loses triangles (E6)");
  addBoxOptions(command, arguments);
  namesFileToWrite(command.add_option("-o,--out", arguments.pictures,
                                      "Picture to write (.png or .svg), repeatable: leaves in different colours, the "
                                      "leaves' boxes and, with --box, what the box finds"))
      ->allow_extra_args(false);
  restrictTo(choiceNames(sights()),
             command.add_option("--view", arguments.side, "Side to draw the picture from")->capture_default_str());
  command.add_option("--leaf-colours", arguments.leaves_file, "Write a PLY with each leaf in a different colour");
  command.add_option("--selection", arguments.selection_file,
                     "Write a PLY with the box's leaves in green and its exact triangles in orange");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
