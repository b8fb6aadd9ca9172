/** The keys of a view that has the focus. */
import type { Side } from '../landmarks.ts';
import type { LookFrom } from '../wasm/page.js';
import type { Place } from './gestures.ts';

/** What keys act on; lengths are in units of the view's height, y up. */
export interface KeyTarget {
  orbit(side: Side, dx: number, dy: number): void;
  pan(side: Side, dx: number, dy: number): void;
  /** Turns the picture counter-clockwise, in radians. */
  roll(side: Side, angle: number): void;
  zoom(side: Side, factor: number, at: Place): void;
  fit(side: Side): void;
  reset(side: Side): void;
  lookFrom(side: Side, from: LookFrom): void;
  /** Moves the selected pin, in CSS pixels, y up; returns whether there is one. */
  nudge(side: Side, dx: number, dy: number): boolean;
  /** Deletes the selected pair; returns whether there is one. */
  deleteSelected(): boolean;
  pick(side: Side, at: Place): void;
  /** Accepts the place that the map proposes; returns whether there is one. */
  accept(): boolean;
  /** Gives up what is in progress; returns whether anything was. */
  escape(): boolean;
}

/** A sentence about the keys, for users who do not see the views. */
export const HELP =
  'Arrow keys turn, with Shift they move; Q and E roll; plus, minus, Page Up and Page Down zoom; F fits the mesh into the view; 0 resets; ' +
  'Shift with F, B, L, R, T or U looks from the front, the back, the left, the right, the top or from under; ' +
  'Enter or Space picks the point in the middle; where the map proposes a place, Enter takes it and Escape drops it. With a landmark selected arrow keys move it, Delete deletes it, Escape lets it go.';

/**
 * The step of an arrow key, in heights of the view. A drag over the height turns by 4 rad, so this is 14°, and 26 presses make a full turn.
 */
const STEP = 0.06;
/** The factor of a zoom key: five presses double the size. */
const ZOOM = 1.15;
/** The factor of Page Up and Page Down: two presses double the size. */
const PAGE_ZOOM = Math.SQRT2;
/** The angle of a roll key, in radians: 24 presses make a full turn. */
const ROLL = Math.PI / 12;
/** The factor by which Shift increases a step of one pixel. */
const COARSE = 10;

const MIDDLE: Place = { x: 0, y: 0 };

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

const DIRECTIONS: Readonly<Record<string, LookFrom>> = { F: 'front', B: 'back', L: 'left', R: 'right', T: 'top', U: 'bottom' };

/** Does what a key means in a view; returns whether it means anything. */
export function pressKey(target: KeyTarget, side: Side, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) {
    return false;
  }
  const arrow = ARROWS[event.key];
  if (arrow !== undefined) {
    pressArrow(target, side, arrow, event.shiftKey);
    return true;
  }
  const from = event.shiftKey ? DIRECTIONS[event.key.toUpperCase()] : undefined;
  if (from !== undefined) {
    target.lookFrom(side, from);
    return true;
  }
  switch (event.key) {
    case '+':
    case '=':
      target.zoom(side, ZOOM, MIDDLE);
      return true;
    case '-':
      target.zoom(side, 1 / ZOOM, MIDDLE);
      return true;
    case 'PageUp':
      target.zoom(side, PAGE_ZOOM, MIDDLE);
      return true;
    case 'PageDown':
      target.zoom(side, 1 / PAGE_ZOOM, MIDDLE);
      return true;
    case 'q':
      target.roll(side, ROLL);
      return true;
    case 'e':
      target.roll(side, -ROLL);
      return true;
    case 'f':
      target.fit(side);
      return true;
    case '0':
    case 'Home':
      target.reset(side);
      return true;
    case 'Enter':
      if (!target.accept()) {
        target.pick(side, MIDDLE);
      }
      return true;
    case ' ':
      target.pick(side, MIDDLE);
      return true;
    case 'Delete':
    case 'Backspace':
      return target.deleteSelected();
    case 'Escape':
      return target.escape();
    default:
      return false;
  }
}

function pressArrow(target: KeyTarget, side: Side, [x, y]: readonly [number, number], shift: boolean): void {
  const pixels = shift ? COARSE : 1;
  if (target.nudge(side, x * pixels, y * pixels)) {
    return;
  }
  if (shift) {
    target.pan(side, x * STEP, y * STEP);
  } else {
    target.orbit(side, x * STEP, y * STEP);
  }
}
