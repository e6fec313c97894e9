// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>

#include "panvo/v4l2_camera/device_list.hpp"

int main(int argc, char** argv) {
  using namespace panvo;
  CLI::App app("Lists the V4L2 cameras: USB cameras, frame grabbers.", "panvo_devices_v4l2");
  bool as_json = false, simulated = false;
  app.add_flag("--json", as_json, "print a JSON list, for scripts");
  app.add_flag("--simulated", simulated, "no effect: load the kernel module vivid for simulated V4L2 cameras");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const auto devices = v4l2_camera::find_devices();
  const std::string text = as_json ? camera_stream::to_json(devices) : camera_stream::to_text(devices);
  std::fputs(text.c_str(), stdout);
  return 0;
}
