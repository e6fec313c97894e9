// SPDX-License-Identifier: Apache-2.0
/** Functions that run in the page; they use nothing from outside themselves. */
import type { App } from "../../src/app.ts";

declare const panvo: App & { addPose?: () => void };

/** Fills the page with a drive that winds through a square of 400 m; every fifth place was seen again. */
export function fill(poses: number, places: number): void {
  const { drive } = panvo;
  const at = (i: number) => ({ x: 200 * Math.sin(i / 120) * Math.cos(i / 324) + i * 0.02, y: 200 * Math.sin(i / 197), z: 0 });
  const covariance = Array.from({ length: 36 }, (_, i) => (i % 7 === 0 ? 0.04 : 0));
  const zero = { x: 0, y: 0, z: 0 };
  let i = 0;
  panvo.addPose = () => {
    const time = 1000 + i * 0.04;
    const header = { stamp: { sec: Math.floor(time), nanosec: Math.round((time % 1) * 1e9) }, frame_id: "map" };
    const orientation = { ...zero, z: Math.sin(i / 240), w: Math.cos(i / 240) };
    const message = { header, pose: { pose: { position: at(i), orientation }, covariance }, twist: { twist: { linear: { ...zero, x: 5 } } } };
    for (const role of ["binocular", "truth", "enhanced"] as const) drive.take({ role, topic: "", message });
    ++i;
  };
  while (i < poses) panvo.addPose();
  const ids = Array.from({ length: places }, (_, place) => place + 1);
  const pose = (place: number) => ({ pose: { position: at(place * 5), orientation: { ...zero, w: 1 } }, covariance });
  drive.take({ role: "landmarkPoses", topic: "", message: { ids, poses: ids.map(pose) } });
  const header = { stamp: { sec: 1000, nanosec: 0 }, frame_id: "map" };
  for (const id of ids.filter((one) => one % 5 === 0)) {
    const [before, after] = [id * 5 + 30, id * 5 + 35].map((place) => ({ position: at(place), orientation: { ...zero, w: 1 } }));
    drive.take({ role: "outcome", topic: "", message: { header, landmark_id: id, outcome: 1 + (id % 3), reason: "", before, after } });
  }
}

/** For 4 s, with a pose in every other frame. */
export async function framesPerSecond(motion: string): Promise<number> {
  const { map } = panvo;
  map.fit();
  if (motion === "follow") {
    map.view.px_per_m = 12;
    map.follow(true);
  }
  const begin = performance.now();
  let frames = 0;
  while (performance.now() - begin < 4000) {
    await new Promise(requestAnimationFrame);
    if (++frames % 2 === 0) panvo.addPose!();
    if (motion === "zoom") map.view.zoom(frames % 100 < 50 ? 1.08 : 1 / 1.08);
    if (motion === "drag") map.view.move(frames % 100 < 50 ? 3 : -3, 1);
    map.draw();
  }
  return (frames / (performance.now() - begin)) * 1000;
}
