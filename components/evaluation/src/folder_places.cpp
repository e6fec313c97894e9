// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/folder_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "angle_units.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/places/image_folder.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

struct Label {
  std::string place;
  std::optional<double> heading_rad;
};

std::map<std::string, Label> read_labels(const fs::path& file) {
  std::map<std::string, Label> labels;
  std::ifstream stream(file);
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
    if (text.empty() || text[0] == '#' || (number == 1 && text.starts_with("image"))) continue;
    std::istringstream words(text);
    std::string image, heading;
    Label label;
    std::getline(words, image, ',');
    std::getline(words, label.place, ',');
    std::getline(words, heading, ',');
    try {
      if (!heading.empty()) label.heading_rad = std::stod(heading) * kRadians;
    } catch (const std::exception&) {
      throw InputError(file, number, "'" + heading + "' is not a heading", "write lines image,place,heading_deg");
    }
    labels[image] = label;
  }
  return labels;
}

/// Distance of the best answer to a query, and whether it is right.
struct Answer {
  double distance = std::numeric_limits<double>::infinity();
  bool is_known = false, is_right = false, is_given = false;
};

/// Fills in everything that follows from the answers.
void summarise(FolderScore& score, const std::vector<Answer>& answers) {
  double least_wrong = std::numeric_limits<double>::infinity();
  for (const auto& answer : answers) {
    ++(answer.is_known ? score.known : score.unknown);
    score.right_first += answer.is_right ? 1 : 0;
    if (!answer.is_right) least_wrong = std::min(least_wrong, answer.distance);
    if (!score.answers_unknown || !answer.is_given) continue;
    ++(answer.is_right ? score.right : score.wrong);
  }
  for (const auto& answer : answers) {
    score.right_at_full_precision += answer.is_right && answer.distance < least_wrong ? 1 : 0;
  }
  std::sort(score.heading_errors_rad.begin(), score.heading_errors_rad.end());
}

void add_heading(FolderScore& score, const FolderPanorama& query, const FolderPanorama& place, double heading_rad) {
  if (!query.heading_rad || !place.heading_rad) return;
  score.heading_errors_rad.push_back(
      std::abs(vision::wrapped(heading_rad - (*query.heading_rad - *place.heading_rad))));
}

double ground_distance_m(const FolderPanorama& a, const FolderPanorama& b) {
  return (a.world_from_base->translation() - b.world_from_base->translation()).head<2>().norm();
}

}  // namespace

std::vector<FolderPanorama> read_folder_panoramas(const fs::path& folder, const fs::path& poses,
                                                  const std::optional<places::ElevationRange>& range,
                                                  const std::function<void(const std::string&)>& report) {
  const auto labels = read_labels(folder / "places.csv");
  std::vector<FolderPanorama> panoramas;
  for (const auto& listed : places::read_image_folder(folder, poses)) {
    FolderPanorama panorama;
    panorama.name = listed.file.filename().string();
    const auto label = labels.find(panorama.name);
    if (label == labels.end() && !listed.map_from_base) {
      report(listed.file.string() + ": has neither a pose nor a line in places.csv");
      continue;
    }
    auto fitted = places::read_panorama(listed.file, range, {});
    if (fitted.fault) {
      report(listed.file.string() + ": " + *fitted.fault);
      continue;
    }
    panorama.image = std::move(fitted.image);
    panorama.world_from_base = listed.map_from_base;
    if (listed.map_from_base) panorama.heading_rad = yaw_of(*listed.map_from_base);
    if (label != labels.end()) {
      panorama.place = label->second.place.empty() ? "only " + panorama.name : label->second.place;
      if (label->second.heading_rad) panorama.heading_rad = label->second.heading_rad;
    }
    panoramas.push_back(std::move(panorama));
  }
  if (panoramas.empty()) {
    throw InputError(folder, "holds no panorama that can be scored",
                     "add places.csv with lines image,place[,heading_deg], or poses");
  }
  return panoramas;
}

bool FolderTask::is_same(const FolderPanorama& a, const FolderPanorama& b) const {
  if (!a.place.empty() && !b.place.empty()) return a.place == b.place;
  return a.world_from_base && b.world_from_base && ground_distance_m(a, b) <= same_place_m;
}

bool FolderTask::is_known(const FolderPanorama& query) const {
  return std::any_of(library.begin(), library.end(), [&](const auto* place) { return is_same(query, *place); });
}

FolderTask folder_task(const std::vector<FolderPanorama>& folder, const std::vector<FolderPanorama>* earlier,
                       double same_place_m) {
  FolderTask task;
  task.same_place_m = same_place_m;
  if (earlier != nullptr) {
    for (const auto& panorama : *earlier) task.library.push_back(&panorama);
    for (const auto& panorama : folder) task.queries.push_back(&panorama);
    return task;
  }
  std::vector<double> added_at_m;
  double travelled_m = 0.0;
  const FolderPanorama* last = nullptr;
  for (const auto& panorama : folder) {
    if (last != nullptr && last->world_from_base && panorama.world_from_base)
      travelled_m += ground_distance_m(*last, panorama);
    last = &panorama;
    if (!task.is_known(panorama)) {
      task.library.push_back(&panorama);
      added_at_m.push_back(travelled_m);
      continue;
    }
    bool is_revisit = !panorama.place.empty();
    for (std::size_t i = 0; i < task.library.size(); ++i) {
      is_revisit =
          is_revisit || (task.is_same(panorama, *task.library[i]) && travelled_m - added_at_m[i] > 2.0 * same_place_m);
    }
    if (is_revisit) task.queries.push_back(&panorama);
  }
  return task;
}

FolderScore score_folder(const PlaceMethod& method, const FolderTask& task) {
  FolderScore score;
  score.method = method.name();
  std::vector<std::unique_ptr<PlaceDescriptor>> places;
  for (const auto* place : task.library) places.push_back(method.describe_landmark(place->image.grey));
  std::vector<Answer> answers;
  for (const auto* query : task.queries) {
    const auto seen = method.describe_query(query->image.grey);
    Answer answer;
    answer.is_known = task.is_known(*query);
    std::size_t best = 0;
    double heading_rad = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto distance = method.distance(*seen, *places[i]);
      if (distance.distance >= answer.distance) continue;
      answer.distance = distance.distance;
      heading_rad = distance.heading_rad;
      best = i;
    }
    answer.is_right = !places.empty() && task.is_same(*query, *task.library[best]);
    if (answer.is_right) add_heading(score, *query, *task.library[best], heading_rad);
    answers.push_back(answer);
  }
  summarise(score, answers);
  return score;
}

FolderScore score_folder(const places::PlaceFinderParameters& parameters, const FolderTask& task) {
  FolderScore score;
  score.method = "bearings (panvo places)";
  score.answers_unknown = true;
  std::vector<places::KnownPlace> known;
  for (const auto* place : task.library) known.push_back(places::make_place(place->name, place->image));
  const places::PlaceFinder finder(std::move(known), parameters);
  std::vector<Answer> answers;
  for (const auto* query : task.queries) {
    const auto found = finder.find(query->image);
    const auto& place = *task.library[found.nearest];
    Answer answer{found.shared.log10_expected, task.is_known(*query), task.is_same(*query, place),
                  found.place.has_value()};
    if (!answer.is_given) answer.distance = 1.0 + found.shared.log10_expected * 1e-9;  // after every answer
    if (answer.is_right && answer.is_given) add_heading(score, *query, place, found.shared.view->heading_rad);
    answers.push_back(answer);
  }
  summarise(score, answers);
  return score;
}

std::string folder_table(const std::vector<FolderScore>& scores) {
  const auto share = [](int part, int whole) {
    return whole > 0 ? fmt::format("{:.2f}", static_cast<double>(part) / whole) : "-";
  };
  std::string text = fmt::format("{:<28} {:>9} {:>17} {:>8} {:>10} {:>14} {:>9}\n", "Method", "first is", "recall at",
                                 "answers:", "", "heading (deg)", "");
  text += fmt::format("{:<28} {:>9} {:>17} {:>8} {:>10} {:>14} {:>9}\n", "", "right", "precision 1", "recall",
                      "precision", "median", "95 %");
  for (const auto& score : scores) {
    const auto& errors = score.heading_errors_rad;
    const auto heading = [&](double part) {
      return errors.empty()
                 ? "-"
                 : fmt::format(
                       "{:.1f}",
                       errors[static_cast<std::size_t>(part * static_cast<double>(errors.size() - 1))] * kDegrees);
    };
    text += fmt::format("{:<28} {:>9} {:>17} {:>8} {:>10} {:>14} {:>9}\n", score.method,
                        share(score.right_first, score.known), share(score.right_at_full_precision, score.known),
                        score.answers_unknown ? share(score.right, score.known) : "-",
                        score.answers_unknown ? share(score.right, score.right + score.wrong) : "-", heading(0.5),
                        heading(0.95));
  }
  return text;
}

}  // namespace panvo::evaluation
