// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/sequence_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::simulation {
namespace {

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

class Stamps {
 public:
  explicit Stamps(std::int64_t start_ns) : start_ns_(start_ns) {}
  std::int64_t operator()(double t_s) const { return start_ns_ + std::llround(t_s * 1e9); }

 private:
  std::int64_t start_ns_;
};

std::string junctions_yaml(const simulated_world::RoadNetwork& roads) {
  std::string text = "junctions:\n";
  for (std::size_t i = 0; i < roads.junctions.size(); ++i) {
    const auto& junction = roads.junctions[i];
    text += fmt::format("  - {{id: {}, name: {}, x: {:.4f}, y: {:.4f}, degree: {}}}\n", i, junction.name,
                        junction.position.x(), junction.position.y(), junction.roads.size());
  }
  return text;
}

std::string visits_yaml(const std::vector<Visit>& visits, const Stamps& stamp) {
  std::string text = "# one entry per pass within 8.5 m of a crossing; t_ns: closest approach\nvisits:\n";
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto& v = visits[i];
    text += fmt::format(
        "  - {{visit: {}, id: {}, t_ns: {}, t_in_ns: {}, t_out_ns: {}, traveled_m: {:.3f}, closest_m: {:.3f}, "
        "heading_in: {:.2f}, heading_closest: {:.2f}, heading_out: {:.2f}, x: {:.3f}, y: {:.3f}}}\n",
        i, v.junction, stamp(v.closest_s), stamp(v.entered_s), stamp(v.left_s), v.travelled_m, v.closest_m,
        degrees(v.heading_entered_rad), degrees(v.heading_closest_rad), degrees(v.heading_left_rad), v.position.x(),
        v.position.y());
  }
  return text;
}

std::string revisits_yaml(const std::vector<Visit>& visits, const std::vector<Revisit>& revisits, const Stamps& stamp) {
  std::string text = "# first_heading_diff: heading on entering now minus that of the first visit\nrevisits:\n";
  for (const auto& r : revisits) {
    const auto& now = visits[static_cast<std::size_t>(r.visit)];
    const auto& first = visits[static_cast<std::size_t>(r.first_visit)];
    text += fmt::format(
        "  - {{visit: {}, id: {}, t_ns: {}, traveled_m: {:.3f}, first_visit: {}, first_t_ns: {}, first_heading_diff: "
        "{:.2f}, first_offset_m: {:.3f}}}\n",
        r.visit, now.junction, stamp(now.closest_s), now.travelled_m, r.first_visit, stamp(first.closest_s),
        degrees(r.entrance_angle_rad), r.offset_m);
  }
  return text;
}

}  // namespace

std::string sequence_yaml(const Simulation& simulation) {
  const auto& p = simulation.parameters();
  const auto& roads = simulation.campus().site->roads;
  const auto& instants = simulation.instants();
  const Stamps stamp(p.start_stamp_ns);
  std::uint64_t stereo_frames = 0, panorama_frames = 0;
  for (const auto& instant : instants) {
    stereo_frames += instant.stereo_frame.has_value();
    panorama_frames += instant.panorama_frame.has_value();
  }
  const double from_s = instants.front().t_s, to_s = instants.back().t_s;

  std::string text =
      "%YAML:1.0\n"
      "# ground truth of this recording; headings in degrees, counter-clockwise, 0 = +x of the world; times in ns as "
      "image stamps\n";
  text += fmt::format(
      "route: {}\nseed: {}\nhilliness: {:g}\ncalibration_error: {:g}\nhour: {:g}\nseason: {}\novercast: {}\nnight: "
      "{}\nwet: {}\nlayout: {}\neffects: "
      "[{}]\ntraveled_m: "
      "{:.3f}\nduration_s: {:.2f}\n"
      "stereo_frames: {}\npanorama_frames: {}\npanorama_clock_offset_ns: {}  # panorama stamps minus true times\n"
      "start_ns: {}\nplace_kind: road junction\n",
      p.route.name, p.seed, p.hilliness, p.calibration_error, p.day.hour,
      kSeasonNames[static_cast<std::size_t>(p.day.season)], p.day.overcast, p.day.night, p.day.wet,
      kLayoutNames[static_cast<std::size_t>(p.layout)], fmt::join(names_of(p.effects), ", "),
      simulation.motion().travelled_m(to_s) - simulation.motion().travelled_m(from_s), to_s - from_s, stereo_frames,
      panorama_frames, std::llround(p.effects.panorama_clock_offset_s() * 1e9), instants.front().stamp_ns);
  text += fmt::format("route_junctions: [{}]\n", fmt::join(p.route.junctions, ", "));
  text += junctions_yaml(roads);

  auto visits = find_visits(roads, simulation.motion());
  // Restrict the ground truth to the rendered part of the journey.
  const auto is_outside = [&](double begin_s, double end_s) { return end_s < from_s || begin_s > to_s; };
  std::erase_if(visits, [&](const Visit& visit) { return is_outside(visit.closest_s, visit.closest_s); });
  text += visits_yaml(visits, stamp);
  text += revisits_yaml(visits, find_revisits(visits), stamp);

  const auto interval = [&](const auto& event) {
    return fmt::format("from_ns: {}, to_ns: {}", stamp(std::max(event.from_s, from_s)),
                       stamp(std::min(event.to_s, to_s)));
  };
  text += "illumination_events:\n";
  for (const auto& cloud : simulation.weather().clouds()) {
    if (is_outside(cloud.from_s, cloud.to_s)) continue;
    text += fmt::format("  - {{{}, cloud_cover: {:.2f}}}\n", interval(cloud), cloud.cover);
  }
  text += "movers:\n";
  if (const auto* traffic = simulation.traffic()) {
    for (const auto& episode : traffic->episodes()) {
      if (!is_outside(episode.from_s, episode.to_s))
        text += fmt::format("  - {{{}, kind: {}}}\n", interval(episode), episode.kind);
    }
  }
  text += "weak_texture_zones:\n";
  for (std::size_t i = 0; i < roads.junctions.size(); ++i) {
    if (p.effects.weak_texture && roads.junctions[i].has_weak_texture) text += fmt::format("  - {{id: {}}}\n", i);
  }
  return text;
}

}  // namespace panvo::simulation
