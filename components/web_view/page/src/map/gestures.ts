// SPDX-License-Identifier: Apache-2.0
/** Mouse, fingers and keys on the map. */

export interface Gestures {
  tap(x: number, y: number): void;
  /** Returns whether the drag is used for something else than moving the map. */
  drag(from: { x: number; y: number }, to: { x: number; y: number }): boolean;
  drop(): void;
  move(dx: number, dy: number): void;
  zoom(factor: number, x?: number, y?: number): void;
  hover(x: number, y: number): void;
  /** To the left (1) or right (-1). */
  turn(by: 1 | -1): void;
}

const tap_px = 6; // a press that moves less is a tap
const keys: Record<string, [number, number]> = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };

interface Pointer {
  x: number;
  y: number;
}

export function listen(canvas: HTMLCanvasElement, gestures: Gestures): void {
  const pointers = new Map<number, Pointer>();
  let start: Pointer | undefined;
  let isTap = false;
  let isTaken = false;
  const at = ({ offsetX, offsetY }: MouseEvent): Pointer => ({ x: offsetX, y: offsetY });

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    start = at(event);
    isTap = pointers.size === 1;
    isTaken = false;
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    const now = at(event);
    if (!last || !start) return gestures.hover(now.x, now.y);
    if (Math.hypot(now.x - start.x, now.y - start.y) > tap_px) isTap = false;
    if (pointers.size === 1 && !isTap) {
      isTaken = gestures.drag(start, now);
      if (!isTaken) gestures.move(now.x - last.x, now.y - last.y);
    } else if (pointers.size === 2) {
      pinch(pointers, event.pointerId, now);
    }
    if (!isTap || pointers.size > 1) pointers.set(event.pointerId, now);
  });
  const end = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId)) return;
    if (pointers.size > 0) return;
    if (event.type === "pointerup" && isTap) gestures.tap(event.offsetX, event.offsetY);
    if (isTaken) gestures.drop();
    start = undefined;
  };
  canvas.addEventListener("pointerup", end);
  canvas.addEventListener("pointercancel", end);

  function pinch(all: Map<number, Pointer>, moving: number, now: Pointer): void {
    const before = all.get(moving)!;
    const other = [...all].find(([id]) => id !== moving)![1];
    const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
    const factor = Math.hypot(now.x - other.x, now.y - other.y) / Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
    gestures.move((now.x - before.x) / 2, (now.y - before.y) / 2);
    gestures.zoom(factor, middle.x, middle.y);
  }

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : 1;
      gestures.zoom(Math.exp(-Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.002), event.offsetX, event.offsetY);
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", ({ offsetX, offsetY }) => gestures.zoom(2, offsetX, offsetY));
  canvas.addEventListener("keydown", (event) => {
    const step = keys[event.key];
    if (step) gestures.move(...step);
    else if (event.key === "+" || event.key === "=") gestures.zoom(1.4);
    else if (event.key === "-") gestures.zoom(1 / 1.4);
    else if (event.key === "Enter") gestures.tap(canvas.clientWidth / 2, canvas.clientHeight / 2);
    else if (event.key === "[") gestures.turn(1);
    else if (event.key === "]") gestures.turn(-1);
    else return;
    event.preventDefault();
  });
}
