/** Connects mouse, fingers and keys with the views: with cameras, pins, picks and questions to the map. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import { otherSide, SIDES } from '../landmarks.ts';
import { SENTENCES } from '../messages.ts';
import type { Event } from '../store/events.ts';
import { proposed } from '../store/proposal.ts';
import type { State } from '../store/state.ts';
import type { Viewer } from '../wasm/page.js';
import type { Cameras } from './cameras.ts';
import type { Box, GestureTarget, Place } from './gestures.ts';
import { Gestures } from './gestures.ts';
import type { KeyTarget } from './keys.ts';
import { pressKey } from './keys.ts';
import type { Picture } from './picture.ts';
import { Pins } from './pins.ts';
import type { Probe } from './probe.ts';
import { probeOf } from './probe.ts';

/** What the hands act on. */
export interface Workbench {
  /** The renderer; `null` while there is none. */
  viewer(): Viewer | null;
  state(): State;
  readonly picture: Picture;
  readonly cameras: Cameras;
  box(side: Side): Box;
  /** Calls a function with the renderer, and asks for a frame. */
  act(action: (viewer: Viewer) => void): void;
  /** Called when the camera of a side was moved. */
  moved(side: Side): void;
  dispatch(event: Event): void;
  /** Called with the map at the place under the mouse; `null` when the mouse has left. */
  probed(probe: Probe | null): void;
}

/** Listens to the events of the canvas and of the views' elements. */
export class Hands {
  readonly #canvas: HTMLCanvasElement;
  readonly #bench: Workbench;
  readonly #pins: Pins;
  readonly #gestures: Gestures;
  /** The place to which the mouse has moved since the last look at what is under it. */
  #pointer: { readonly side: Side; readonly at: Place } | null = null;
  #probed = false;

  constructor(canvas: HTMLCanvasElement, elements: readonly [HTMLElement, HTMLElement], bench: Workbench) {
    this.#canvas = canvas;
    this.#bench = bench;
    this.#pins = new Pins((event) => {
      bench.dispatch(event);
    });
    this.#gestures = new Gestures(canvas, this.#gestureTarget(elements));
    const keys = this.#keyTarget();
    for (const side of SIDES) {
      elements[side].addEventListener('keydown', (event) => {
        if (event.target !== elements[side]) {
          return;
        }
        this.#gestures.settle();
        if (pressKey(keys, side, event)) {
          event.preventDefault();
        }
      });
    }
  }

  /** Moves the pin that is dragged to the pointer; called once in each frame. */
  follow(viewer: Viewer): void {
    this.#pins.follow(viewer);
  }

  #gestureTarget(elements: readonly [HTMLElement, HTMLElement]): GestureTarget {
    const { cameras } = this.#bench;
    return {
      box: (side) => this.#bench.box(side),
      focus: (side) => {
        elements[side].focus({ preventScroll: true });
      },
      grab: (side) => {
        cameras.grab(side);
      },
      orbit: (side, dx, dy) => {
        cameras.orbit(side, dx, dy);
        this.#bench.moved(side);
      },
      pan: (side, dx, dy) => {
        cameras.pan(side, dx, dy);
        this.#bench.moved(side);
      },
      roll: (side, angle) => {
        cameras.roll(side, angle, 'at once');
        this.#bench.moved(side);
      },
      zoom: (side, factor, at, way) => {
        cameras.zoom(side, factor, at, way);
        this.#bench.moved(side);
      },
      takePin: (side, at, slack) => {
        const viewer = this.#bench.viewer();
        return viewer !== null && this.#pins.take(viewer, this.#bench.state(), side, at, slack);
      },
      dragPin: (at) => {
        this.#pins.drag(at);
        this.#bench.act((viewer) => {
          viewer.clearProbe();
        });
      },
      dropPin: (outcome) => {
        const viewer = this.#bench.viewer();
        if (outcome === 'moved' && viewer !== null) {
          this.#pins.follow(viewer);
        }
        this.#pins.drop(outcome);
      },
      pick: (side, at) => {
        this.#pick(side, at);
      },
      firstClick: (side, at) => {
        this.#bench.act((viewer) => {
          viewer.mark(side, at.x, at.y);
        });
      },
      doubleClick: (side, at) => {
        cameras.centre(side, at, (viewer) => this.#partnerAt(viewer, side, at));
        this.#bench.moved(side);
      },
      hover: (side, at) => {
        this.#pointTo(side, at);
      },
      leave: () => {
        this.#leave();
      },
    };
  }

  #keyTarget(): KeyTarget {
    const { cameras } = this.#bench;
    const moved = (side: Side): void => {
      this.#bench.moved(side);
    };
    return {
      orbit: (side, dx, dy) => {
        cameras.grab(side);
        cameras.orbit(side, dx, dy, 'smoothly');
        moved(side);
      },
      pan: (side, dx, dy) => {
        cameras.pan(side, dx, dy, 'smoothly');
        moved(side);
      },
      roll: (side, angle) => {
        cameras.roll(side, angle);
        moved(side);
      },
      zoom: (side, factor, at) => {
        cameras.zoom(side, factor, at);
        moved(side);
      },
      fit: (side) => {
        cameras.fit(side);
        moved(side);
      },
      reset: (side) => {
        cameras.reset(side);
        moved(side);
      },
      lookFrom: (side, from) => {
        cameras.lookFrom(side, from);
        moved(side);
      },
      nudge: (side, dx, dy) => {
        const viewer = this.#bench.viewer();
        return viewer !== null && this.#pins.nudge(viewer, this.#bench.state(), side, dx, dy);
      },
      deleteSelected: () => {
        const { selected } = this.#bench.state().ui;
        if (selected !== null) {
          this.#bench.dispatch({ kind: 'pair-deleted', id: selected });
        }
        return selected !== null;
      },
      pick: (side, at) => {
        this.#pick(side, at);
      },
      accept: () => {
        const isThere = proposed(this.#bench.state()) !== null;
        if (isThere) {
          this.#bench.dispatch({ kind: 'proposal-accepted' });
        }
        return isThere;
      },
      escape: () => {
        if (this.#pins.isDragging) {
          this.#pins.drop('given up');
          return true;
        }
        const before = this.#bench.state();
        this.#bench.dispatch({ kind: proposed(before) === null ? 'pick-dropped' : 'proposal-dropped' });
        return this.#bench.state() !== before;
      },
    };
  }

  #pick(side: Side, at: Place): void {
    if (side === 0 && this.#bench.picture.isMorphed) {
      this.#bench.dispatch({ kind: 'toast', sentence: SENTENCES.notItsShape, undo: false });
      return;
    }
    let hit: string | undefined;
    this.#bench.act((viewer) => {
      viewer.clearProbe();
      hit = viewer.pick(side, at.x, at.y);
    });
    if (hit !== undefined) {
      this.#bench.dispatch({ kind: 'point-picked', side, point: JSON.parse(hit) as SurfacePoint });
    }
  }

  /** The partner of the point that is seen at a place, as JSON; `null` without a map. */
  #partnerAt(viewer: Viewer, side: Side, at: Place): string | null {
    const probe = this.#bench.picture.bringMap(viewer) ? probeOf(side, viewer.probe(side, at.x, at.y), this.#bench.picture.known) : null;
    viewer.clearProbe();
    return probe === null ? null : JSON.stringify(probe.points[otherSide(side)]);
  }

  /** Looks at what is under the mouse before the next frame. A frame is drawn only where the picture changes. */
  #pointTo(side: Side, at: Place): void {
    if (this.#pointer === null) {
      requestAnimationFrame(() => {
        const viewer = this.#bench.viewer();
        try {
          if (viewer !== null) {
            this.#look(viewer);
          }
        } finally {
          // Reset even where the look failed; otherwise no later move would be looked at.
          this.#pointer = null;
        }
      });
    }
    this.#pointer = { side, at };
  }

  #look(viewer: Viewer): void {
    if (this.#pointer === null || this.#pins.isDragging) {
      return;
    }
    const { side, at } = this.#pointer;
    const pair = this.#pins.under(viewer, this.#bench.state(), side, at);
    this.#hover(pair?.id ?? null);
    if (pair !== null || !this.#bench.picture.bringMap(viewer)) {
      this.#endProbe();
      return;
    }
    // Rings that were shown for another reason are removed, too.
    const shown = viewer.clearProbe();
    this.#bench.picture.bringPatches(viewer);
    const probe = probeOf(side, viewer.probe(side, at.x, at.y), this.#bench.picture.known);
    const patch = probe?.patch ?? null;
    const lit = this.#bench.picture.light(viewer, patch === null ? null : { kind: 'face', index: patch });
    if (probe !== null || shown || lit || this.#probed) {
      this.#probed = probe !== null;
      this.#bench.act(() => undefined);
      this.#bench.probed(probe);
    }
  }

  #leave(): void {
    this.#pointer = null;
    this.#hover(null);
    this.#endProbe();
  }

  #endProbe(): void {
    if (this.#probed) {
      this.#probed = false;
      this.#bench.act((viewer) => {
        viewer.clearProbe();
        this.#bench.picture.light(viewer, null);
      });
      this.#bench.probed(null);
    }
  }

  #hover(id: number | null): void {
    this.#canvas.style.cursor = id === null ? '' : 'grab';
    if (this.#bench.state().ui.hovered !== id) {
      this.#bench.dispatch({ kind: 'pair-hovered', id });
    }
  }
}
