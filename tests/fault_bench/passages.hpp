// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "fault.hpp"

/// Helpers to create passages from simpler functions.
namespace panvo::test {

/// `alter(message, moment)` changes a copy of each message within the window.
template <class Message, class Alter>
Passage<Message> altered(Alter alter) {
  return [alter](const Message& message, const Moment& moment) mutable {
    std::vector<Message> passed{message};
    if (moment.is_on) alter(passed.front(), moment);
    return passed;
  };
}

/// Drops each message within the window for which `is_dropped(moment)` returns true.
template <class Message, class IsDropped>
Passage<Message> dropped(IsDropped is_dropped) {
  return [is_dropped](const Message& message, const Moment& moment) mutable {
    if (moment.is_on && is_dropped(moment)) return std::vector<Message>{};
    return std::vector<Message>{message};
  };
}

/// Drops all messages within the window.
template <class Message>
Passage<Message> stopped() {
  return dropped<Message>([](const Moment&) { return true; });
}

/// `change(image, moment, eye)` changes copies of the left (0) and right (1) images within the window.
template <class Change>
Passage<StereoPair> both_eyes(Change change) {
  return altered<StereoPair>([change](StereoPair& pair, const Moment& moment) mutable {
    pair.left = pair.left.clone();
    pair.right = pair.right.clone();
    change(pair.left, moment, 0);
    change(pair.right, moment, 1);
  });
}

/// `change(image, moment)` changes a copy of the panorama within the window.
template <class Change>
Passage<Panorama> each_panorama(Change change) {
  return altered<Panorama>([change](Panorama& panorama, const Moment& moment) mutable {
    panorama.pixels = panorama.pixels.clone();
    change(panorama.pixels, moment);
  });
}

}  // namespace panvo::test
