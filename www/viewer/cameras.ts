/** The cameras of both views: turned together or each by itself, gliding to where they are put. */
import type { Side } from '../landmarks.ts';
import { otherSide, SIDES } from '../landmarks.ts';
import type { Axis, Camera } from '../store/state.ts';
import type { LookFrom, MeshDefects, Viewer } from '../wasm/page.js';
import type { Place } from './gestures.ts';

/** How long a camera glides, in ms: long enough for the eye to follow, short enough not to wait for. */
const GLIDE = 180;

/** Where a camera stands; `null` at the first look. */
export function cameraOf(viewer: Viewer, side: Side): Camera | null {
  const numbers = viewer.camera(side);
  return numbers === undefined ? null : [...numbers];
}

/** Moves cameras; `act` gives the renderer and asks for a frame. */
export class Cameras {
  readonly #act: (action: (viewer: Viewer) => void) => void;
  readonly #still = window.matchMedia('(prefers-reduced-motion: reduce)');
  /** Whether what is done to one camera is done to the other. */
  linked = true;
  /** Whether both views show the source, by its camera. */
  showsSourceTwice = false;

  constructor(act: (action: (viewer: Viewer) => void) => void) {
    this.#act = act;
  }

  /** A gesture begins that may turn a view. */
  grab(side: Side): void {
    this.#each(side, 'at once', (viewer, each) => {
      viewer.grab(each);
    });
  }

  /** Turns, in units of the view's height, y up. */
  orbit(side: Side, dx: number, dy: number, way: 'smoothly' | 'at once' = 'at once'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.orbit(each, dx, dy);
    });
  }

  /** Moves sideways, likewise. */
  pan(side: Side, dx: number, dy: number, way: 'smoothly' | 'at once' = 'at once'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.pan(each, dx, dy);
    });
  }

  /** Turns the picture counter-clockwise, in radians. */
  roll(side: Side, angle: number, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#each(side, way, (viewer, each) => {
      viewer.roll(each, angle);
    });
  }

  /** Brings what is seen at a place nearer by a factor; it stays where it is. In the other view the same place of the view does. */
  zoom(side: Side, factor: number, at: Place, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#each(side, way, (viewer, each) => {
      // The renderer takes the factor of the distance.
      viewer.zoomAt(each, 1 / factor, at.x, at.y);
    });
  }

  /** Brings the whole mesh into the view; the direction stays. */
  fit(side: Side): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.fit(each);
    });
  }

  /** Back to the first look. */
  reset(side: Side): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.resetCamera(each);
    });
  }

  /** Looks at the whole mesh from one of six sides. */
  lookFrom(side: Side, from: LookFrom): void {
    this.#each(side, 'smoothly', (viewer, each) => {
      viewer.lookFrom(each, from);
    });
  }

  /** Another axis of one mesh points up. */
  setUp(side: Side, axis: Axis, way: 'smoothly' | 'at once' = 'smoothly'): void {
    this.#one(side, way, (viewer) => {
      viewer.setUp(side, axis);
    });
  }

  /** Turns one view to a landmark point, given as JSON, and comes near. */
  face(side: Side, point: string): void {
    this.#one(side, 'smoothly', (viewer) => {
      viewer.face(side, point);
    });
  }

  /** Turns one view to a defect that it shows, and comes near. */
  faceDefect(side: Side, found: MeshDefects, group: number, index: number): void {
    this.#one(side, 'smoothly', (viewer) => {
      viewer.lookAtDefect(side, found, group, index);
    });
  }

  /**
   * Brings what is seen at a place to the middle, and turns about it from now on; in the other view its partner, if `partnerOf`
   * tells one, or what is seen at the same place of the view.
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

  /** Puts a camera where one stood. */
  restore(side: Side, camera: Camera | null): void {
    this.#one(side, 'at once', (viewer) => {
      if (camera === null) {
        viewer.resetCamera(side);
      } else {
        viewer.setCamera(side, new Float32Array(camera));
      }
    });
  }

  /** The side whose camera a view has. */
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
