/** Turns the events of mouse, pen and touch into moves of cameras and pins, and into picks. */
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';

/** A view's box in the window, in CSS pixels. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** A place in a view: x and y from -1 to 1, y up. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

/** What gestures act on; lengths are in units of the view's height, y up. */
export interface GestureTarget {
  box(side: Side): Box;
  focus(side: Side): void;
  /** Called when a gesture begins that may turn the view. */
  grab(side: Side): void;
  orbit(side: Side, dx: number, dy: number): void;
  pan(side: Side, dx: number, dy: number): void;
  /** Turns the picture counter-clockwise, in radians. */
  roll(side: Side, angle: number): void;
  /** Magnifies about a place by a factor; `smoothly` for single steps, `at once` for motions that follow a hand. */
  zoom(side: Side, factor: number, at: Place, way: 'smoothly' | 'at once'): void;
  /** Takes the pin under the pointer; returns whether there is one. `slack` is in CSS pixels. */
  takePin(side: Side, at: Place, slack: number): boolean;
  /** Moves the pin that was taken to a place. */
  dragPin(at: Place): void;
  /** Releases the pin that was taken, whether it has moved or not. */
  dropPin(outcome: 'moved' | 'clicked' | 'given up'): void;
  pick(side: Side, at: Place): void;
  /** Called at a click that may become a double click. */
  firstClick(side: Side, at: Place): void;
  doubleClick(side: Side, at: Place): void;
  hover(side: Side, at: Place): void;
  leave(): void;
}

interface Finger {
  x: number;
  y: number;
}

/** What a finger or the mouse is doing. */
type Mode = 'turn' | 'move' | 'pin' | 'nothing';

/** How far a pointer may move between press and release of a click, in CSS pixels, since hands and fingers tremble. */
const CLICK_SLACK = 5;
/** How far beside a pin's head a pointer may take the pin, in CSS pixels; fingers are wider. */
const PIN_SLACK = { mouse: 3, touch: 12 };
/**
 * The time between the clicks of a double click, in ms. It is about that of operating systems, but short, since a single click must wait
 * for it.
 */
const DOUBLE_CLICK = 280;
/** The amount that a wheel reports for one notch: 100 pixels (Chromium), or 3 lines (Firefox). */
const NOTCH_PIXELS = 100;
const NOTCH_LINES = 3;
/**
 * The most notches of one event. An event has more where the page was late or the wheel spins freely, and would move the mesh out of sight.
 */
const MOST_NOTCHES = 3;
/** The logarithm of the factor of a notch: a little more than that of a key, since a notch is made more quickly. */
const NOTCH_ZOOM = 0.16;
/**
 * The same for a pinch on a touchpad, which is reported as a wheel with Ctrl in steps of some pixels. At five times the strength the mesh
 * follows the fingers.
 */
const PINCH_ZOOM = 5 * NOTCH_ZOOM;

/** Listens to the events of a canvas with two views. */
export class Gestures {
  readonly #target: GestureTarget;
  readonly #fingers = new Map<number, Finger>();
  #side: Side = 0;
  #travelled = 0;
  #mode: Mode = 'nothing';
  /** A click that waits for a possible second one. */
  #click: { readonly side: Side; readonly x: number; readonly y: number; readonly timer: number } | null = null;

  constructor(canvas: HTMLCanvasElement, target: GestureTarget) {
    this.#target = target;
    canvas.addEventListener('pointerdown', (event) => {
      this.#press(event);
      try {
        canvas.setPointerCapture(event.pointerId);
      } catch {
        // The pointer is gone already.
      }
      event.preventDefault();
    });
    canvas.addEventListener('pointermove', (event) => {
      this.#move(event);
    });
    canvas.addEventListener('pointerup', (event) => {
      this.#lift(event, 'up');
    });
    canvas.addEventListener('pointercancel', (event) => {
      this.#lift(event, 'cancelled');
    });
    canvas.addEventListener('pointerleave', () => {
      if (this.#fingers.size === 0) {
        target.leave();
      }
    });
    canvas.addEventListener('contextmenu', (event) => {
      event.preventDefault();
    });
    canvas.addEventListener('wheel', (event) => { this.#turnWheel(event); }, { passive: false });
  }

  /** Treats a click that waits for a second one as a single click at once, because what follows depends on its outcome. */
  settle(): void {
    const click = this.#click;
    if (click !== null) {
      this.#click = null;
      clearTimeout(click.timer);
      this.#target.pick(click.side, this.#place(click.side, click));
    }
  }

  #press(event: PointerEvent): void {
    const finger = { x: event.clientX, y: event.clientY };
    if (this.#fingers.size === 0) {
      const under = this.#sideAt(finger);
      if (under === null) {
        return;
      }
      this.#side = under;
      this.#travelled = 0;
      this.#target.focus(under);
      this.#mode = this.#modeOf(event, finger);
      if (this.#mode === 'turn') {
        this.#target.grab(under);
      }
    } else {
      this.#endPin('given up');
      this.#mode = 'nothing';
    }
    this.#fingers.set(event.pointerId, finger);
  }

  #modeOf(event: PointerEvent, finger: Finger): Mode {
    if (event.button !== 0 || event.shiftKey) {
      return 'move';
    }
    if (this.#isSecondClick(finger)) {
      return 'turn';
    }
    this.settle();
    const slack = event.pointerType === 'touch' ? PIN_SLACK.touch : PIN_SLACK.mouse;
    return this.#target.takePin(this.#side, this.#place(this.#side, finger), slack) ? 'pin' : 'turn';
  }

  #isSecondClick(finger: Finger): boolean {
    const click = this.#click;
    return click?.side === this.#side && Math.hypot(finger.x - click.x, finger.y - click.y) <= CLICK_SLACK;
  }

  #move(event: PointerEvent): void {
    const finger = this.#fingers.get(event.pointerId);
    if (finger === undefined) {
      this.#hover(event);
      return;
    }
    const before = { ...finger };
    finger.x = event.clientX;
    finger.y = event.clientY;
    this.#travelled += Math.hypot(finger.x - before.x, finger.y - before.y);
    if (this.#fingers.size > 1) {
      this.#moveMany(finger, before);
    } else if (this.#travelled > CLICK_SLACK) {
      this.settle();
      this.#moveOne(finger, before);
    }
  }

  #moveOne(finger: Finger, before: Finger): void {
    const { height } = this.#target.box(this.#side);
    const dx = (finger.x - before.x) / height;
    const dy = -(finger.y - before.y) / height;
    switch (this.#mode) {
      case 'turn':
        this.#target.orbit(this.#side, dx, dy);
        break;
      case 'move':
        this.#target.pan(this.#side, dx, dy);
        break;
      case 'pin':
        this.#target.dragPin(this.#place(this.#side, finger));
        break;
      case 'nothing':
        break;
    }
  }

  /** Moves, turns and stretches the picture with two fingers; with three or more only moves it. */
  #moveMany(finger: Finger, before: Finger): void {
    const { height } = this.#target.box(this.#side);
    const others = [...this.#fingers.values()].filter((candidate) => candidate !== finger);
    const count = others.length + 1;
    this.#target.pan(this.#side, (finger.x - before.x) / count / height, -(finger.y - before.y) / count / height);
    const [other] = others;
    if (count !== 2 || other === undefined) {
      return;
    }
    const was = { x: before.x - other.x, y: before.y - other.y };
    const is = { x: finger.x - other.x, y: finger.y - other.y };
    const lengths = [Math.hypot(was.x, was.y), Math.hypot(is.x, is.y)] as const;
    if (lengths[0] > 1 && lengths[1] > 1) {
      const middle = { x: (finger.x + other.x) / 2, y: (finger.y + other.y) / 2 };
      this.#target.zoom(this.#side, lengths[1] / lengths[0], this.#place(this.#side, middle), 'at once');
      // On the screen y points down, so this angle is clockwise.
      const clockwise = Math.atan2(was.x * is.y - was.y * is.x, was.x * is.x + was.y * is.y);
      this.#target.roll(this.#side, -clockwise);
    }
  }

  #lift(event: PointerEvent, how: 'up' | 'cancelled'): void {
    const finger = this.#fingers.get(event.pointerId);
    if (finger === undefined) {
      return;
    }
    this.#fingers.delete(event.pointerId);
    if (this.#fingers.size > 0) {
      return;
    }
    const clicks = how === 'up' && this.#travelled <= CLICK_SLACK;
    if (this.#mode === 'pin') {
      this.#endPin(clicks ? 'clicked' : how === 'up' ? 'moved' : 'given up');
    } else if (clicks && this.#mode === 'turn') {
      this.#clicked(finger);
    }
    this.#mode = 'nothing';
  }

  #endPin(outcome: 'moved' | 'clicked' | 'given up'): void {
    if (this.#mode === 'pin') {
      this.#target.dropPin(outcome);
    }
  }

  #clicked(finger: Finger): void {
    const side = this.#side;
    const at = this.#place(side, finger);
    const first = this.#click;
    if (first !== null && this.#isSecondClick(finger)) {
      clearTimeout(first.timer);
      this.#click = null;
      this.#target.doubleClick(side, at);
      return;
    }
    this.settle();
    const timer = window.setTimeout(() => {
      this.settle();
    }, DOUBLE_CLICK);
    this.#click = { side, x: finger.x, y: finger.y, timer };
    this.#target.firstClick(side, at);
  }

  #hover(event: PointerEvent): void {
    const at = { x: event.clientX, y: event.clientY };
    const click = this.#click;
    if (click !== null) {
      if (Math.hypot(at.x - click.x, at.y - click.y) <= CLICK_SLACK) {
        return;
      }
      this.settle();
    }
    if (event.pointerType === 'touch') {
      return;
    }
    const side = this.#sideAt(at);
    if (side === null) {
      this.#target.leave();
    } else {
      this.#target.hover(side, this.#place(side, at));
    }
  }

  #turnWheel(event: WheelEvent): void {
    const at = { x: event.clientX, y: event.clientY };
    const under = this.#sideAt(at);
    if (under === null) {
      return;
    }
    event.preventDefault();
    const notches = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / NOTCH_PIXELS : event.deltaY / NOTCH_LINES;
    const bounded = Math.max(-MOST_NOTCHES, Math.min(MOST_NOTCHES, notches));
    const factor = Math.exp(-bounded * (event.ctrlKey ? PINCH_ZOOM : NOTCH_ZOOM));
    // A wheel moves in notches; a touchpad moves in many small steps, which are smooth already.
    const way = event.ctrlKey || Math.abs(notches) < 0.5 ? 'at once' : 'smoothly';
    this.#target.zoom(under, factor, this.#place(under, at), way);
  }

  #sideAt({ x, y }: Finger): Side | null {
    for (const candidate of SIDES) {
      const box = this.#target.box(candidate);
      if (x >= box.left && x < box.left + box.width && y >= box.top && y < box.top + box.height) {
        return candidate;
      }
    }
    return null;
  }

  #place(side: Side, { x, y }: Finger): Place {
    const box = this.#target.box(side);
    return { x: (2 * (x - box.left)) / box.width - 1, y: 1 - (2 * (y - box.top)) / box.height };
  }
}
