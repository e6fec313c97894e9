// SPDX-License-Identifier: Apache-2.0
// panvo_places: recognises places in plain folders of panoramas.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "answer_text.hpp"
#include "contact_sheet.hpp"
#include "panvo/places/image_folder.hpp"
#include "panvo/places/place_finder.hpp"
#include "panvo/places/place_library.hpp"

namespace {

namespace fs = std::filesystem;
using namespace panvo::places;

enum ExitStatus { kWell = 0, kSkipped = 1, kError = 2 };

struct Arguments {
  std::string folder, library, out, poses, mask;
  double top_deg = -1.0, bottom_deg = -1.0;
  double false_alarms = 1e-3;
  int max_verified = PlaceFinderParameters{}.max_verified;
  bool as_json = false;
};

/// How the images of a folder are read.
struct Reading {
  std::optional<ElevationRange> range;
  cv::Mat mask;
};

Reading reading_of(const Arguments& arguments) {
  Reading reading;
  if ((arguments.top_deg < 0.0) != (arguments.bottom_deg < 0.0)) {
    throw FolderError("--top and --bottom belong together: the elevations of the first and last row");
  }
  if (arguments.top_deg >= 0.0) reading.range = ElevationRange{arguments.top_deg, arguments.bottom_deg};
  if (!arguments.mask.empty()) {
    reading.mask = cv::imread(arguments.mask, cv::IMREAD_GRAYSCALE);
    if (reading.mask.empty())
      throw FolderError(arguments.mask + ": cannot be decoded; a mask is an image, black on the vehicle");
  }
  return reading;
}

int build(const Arguments& arguments) {
  const auto reading = reading_of(arguments);
  std::vector<KnownPlace> places;
  int skipped = 0;
  for (const auto& image : read_image_folder(arguments.folder, arguments.poses)) {
    const auto name = image.file.filename().string();
    const auto fitted = read_panorama(image.file, reading.range, reading.mask);
    if (fitted.fault) {
      std::fprintf(stderr, "%s: skipped: %s\n", image.file.c_str(), fitted.fault->c_str());
      ++skipped;
      continue;
    }
    places.push_back(make_place(name, fitted.image));
    places.back().map_from_base = image.map_from_base;
  }
  if (places.empty()) throw FolderError(arguments.folder + ": no image can be used; see above");
  const int metric = triangulate_places(places);
  save_places(arguments.out, places);
  std::printf("%s: %zu places, %d images skipped; %d places give positions in metres%s\n", arguments.out.c_str(),
              places.size(), skipped, metric, metric == 0 ? " (that needs poses less than 6 m apart)" : "");
  return skipped == 0 ? kWell : kSkipped;
}

std::vector<FolderImage> images_of(const std::string& path) {
  if (fs::is_regular_file(path)) return {{path, {}, {}}};
  return read_image_folder(path, {});
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text).flush())
    throw FolderError(file.string() + ": cannot be written; check the folder and the free disk space");
}

void write_sheet(const fs::path& folder, std::size_t number, const PanoramaImage& image, const ImageAnswer& answer,
                 const std::vector<KnownPlace>& places) {
  const auto file = folder / fmt::format("match_{:04}.jpg", number);
  if (!cv::imwrite(file.string(), draw_match(image, answer.answer, places, line_of(answer, places)))) {
    throw FolderError(file.string() + ": cannot be written; check the folder and the free disk space");
  }
}

int match(const Arguments& arguments) {
  const auto reading = reading_of(arguments);
  PlaceFinderParameters parameters;
  parameters.view.log10_false_alarms = std::log10(arguments.false_alarms);
  parameters.max_verified = arguments.max_verified;
  const PlaceFinder finder(load_places(arguments.library), parameters);
  const auto images = images_of(arguments.folder);
  if (!arguments.out.empty()) fs::create_directories(arguments.out);
  if (!arguments.as_json) {
    const bool has_metres = std::any_of(finder.places().begin(), finder.places().end(), [](const KnownPlace& place) {
      return std::any_of(place.keypoints.begin(), place.keypoints.end(),
                         [](const auto& keypoint) { return keypoint.has_point; });
    });
    std::printf("# heading and direction: left positive, from straight ahead of the place; %s\n",
                has_metres ? "positions in metres by the poses of the library" : "bearings only: no metres");
  }
  auto json = nlohmann::json::array();
  std::string csv = csv_header();
  std::size_t found = 0, skipped = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    ImageAnswer answer{images[i].file.filename().string(), {}, {}};
    const auto fitted = read_panorama(images[i].file, reading.range, reading.mask);
    answer.fault = fitted.fault;
    if (fitted.fault) {
      std::fprintf(stderr, "%s: skipped: %s\n", images[i].file.c_str(), fitted.fault->c_str());
      ++skipped;
    } else {
      answer.answer = finder.find(fitted.image);
      found += answer.answer.place ? 1 : 0;
      if (!arguments.out.empty()) write_sheet(arguments.out, i, fitted.image, answer, finder.places());
    }
    json.push_back(json_of(answer, finder.places()));
    csv += csv_line(answer, finder.places());
    if (!arguments.as_json) std::printf("%s\n", line_of(answer, finder.places()).c_str());
  }
  const nlohmann::json report{{"library", arguments.library}, {"images", json}};
  const auto text =
      report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);  // file names may be in Latin-1
  if (arguments.as_json) {
    std::printf("%s\n", text.c_str());
  } else {
    std::printf("%zu images: %zu found, %zu unknown, %zu skipped\n", images.size(), found,
                images.size() - found - skipped, skipped);
  }
  if (!arguments.out.empty()) {
    write(fs::path(arguments.out) / "places.csv", csv);
    write(fs::path(arguments.out) / "places.json", text + "\n");
  }
  return skipped == 0 ? kWell : kSkipped;
}

void add_reading(CLI::App& command, Arguments& arguments) {
  command.add_option("--mask", arguments.mask, "image, black where the vehicle or its mounting is seen; any size");
  command.add_option("--top", arguments.top_deg,
                     "elevation of the first row, deg above the horizon (default: 2:1 images are the "
                     "whole sphere, lower ones have square pixels about the horizon)");
  command.add_option("--bottom", arguments.bottom_deg, "elevation of the last row, deg below the horizon");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Recognises places in plain folders of panoramas, of any size, without a stereo camera, poses or times.",
               "panvo places");
  app.require_subcommand(1);
  app.footer("Exit status: 0 success, 1 images were skipped (stderr names them with the reason), 2 error.");
  Arguments arguments;

  auto* build_command = app.add_subcommand("build", "describe every panorama of a folder and store them as places");
  build_command->add_option("FOLDER", arguments.folder, "folder of panoramas, .jpg or .png")->required();
  build_command->add_option("--out", arguments.out, "the library, one SQLite file; replaced if it exists")->required();
  build_command->add_option("--poses", arguments.poses,
                            "poses of the camera: lines image,x_m,y_m,heading_deg, or TUM or KITTI with one line per "
                            "image (default: poses.csv or poses.txt in FOLDER)");
  add_reading(*build_command, arguments);

  auto* match_command =
      app.add_subcommand("match", "find the place that each panorama of a folder shows, or say that it is unknown");
  match_command->add_option("FOLDER", arguments.folder, "folder of panoramas, or one image")->required();
  match_command->add_option("--library", arguments.library, "library made by panvo places build")->required();
  match_command->add_flag("--json", arguments.as_json, "print JSON");
  match_command->add_option("--out", arguments.out,
                            "folder for places.csv, places.json and a picture per image: query above its "
                            "place, turned to the same heading");
  match_command
      ->add_option("--false-alarms", arguments.false_alarms, "expected number of wrong places per image by chance")
      ->check(CLI::Range(1e-30, 1.0))
      ->capture_default_str();
  match_command
      ->add_option("--verify", arguments.max_verified,
                   "places per image whose geometry is compared, most similar first")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_reading(*match_command, arguments);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kWell : kError;
  }
  try {
    return *build_command ? build(arguments) : match(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo places: %s\n", error.what());
    return kError;
  }
}
