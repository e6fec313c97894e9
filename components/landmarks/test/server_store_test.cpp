// SPDX-License-Identifier: Apache-2.0
// A store on a server: several writers, lost connections, passwords, versions.
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <mutex>
#include <set>
#include <thread>

#include "postgres_schema.hpp"
#include "store_fixture.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

class ServerStore : public ServerTest {
 protected:
  LandmarkStore opened(const StorePatience& patience = much_patience()) const {
    return LandmarkStore(location(), made_up_settings(), patience);
  }
  /// Runs `write` in several threads, each with a store of its own.
  template <class Write>
  void in_threads(int count, Write write) const {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) {
      threads.emplace_back([&, i] {
        try {
          LandmarkStore store(location(), made_up_settings(), much_patience());
          write(store, i);
        } catch (const std::exception& error) {
          ADD_FAILURE() << error.what();
        }
      });
    }
    for (auto& thread : threads) thread.join();
  }
  /// Every landmark is whole, and there are `count`.
  void expect_whole(std::size_t count) const {
    const LandmarkStore store(location());
    EXPECT_EQ(store.size(), count);
    EXPECT_EQ(store.find_damage(), std::nullopt);
    EXPECT_EQ(store.keypoint_count(), 20 * count);
    EXPECT_EQ(sql("SELECT count(*) FROM panvo.thumbnail WHERE length(jpeg) = 1000"), std::to_string(count));
  }
};

TEST_F(ServerStore, GivesLandmarksOfSeveralThreadsDifferentIds) {
  std::vector<std::vector<std::uint32_t>> ids(4);
  in_threads(4, [&](LandmarkStore& store, int robot) {
    for (std::uint32_t i = 1; i <= 20; ++i) {
      ids[static_cast<std::size_t>(robot)].push_back(store.add(made_up_landmark(i), IfTaken::kNextId));
    }
  });
  std::set<std::uint32_t> all;
  for (const auto& of_robot : ids) all.insert(of_robot.begin(), of_robot.end());
  EXPECT_EQ(all.size(), 80U);
  expect_whole(80);
}

TEST_F(ServerStore, TakesLandmarksOfSeveralProcesses) {
  { const auto made = opened(); }
  std::vector<pid_t> processes;
  for (int i = 0; i < 3; ++i) {
    const pid_t process = ::fork();
    if (process == 0) {
      ::execl(PANVO_STORING_CHILD, PANVO_STORING_CHILD, location().c_str(), "share", "15", nullptr);
      ::_exit(127);
    }
    processes.push_back(process);
  }
  for (const auto process : processes) {
    int status = -1;
    ASSERT_EQ(::waitpid(process, &status, 0), process);
    EXPECT_EQ(status, 0);
  }
  expect_whole(45);
}

TEST_F(ServerStore, LosesNothingOfAKilledProcessThatItHadAdded) {
  { const auto made = opened(); }
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::execl(PANVO_STORING_CHILD, PANVO_STORING_CHILD, location().c_str(), "20", nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  std::FILE* output = ::fdopen(ends[0], "r");
  char line[100] = "";
  unsigned long told = 0;
  while (told < 10 && std::fgets(line, sizeof line, output)) told = std::strtoul(line, nullptr, 10);
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  std::fclose(output);
  EXPECT_GE(told, 10U);
  const auto size = LandmarkStore(location()).size();
  EXPECT_GE(size, told);
  expect_whole(size);
}

TEST_F(ServerStore, IsMadeOnceBySeveralThatBeginAtOnce) {
  in_threads(6, [](LandmarkStore& store, int) { EXPECT_EQ(store.settings(), made_up_settings()); });
  EXPECT_EQ(sql("SELECT count(*) FROM panvo.store"), "1");
  EXPECT_EQ(sql("SELECT count(*) FROM panvo.meta"), "2");
}

TEST_F(ServerStore, HasTheMapOfOneOfTwoRobotsThatMoveTheSameLandmarks) {
  {
    auto store = opened();
    for (std::uint32_t id = 1; id <= 8; ++id) store.add(made_up_landmark(id));
  }
  std::atomic<int> left = 2;
  std::thread reader([&] {
    const LandmarkStore store(location(), much_patience());
    while (left > 0) {
      std::set<double> seen;
      for (const auto& landmark : store.landmarks()) {
        if (landmark.covariance(0, 0) < 2.5) continue;  // not moved yet
        seen.insert(landmark.map_from_base.translation().x());
        EXPECT_EQ(landmark.map_from_base.translation().x(), landmark.covariance(0, 0)) << "torn landmark";
      }
      EXPECT_LE(seen.size(), 1U) << "torn map";
    }
  });
  in_threads(2, [&](LandmarkStore& store, int robot) {
    for (int round = 0; round < 20; ++round) {
      std::vector<LandmarkPose> poses(8);
      for (std::uint32_t i = 0; i < 8; ++i) {
        poses[i].id = robot == 0 ? i + 1 : 8 - i;  // in opposite orders
        poses[i].map_from_base.translation().x() = 10.0 + 2 * round + robot;
        poses[i].covariance.setIdentity();
        poses[i].covariance *= 10.0 + 2 * round + robot;
      }
      store.set_poses(poses);
    }
    --left;
  });
  reader.join();
  std::set<double> last;
  for (const auto& landmark : LandmarkStore(location()).landmarks()) last.insert(landmark.covariance(0, 0));
  EXPECT_EQ(last.size(), 1U);
  EXPECT_GE(*last.begin(), 48.0);
}

TEST_F(ServerStore, CountsThePassesOfTwoRobots) {
  {
    auto store = opened();
    for (const std::uint32_t id : {1U, 2U}) store.add(made_up_landmark(id));
  }
  std::latch both_are_ready(2);
  in_threads(2, [&](LandmarkStore& store, int robot) {
    both_are_ready.arrive_and_wait();
    for (int i = 0; i < 100; ++i) {
      std::vector<LandmarkPass> passes{{1, true, false}, {2, robot == 0, false}};
      if (robot == 0) std::ranges::reverse(passes);
      store.count(passes);
    }
  });
  const auto uses = LandmarkStore(location()).uses();
  EXPECT_EQ(uses.at(1).passes, 200U);
  EXPECT_EQ(uses.at(1).recognitions, 200U);
  EXPECT_EQ(uses.at(2).passes, 200U);
  EXPECT_EQ(uses.at(2).recognitions, 100U);
}

TEST_F(ServerStore, NumbersTheRunsOfSeveralRobotsDifferently) {
  std::mutex mutex;
  std::multiset<std::uint32_t> sessions;
  in_threads(4, [&](LandmarkStore& store, int) {
    for (int i = 0; i < 5; ++i) {
      const auto session = store.next_session();
      const std::lock_guard lock(mutex);
      sessions.insert(session);
    }
  });
  EXPECT_EQ(std::set(sessions.begin(), sessions.end()).size(), 20U);
}

TEST_F(ServerStore, GoesOnAfterItsSessionWasKilled) {
  auto store = opened();
  store.add(made_up_landmark(1));
  EXPECT_EQ(kill_sessions(), "1");
  EXPECT_EQ(store.size(), 1U);
  EXPECT_EQ(kill_sessions(), "1");
  store.add(made_up_landmark(2));
  expect_whole(2);
}

TEST_F(ServerStore, AddsEachLandmarkOnceWhileSessionsAreKilled) {
  auto store = opened();  // the first connection is not repeated
  std::atomic<bool> has_ended = false;
  std::thread robot([&] {
    try {
      for (std::uint32_t id = 1; id <= 60; ++id) EXPECT_EQ(store.add(made_up_landmark(id)), id);
    } catch (const StoreError& error) {
      ADD_FAILURE() << error.what();
    }
    has_ended = true;
  });
  int kills = 0;
  EXPECT_TRUE(becomes_true([&] {
    if (kill_sessions() != "0") ++kills;
    return has_ended.load();
  }));
  robot.join();
  EXPECT_GT(kills, 0);
  expect_whole(60);
}

// The server commits, and the connection is lost before it says so.
TEST_F(ServerStore, AddsALandmarkOnceIfTheAnswerToItsCommitIsLost) {
  auto store =
      opened({.connect_s = 5, .answer_s = 60, .pause = [](int attempt, const std::string&) { return attempt < 100; }});
  auto landmark = made_up_landmark(1);
  landmark.id = 0;
  store.add(landmark);
  // A commit is on disk, but then waits for a standby that does not exist.
  const auto wait_for_standby = [&](bool waits) {
    server_->sql("postgres", waits ? "ALTER SYSTEM SET synchronous_standby_names = 'nobody'"
                                   : "ALTER SYSTEM RESET synchronous_standby_names");
    server_->sql("postgres", "SELECT pg_reload_conf()");
  };
  const auto is_waiting = [&](const std::string& database) {
    return server_->sql("postgres",
                        "SELECT count(*) FROM pg_stat_activity WHERE wait_event = 'SyncRep' AND datname = '" +
                            database + "'") == "1";
  };
  wait_for_standby(true);
  // The server takes the setting over after a while: when the first commit of this thread waits.
  std::atomic<bool> is_set = false;
  std::thread trial([&] {
    postgres::Connection connection(server_->location("postgres"), {.connect_s = 5, .answer_s = 60});
    while (!is_set) connection.query("SELECT pg_current_xact_id()");
  });
  EXPECT_TRUE(becomes_true([&] { return is_waiting("postgres"); }));
  is_set = true;
  std::uint32_t id = 0;
  std::thread robot([&] { id = store.add(landmark); });
  EXPECT_TRUE(becomes_true([&] { return is_waiting(database_); }));
  kill_sessions();
  wait_for_standby(false);
  robot.join();
  trial.join();
  EXPECT_EQ(id, 2U);
  expect_whole(2);
}

TEST_F(ServerStore, LosesNothingWhenTheServerCrashesAndIsStartedAgain) {
  std::atomic<std::uint32_t> added = 0;
  std::thread robot([&] {
    auto store = opened();
    for (std::uint32_t id = 1; id <= 40; ++id) {
      EXPECT_EQ(store.add(made_up_landmark(id)), id);
      added = id;
    }
  });
  for (const int signal : {SIGQUIT, SIGINT}) {
    const auto before = added.load();
    EXPECT_TRUE(becomes_true([&] { return added >= std::min(before + 5, 40U); }));
    server_->stop(signal);
    server_->start();
  }
  robot.join();
  expect_whole(40);
}

TEST_F(ServerStore, TellsThatTheServerIsAwayAndGoesOnWhenItIsBack) {
  auto store = opened(little_patience());
  store.add(made_up_landmark(1));
  server_->stop();
  EXPECT_THAT(
      error_of<StoreUnavailable>([&] { store.add(made_up_landmark(2)); }),
      testing::AllOf(HasSubstr(database_), HasSubstr("the server cannot be reached"), HasSubstr("check that it runs")));
  EXPECT_THAT(error_of<StoreUnavailable>([&] { store.size(); }), HasSubstr("the server cannot be reached"));
  EXPECT_THAT(error_of<StoreUnavailable>([&] { LandmarkStore(location(), little_patience()); }),
              HasSubstr("the server cannot be reached"));
  server_->start();
  store.add(made_up_landmark(2));
  expect_whole(2);
}

TEST_F(ServerStore, GivesUpAFrozenServerAfterItsLimits) {
  auto store = opened(little_patience());
  store.add(made_up_landmark(1));
  server_->freeze();
  EXPECT_THAT(error_of<StoreUnavailable>([&] { store.add(made_up_landmark(2)); }), HasSubstr("cannot be reached"));
  EXPECT_THAT(error_of<StoreUnavailable>([&] { store.landmarks(); }), HasSubstr("cannot be reached"));
  server_->thaw();
  store.add(made_up_landmark(2));
  expect_whole(2);
}

TEST_F(ServerStore, TellsAnotherSessionThatBlocksIt) {
  auto store = opened(little_patience());
  store.add(made_up_landmark(1));
  postgres::Connection other(location());
  const postgres::Transaction transaction(other);
  other.execute("LOCK TABLE panvo.landmark IN ACCESS EXCLUSIVE MODE");
  EXPECT_THAT(error_of<StoreUnavailable>([&] { store.add(made_up_landmark(2)); }),
              HasSubstr("another writer is in the way"));
}

TEST_F(ServerStore, IsReadWithoutTheRightToWrite) {
  opened().add(made_up_landmark(1));
  sql("CREATE USER visitor; GRANT USAGE ON SCHEMA panvo TO visitor; GRANT SELECT ON ALL TABLES IN SCHEMA panvo TO "
      "visitor");
  auto as_visitor = location();
  as_visitor.replace(as_visitor.find("user=panvo"), 10, "user=visitor");
  EXPECT_EQ(LandmarkStore(as_visitor).size(), 1U);
  EXPECT_THAT(error_of<StoreUnavailable>([&] { LandmarkStore(as_visitor, made_up_settings()); }),
              HasSubstr("the rights do not suffice"));
}

TEST_F(ServerStore, TellsAMissingDatabaseAndUser) {
  EXPECT_THAT(
      error_of<StoreUnavailable>([&] { LandmarkStore(server_->location("nowhere")); }),
      testing::AllOf(HasSubstr("database \"nowhere\" does not exist"), HasSubstr("create the database (createdb)")));
}

TEST_F(ServerStore, TakesThePasswordFromTheUsualPlacesAndNeverTellsIt) {
  sql("CREATE USER robot PASSWORD 'opensesame' SUPERUSER");
  const auto rules = server_->folder().read("data/pg_hba.conf");
  server_->folder().write("data/pg_hba.conf", "local all robot scram-sha-256\n" + rules);
  server_->sql("postgres", "SELECT pg_reload_conf()");
  const auto at = [&](const std::string& user) {
    return "postgresql://" + user + "@/" + database_ + "?host=" + server_->folder().path().string();
  };
  // Until the server has read the rule.
  EXPECT_TRUE(becomes_true(
      [&] { return !error_of<StoreError>([&] { LandmarkStore(at("robot"), made_up_settings()); }).empty(); }));

  for (const auto& wrong : {at("robot:opensesam"), at("robot") + "&password=opensesam"}) {
    const auto error = error_of<StoreUnavailable>([&] { LandmarkStore(wrong, made_up_settings()); });
    EXPECT_THAT(error, HasSubstr("postgresql://robot@/" + database_));
    EXPECT_THAT(error, HasSubstr("the server refuses the password"));
    EXPECT_THAT(error, HasSubstr("~/.pgpass or the file that PGPASSFILE names"));
    EXPECT_THAT(error, Not(HasSubstr("sesam")));
  }
  EXPECT_THAT(error_of<StoreUnavailable>([&] { LandmarkStore(at("robot"), made_up_settings()); }),
              HasSubstr("refuses the password"));

  const LandmarkStore by_location(at("robot:opensesame"), made_up_settings());
  EXPECT_THAT(by_location.name(), Not(HasSubstr("sesame")));
  ::setenv("PGPASSWORD", "opensesame", 1);
  EXPECT_EQ(error_of<StoreError>([&] { LandmarkStore(at("robot"), made_up_settings()); }), "");
  ::unsetenv("PGPASSWORD");
  const auto file = server_->folder().write("passwords", "*:*:*:robot:opensesame\n");
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  ::setenv("PGPASSFILE", file.c_str(), 1);
  EXPECT_EQ(error_of<StoreError>([&] { LandmarkStore(at("robot"), made_up_settings()); }), "");
  ::unsetenv("PGPASSFILE");
  server_->folder().write("data/pg_hba.conf", rules);
  server_->sql("postgres", "SELECT pg_reload_conf()");
}

TEST_F(ServerStore, OfAnOlderLayoutIsConvertedWithItsContent) {
  opened().add(made_up_landmark(1));
  postgres::Connection connection(location());
  const char* const steps[] = {store_migrations()[0], "ALTER TABLE panvo.landmark ADD COLUMN colour bigint DEFAULT 7"};
  EXPECT_THAT(
      error_of<StoreError>([&] { check_layout(connection, "map", 2); }),
      HasSubstr("map: has the older layout 1; this version of panvo reads 2. Start a run that stores landmarks"));
  migrate(connection, "map", steps);
  EXPECT_EQ(layout_of(connection), 2);
  EXPECT_EQ(sql("SELECT id, colour FROM panvo.landmark"), "1|7");
  migrate(connection, "map", steps);
  EXPECT_THAT(error_of<StoreError>([&] { LandmarkStore{StoreLocation(location())}; }),
              HasSubstr("has layout 2; this version of panvo reads 1"));
}

TEST_F(ServerStore, KeepsItsOldLayoutIfTheConversionFails) {
  opened().add(made_up_landmark(1));
  postgres::Connection connection(location());
  const char* const steps[] = {store_migrations()[0],
                               "ALTER TABLE panvo.landmark ADD COLUMN colour bigint; SELECT nothing FROM nowhere"};
  EXPECT_THROW(migrate(connection, "map", steps), postgres::DatabaseError);
  EXPECT_EQ(layout_of(connection), 1);
  expect_whole(1);
}

TEST_F(ServerStore, OfAnotherProgramIsRefusedAndLeftAlone) {
  sql("CREATE SCHEMA panvo; CREATE TABLE panvo.landmark(name text)");
  EXPECT_THAT(error_of<StoreError>([&] { opened(); }), HasSubstr("already exists"));
  EXPECT_EQ(sql("SELECT count(*) FROM pg_tables WHERE schemaname = 'panvo'"), "1");
}

}  // namespace
}  // namespace panvo::landmarks
