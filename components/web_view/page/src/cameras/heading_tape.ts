// SPDX-License-Identifier: Apache-2.0
/** Directions over the panorama: where ahead, left, right and back are, and the azimuths of the map. */
import { wrapped } from "../model/geometry.ts";

export interface Tick {
  at: number; // fraction of the width, [0, 1)
  text: string;
  isMain: boolean;
}

/** Column of the panorama, as a fraction, in which an azimuth is seen. The middle looks to `centre`. Angles in rad, left positive. */
export function columnOf(azimuth: number, centre: number): number {
  return 0.5 - wrapped(azimuth - centre) / (2 * Math.PI);
}

/** Ticks every 30 degrees of the map, counted from its x axis to the left. */
export function ticksOf(centre: number): Tick[] {
  return Array.from({ length: 12 }, (_, i) => {
    const degrees = i * 30;
    const at = columnOf((degrees * Math.PI) / 180, centre);
    return { at: at === 1 ? 0 : at, text: `${degrees}°`, isMain: degrees % 90 === 0 };
  });
}

/** Directions of the vehicle, whose yaw in the map is `yaw`. */
export function sidesOf(yaw: number, centre: number): { at: number; text: string }[] {
  return [
    ["ahead", 0],
    ["left", 0.5],
    ["back", 1],
    ["right", -0.5],
  ].map(([text, halfTurns]) => ({ text: text as string, at: columnOf(yaw + (halfTurns as number) * Math.PI, centre) % 1 }));
}

/** How far, as a fraction of the width, the picture of a place is moved to the right so that what it shows stands below the same
    thing in the panorama. `heading`: yaw now minus yaw at the place. */
export function shiftOf(heading: number): number {
  const turns = heading / (2 * Math.PI);
  return turns - Math.floor(turns);
}
