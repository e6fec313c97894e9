// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: byte changes to a store of three landmarks, each an offset (3 bytes) and a value (1 byte). The
// store must be rejected, or yield landmarks that keep the rules and can be compared.
#include <cstdlib>
#include <string>

#include "landmark_rules.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "places.hpp"

namespace {

using namespace panvo::landmarks;

PanoramicLandmark landmark_of(std::uint32_t id) {
  PanoramicLandmark landmark;
  landmark.id = id;
  landmark.map_from_base.translation().x() = 10.0 * id;
  landmark.covariance.setIdentity();
  landmark.description = fuzz::here().describer.describe(fuzz::Here::noise());
  landmark.keypoints.resize(10);
  landmark.thumbnail.resize(100);
  return landmark;
}

/// In shared memory, to avoid disk writes.
const panvo::test::TemporaryFolder& folder() {
  static const panvo::test::TemporaryFolder made("/dev/shm");
  return made;
}

const std::string& sound_store() {
  static const std::string bytes = [] {
    {
      LandmarkStore store(folder() / "store", fuzz::here().settings);
      for (const std::uint32_t id : {1U, 2U, 3U}) store.add(landmark_of(id));
    }
    return folder().read("store");
  }();
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes = sound_store();
  for (std::size_t i = 0; i + 4 <= size && i < 400; i += 4) {
    const std::size_t place = data[i] | std::size_t{data[i + 1]} << 8 | std::size_t{data[i + 2]} << 16;
    bytes[place % bytes.size()] = static_cast<char>(data[i + 3]);
  }
  const auto file = folder().write("store", bytes);
  try {
    const LandmarkStore store(file);
    for (const auto& landmark : store.landmarks()) {
      if (problem_of(landmark, store.settings())) std::abort();
      store.keypoints(landmark.id);
      store.thumbnail(landmark.id);
      if (fits(landmark.description, fuzz::here().describer.basis().limits())) fuzz::compare(landmark.description);
    }
    store.find_damage();
  } catch (const StoreError&) {
  }
  return 0;
}
