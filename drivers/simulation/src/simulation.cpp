// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulation {

using simulated_world::kToPanorama;
using simulated_world::kToStereo;
using simulated_world::MovingPlacement;
using simulated_world::pinhole_rays;
using simulated_world::Random;

namespace {

constexpr double kDroppedShare = 1.0 / 50.0;

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(std::llround(seconds * 1e9)); }

/// Frame numbers of a camera with `rate_hz` between two times.
std::vector<std::uint64_t> frames_between(double from_s, double to_s, double rate_hz) {
  std::vector<std::uint64_t> frames;
  constexpr double kRounding = 1e-9;
  for (auto frame = static_cast<std::uint64_t>(std::ceil(from_s * rate_hz - kRounding));
       static_cast<double>(frame) / rate_hz <= to_s + kRounding; ++frame) {
    frames.push_back(frame);
  }
  return frames;
}

/// The actual stereo camera, which deviates from its published calibration as after some months of driving (focal
/// length 0.1 %, principal point half a pixel, right eye rotated by a fiftieth of a degree), times `error`.
vision::StereoCalibration aged(const vision::StereoCalibration& published, double error, std::uint64_t seed) {
  const double focal_length = 1e-3 * error, principal_point_px = 0.5 * error, distortion = 2e-3 * error;
  const double rotation_deviation_rad = 3.5e-4 * error;
  Random random(seed, "old calibration");
  vision::StereoCalibration actual = published;
  for (auto* eye : {&actual.left, &actual.right}) {
    const double focal = 1.0 + focal_length * random.gaussian();
    eye->pinhole.fx *= focal;
    eye->pinhole.fy *= focal;
    eye->pinhole.cx += principal_point_px * random.gaussian();
    eye->pinhole.cy += principal_point_px * random.gaussian();
    eye->distortion[0] += distortion * random.gaussian();
  }
  Eigen::Vector3d rotation_rad;
  for (auto& value : rotation_rad) value = rotation_deviation_rad * random.gaussian();
  actual.right_from_left.linear() = vision::so3_exp(rotation_rad) * published.right_from_left.linear();
  return actual;
}

MotionParameters at_speed(MotionParameters motion, double speed_m_per_s) {
  constexpr double kShareInTurns = 0.6;
  motion.cruise_speed_m_per_s = speed_m_per_s;
  motion.min_speed_m_per_s = std::min(motion.min_speed_m_per_s, kShareInTurns * speed_m_per_s);
  return motion;
}

/// A camera that has got used to the dark: it amplifies its signal, so that a white pixel has fewer electrons.
SensorParameters at_night(SensorParameters sensor) {
  constexpr double kAmplification = 12.0, kGain = 25.0;
  sensor.full_well /= kAmplification;
  sensor.start_gain = kGain;
  return sensor;
}

}  // namespace

simulated_world::Layout layout_of(const std::string& name) {
  const auto found = std::ranges::find(kLayoutNames, name);
  if (found == kLayoutNames.end()) {
    throw std::invalid_argument(fmt::format("unknown layout '{}'; known are {}", name, fmt::join(kLayoutNames, ", ")));
  }
  return static_cast<simulated_world::Layout>(found - kLayoutNames.begin());
}

void check_parameters(const SimulationParameters& parameters) {
  const Day& day = parameters.day;
  check_day(day);
  if (parameters.layout != simulated_world::Layout::kHall) return;
  const auto refuse = [](bool is_given, std::string_view what) {
    if (is_given)
      throw std::invalid_argument(fmt::format("layout 'hall' contradicts {}: it is indoors and flat", what));
  };
  refuse(parameters.hilliness != 0.0, "hilliness");
  refuse(day.season != simulated_world::Season::kSummer, "season");
  refuse(day.overcast, "overcast");
  refuse(day.night, "night");
  refuse(day.wet, "wet");
}

Simulation::Simulation(const SimulationParameters& parameters) : parameters_(parameters) {
  // Everything that may be rejected comes before building the campus, which takes time.
  const auto& [route, rig, effects, motion, seed, hilliness, calibration_error, day, layout, assets, start_s,
               duration_s, stereo, panorama, stamp, quality] = parameters_;
  check_parameters(parameters_);
  const std::uint64_t own = day.seed.value_or(seed);
  const auto steering = rig.vehicle.turns_in_place ? Steering::kDifferential : Steering::kCar;
  const auto path = drive(simulated_world::campus_roads(seed), route, day.left_m, steering);
  motion_ = std::make_unique<VehicleMotion>(path, simulated_world::Terrain(seed, hilliness),
                                            at_speed(motion, rig.vehicle.speed_m_per_s), own);
  weather_ = std::make_unique<Weather>(day, motion_->duration_s(), effects, own);
  plan_instants();

  const LensEffects lens{effects.rain ? 0.6 : 0.0, effects.smear ? 0.7 : 0.0};
  const auto add_camera = [&](std::vector<Camera>& cameras, simulated_world::CameraRays rays,
                              const Eigen::Isometry3d& base_from_camera, const SensorParameters& sensor,
                              std::string_view name) {
    const cv::Size size(rays.width, rays.height);
    const auto adjusted = parameters_.day.night ? at_night(sensor) : sensor;
    cameras.push_back({std::move(rays), base_from_camera, Sensor(adjusted, lens, size, Random(own, name).bits())});
  };
  if (stereo) {
    auto eyes = rig.stereo;
    if (calibration_error > 0.0) eyes.calibration = aged(eyes.calibration, calibration_error, seed);
    add_camera(eyes_, pinhole_rays(eyes.calibration.left), eyes.base_from_left, eyes.sensor, "left");
    add_camera(eyes_, pinhole_rays(eyes.calibration.right), eyes.base_from_right(), eyes.sensor, "right");
  }
  if (panorama) {
    for (const auto& head : rig.panorama.heads) {
      add_camera(heads_, rays_of(rig.panorama, head), head.base_from_head, rig.panorama.sensor, head.frame_id);
    }
  }
  campus_ = simulated_world::build_campus({.seed = seed,
                                           .hilliness = hilliness,
                                           .weak_texture = effects.weak_texture,
                                           .layout = layout,
                                           .season = day.season,
                                           .wet = day.wet,
                                           .day = day.seed},
                                          assets);
  if (effects.movers) traffic_.emplace(*campus_.site, *motion_, campus_.movers, own);
  renderer_ = std::make_unique<simulated_world::Renderer>(campus_.scene);
}

Simulation::~Simulation() = default;

void Simulation::plan_instants() {
  const auto& p = parameters_;
  const double end_s =
      p.duration_s > 0.0 ? std::min(p.start_s + p.duration_s, motion_->duration_s()) : motion_->duration_s();
  const Random drops(p.day.seed.value_or(p.seed), "dropped frames");
  const auto is_dropped = [&](std::uint64_t stream, std::uint64_t frame) {
    return p.effects.dropped_frames && drops.part(stream).part(frame).chance(kDroppedShare);
  };
  const auto instant_at = [&](double t_s) -> Instant& {
    Instant instant;
    instant.t_s = t_s;
    instant.stamp_ns = p.start_stamp_ns + nanoseconds(t_s);
    const auto place =
        std::lower_bound(instants_.begin(), instants_.end(), instant.stamp_ns,
                         [](const Instant& other, std::int64_t stamp_ns) { return other.stamp_ns < stamp_ns; });
    return place != instants_.end() && place->stamp_ns == instant.stamp_ns ? *place : *instants_.insert(place, instant);
  };
  if (p.stereo) {
    for (const auto frame : frames_between(p.start_s, end_s, p.rig.stereo.rate_hz)) {
      if (!is_dropped(0, frame)) instant_at(static_cast<double>(frame) / p.rig.stereo.rate_hz).stereo_frame = frame;
    }
  }
  if (p.panorama) {
    for (const auto frame : frames_between(p.start_s, end_s, p.rig.panorama.rate_hz)) {
      if (!is_dropped(1, frame)) instant_at(static_cast<double>(frame) / p.rig.panorama.rate_hz).panorama_frame = frame;
    }
  }
  if (instants_.empty()) {
    throw std::invalid_argument(
        fmt::format("nothing to render: the journey lasts {:.1f} s and the requested part starts at "
                    "{:.1f} s with {}; choose another start or duration",
                    motion_->duration_s(), p.start_s, p.stereo || p.panorama ? "its cameras" : "no camera"));
  }
}

cv::Mat Simulation::expose(Camera& camera, double middle_s, double exposure_s, std::uint32_t visibility,
                           std::uint64_t frame) {
  const auto within = [&](double t_s) { return std::clamp(t_s, 0.0, motion_->duration_s()); };
  const double opened_s = within(middle_s - 0.5 * exposure_s);
  const double closed_s = within(middle_s + 0.5 * exposure_s);
  const auto world_from_base_opened = motion_->world_from_base(opened_s);
  const auto world_from_base_closed = motion_->world_from_base(closed_s);

  std::vector<MovingPlacement> movers;
  if (traffic_) movers = traffic_->at(opened_s, closed_s);
  if (parameters_.rig.vehicle.has_body) {
    MovingPlacement own;
    own.at_opening.model = campus_.movers.own_vehicle;
    own.at_opening.world_from_model = world_from_base_opened.cast<float>();
    own.at_opening.visibility = kToPanorama | simulated_world::kToShadow;
    own.world_from_model_closed = world_from_base_closed.cast<float>();
    movers.push_back(own);
  }

  const simulated_world::Shot shot{world_from_base_opened * camera.base_from_camera,
                                   world_from_base_closed * camera.base_from_camera, visibility};
  const bool is_indoors = parameters_.layout == simulated_world::Layout::kHall;
  const auto light = is_indoors ? simulated_world::hall_light() : weather_->light(middle_s);
  auto radiance = renderer_->render(camera.rays, shot, light, movers, parameters_.quality);
  const auto traced = renderer_->statistics();
  statistics_.pixels += traced.pixels;
  statistics_.primary_rays += traced.primary_rays;
  statistics_.shadow_rays += traced.shadow_rays;
  statistics_.triangles = traced.triangles;
  return camera.sensor.expose(radiance, frame);
}

Simulation::StereoImages Simulation::render_stereo(const Instant& instant) {
  const auto& stereo = parameters_.rig.stereo;
  const auto frame = instant.stereo_frame.value();
  auto& left = eyes_.at(0);
  auto& right = eyes_.at(1);
  right.sensor.set_gain(left.sensor.gain());  // one exposure for both eyes
  StereoImages images;
  images.left = expose(left, instant.t_s, stereo.exposure_s, kToStereo, frame);
  images.right = expose(right, instant.t_s, stereo.exposure_s, kToStereo, frame);
  return images;
}

std::vector<cv::Mat> Simulation::render_panorama(const Instant& instant) {
  const auto& panorama = parameters_.rig.panorama;
  const double late_s = parameters_.effects.panorama_clock_offset_s();
  const double gain = heads_.front().sensor.gain();
  std::vector<cv::Mat> images;
  for (auto& head : heads_) {
    head.sensor.set_gain(gain);  // one exposure for all heads
    images.push_back(
        expose(head, instant.t_s - late_s, panorama.exposure_s, kToPanorama, instant.panorama_frame.value()));
  }
  return images;
}

// The first camera of a group determines the exposure of the group.
Exposure Simulation::exposure() const {
  Exposure exposure;
  if (!eyes_.empty()) exposure.stereo_gain = eyes_.front().sensor.gain();
  if (!heads_.empty()) exposure.panorama_gain = heads_.front().sensor.gain();
  return exposure;
}

void Simulation::set_exposure(const Exposure& exposure) {
  if (!eyes_.empty()) eyes_.front().sensor.set_gain(exposure.stereo_gain);
  if (!heads_.empty()) heads_.front().sensor.set_gain(exposure.panorama_gain);
}

}  // namespace panvo::simulation
