// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/simulated_world/campus.hpp"
#include "panvo/simulated_world/renderer.hpp"
#include "panvo/simulation/day.hpp"
#include "panvo/simulation/effects.hpp"
#include "panvo/simulation/revisits.hpp"
#include "panvo/simulation/rig.hpp"
#include "panvo/simulation/route.hpp"
#include "panvo/simulation/traffic.hpp"
#include "panvo/simulation/weather.hpp"

namespace panvo::simulation {

/// Names of the layouts, in order of simulated_world::Layout.
inline const std::vector<std::string> kLayoutNames = {"varied", "rows", "twins", "car_parks", "hall", "fields"};

/// The layout of that name. Throws std::invalid_argument, with the valid names, for another one.
simulated_world::Layout layout_of(const std::string& name);

struct SimulationParameters {
  Route route;
  Rig rig = paper_rig();
  Effects effects;
  MotionParameters motion;  ///< except the speed, which is that of the rig's vehicle
  std::uint64_t seed = 1;
  double hilliness = 0.0;
  double calibration_error = 0.0;  ///< of the published stereo calibration; 1: a good one after months of driving
  Day day;
  simulated_world::Layout layout = simulated_world::Layout::kVaried;
  std::filesystem::path assets;  ///< photographs in place of painted textures; empty: none
  double start_s = 0.0;          ///< start time on the journey
  double duration_s = 0.0;       ///< duration; 0: to the end
  bool stereo = true, panorama = true;
  std::int64_t start_stamp_ns = 1'700'000'000'000'000'000;
  simulated_world::Renderer::Quality quality;
};

/// Throws std::invalid_argument if day, layout and terrain contradict each other.
void check_parameters(const SimulationParameters& parameters);

/// An exposure of the stereo camera, the panoramic camera or both. The middle of the exposure is at `t_s`, except that
/// the effect time_offset shifts the panorama.
struct Instant {
  std::int64_t stamp_ns = 0;
  double t_s = 0.0;
  std::optional<std::uint64_t> stereo_frame, panorama_frame;  ///< frame numbers, including dropped frames
};

/// The state of exposure control, which is all that one instant passes to the next.
struct Exposure {
  double stereo_gain = 1.0, panorama_gain = 1.0;
};

/// Simulates the vehicle with its rig on a route, instant by instant.
class Simulation {
 public:
  /// Plans the journey and builds the campus, which takes seconds. Throws std::invalid_argument or std::runtime_error
  /// if route, rig or assets are invalid.
  explicit Simulation(const SimulationParameters& parameters);
  ~Simulation();

  const SimulationParameters& parameters() const { return parameters_; }
  const simulated_world::Campus& campus() const { return campus_; }
  const VehicleMotion& motion() const { return *motion_; }
  const Weather& weather() const { return *weather_; }
  const Traffic* traffic() const { return traffic_ ? &*traffic_ : nullptr; }  ///< null: the effect is off

  /// All instants to render, in order of time.
  const std::vector<Instant>& instants() const { return instants_; }

  struct StereoImages {
    cv::Mat left, right;
  };
  /// Images of an instant, grey or RGB. Through exposure control they depend on earlier instants: render in order from
  /// the first one for reproducible images.
  StereoImages render_stereo(const Instant& instant);
  std::vector<cv::Mat> render_panorama(const Instant& instant);  ///< one image per head

  /// To resume an interrupted run, pass the exposure() after its last instant to set_exposure().
  Exposure exposure() const;
  void set_exposure(const Exposure& exposure);

  /// Statistics of everything rendered so far.
  const simulated_world::Renderer::Statistics& statistics() const { return statistics_; }

 private:
  struct Camera {
    simulated_world::CameraRays rays;
    Eigen::Isometry3d base_from_camera;
    Sensor sensor;
  };
  void plan_instants();
  cv::Mat expose(Camera& camera, double middle_s, double exposure_s, std::uint32_t visibility, std::uint64_t frame);

  SimulationParameters parameters_;
  simulated_world::Campus campus_;
  std::unique_ptr<VehicleMotion> motion_;
  std::unique_ptr<Weather> weather_;
  std::optional<Traffic> traffic_;
  std::unique_ptr<simulated_world::Renderer> renderer_;
  simulated_world::Renderer::Statistics statistics_;
  std::vector<Camera> eyes_, heads_;
  std::vector<Instant> instants_;
};

}  // namespace panvo::simulation
