// SPDX-License-Identifier: Apache-2.0
// panvo_simulate: renders a journey through the simulated campus as a data set, or single pictures of it.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/simulation/effects.hpp"
#include "panvo/simulation/euroc_writer.hpp"
#include "panvo/simulation/sequence_file.hpp"
#include "panvo/simulation/simulation.hpp"
#include "plan_picture.hpp"

namespace panvo::simulation {

using simulated_world::campus_roads;

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  fs::path route, rig, out;
  std::vector<std::string> junctions, effects;
  std::string season = "summer", layout = "varied";
  int random_junctions = 0;
  std::string cameras = "all", format = "jpg";
  std::vector<double> pictures_s;
  bool truth_only = false, map = false;
  SimulationParameters simulation;
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Progress output: one line rewritten in place on a terminal, else a line every 10 %.
class Progress {
 public:
  /// Starts at instant `first`.
  Progress(const Simulation& simulation, std::size_t first)
      : from_s_(simulation.instants().front().t_s),
        length_s_(std::max(simulation.instants().back().t_s - from_s_, 1e-3)),
        begun_s_(first < simulation.instants().size() ? simulation.instants()[first].t_s : from_s_ + length_s_),
        is_terminal_(isatty(STDERR_FILENO) != 0) {}

  void show(double t_s) {
    const double share = (t_s - from_s_) / length_s_;
    const double wall_s = seconds_since(start_);
    if (is_terminal_ ? wall_s - last_wall_s_ < 0.5 : share - last_share_ < 0.1) return;
    last_wall_s_ = wall_s;
    last_share_ = share;
    fmt::print(stderr, "{}  rendered {:5.1f} of {:.1f} s, {:.0f} s left{}", is_terminal_ ? "\r" : "", t_s - from_s_,
               length_s_, t_s > begun_s_ ? wall_s / (t_s - begun_s_) * (from_s_ + length_s_ - t_s) : 0.0,
               is_terminal_ ? "   " : "\n");
  }

  /// Ends the line; returns the elapsed time in s.
  double finish() {
    if (is_terminal_) fmt::print(stderr, "\r\033[K");
    return seconds_since(start_);
  }

 private:
  Clock::time_point start_ = Clock::now();
  double from_s_, length_s_, begun_s_, last_wall_s_ = 0.0, last_share_ = 0.0;
  bool is_terminal_;
};

void describe_options(CLI::App& app, Options& options) {
  auto& s = options.simulation;
  app.add_option("--route", options.route, "route file, as in config/routes");
  app.add_option("--junctions", options.junctions, "custom route: comma-separated junctions")->delimiter(',');
  app.add_option("--random", options.random_junctions, "random route over this number of junctions")
      ->check(CLI::Range(2, 1000));
  app.add_option("--out", options.out, "output folder; an interrupted run resumes with the same arguments");
  app.add_option("--seed", s.seed, "seed of the world, the motion and the noise")->capture_default_str();
  app.add_option("--effects", options.effects, "comma-separated effects, see below; all, none")->delimiter(',');
  app.add_option("--rig", options.rig, "rig file, as config/rigs/paper/rig.yaml");
  app.add_option("--hilliness", s.hilliness, "0: flat, 1: hills of 8 m")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
  auto* hour =
      app.add_option("--hour", s.day.hour, "hour of the day at the start, 6 to 18")->check(CLI::Range(6.0, 18.0));
  app.add_flag("--night", s.day.night, "street lamps and lit windows instead of the sun")->excludes(hour);
  app.add_option("--season", options.season, "bare: trees without leaves; snow: also snow on what faces upwards")
      ->check(CLI::IsMember(kSeasonNames))
      ->capture_default_str();
  app.add_flag("--overcast", s.day.overcast, "a closed layer of clouds, no shadows");
  app.add_flag("--wet", s.day.wet, "after rain: roads and pavements mirror, under clouds; not in snow");
  app.add_option("--day", s.day.seed,
                 "another day on the same campus, this many days later, with other vibration, noise, traffic, clouds "
                 "and parked cars")
      ->check(CLI::Range(1, 10000));
  app.add_option("--left", s.day.left_m, "lateral offset from the middle of the lane, m; positive: left")
      ->check(CLI::Range(-1.0, 1.0))
      ->capture_default_str();
  app.add_option(
         "--layout", options.layout,
         "rows: equal buildings; twins: pairs of junctions with the same buildings; car_parks: equal bays; hall: "
         "aisles between shelves under one roof; fields: meadows, with woods in the distance")
      ->check(CLI::IsMember(kLayoutNames))
      ->capture_default_str();
  app.add_option("--vibration", s.motion.vibration, "scale of the vehicle's vibration; 0: none")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--calibration-error", s.calibration_error,
                 "error of the published stereo calibration; 1: a good one after months of driving")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--assets", s.assets, "folder of photographs, MATERIAL.jpg, in place of painted textures")
      ->check(CLI::ExistingDirectory);
  app.add_option("--start", s.start_s, "start time on the journey, s")->check(CLI::Range(0.0, 1e6));
  app.add_option("--duration", s.duration_s, "duration, s; 0: to the end")->check(CLI::Range(0.0, 1e6));
  app.add_option("--cameras", options.cameras, "cameras to render")
      ->check(CLI::IsMember({"all", "stereo", "panorama"}))
      ->capture_default_str();
  app.add_option("--format", options.format, "image format: jpg (quality 95) or png (lossless, twice the size)")
      ->check(CLI::IsMember({"jpg", "png"}))
      ->capture_default_str();
  app.add_option("--pictures", options.pictures_s, "only write single views as PNG, at these times (s)")
      ->delimiter(',');
  app.add_flag("--map", options.map, "only write plan.png: a map of the campus with the route");
  app.add_flag("--truth-only", options.truth_only, "only write sequence.yaml: the ground truth");
  std::string effects = "Effects:";
  for (const auto& effect : kEffectNames) effects += fmt::format("\n  {:<15} {}", effect.name, effect.description);
  app.footer(effects);
}

/// Combines the options. Throws if they are invalid.
void complete(Options& options) {
  auto& s = options.simulation;
  s.effects = effects_of(options.effects);
  s.day.season = season_of(options.season);
  s.layout = layout_of(options.layout);
  try {
    check_parameters(s);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  if (s.day.seed) s.start_stamp_ns += static_cast<std::int64_t>(*s.day.seed) * kDay_ns;
  s.stereo = options.cameras != "panorama";
  s.panorama = options.cameras != "stereo";
  if (!options.rig.empty()) s.rig = read_rig(options.rig);
  if (!options.junctions.empty()) {
    s.route = {"custom", options.junctions, ""};
  } else if (options.random_junctions > 0) {
    s.route = random_route(campus_roads(s.seed), options.random_junctions, s.seed);
  } else if (!options.route.empty()) {
    s.route = read_route(options.route);
  } else {
    throw std::runtime_error("no route is given; use --route FILE, --junctions LIST or --random N");
  }
}

void write_picture(const fs::path& file, const cv::Mat& image) {
  cv::Mat bgr = image;
  if (image.channels() == 3) cv::cvtColor(image, bgr, cv::COLOR_RGB2BGR);
  if (!cv::imwrite(file.string(), bgr)) throw std::runtime_error(file.string() + ": cannot be written");
}

/// Writes single views. Each is exposed several times so that exposure control settles.
void write_pictures(Simulation& simulation, const Options& options) {
  constexpr int kExposures = 8;
  fs::create_directories(options.out);
  for (const double t_s : options.pictures_s) {
    Instant instant;
    instant.t_s = t_s;
    Simulation::StereoImages eyes;
    std::vector<cv::Mat> heads;
    for (instant.stereo_frame = instant.panorama_frame = 0; *instant.stereo_frame < kExposures;
         ++*instant.stereo_frame, ++*instant.panorama_frame) {
      if (options.simulation.stereo) eyes = simulation.render_stereo(instant);
      if (options.simulation.panorama) heads = simulation.render_panorama(instant);
    }
    if (options.simulation.stereo) write_picture(options.out / fmt::format("{:07.2f}_left.png", t_s), eyes.left);
    for (std::size_t i = 0; i < heads.size(); ++i) {
      write_picture(
          options.out / fmt::format("{:07.2f}_panorama{}.png", t_s, heads.size() > 1 ? fmt::format("_{}", i) : ""),
          heads[i]);
    }
  }
}

/// Checks the disk space before rendering.
void check_space(const Simulation& simulation, std::size_t first_instant, const fs::path& folder, ImageFormat format) {
  const auto needed = estimated_bytes(simulation, first_instant, format);
  std::error_code error;
  const auto space = fs::space(fs::absolute(folder).parent_path(), error);
  if (!error && space.available < needed) {
    throw std::runtime_error(
        fmt::format("{}: about {} MB are needed, {} MB are free; use another folder, --cameras stereo or "
                    "a shorter --duration",
                    folder.string(), needed / 1'000'000, space.available / 1'000'000));
  }
}

void write_data_set(Simulation& simulation, const Options& options) {
  const auto format = options.format == "jpg" ? ImageFormat::kJpeg : ImageFormat::kPng;
  // Under another name until it is complete, so that a folder of the final name is always complete.
  const fs::path partial = options.out.string() + ".partial";
  EurocWriter writer(partial, simulation, format);
  const auto& instants = simulation.instants();
  const auto first = writer.written_before();
  check_space(simulation, first, options.out, format);
  if (first > 0) fmt::print(stderr, "  {} has {} of {} instants: resuming\n", partial.string(), first, instants.size());
  simulation.set_exposure(writer.exposure_before());
  Progress progress(simulation, first);
  for (std::size_t i = first; i < instants.size(); ++i) {
    const auto& instant = instants[i];
    if (instant.stereo_frame) writer.write(instant, simulation.render_stereo(instant));
    if (instant.panorama_frame) writer.write(instant, simulation.render_panorama(instant));
    writer.complete(instant, simulation.exposure());
    progress.show(instant.t_s);
  }
  writer.finish();
  const double wall_s = progress.finish();
  fs::remove(options.out);  // an empty folder, if there is one
  fs::rename(partial, options.out);

  const double length_s = instants.back().t_s - instants[std::min(first, instants.size() - 1)].t_s;
  const auto statistics = simulation.statistics();
  fmt::print(
      "{}: {} s of {} in {:.0f} s ({:.1f} s per second): {:.2f} million pixels and {:.2f} million rays per second, "
      "{:.2f} million triangles\n",
      options.out.string(), fmt::format("{:.1f}", length_s), options.simulation.route.name, wall_s,
      wall_s / std::max(length_s, 1e-3), 1e-6 * static_cast<double>(statistics.pixels) / wall_s,
      1e-6 * static_cast<double>(statistics.primary_rays + statistics.shadow_rays) / wall_s,
      1e-6 * static_cast<double>(statistics.triangles));
}

void run(Options& options) {
  complete(options);
  if (options.out.empty()) throw std::runtime_error("no output folder is given; use --out");
  if (options.out.filename().empty()) options.out = options.out.parent_path();  // removes a trailing slash
  if (options.pictures_s.empty() && !options.truth_only && !options.map && fs::exists(options.out) &&
      !(fs::is_directory(options.out) && fs::is_empty(options.out))) {
    throw std::runtime_error(options.out.string() + ": exists and is not empty; choose a new folder");
  }
  if (const auto parent = fs::absolute(options.out).parent_path(); !fs::is_directory(parent)) {
    std::error_code error;
    fs::create_directories(parent, error);
    if (error) throw std::runtime_error(parent.string() + ": cannot be created (" + error.message() + ")");
  }
  if (options.map) {
    fs::create_directories(options.out);
    const auto roads = campus_roads(options.simulation.seed);
    write_picture(options.out / "plan.png", plan_picture(roads, drive(roads, options.simulation.route)));
    return;
  }
  const auto start = Clock::now();
  fmt::print(stderr, "  building the campus of seed {} ...", options.simulation.seed);
  Simulation simulation(options.simulation);
  fmt::print(stderr, " {:.1f} s; {}: {:.0f} m in {:.0f} s, {} instants\n", seconds_since(start),
             options.simulation.route.name, simulation.motion().travelled_m(simulation.motion().duration_s()),
             simulation.motion().duration_s(), simulation.instants().size());
  if (options.truth_only) {
    fs::create_directories(options.out);
    std::ofstream file(options.out / "sequence.yaml");
    file << sequence_yaml(simulation) << std::flush;
    if (!file) throw std::runtime_error((options.out / "sequence.yaml").string() + ": cannot be written");
  } else if (!options.pictures_s.empty()) {
    write_pictures(simulation, options);
  } else {
    write_data_set(simulation, options);
  }
}

}  // namespace
}  // namespace panvo::simulation

int main(int argc, char** argv) {
  CLI::App app(
      "Renders a journey through a simulated campus (stereo pairs, panoramas, ground truth) as a EuRoC/ASL data set");
  panvo::simulation::Options options;
  panvo::simulation::describe_options(app, options);
  try {
    app.parse(argc, argv);
    panvo::simulation::run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "panvo_simulate: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
