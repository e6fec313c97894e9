// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/landmarks/landmark_use.hpp"

namespace panvo::landmarks {

/// Parameters of the component LandmarkStoreComponent.
struct StoreParameters {
  std::string file;
  bool read_only = false;
  std::string map_frame = "map";
  int appearances = 4;
  int forget_after = 10;
  int waiting = 1000;
  int answer_s = 10;

  UseRules rules() const {
    UseRules rules;
    rules.appearances = appearances;
    rules.forget_after = forget_after;
    return rules;
  }

  template <class Field>
  static void describe(Field&& field) {
    using P = StoreParameters;
    field.path(&P::file, "file",
               "store file, created with the first landmark, or location of a PostgreSQL database, "
               "postgresql://USER@HOST/NAME; "
               "empty: landmarks are not saved");
    field(&P::read_only, "read_only", "", "publish the stored landmarks, store nothing");
    field(&P::map_frame, "map_frame", "", "frame of the stored poses");
    field(&P::appearances, "appearances", "1",
          "landmarks at one place: others are kept where the known ones were missed on two drives while most others of "
          "their sessions were missed, too, or on four",
          1, 20);
    field(&P::forget_after, "forget_after", "1",
          "drives past a landmark without recognising it, where most others of its session were recognised, after "
          "which it "
          "is removed; 0: never",
          0, 1000);
    field(
        &P::waiting, "waiting", "1",
        "changes kept in memory while the database server does not answer or another process reads the file; more are "
        "lost, those for a server counted in /diagnostics",
        10, 1'000'000);
    field(&P::answer_s, "answer_s", "s", "longest wait for an answer of the database server", 1, 600);
  }
};

}  // namespace panvo::landmarks
