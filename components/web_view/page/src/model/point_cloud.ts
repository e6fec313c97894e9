// SPDX-License-Identifier: Apache-2.0
import type { Header } from "./messages.ts";

/** The members of sensor_msgs/msg/PointCloud2 that are read. */
export interface PointCloud {
  header: Header;
  width: number;
  height: number;
  fields: { name: string; offset: number; datatype: number }[];
  is_bigendian: boolean;
  point_step: number;
  data: Uint8Array;
}

const uint8 = 2; // of sensor_msgs/msg/PointField
const uint32 = 6;
const float32 = 7;

/** The named fields of each point. Undefined if the cloud does not have all of them. */
export function pointsOf<Name extends string>(cloud: PointCloud, names: readonly Name[]): Record<Name, number>[] | undefined {
  const fields = names.map((name) => cloud.fields.find((field) => field.name === name));
  if (!fields.every((field) => field !== undefined)) return undefined;
  const count = Math.min(cloud.width * cloud.height, Math.floor(cloud.data.length / cloud.point_step));
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const isLittle = !cloud.is_bigendian;
  const read = (at: number, datatype: number) => {
    if (datatype === uint8) return view.getUint8(at);
    if (datatype === uint32) return view.getUint32(at, isLittle);
    return datatype === float32 ? view.getFloat32(at, isLittle) : NaN;
  };
  return Array.from({ length: count }, (_, i) => {
    const values = fields.map(({ name, offset, datatype }) => [name, read(i * cloud.point_step + offset, datatype)]);
    return Object.fromEntries(values) as Record<Name, number>;
  });
}
