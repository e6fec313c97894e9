// SPDX-License-Identifier: Apache-2.0
// panvo_evaluate_journey: compares a journey of the enhanced odometry with ground truth.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "panvo/evaluation/drive_page.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"
#include "panvo/evaluation/journey_page.hpp"
#include "panvo/evaluation/journey_video.hpp"
#include "panvo/evaluation/output_file.hpp"
#include "panvo/evaluation/plot.hpp"
#include "panvo/evaluation/run_folder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace panvo::evaluation;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2, kNoPlot = 3 };

struct Arguments {
  std::string run;
  std::string recording;
  std::string earlier;
  std::string paper_run;
  std::string out;
  std::string title;
  std::string video;
  double video_speed = 4.0;
  bool only_table = false;
  bool partial = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("run", arguments.run, "run folder of enhanced_vo or stereo_places, from `panvo run --out`")
      ->required();
  app.add_option("--recording", arguments.recording,
                 "recording that was played: EuRoC/ASL data set with ground truth and, for revisits and pictures, "
                 "sequence.yaml and cam2 (default: the ground truth in the run folder)");
  app.add_option("--earlier", arguments.earlier,
                 "for a second journey: recording that built the landmark store; its start is the origin of the map");
  app.add_option("--paper-run", arguments.paper_run,
                 "run of the same recording with the paper's own correction, for comparison");
  app.add_option("--out", arguments.out,
                 "folder for report.html, drive.html, journey.json and pictures (default: the run folder)");
  app.add_option("--title", arguments.title, "title (default: names of recording and run)");
  app.add_option("--video", arguments.video,
                 "also write a video of the drive to this file (.mp4, .webm); needs ffmpeg");
  app.add_option("--video-speed", arguments.video_speed, "speed of the video relative to the drive (default: 4)")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_flag("--partial", arguments.partial, "also accept an interrupted run");
  app.add_flag("--only-table", arguments.only_table, "only print the tables, write no files");
}

std::string default_title(const JourneyRun& run, const JourneyRecording& recording) {
  const auto name = fs::weakly_canonical(recording.folder).filename().string();
  return name == run.name ? name : name + ", run " + run.name;
}

void write_drive_page(const JourneyReport& report, const fs::path& file) {
  const auto page = live_page_folder();
  if (page.empty()) {
    std::cout << "left out: drive.html, because the page of the web view was not built (panvo setup page)\n";
    return;
  }
  write_output(file, drive_page(report, page));
  std::cout << "written: " << file.string() << " (the live page, with a cursor that moves along the drive)\n"
            << std::flush;
}

int run(const Arguments& arguments) {
  if (!arguments.partial) require_finished(arguments.run);
  const auto journey = read_journey_run(arguments.run);
  const auto recording = read_journey_recording(arguments.recording.empty() ? arguments.run : arguments.recording);
  std::optional<JourneyRecording> earlier;
  if (!arguments.earlier.empty()) earlier = read_journey_recording(arguments.earlier);
  std::optional<JourneyRun> paper;
  if (!arguments.paper_run.empty()) paper = read_journey_run(arguments.paper_run);

  const auto* library = earlier ? &*earlier : nullptr;
  JourneyReport report{arguments.title.empty() ? default_title(journey, recording) : arguments.title,
                       evaluate_run(journey, recording, library),
                       {},
                       earlier.has_value()};
  if (paper) report.paper_run.emplace(evaluate_run(*paper, recording, library));
  std::cout << journey_table(report) << std::flush;
  if (arguments.only_table) return kSuccess;

  const fs::path folder = arguments.out.empty() ? arguments.run : arguments.out;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder, "cannot be created: " + error.message(), "choose another folder with --out");
  write_output(folder / "journey.json", journey_json(report));
  write_output(folder / "report.html", journey_page(report));
  std::cout << "\nwritten: " << (folder / "report.html").string() << " (opens in any browser), journey.json\n"
            << std::flush;
  write_drive_page(report, folder / "drive.html");
  draw_journey(report, folder);
  if (!arguments.video.empty()) {
    write_video(report.run, arguments.video, arguments.video_speed);
    std::cout << "written: " << arguments.video << '\n';
  }
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Compares a journey of the enhanced odometry with ground truth: error before and after each revisit, times, "
      "trajectories and azimuth, Tables 2 to 4 of [Lu2015], and an HTML report",
      "panvo evaluate journey");
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  try {
    return run(arguments);
  } catch (const PlotError& error) {
    std::cerr << "panvo evaluate journey: " << error.what() << '\n';
    return kNoPlot;
  } catch (const std::exception& error) {
    std::cerr << "panvo evaluate journey: " << error.what() << '\n';
    return kFailed;
  }
}
