// /sys/bus/usb/devices/*/{idVendor,idProduct,manufacturer,product,busnum,devnum} -> /dev/bus/usb/BBB/DDD. Cold path.
#include "palpate/device/hardware/usb_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/system/files.h"
#include "palpate/base/text.h"

namespace palpate::device {

namespace {

namespace fs = std::filesystem;

/// The kernel's attributes are pages.
constexpr std::uint64_t kMaxAttributeBytes = 1u << 16;

std::string readAttribute(const fs::path& device, const char* name) {
  try {
    return oneLine(trimmed(readFile(device / name, kMaxAttributeBytes)));
  } catch (const Error&) {
    return {};  // not every device has every attribute
  }
}

bool matchesMarks(const UsbDevice& device, const UsbMarks& marks) {
  const std::string name = inSmallLetters(device.maker + " " + device.product);
  const auto named = [&](const std::string& word) { return name.find(word) != std::string::npos; };
  const std::string number = inSmallLetters(device.vendor_id + ":" + device.product_id);
  return std::any_of(marks.words.begin(), marks.words.end(), named) ||
         std::find(marks.numbers.begin(), marks.numbers.end(), number) != marks.numbers.end();
}

fs::path busNode(const fs::path& attributes, const fs::path& root) {
  const std::optional<double> bus = parseNumber(readAttribute(attributes, "busnum"));
  const std::optional<double> number = parseNumber(readAttribute(attributes, "devnum"));
  if (!bus || !number) return {};
  return root / fmt::format("dev/bus/usb/{:03.0f}/{:03.0f}", *bus, *number);
}

/// In the order of their names; empty where the folder cannot be read.
std::vector<fs::path> listEntries(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

std::vector<UsbDevice> usbDevices(const UsbMarks& marks, const fs::path& root) {
  std::vector<UsbDevice> found;
  for (const fs::path& attributes : listEntries(root / "sys/bus/usb/devices")) {
    UsbDevice device;
    device.vendor_id = readAttribute(attributes, "idVendor");
    if (device.vendor_id.empty()) continue;  // an interface of a device, not one itself
    device.product_id = readAttribute(attributes, "idProduct");
    device.maker = readAttribute(attributes, "manufacturer");
    device.product = readAttribute(attributes, "product");
    if (!matchesMarks(device, marks)) continue;
    device.node = busNode(attributes, root);
    device.may_open = system::mayReadAndWrite(device.node);
    found.push_back(std::move(device));
  }
  return found;
}

std::vector<UsbDevice> deviceNodes(std::span<const std::string> beginnings, const fs::path& root) {
  std::vector<UsbDevice> found;
  for (const fs::path& node : listEntries(root / "dev")) {
    const std::string name = node.filename().string();
    const auto begins = [&](const std::string& beginning) { return name.starts_with(beginning); };
    if (!std::any_of(beginnings.begin(), beginnings.end(), begins)) continue;
    UsbDevice device;
    device.node = node;
    device.may_open = system::mayReadAndWrite(node);
    found.push_back(std::move(device));
  }
  return found;
}

std::string describe(const UsbDevice& device) {
  std::string text;
  if (!device.vendor_id.empty()) {
    text = fmt::format("{} {} ({}:{}) at ", device.maker.empty() ? "USB device" : device.maker, device.product,
                       device.vendor_id, device.product_id);
  }
  return text + device.node.string() + (device.may_open ? "" : ", no permission to open it");
}

std::string udevRemedy(const UsbDevice& device, std::string_view rule_name) {
  const std::string rule =
      device.vendor_id.empty()
          ? fmt::format(R"(KERNEL=="{}", MODE="0660", TAG+="uaccess")", device.node.filename().string())
          : fmt::format(R"(SUBSYSTEM=="usb", ATTR{{idVendor}}=="{}", MODE="0660", TAG+="uaccess")", device.vendor_id);
  return fmt::format(
      "write the line  {}  into /etc/udev/rules.d/70-{}.rules, run  sudo udevadm control --reload && sudo udevadm "
      "trigger  and plug the device in again",
      rule, rule_name);
}

}  // namespace palpate::device
