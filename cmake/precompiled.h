// Precompiled for every target of this project: the headers that almost every file includes and that take longest to
// parse (Eigen is 2 s of a file's 3). Do not include this file or rely on it: the check of the public headers compiles
// each without it.
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
