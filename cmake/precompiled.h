// Precompiled for every target of this project: what almost every file includes and the compiler takes longest to
// read (Eigen is 2 s of a file's 3). Nobody includes this by name, and no header relies on it: the check of the public
// headers compiles each without it.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>
