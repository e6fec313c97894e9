// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>

#include "panvo/aravis_camera/device_list.hpp"

int main(int argc, char** argv) {
  using namespace panvo;
  CLI::App app("Lists the GigE Vision and USB3 Vision cameras that respond.", "panvo_devices_aravis");
  bool as_json = false, simulated = false;
  app.add_flag("--json", as_json, "print a JSON list, for scripts");
  app.add_flag("--simulated", simulated, "include Aravis's simulated camera");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (simulated) aravis_camera::enable_simulated_camera();
  const auto devices = aravis_camera::find_devices();
  const std::string text = as_json ? camera_stream::to_json(devices) : camera_stream::to_text(devices);
  std::fputs(text.c_str(), stdout);
  return 0;
}
