// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::landmarks {
namespace {

struct Parameters {
  std::string file;
  bool read_only = false;
  std::string map_frame = "map";

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::file, "file", "",
          "the store: made with the first landmark if it is not there; empty: none, landmarks are forgotten");
    field(&P::read_only, "read_only", "", "publish what is in the store, and add nothing");
    field(&P::map_frame, "map_frame", "", "frame of the poses of the landmarks in the store");
  }
};

/// landmarks <-> a file: publishes at the start what earlier sessions left there, and keeps what is built or moved.
class LandmarkStoreComponent final : public runtime::Component {
 public:
  explicit LandmarkStoreComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<Parameters>()), output_(context.output(topics::kLandmarks)) {
    if (parameters_.file.empty()) {
      context.log().info("no file is named: the landmarks of this session are forgotten at its end");
      return;
    }
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    try {
      if (parameters_.read_only || std::filesystem::exists(parameters_.file)) open();
    } catch (const StoreError& error) {
      throw runtime::ConfigError(error.what());
    }
  }

 private:
  struct Known {
    Eigen::Matrix4d map_from_base;
    Eigen::Matrix<double, 6, 6> covariance;
  };

  void open() {
    // Settings are those of the landmarks that come: whoever describes panoramas judges whether he can use these.
    store_ = std::make_unique<LandmarkStore>(parameters_.file);
    if (!parameters_.read_only) {
      const auto settings = store_->settings();
      store_ = std::make_unique<LandmarkStore>(parameters_.file, settings);
    }
    for (auto& landmark : store_->landmarks()) {
      landmark.keypoints = store_->keypoints(landmark.id);  // its picture stays in the file: it is for people
      remember(landmark);
      // Latched, so it does not matter which components are there already.
      output_.publish(to_message(landmark, store_->settings(), parameters_.map_frame));
    }
    context_.log().info("{}: {} landmarks of earlier sessions", parameters_.file, known_.size());
  }

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    if (parameters_.read_only || has_failed_) return;
    const auto settings = settings_from_text(message.settings());
    const auto landmark = to_landmark(message, settings);
    if (!landmark) {
      context_.log().warn("a landmark {} and is not kept", landmark.reason());
      return;
    }
    try {
      if (!store_) store_ = std::make_unique<LandmarkStore>(parameters_.file, settings);
      store_->require(settings);
      keep(*landmark);
    } catch (const StoreError& error) {
      has_failed_ = true;  // what ails a file stays; the rest of the system goes on
      context_.log().error("{}. No more landmarks are kept", error.what());
    }
  }

  void keep(const PanoramicLandmark& landmark) {
    const auto known = known_.find(landmark.id);
    if (known == known_.end()) {
      store_->add(landmark);
    } else if (is_moved(known->second, landmark)) {
      const LandmarkPose moved{landmark.id, landmark.map_from_base, landmark.covariance};
      store_->set_poses(std::span(&moved, 1));
    }
    remember(landmark);
  }

  static bool is_moved(const Known& known, const PanoramicLandmark& landmark) {
    constexpr double kRounding =
        1e-9;  // of a rotation on its way through quaternions; what is published here comes back
    return (known.map_from_base - landmark.map_from_base.matrix()).cwiseAbs().maxCoeff() > kRounding ||
           known.covariance != landmark.covariance;
  }

  void remember(const PanoramicLandmark& landmark) {
    known_.insert_or_assign(landmark.id, Known{landmark.map_from_base.matrix(), landmark.covariance});
  }

  runtime::Context& context_;
  const Parameters parameters_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> output_;
  std::unique_ptr<LandmarkStore> store_;
  std::map<std::uint32_t, Known> known_;
  bool has_failed_ = false;
};

}  // namespace
}  // namespace panvo::landmarks

namespace {
using panvo::landmarks::LandmarkStoreComponent;
}
PANVO_REGISTER_COMPONENT(LandmarkStoreComponent)
