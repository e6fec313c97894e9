// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/sky.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace panvo::simulated_world {
namespace {

constexpr float kPixel = 0.002f;  // rad

const Sky& sky() {
  static const Sky made(7);
  return made;
}

Eigen::Vector3f towards(float azimuth_rad, float elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

Eigen::Vector3f around(float elevation_rad, const Light& light) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int step = 0; step < 360; ++step) {
    sum += sky().radiance(towards(static_cast<float>(step) * std::numbers::pi_v<float> / 180.0f, elevation_rad), light,
                          kPixel);
  }
  return sum / 360.0f;
}

TEST(LightAt, LetsTheSunRiseInTheEastAndStandInTheSouthAtNoon) {
  EXPECT_GT(light_at(6.0, 0.0).to_sun.x(), 0.999);
  EXPECT_NEAR(light_at(12.0, 0.0).to_sun.x(), 0.0, 1e-3);
  EXPECT_LT(light_at(12.0, 0.0).to_sun.y(), -0.3);
  EXPECT_GT(light_at(12.0, 0.0).to_sun.z(), 0.7);
  EXPECT_LT(light_at(18.0, 0.0).to_sun.x(), -0.999);
  for (double hour = 4.0; hour <= 20.0; hour += 0.5) {
    EXPECT_NEAR(light_at(hour, 0.3).to_sun.norm(), 1.0, 1e-5);
    EXPECT_TRUE(light_at(hour, 0.3).sun.allFinite());
    EXPECT_GE(light_at(hour, 0.3).sun.minCoeff(), 0.0);
    EXPECT_GT(light_at(hour, 0.3).sky.minCoeff(), 0.0);
  }
}

TEST(LightAt, MakesALowSunWeakAndRed) {
  const Light morning = light_at(7.0, 0.0);
  const Light noon = light_at(12.0, 0.0);
  EXPECT_LT(morning.sun.maxCoeff(), 0.8f * noon.sun.maxCoeff());
  EXPECT_GT(morning.sun.x() / morning.sun.z(), 1.5f * noon.sun.x() / noon.sun.z());
  EXPECT_NEAR((noon.sun * noon.to_sun.z() + noon.sky).mean(), 0.85, 0.15);  // a white surface is about 1 at noon
}

TEST(LightAt, TurnsSunlightIntoSkylightUnderACloud) {
  const Light clear = light_at(11.0, 0.0);
  const Light covered = light_at(11.0, 1.0);
  EXPECT_LT(covered.sun.mean(), 0.05f * clear.sun.mean());
  EXPECT_GT(covered.sky.mean(), 1.1f * clear.sky.mean());
  EXPECT_LT((covered.sun * covered.to_sun.z() + covered.sky).mean(),
            0.7f * (clear.sun * clear.to_sun.z() + clear.sky).mean());
}

TEST(LightAt, IsWithoutSunAndDimmerOnAnOvercastDay) {
  const Light clear = light_at(11.0, 0.0);
  const Light covered = overcast_light_at(11.0);
  EXPECT_EQ(covered.sun.norm(), 0.0f);
  const float open = (clear.sun * clear.to_sun.z() + clear.sky).mean();
  EXPECT_LT(covered.sky.mean(), 0.7f * open);
  EXPECT_GT(covered.sky.mean(), 0.3f * open);
}

TEST(NightLight, IsMuchDimmerThanTheDayAndBrighterUnderClouds) {
  const Light night = night_light(false, 1);
  EXPECT_EQ(night.sun.norm(), 0.0f);
  EXPECT_LT(night.sky.mean(), 0.02f * light_at(12.0, 0.0).sky.mean());
  EXPECT_NEAR(night_light(true, 1).sky.mean(), 2.0f * night.sky.mean(), 1e-6f);
  const float above = sky().radiance(Eigen::Vector3f::UnitZ(), night, kPixel).mean();
  EXPECT_GT(above, 0.2f * night.sky.mean());
  EXPECT_LT(above, 2.0f * night.sky.mean());
}

TEST(Sky, IsThreeTimesAsBrightOverheadOnAnOvercastDay) {
  const Light light = overcast_light_at(10.0);
  const float high = sky().radiance(Eigen::Vector3f::UnitZ(), light, kPixel).mean();
  EXPECT_NEAR(high / sky().radiance(towards(1.0f, 0.1f), light, kPixel).mean(), 3.0f / (1.0f + 2.0f * std::sin(0.1f)),
              0.01f);
  EXPECT_NEAR(sky().radiance(light.to_sun, light, kPixel).mean(),
              sky().radiance(towards(2.0f, std::asin(light.to_sun.z())), light, kPixel).mean(),
              1e-4f);  // no sun to see
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0f;
  for (float elevation = 0.005f; elevation < 1.57f; elevation += 0.01f) {
    const float weight = std::cos(elevation) * std::sin(elevation);
    sum += weight * light.sky * (3.0f / 7.0f * (1.0f + 2.0f * std::sin(elevation)));
    weights += weight;
    if (elevation < 0.1f) continue;  // hills and trees
    const Eigen::Vector3f seen = sky().radiance(towards(1.0f, elevation), light, kPixel);
    EXPECT_NEAR((seen - light.sky * (3.0f / 7.0f * (1.0f + 2.0f * std::sin(elevation)))).norm(), 0.0f, 1e-4f);
  }
  EXPECT_NEAR((sum / weights - light.sky).norm(), 0.0f, 0.01f);  // the light is the sky's mean
}

TEST(Sky, IsBlueOverheadAndBrighterAtTheHorizon) {
  const Light light = light_at(10.0, 0.0);
  const Eigen::Vector3f low = around(0.12f, light);
  const Eigen::Vector3f high = around(1.0f, light);
  EXPECT_GT(high.z(), 1.1f * high.x());
  EXPECT_GT(low.mean(), 1.1f * high.mean());
  EXPECT_LT(low.z() / low.x(), high.z() / high.x());
}

TEST(Sky, ShinesOnTheGroundAboutAsBrightlyAsItsLightSays) {
  const Light light = light_at(10.0, 0.0);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0f;
  for (float elevation = 0.03f; elevation < 1.57f; elevation += 0.06f) {
    for (float azimuth = 0.0f; azimuth < 6.28f; azimuth += 0.1f) {
      const Eigen::Vector3f direction = towards(azimuth, elevation);
      if (direction.dot(light.to_sun) > 0.97f) continue;  // the sun and its glow count as sunlight
      const float weight = std::cos(elevation) * std::sin(elevation);
      sum += weight * sky().radiance(direction, light, 0.05f);
      weights += weight;
    }
  }
  const Eigen::Vector3f mean = sum / weights;
  EXPECT_GT(mean.mean(), 0.8f * light.sky.mean());
  EXPECT_LT(mean.mean(), 1.9f * light.sky.mean());  // sunlit clouds add to a clear sky's light
}

TEST(Sky, HasTheSunWhereItsLightComesFrom) {
  for (const double hour : {8.0, 10.5, 15.0}) {
    const Light light = light_at(hour, 0.0);
    const float seen = sky().radiance(light.to_sun, light, kPixel).mean();
    for (float azimuth = 0.0f; azimuth < 6.28f; azimuth += 0.3f) {
      for (float elevation = 0.2f; elevation < 1.5f; elevation += 0.3f) {
        EXPECT_GT(seen, sky().radiance(towards(azimuth, elevation), light, kPixel).mean());
      }
    }
  }
}

TEST(Sky, EndsInHillsBelowFiveDegreesAndInHazeAboveThem) {
  const Light light = light_at(10.0, 0.0);
  const Eigen::Vector3f far = haze(light);
  EXPECT_LT((around(0.1f, light) - far).norm(), 0.35f * far.norm());
  EXPECT_LT(around(0.008f, light).mean(), 0.75f * far.mean());
  // No steps at the edge of the horizon picture and at the horizon itself.
  for (float azimuth = 0.0f; azimuth < 6.28f; azimuth += 0.2f) {
    const auto at = [&](float elevation) { return sky().radiance(towards(azimuth, elevation), light, kPixel); };
    EXPECT_LT((at(0.0799f) - at(0.0805f)).norm(), 0.05);
    EXPECT_LT((at(-0.0001f) - at(0.0001f)).norm(), 0.05);
  }
}

TEST(Sky, IsSmoothForAWidePixel) {
  const Light light = light_at(10.0, 0.0);
  const auto unrest = [&](float spread_rad) {
    float sum = 0.0f;
    for (float azimuth = 0.0f; azimuth < 6.28f; azimuth += 0.05f) {
      const Eigen::Vector3f here = sky().radiance(towards(azimuth, 0.4f), light, spread_rad);
      sum += (sky().radiance(towards(azimuth + 0.02f, 0.4f), light, spread_rad) - here).norm();
    }
    return sum;
  };
  EXPECT_LT(unrest(0.3f), 0.5f * unrest(kPixel));
}

TEST(Sky, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Light light = light_at(10.0, 0.0);
  const Sky same(7);
  const Sky other(8);
  float difference = 0.0f;
  for (float azimuth = 0.0f; azimuth < 6.28f; azimuth += 0.1f) {
    const Eigen::Vector3f direction = towards(azimuth, 0.5f);
    EXPECT_EQ(same.radiance(direction, light, kPixel), sky().radiance(direction, light, kPixel));
    difference += (other.radiance(direction, light, kPixel) - sky().radiance(direction, light, kPixel)).norm();
  }
  EXPECT_GT(difference, 1.0f);
}

}  // namespace
}  // namespace panvo::simulated_world
