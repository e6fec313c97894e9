// SPDX-License-Identifier: Apache-2.0
// panvo_calibrate: calibrates lenses and poses of cameras from images of a board.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "panvo/vision/lens_models.hpp"

namespace {

using namespace panvo::calibration;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2, kStale = 3 };

void add_board(CLI::App& command, Arguments& arguments) {
  command
      .add_option("--board", arguments.board,
                  "chessboard:COLUMNSxROWS:SQUARE (inner corners, m), or "
                  "charuco:COLUMNSxROWS:SQUARE:MARKER[:DICTIONARY] (squares, m)")
      ->required();
}

void add_images(CLI::App& command, Arguments& arguments, const std::string& what) {
  command.add_option("images", arguments.images, what)->required();
  add_board(command, arguments);
}

/// Adds the alternatives: a folder of images, or live topics.
void add_sources(CLI::App& command, Arguments& arguments, const std::string& what, const std::string& topics) {
  auto* images = command.add_option("images", arguments.images, what);
  add_board(command, arguments);
  auto& live = arguments.live;
  auto* option = command
                     .add_option("--topics", live.topics,
                                 topics +
                                     ": collect images from live topics until there are enough views; they are kept "
                                     "in OUT/images")
                     ->delimiter(',')
                     ->excludes(images);
  command.add_option("--views", live.max_views, "live topics: maximum number of views")
      ->check(CLI::Range(1, 10000))
      ->needs(option)
      ->capture_default_str();
  command.add_option("--for", live.limit_s, "live topics: time limit in seconds")
      ->check(CLI::Range(1.0, 86400.0))
      ->needs(option)
      ->capture_default_str();
  command.add_option("--timeout", live.timeout_s, "live topics: seconds to wait for publishers and for images")
      ->check(CLI::Range(0.1, 3600.0))
      ->needs(option)
      ->capture_default_str();
  command
      .add_option("--tolerance-ms", live.tolerance_ms, "live topics: largest stamp difference of simultaneous images")
      ->check(CLI::Range(0.0, 1e6))
      ->needs(option)
      ->capture_default_str();
  command.final_callback([&arguments] {
    if (arguments.images.empty() && arguments.live.topics.empty())
      throw CLI::RequiredError("images (a folder) or --topics (live)");
  });
}

void add_model(CLI::App& command, Arguments& arguments) {
  std::vector<std::string> names;
  std::string help = "lens model:";
  for (const auto model : panvo::vision::kLensModels) {
    panvo::vision::visit_lens(model, [&](const auto& formula) {
      help.append(names.empty() ? " " : ", ").append(formula.kName).append(" (").append(formula.kPurpose).append(")");
      names.emplace_back(formula.kName);
    });
  }
  command.add_option("--model", arguments.model, help)->check(CLI::IsMember(names))->capture_default_str();
}

void add_out(CLI::App& command, Arguments& arguments, const std::string& what) {
  command.add_option("--out", arguments.out, what)->required();
}

void add_reference(CLI::App& command, Arguments& arguments) {
  command.add_option("--reference", arguments.reference,
                     "camera that defines the reference frame (default: the first)");
  command.add_option("--cameras", arguments.cameras, "folders of IMAGES to use: left,right,head_0 (default: all)")
      ->delimiter(',');
  command
      .add_option("--mount", arguments.mount,
                  "pose of the reference camera on base_link: x,y,z in m; roll,pitch,yaw in degrees. extrinsics.yaml "
                  "gives the resulting mount of each camera")
      ->delimiter(',')
      ->expected(6);
}

void describe(CLI::App& app, Arguments& arguments) {
  app.require_subcommand(1);
  auto* stereo =
      app.add_subcommand("stereo", "calibrate and rectify a stereo pair: left.yaml, right.yaml, report.html");
  add_sources(*stereo, arguments,
              "folder of images: left*.png and right*.png, or folders left/ and right/ (or cam0/ and cam1/)",
              "LEFT RIGHT, or left:=LEFT right:=RIGHT");
  add_model(*stereo, arguments);
  add_out(*stereo, arguments, "output folder");
  stereo->add_option("--start", arguments.calibration, "folder of left.yaml and right.yaml with initial values");

  auto* rig = app.add_subcommand(
      "rig",
      "calibrate a rig whose neighbouring cameras see the board together: NAME.yaml, extrinsics.yaml, panorama.yaml");
  add_sources(*rig, arguments, "folder with an image folder for each camera; files with equal names form a set",
              "NAME:=TOPIC of each camera, or TOPIC of the form .../NAME/image_raw");
  add_model(*rig, arguments);
  add_out(*rig, arguments, "output folder");
  add_reference(*rig, arguments);

  auto* extrinsics =
      app.add_subcommand("extrinsics", "estimate the poses of cameras with calibrated lenses: extrinsics.yaml");
  add_sources(*extrinsics, arguments, "folder with an image folder for each camera; files with equal names form a set",
              "NAME:=TOPIC of each camera, or TOPIC of the form .../NAME/image_raw");
  extrinsics
      ->add_option("--calibration", arguments.calibration, "folder with the camera_info file NAME.yaml of each camera")
      ->required();
  add_out(*extrinsics, arguments, "output folder");
  add_reference(*extrinsics, arguments);

  auto* check =
      app.add_subcommand("check", "check whether the calibration of a pair is still valid; exit status 3 if not");
  add_images(*check, arguments, "folder of images, as for stereo");
  check->add_option("--calibration", arguments.calibration, "folder with left.yaml and right.yaml")->required();
  check->add_option("--limit-px", arguments.limit_px, "largest accepted epipolar residual (rms)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();

  auto* convert = app.add_subcommand(
      "convert", "convert a Kalibr camchain YAML to camera_info files, or a folder of these to a camchain");
  convert
      ->add_option("input", arguments.images,
                   "camchain YAML, or folder with left.yaml and right.yaml or extrinsics.yaml")
      ->required();
  add_out(*convert, arguments, "output folder, or the camchain YAML to write");

  auto* board = app.add_subcommand("board", "write the board as SVG in true size, to print at 100 %");
  add_board(*board, arguments);
  add_out(*board, arguments, "output file, e.g. board.svg");
}

int run(const CLI::App& app, const Arguments& arguments) {
  if (app.got_subcommand("stereo")) calibrate_stereo(arguments);
  if (app.got_subcommand("rig")) calibrate_rig(arguments);
  if (app.got_subcommand("extrinsics")) calibrate_extrinsics(arguments);
  if (app.got_subcommand("convert")) convert(arguments);
  if (app.got_subcommand("board")) draw(arguments);
  if (app.got_subcommand("check") && !check_stereo(arguments)) return kStale;
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Calibrates cameras from images of a chessboard or ChArUco board.", "panvo calibrate");
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
    return run(app, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo calibrate: %s\n", error.what());
    return kFailed;
  }
}
