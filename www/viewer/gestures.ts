/** Mouse, pen, touch and keys become camera moves and picks. */
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';

/** A view's box in the window, in CSS pixels. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** What gestures do; lengths in units of the view's height, y up; picks in [-1, 1], y up. */
export interface GestureTarget {
  box(side: Side): Box;
  orbit(side: Side, dx: number, dy: number): void;
  pan(side: Side, dx: number, dy: number): void;
  zoom(side: Side, factor: number): void;
  reset(side: Side): void;
  pick(side: Side, x: number, y: number): void;
  cancelPick(): void;
  focus(side: Side): void;
}

interface Finger {
  x: number;
  y: number;
}

/** How far a pointer may travel between press and release and still click, in CSS pixels: hands and fingers tremble. */
const CLICK_SLACK = 5;
/** An arrow key's step in heights of the view. A height turns by 4 rad, so that this is 14°: 26 presses go round. */
const KEY_STEP = 0.06;
/** A zoom key's factor: five presses double the size. */
const KEY_ZOOM = 1.15;
/** What a wheel tells for one notch: 100 pixels (Chromium), or 3 lines (Firefox). */
const NOTCH_PIXELS = 100;
const NOTCH_LINES = 3;
/** Events bring more notches where the page was late or the wheel spins freely; more than these would lose the mesh. */
const MOST_NOTCHES = 3;
/** The logarithm of a notch's factor: a little more than a key, as a notch is made more quickly. */
const NOTCH_ZOOM = 0.16;
/** A pinch on a touchpad comes as a wheel with Ctrl, in steps of some pixels: five times as strong, the mesh follows the fingers. */
const PINCH_ZOOM = 5 * NOTCH_ZOOM;

/** Listens on the canvas; the views' own elements give the boxes and take the keys. */
export function listen(canvas: HTMLCanvasElement, views: readonly [HTMLElement, HTMLElement], target: GestureTarget): void {
  const fingers = new Map<number, Finger>();
  let side: Side = 0;
  let moved = 0;
  let many = false;
  let panning = false;

  const sideAt = (x: number, y: number): Side | null => {
    for (const candidate of SIDES) {
      const box = target.box(candidate);
      if (x >= box.left && x < box.left + box.width && y >= box.top && y < box.top + box.height) {
        return candidate;
      }
    }
    return null;
  };

  canvas.addEventListener('pointerdown', (event) => {
    if (fingers.size === 0) {
      const under = sideAt(event.clientX, event.clientY);
      if (under === null) {
        return;
      }
      side = under;
      moved = 0;
      many = false;
      panning = event.button !== 0 || event.shiftKey;
      target.focus(side);
    }
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    many ||= fingers.size > 1;
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {
      // The pointer is gone already.
    }
    event.preventDefault();
  });

  canvas.addEventListener('pointermove', (event) => {
    const finger = fingers.get(event.pointerId);
    if (finger === undefined) {
      return;
    }
    const height = target.box(side).height;
    const dx = event.clientX - finger.x;
    const dy = event.clientY - finger.y;
    moved += Math.hypot(dx, dy);
    if (fingers.size >= 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
      if (other !== undefined) {
        const before = Math.hypot(finger.x - other.x, finger.y - other.y);
        const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
        if (before > 1 && after > 1) {
          target.zoom(side, after / before);
        }
        target.pan(side, dx / 2 / height, -dy / 2 / height);
      }
    } else if (moved > CLICK_SLACK) {
      if (panning) {
        target.pan(side, dx / height, -dy / height);
      } else if (!many) {
        target.orbit(side, dx / height, -dy / height);
      }
    }
    finger.x = event.clientX;
    finger.y = event.clientY;
  });

  const lift = (event: PointerEvent, clicks: boolean): void => {
    if (!fingers.delete(event.pointerId) || fingers.size > 0) {
      return;
    }
    if (clicks && moved <= CLICK_SLACK && !many && !panning) {
      const box = target.box(side);
      target.pick(
        side,
        (2 * (event.clientX - box.left)) / box.width - 1,
        1 - (2 * (event.clientY - box.top)) / box.height,
      );
    }
  };
  canvas.addEventListener('pointerup', (event) => {
    lift(event, true);
  });
  canvas.addEventListener('pointercancel', (event) => {
    lift(event, false);
  });
  canvas.addEventListener('contextmenu', (event) => {
    event.preventDefault();
  });
  canvas.addEventListener(
    'wheel',
    (event) => {
      const under = sideAt(event.clientX, event.clientY);
      if (under === null) {
        return;
      }
      event.preventDefault();
      const notches = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / NOTCH_PIXELS : event.deltaY / NOTCH_LINES;
      const bounded = Math.max(-MOST_NOTCHES, Math.min(MOST_NOTCHES, notches));
      target.zoom(under, Math.exp(-bounded * (event.ctrlKey ? PINCH_ZOOM : NOTCH_ZOOM)));
    },
    { passive: false },
  );

  for (const candidate of SIDES) {
    views[candidate].addEventListener('keydown', (event) => {
      if (keyMove(target, candidate, event)) {
        event.preventDefault();
      }
    });
  }
}

function keyMove(target: GestureTarget, side: Side, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) {
    return false;
  }
  const move = (dx: number, dy: number): boolean => {
    if (event.shiftKey) {
      target.pan(side, dx, dy);
    } else {
      target.orbit(side, dx, dy);
    }
    return true;
  };
  switch (event.key) {
    case 'ArrowLeft':
      return move(-KEY_STEP, 0);
    case 'ArrowRight':
      return move(KEY_STEP, 0);
    case 'ArrowUp':
      return move(0, KEY_STEP);
    case 'ArrowDown':
      return move(0, -KEY_STEP);
    case '+':
    case '=':
      target.zoom(side, KEY_ZOOM);
      return true;
    case '-':
      target.zoom(side, 1 / KEY_ZOOM);
      return true;
    case '0':
    case 'Home':
      target.reset(side);
      return true;
    case 'Enter':
    case ' ':
      target.pick(side, 0, 0);
      return true;
    case 'Escape':
      target.cancelPick();
      return true;
    default:
      return false;
  }
}
