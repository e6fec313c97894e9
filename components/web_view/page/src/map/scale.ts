// SPDX-License-Identifier: Apache-2.0

/** The largest of 1, 2, 5, 10, 20 ... (and parts of one) that is at most `value`. */
export function roundLength(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const digit = value / power + 1e-9;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

export function lengthText(metres: number): string {
  if (metres >= 1000) return `${metres / 1000} km`;
  return metres >= 1 ? `${metres} m` : `${Math.round(metres * 100)} cm`;
}
