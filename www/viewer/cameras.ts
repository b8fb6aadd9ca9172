/** The cameras of both views, which turn together or each by itself and glide to their new positions. */
import type { Side } from '../landmarks.ts';
import { otherSide, SIDES } from '../landmarks.ts';
import type { Axis, Camera } from '../store/state.ts';
import type { LookFrom, MeshDefects, Viewer } from '../wasm/page.js';
import type { Place } from './gestures.ts';

/** The time in which a camera glides to a new position, in ms: long enough for the eye to follow, short enough that nobody waits for it. */
const GLIDE = 180;

/** The numbers of a camera; `null` where it is in its first position. */
export function cameraOf(viewer: Viewer, side: Side): Camera | null {
  const numbers = viewer.camera(side);
  return numbers === undefined ? null : [...numbers];
}

/** Moves the cameras; `act` calls a function with the renderer and asks for a frame. */
export class Cameras {
  readonly #act: (action: (viewer: Viewer) => void) => void;
  readonly #still = window.matchMedia('(prefers-reduced-motion: reduce)');
  /** Whether both cameras move together. */
  linked = true;
  /** Whether both views show the source, with the source's camera. */
  showsSourceTwice = false;

  constructor(act: (action: (viewer: Viewer) => void) => void) {
    this.#act = act;
  }

  /** Called when a gesture begins that may turn a view; makes sure that the camera turns about a point that is seen. */
  grab(side: Side): void {
    this.#each(side, 'at once', (viewer, each) => {
      viewer.grab(each);
    });
  }

  /** Turns a view, in units of its height, y up. */
  orbit(side: Side, dx: number, dy: number, way: 'smoothly' | 'at once' = 'at once'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.orbit(each, dx, dy);
    });
  }

  /** Moves a view sideways, in the same units. */
  pan(side: Side, dx: number, dy: number, way: 'smoothly' | 'at once' = 'at once'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.pan(each, dx, dy);
    });
  }

  /** Turns the picture of a view counter-clockwise, in radians. */
  roll(side: Side, angle: number, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.roll(each, angle);
    });
  }

  /** Magnifies a view by a factor about a place, which stays where it is; the other view is magnified about the same place of that view. */
  zoom(side: Side, factor: number, at: Place, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#each(side, way, (viewer, each) => {
      // The renderer takes the factor by which the distance changes.
      viewer.zoomAt(each, 1 / factor, at.x, at.y);
    });
  }

  /** Shows the whole mesh in the view; the direction stays. */
  fit(side: Side): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.fit(each);
    });
  }

  /** Goes back to the first position. */
  reset(side: Side): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.resetCamera(each);
    });
  }

  /** Shows the whole mesh from one of six sides. */
  lookFrom(side: Side, from: LookFrom): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.lookFrom(each, from);
    });
  }

  /**
   * Turns a view so that its whole mesh is seen as the other one is; `pairs` are points of both meshes that correspond, as JSON. `turned` is
   * called with the axis that points up then; where too few pairs tell how, the view stays and it is not called.
   */
  lookAsOther(side: Side, pairs: string, turned: (up: Axis) => void): void {
    this.#one(side, 'smoothly', (viewer) => {
      const up = viewer.lookAsOther(side, pairs) as Axis | undefined;
      if (up !== undefined) {
        turned(up);
      }
    });
  }

  /** Lets another axis of a mesh point up. */
  setUp(side: Side, axis: Axis, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#one(side, way, (viewer) => {
      viewer.setUp(side, axis);
    });
  }

  /** Turns a view to a landmark point, given as JSON, and moves near it. */
  face(side: Side, point: string): void {
    this.#one(side, 'smoothly', (viewer) => {
      viewer.face(side, point);
    });
  }

  /** Turns a view to a defect that it shows, and moves near it. */
  faceDefect(side: Side, found: MeshDefects, group: number, index: number): void {
    this.#one(side, 'smoothly', (viewer) => {
      viewer.lookAtDefect(side, found, group, index);
    });
  }

  /**
   * Moves the point that is seen at a place to the middle of the view, which turns about it from now on. The other view moves to the
   * partner of that point where `partnerOf` gives one, else to the point at the same place of that view.
   */
  centre(view: Side, at: Place, partnerOf: (viewer: Viewer) => string | null): void {
    const side = this.#inView(view);
    this.#act((viewer) => {
      const partner = this.linked ? partnerOf(viewer) : null;
      this.#glide(viewer, side, 'smoothly');
      if (!viewer.centreAt(side, at.x, at.y) || !this.linked) {
        return;
      }
      const other = otherSide(side);
      this.#glide(viewer, other, 'smoothly');
      if (partner === null) {
        viewer.centreAt(other, at.x, at.y);
      } else {
        viewer.centreOn(other, partner);
      }
    });
  }

  /** Puts a camera into an earlier position; `null` is its first one. */
  restore(side: Side, camera: Camera | null): void {
    this.#one(side, 'at once', (viewer) => {
      if (camera === null) {
        viewer.resetCamera(side);
      } else {
        viewer.setCamera(side, new Float32Array(camera));
      }
    });
  }

  /** The side whose camera a view uses. */
  #inView(view: Side): Side {
    return this.showsSourceTwice ? 0 : view;
  }

  #each(view: Side, way: 'smoothly' | 'at once', action: (viewer: Viewer, side: Side) => void): void {
    const side = this.#inView(view);
    for (const each of SIDES) {
      if (each === side || this.linked) {
        this.#one(each, way, (viewer) => {
          action(viewer, each);
        });
      }
    }
  }

  #one(side: Side, way: 'smoothly' | 'at once', action: (viewer: Viewer) => void): void {
    this.#act((viewer) => {
      this.#glide(viewer, side, way);
      action(viewer);
    });
  }

  #glide(viewer: Viewer, side: Side, way: 'smoothly' | 'at once'): void {
    if (way === 'smoothly') {
      viewer.glide(side, performance.now(), this.#still.matches ? 0 : GLIDE);
    }
  }
}
