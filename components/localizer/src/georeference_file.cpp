// SPDX-License-Identifier: Apache-2.0
#include "georeference_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "panvo/interfaces/check.hpp"
#include "pose_lines.hpp"

namespace panvo::localizer {
namespace {

constexpr double kHighest_m = 1e5;

const FileKind kGeoreferenceFile{"georeference", {"map_frame", "origin", "position", "orientation", "covariance"}};

Georeference georeference_of(const Lines& lines) {
  Georeference georeference;
  const auto frame = lines.find("map_frame");
  if (frame != lines.end()) georeference.map_frame = frame->second;
  const auto origin = numbers<double>(lines, "origin", 3);
  interfaces::Check check;
  check.within("latitude", origin[0], -90.0, 90.0);
  check.within("longitude", origin[1], -360.0, 360.0);
  check.within("altitude", origin[2], -kHighest_m, kHighest_m);
  if (check.problem()) throw std::runtime_error(*check.problem());
  georeference.origin = {origin[0], origin[1], origin[2]};
  georeference.map_from_enu = pose_of(lines);
  return georeference;
}

}  // namespace

void write_georeference(const std::filesystem::path& file, const Georeference& georeference) {
  const auto& origin = georeference.origin;
  write_kept(file, kGeoreferenceFile,
             fmt::format("map_frame {}\norigin {} {} {}\n{}", georeference.map_frame, origin.latitude_deg,
                         origin.longitude_deg, origin.altitude_m, to_lines(georeference.map_from_enu)));
}

std::optional<Georeference> read_georeference(const std::filesystem::path& file) {
  return read_kept(file, kGeoreferenceFile, georeference_of);
}

}  // namespace panvo::localizer
