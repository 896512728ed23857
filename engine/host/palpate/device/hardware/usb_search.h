// Finds a maker's USB devices that are plugged in, and whether this user may open them: read from /sys and /dev, where
// the kernel lists them, without a library and without opening anything.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::device {

struct UsbDevice {
  std::string vendor_id;   ///< four hexadecimal digits
  std::string product_id;  ///< likewise
  std::string maker;       ///< as the device calls it
  std::string product;
  std::filesystem::path node;  ///< file that has to be opened
  bool may_open = false;       ///< this user may read and write the node
};

/// Marks of a device: words of its maker or product, in small letters, or its numbers "0403:cb48".
struct UsbMarks {
  std::vector<std::string> words;
  std::vector<std::string> numbers;
};

/// Devices that bear one of the marks. `root` replaces the file system's root. Empty without /sys.
std::vector<UsbDevice> usbDevices(const UsbMarks& marks, const std::filesystem::path& root = "/");

/// "Force Dimension omega.3 (1a2b:3c4d) at /dev/bus/usb/001/004, no permission"
std::string describe(const UsbDevice& device);

/// How to let all users of the machine open it: a file of a udev rule, its line, and what to run.
std::string udevRemedy(const UsbDevice& device, std::string_view rule_name);

/// Files of /dev whose names begin so, with whether this user may open them: serial ports that a driver uses.
std::vector<UsbDevice> deviceNodes(std::span<const std::string> beginnings, const std::filesystem::path& root = "/");

}  // namespace palpate::device
