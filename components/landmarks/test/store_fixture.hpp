// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/postgres/connection.hpp"
#include "panvo/postgres/worker.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/postgres_server.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::landmarks::test {

using panvo::test::becomes_true;
using panvo::test::PostgresServer;
using panvo::test::TemporaryFolder;

/// A test with empty databases on a server of its own, which runs again when the test ends.
class ServerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!postgres::is_available()) GTEST_SKIP() << "built without libpq; install libpq-dev";
    PANVO_SKIP_WITHOUT_POSTGRES();
    server_ = &PostgresServer::shared();
    database_ = new_database();
  }
  void TearDown() override {
    if (!server_) return;
    server_->thaw();
    server_->start();
  }

  std::string new_database() const {
    static int made = 0;
    const std::string name = "map" + std::to_string(++made);
    server_->sql("postgres", "CREATE DATABASE " + name);
    return name;
  }
  std::string location() const { return server_->location(database_); }
  std::string sql(const std::string& statements) const { return server_->sql(database_, statements); }
  /// Ends all sessions of panvo in the database, like an administrator.
  std::string kill_sessions() const {
    return server_->sql("postgres", "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity WHERE datname = '" +
                                        database_ + "' AND pid <> pg_backend_pid()");
  }

  PostgresServer* server_ = nullptr;
  std::string database_;
};

/// Waits for short, so that tests do not take long, and for a second attempt at most.
inline StorePatience little_patience() {
  return {.connect_s = 2, .answer_s = 1, .pause = [](int attempt, const std::string&) { return attempt < 1; }};
}

/// Tries again until the server answers; a minute at most.
inline StorePatience much_patience() {
  return {.connect_s = 2, .answer_s = 2, .pause = [](int attempt, const std::string&) {
            return attempt < 240 && postgres::sleep_before_attempt(0, 1);
          }};
}

/// The whole landmark as a store has it.
inline PanoramicLandmark whole(const LandmarkStore& store, std::uint32_t id) {
  for (auto& landmark : store.landmarks()) {
    if (landmark.id != id) continue;
    landmark.keypoints = store.keypoints(id);
    landmark.thumbnail = store.thumbnail(id);
    return landmark;
  }
  ADD_FAILURE() << "no landmark " << id;
  return {};
}

}  // namespace panvo::landmarks::test
