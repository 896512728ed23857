// The reference unit of tools/weight: it measures the compiler and the machine, never Palpate. It reads the standard
// library alone, makes some of its heavier templates and takes about three seconds. Leave it as it is: every figure of
// weights.toml is a multiple of it.
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

int main() {
  const std::regex pattern("a(b|c)*d");
  std::vector<std::string> lines{"abd", "acd", "ad"};
  std::sort(lines.begin(), lines.end());
  std::stable_sort(lines.begin(), lines.end(), std::greater<>());
  std::map<std::string, std::size_t> lengths;
  std::unordered_map<std::string, std::variant<int, double, std::string>> values;
  for (const std::string& line : lines) {
    lengths[line] = line.size();
    if (std::regex_search(line, pattern)) values[line] = line;
  }
  const auto shared = std::make_shared<std::function<int(int)>>([](int i) { return i + 1; });
  for (const auto& [name, value] : values) {
    std::visit([&name = name](const auto& held) { std::cout << name << ' ' << held << '\n'; }, value);
  }
  return (*shared)(static_cast<int>(lengths.size())) == 4 ? 0 : 1;
}
