// SPDX-License-Identifier: Apache-2.0
// panvo_calibration_images: extracts images of a bag for panvo_calibrate; simultaneous images get equal file names.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>

#include "bag_images.hpp"
#include "panvo/calibration/calibration_error.hpp"

namespace {

using namespace panvo::calibration;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2 };

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Extracts images of a bag to files. Simultaneous images get equal names.", "panvo calibrate images");
  BagImages settings;
  std::vector<std::string> topics;
  double every_s = 1.0;
  double tolerance_ms = 5.0;
  app.add_option("bag", settings.bag, "bag with the images of all cameras, e.g. from panvo record")->required();
  app.add_option("--out", settings.out, "output folder; files are NAME/STAMP.png")->required();
  app.add_option("--topics", topics,
                 "NAME:=TOPIC of each camera (default: every */image_raw, named after its namespace)")
      ->delimiter(',');
  app.add_option("--every", every_s, "seconds between images")->check(CLI::NonNegativeNumber)->capture_default_str();
  app.add_option("--tolerance-ms", tolerance_ms, "largest stamp difference of simultaneous images")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    for (const auto& topic : topics) settings.cameras.push_back(parse_named_topic(topic));
    settings.every_ns = std::llround(1e9 * every_s);
    settings.tolerance_ns = std::llround(1e6 * tolerance_ms);
    const auto written = write_images(settings);
    for (std::size_t i = 0; i < written.size(); ++i)
      std::printf("%s: %zu images in %s\n", settings.cameras[i].topic.c_str(), written[i],
                  (settings.out / settings.cameras[i].name).c_str());
    return kSuccess;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo calibrate images: %s\n", error.what());
    return kFailed;
  }
}
