// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/route.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::simulation {
namespace {

class RouteFileTest : public testing::Test {
 protected:
  std::string problem_of(const std::string& content) {
    try {
      read_route(folder_.write("route.yaml", content));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }
  std::string at(int line) const { return file_.string() + ":" + std::to_string(line) + ": "; }

  const panvo::test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "route.yaml";
};

TEST_F(RouteFileTest, IsReadWithAllItsKeys) {
  const Route route = read_route(
      folder_.write("route.yaml", "name: there\njunctions: [gate, library]\ndescription: \"from the gate\"\n"));
  EXPECT_EQ(route.name, "there");
  EXPECT_EQ(route.junctions, (std::vector<std::string>{"gate", "library"}));
  EXPECT_EQ(route.description, "from the gate");
}

TEST_F(RouteFileTest, ProblemsNameFileLineAndKey) {
  EXPECT_EQ(problem_of("name: a\njunctions: [x]\n").find(at(2) + "junctions:"), 0U);
  EXPECT_EQ(problem_of("name: a\njunctions: x\n").find(at(2) + "junctions:"), 0U);
  EXPECT_EQ(problem_of("name: a\njunctions:\n  - x\n  - [y]\n").find(at(4) + "junctions:"), 0U);
  EXPECT_EQ(problem_of("name: a\njunctions: [x, y]\nspeed: 3\n").find(at(3) + "speed:"), 0U);
  EXPECT_EQ(problem_of("name: a\nname: b\njunctions: [x, y]\n").find(at(2) + "name:"), 0U);
  EXPECT_EQ(problem_of("junctions: [x, y]\n").find(at(1) + "name:"), 0U);
  EXPECT_EQ(problem_of("name: [a]\njunctions: [x, y]\n").find(at(1) + "name:"), 0U);
  EXPECT_EQ(problem_of("name: {a\n").find(file_.string() + ":"), 0U);
  EXPECT_EQ(problem_of("").find(file_.string()), 0U);
}

TEST_F(RouteFileTest, AFileThatIsNotThereIsNamed) {
  try {
    read_route(file_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos);
  }
}

TEST(RandomRoute, CanBeDrivenAndIsTheSameForTheSameSeed) {
  const simulated_world::RoadNetwork roads = simulated_world::campus_roads(4);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Route route = random_route(roads, 12, seed);
    EXPECT_EQ(route.junctions.size(), 12U);
    EXPECT_EQ(route.junctions, random_route(roads, 12, seed).junctions);
    EXPECT_NO_THROW(drive(roads, route)) << "seed " << seed;
  }
  EXPECT_NE(random_route(roads, 12, 1).junctions, random_route(roads, 12, 2).junctions);
  EXPECT_THROW(random_route(roads, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulation
