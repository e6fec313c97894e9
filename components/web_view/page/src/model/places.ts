// SPDX-License-Identifier: Apache-2.0
/** The landmarks, which are places, and how often each was seen again. */
import { flat, yawOf, type Pose2 } from "./geometry.ts";
import { seconds, type Landmark, type LandmarkPoses } from "./messages.ts";

export interface Place {
  id: number;
  pose: Pose2; // of the vehicle when the place was built, in the map
  isJunction: boolean;
  built_s: number;
  thumbnail: Uint8Array | undefined; // JPEG of the panorama
  corrections: number;
}

export class Places {
  all = new Map<number, Place>();
  version = 0; // changes with the content

  add({ header, id, pose, is_junction, thumbnail }: Landmark): Place {
    const known = this.all.get(id);
    const place: Place = {
      id,
      pose: known?.pose ?? flat(pose.pose), // landmarks/poses is newer than the message of the landmark
      isJunction: is_junction,
      built_s: seconds(header.stamp),
      thumbnail: thumbnail.length > 0 ? thumbnail : undefined,
      corrections: known?.corrections ?? 0,
    };
    ++this.version;
    this.all.set(id, place);
    return place;
  }

  move({ ids, poses }: LandmarkPoses): void {
    ++this.version;
    poses.forEach(({ pose }, i) => {
      const id = ids[i];
      if (id === undefined) return;
      const place = this.all.get(id);
      if (place) place.pose = { x: pose.position.x, y: pose.position.y, yaw: yawOf(pose.orientation) };
      else this.all.set(id, { id, pose: flat(pose), isJunction: false, built_s: NaN, thumbnail: undefined, corrections: 0 });
    });
  }
}
