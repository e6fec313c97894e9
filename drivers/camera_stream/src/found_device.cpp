// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/found_device.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "panvo/runtime/printable.hpp"

namespace panvo::camera_stream {
namespace {

/// A text of the device, on one line: any host of the network can answer the search for cameras.
std::string shown(const std::string& text) {
  std::string line = runtime::printable(text);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

}  // namespace

std::string to_text(const std::vector<FoundDevice>& devices) {
  std::string text;
  for (const auto& device : devices) {
    text +=
        fmt::format("{}  {} {}  ({}, {}; driver {})\n", device.serial.empty() ? "no serial" : shown(device.serial),
                    shown(device.vendor), shown(device.model), device.protocol, shown(device.address), device.driver);
    if (!device.formats.empty())
      text += fmt::format("    formats: {}\n", shown(fmt::format("{}", fmt::join(device.formats, ", "))));
    if (!device.sizes.empty()) text += fmt::format("    sizes:   {}\n", device.sizes);
    if (!device.rates.empty()) text += fmt::format("    rates:   {}\n", device.rates);
    if (!device.problem.empty()) text += fmt::format("    {}\n", shown(device.problem));
  }
  return text;
}

std::string to_json(const std::vector<FoundDevice>& devices) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& device : devices) {
    list.push_back({{"driver", device.driver},
                    {"protocol", device.protocol},
                    {"vendor", device.vendor},
                    {"model", device.model},
                    {"serial", device.serial},
                    {"address", device.address},
                    {"formats", device.formats},
                    {"sizes", device.sizes},
                    {"rates", device.rates},
                    {"problem", device.problem}});
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace panvo::camera_stream
