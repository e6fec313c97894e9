// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "store_copy.hpp"
#include "store_info.hpp"
#include "store_merge.hpp"
#include "store_pictures.hpp"

namespace {

using namespace panvo::landmarks;
namespace fs = std::filesystem;

enum ExitStatus { kWell = 0, kNotSo = 1, kError = 2 };

constexpr double kClose_m = 3.0;

int info(const std::string& path, bool as_json, bool check) {
  const auto found = inspect(LandmarkStore(path), kClose_m, check);
  std::fputs((as_json ? describe_as_json(found) : describe_as_text(found)).c_str(), stdout);
  return found.damage ? kNotSo : kWell;
}

void write_picture(const fs::path& file, const cv::Mat& picture) {
  if (!cv::imwrite(file.string(), picture)) {
    throw StoreError(file.string() + ": cannot be written; check the folder and the free disk space");
  }
}

int show(const std::string& path, const fs::path& out, const std::vector<std::uint32_t>& ids, int count) {
  const LandmarkStore store(path);
  const auto settings = from_settings<DescriptionParameters>(store.settings());
  if (!settings) {
    throw StoreError(store.name() +
                     ": its settings do not match this version of panvo (see `panvo landmarks info`), so its "
                     "features cannot be drawn; use the version that wrote it");
  }
  const PanoramaDescriber describer(settings->first, settings->second);
  auto landmarks = store.landmarks();
  for (const auto id : ids) {
    if (std::none_of(landmarks.begin(), landmarks.end(), [&](const auto& landmark) { return landmark.id == id; })) {
      throw StoreError(store.name() + ": has no landmark " + std::to_string(id));
    }
  }
  fs::create_directories(out);
  write_picture(out / "map.png", draw_map(landmarks));
  std::size_t drawn = 0;
  for (auto& landmark : landmarks) {
    if (!ids.empty() && std::find(ids.begin(), ids.end(), landmark.id) == ids.end()) continue;
    landmark.thumbnail = store.thumbnail(landmark.id);
    char name[40];
    std::snprintf(name, sizeof name, "landmark_%04u.png", landmark.id);
    write_picture(out / name, draw_landmark(landmark, describer.basis(), count));
    landmark.thumbnail = {};
    ++drawn;
  }
  std::printf("%s: map.png and %zu landmarks drawn\n", out.c_str(), drawn);
  return kWell;
}

int merge(const std::vector<std::string>& stores, const std::string& out, bool replace) {
  for (const auto& part : merge_stores(stores, out, replace)) {
    std::printf("%s: %zu landmarks", part.store.c_str(), part.landmarks);
    if (part.landmarks > 0) {
      std::printf(", now %u to %zu", part.first, part.first + part.landmarks - 1);
    }
    std::printf("\n");
  }
  const auto found = inspect(LandmarkStore(out), kClose_m, false);
  std::printf("%s: %zu landmarks", out.c_str(), found.landmarks);
  if (!found.close.empty()) {
    std::printf("; %zu pairs are closer than %g m (panvo landmarks info)", found.close.size(), kClose_m);
  }
  std::printf("\n");
  return kWell;
}

int copy(const StoreLocation& from, const StoreLocation& to, bool replace, bool skip_damaged) {
  std::size_t left_out = 0;
  const std::function<void(const std::string&)> tell = [&](const std::string& problem) {
    std::fprintf(stderr, "panvo landmarks: %s: %s; left out\n", from.shown().c_str(), problem.c_str());
    ++left_out;
  };
  const auto count = copy_store(from, to, replace, skip_damaged ? tell : std::function<void(const std::string&)>());
  std::printf("%s: %zu landmarks copied to %s and compared\n", from.shown().c_str(), count, to.shown().c_str());
  return left_out > 0 ? kNotSo : kWell;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Inspects, draws, merges and copies landmark stores: files, or PostgreSQL databases, named "
      "postgresql://USER@HOST/DATABASE.",
      "panvo landmarks");
  app.require_subcommand(1);
  app.footer(
      "The password of a database comes from PGPASSFILE, ~/.pgpass or PGPASSWORD, as for psql.\n"
      "Exit status: 0 success, 1 store damaged (info --check, copy --skip-damaged), 2 error.");
  std::string store, out, from, to;
  std::vector<std::string> stores;
  std::vector<std::uint32_t> ids;
  bool as_json = false, check = false, overwrite = false, skip_damaged = false;
  int count = 4;

  auto* info_command = app.add_subcommand(
      "info", "contents of a store: landmarks, bytes per part, extent, settings, pairs closer than 3 m");
  info_command->add_option("STORE", store, "landmark store")->required();
  info_command->add_flag("--json", as_json, "print JSON; lengths in m, times in ns");
  info_command->add_flag("--check", check, "read the whole file and report damage");

  auto* show_command = app.add_subcommand(
      "show", "draw each landmark's panorama with its most discriminative features, and a map of all landmarks");
  show_command->add_option("STORE", store, "landmark store")->required();
  show_command->add_option("--out", out, "output folder for the PNG files")->required();
  show_command->add_option("--id", ids, "only this landmark; may be repeated")->expected(1)->take_all();
  show_command->add_option("--features", count, "features drawn per scale")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();

  auto* merge_command = app.add_subcommand(
      "merge", "merge stores of one map and equal settings into a new file, with new ids in order of the stores");
  merge_command->add_option("STORES", stores, "two or more landmark stores")->required()->expected(2, 1000);
  merge_command->add_option("--out", out, "the new store")->required();
  merge_command->add_flag("--overwrite", overwrite, "replace an existing store");

  auto* copy_command = app.add_subcommand("copy",
                                          "copy a store, between files and databases: landmarks with their ids, and "
                                          "how they served; reads the copy back and "
                                          "compares it");
  copy_command->add_option("FROM", from, "landmark store")->required();
  copy_command->add_option("TO", to, "new file, or database of which the tables are made")->required();
  copy_command->add_flag("--overwrite", overwrite, "replace the landmarks of TO");
  copy_command->add_flag("--skip-damaged", skip_damaged, "leave out damaged landmarks, and name them");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kWell : kError;
  }
  try {
    if (*info_command) return info(store, as_json, check);
    if (*show_command) return show(store, out, ids, count);
    if (*copy_command) return copy(from, to, overwrite, skip_damaged);
    return merge(stores, out, overwrite);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo landmarks: %s\n", error.what());
    return kError;
  }
}
