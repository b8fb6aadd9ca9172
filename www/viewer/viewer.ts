/** Both views on one canvas: drawn on demand, kept in step with the state, rebuilt after a lost context. */
import { failureOf } from '../compute/messages.ts';
import { byId } from '../dom.ts';
import type { Side, SurfacePoint } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { failureSentence, SENTENCES } from '../messages.ts';
import { pointsOf } from '../store/points.ts';
import { wholePairs } from '../store/order.ts';
import { hasItsCones, shownResult } from '../store/staleness.ts';
import type { Result, State } from '../store/state.ts';
import { Viewer } from '../wasm/conemap.js';
import type { Box } from './gestures.ts';
import { listen } from './gestures.ts';
import { Labels } from './labels.ts';
import { Rings } from './rings.ts';

/** What the views tell the page. */
export interface ViewListener {
  picked(side: Side, point: SurfacePoint): void;
  pickDropped(): void;
  failed(sentence: string): void;
  /** The views are back: what they said is void. */
  recovered(): void;
}

const HELP =
  'Arrow keys turn, with Shift they move; plus and minus zoom; 0 resets; Enter picks the point in the middle.';

/** Samples a pixel: four, but one where a processor draws in place of a graphics card. */
function samplesOf(): number {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) {
    return 4;
  }
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = gl.getParameter(info === null ? gl.RENDERER : info.UNMASKED_RENDERER_WEBGL);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name)) ? 1 : 4;
}

/** The cones of a map by their pair's number less 1, as the points are. */
function conesOf({ output, inputs }: Result): Float64Array {
  const pairs = wholePairs(inputs);
  const cones = new Float64Array(pairs.reduce((most, { number }) => Math.max(most, number), 0));
  pairs.forEach(({ number }, order) => {
    cones[number - 1] = output.cones[order] ?? 0;
  });
  return cones;
}

/** The views of the page. */
export class Views {
  readonly #canvas: HTMLCanvasElement;
  readonly #elements: readonly [HTMLElement, HTMLElement];
  readonly #labels: readonly [Labels, Labels];
  readonly #rings: readonly [Rings, Rings];
  readonly #listener: ViewListener;
  #viewer: Viewer | null = null;
  #state: State;
  #frame = 0;
  #resized = true;
  #started = false;
  #lost = false;
  readonly #dark = window.matchMedia('(prefers-color-scheme: dark)');

  constructor(state: State, listener: ViewListener) {
    const canvas = byId('canvas');
    if (!(canvas instanceof HTMLCanvasElement)) {
      throw new Error('#canvas is no canvas');
    }
    this.#canvas = canvas;
    this.#state = state;
    this.#listener = listener;
    this.#elements = [byId('view-source'), byId('view-target')];
    this.#labels = [new Labels(this.#elements[0]), new Labels(this.#elements[1])];
    this.#rings = [new Rings(this.#elements[0], 'source'), new Rings(this.#elements[1], 'target')];
    for (const side of SIDES) {
      const element = this.#elements[side];
      element.tabIndex = 0;
      element.setAttribute('role', 'group');
      element.setAttribute('aria-label', `${side === 0 ? 'Source' : 'Target'} view. ${HELP}`);
    }
    this.#listen();
  }

  /** Makes the renderer; says a sentence where there is none. */
  async start(): Promise<void> {
    this.#started = true;
    if (this.#lost) {
      return;
    }
    this.#fitCanvas();
    try {
      const viewer = await Viewer.create(this.#canvas, samplesOf());
      this.#viewer = viewer;
      this.#resized = true;
      this.#sync(null);
    } catch (thrown) {
      console.error(thrown);
      this.#listener.failed(SENTENCES.noWebGl);
    }
  }

  /** Follows the state. */
  sync(state: State, previous: State): void {
    this.#state = state;
    if (this.#viewer !== null) {
      this.#sync(previous);
    }
  }

  /** Both cameras as at the start. */
  reset(): void {
    for (const side of SIDES) {
      this.#with((viewer) => {
        viewer.resetCamera(side);
      });
    }
  }

  #sync(previous: State | null): void {
    const state = this.#state;
    this.#with((viewer) => {
      const result = shownResult(state);
      const isOther = previous === null || shownResult(previous) !== result;
      if (isOther) {
        viewer.clearResult();
      }
      for (const side of SIDES) {
        const file = state.meshes[side];
        if (previous?.meshes[side] !== file) {
          if (file === null) {
            viewer.clearMesh(side);
          } else {
            viewer.setMesh(side, file.mesh);
          }
        }
      }
      if (result !== null && isOther) {
        const { output } = result;
        const cones = conesOf(result);
        for (const side of SIDES) {
          const part = output.sides[side];
          viewer.setResult(
            side,
            part.positions,
            part.normals,
            output.uvs,
            output.distortion,
            output.triangles,
            part.linePoints,
            part.lineStarts,
            cones,
          );
        }
      }
      if (previous?.pairs !== state.pairs || previous.meshes !== state.meshes) {
        this.#setLandmarks(viewer);
      }
      if (previous?.suggestions !== state.suggestions || previous.meshes !== state.meshes) {
        this.#setSuggestions(viewer);
      }
      if (previous?.ui.style !== state.ui.style || isOther || previous.pairs !== state.pairs) {
        this.#setStyle(viewer);
      }
    });
  }

  #setStyle(viewer: Viewer): void {
    const { style } = this.#state.ui;
    const result = shownResult(this.#state);
    viewer.setStyle(
      JSON.stringify({
        ...style,
        surface: result === null ? 'shaded' : style.surface,
        cones: style.cones && hasItsCones(this.#state),
        dark: this.#dark.matches,
        holes: result !== null && result.report.certificate === null,
      }),
    );
  }

  #setLandmarks(viewer: Viewer): void {
    for (const side of SIDES) {
      if (this.#state.meshes[side] === null) {
        continue;
      }
      try {
        viewer.setLandmarks(side, JSON.stringify(pointsOf(this.#state, side)));
      } catch (thrown) {
        if (thrown instanceof WebAssembly.RuntimeError) {
          throw thrown;
        }
        viewer.setLandmarks(side, '[]');
        this.#listener.failed(SENTENCES.badPoint);
      }
    }
  }

  #setSuggestions(viewer: Viewer): void {
    for (const side of SIDES) {
      const suggestions = this.#state.meshes[side] === null ? [] : this.#state.suggestions[side];
      viewer.setSuggestions(side, JSON.stringify(suggestions.map((suggestion) => suggestion.point)));
      this.#rings[side].show(suggestions, ({ point }) => {
        if (this.#state.job.kind !== 'running') {
          this.#listener.picked(side, point);
        }
      });
    }
  }

  /** Calls the renderer and asks for a frame; what it throws becomes a sentence. */
  #with(action: (viewer: Viewer) => void): void {
    if (this.#viewer === null || this.#lost) {
      return;
    }
    try {
      action(this.#viewer);
    } catch (thrown) {
      console.error(thrown);
      this.#listener.failed(failureSentence(failureOf(thrown)));
    }
    this.#requestFrame();
  }

  #requestFrame(): void {
    if (this.#frame === 0) {
      this.#frame = requestAnimationFrame(() => {
        this.#frame = 0;
        this.#draw();
      });
    }
  }

  #draw(): void {
    const viewer = this.#viewer;
    if (viewer === null || this.#lost) {
      return;
    }
    try {
      if (this.#resized) {
        this.#resized = false;
        this.#fit(viewer);
      }
      viewer.render();
      for (const side of SIDES) {
        const box = this.box(side);
        this.#labels[side].place(
          this.#state.ui.style.markers ? viewer.labels(side) : new Float32Array(),
          box.width,
          box.height,
        );
        this.#rings[side].place(viewer.suggestions(side), box.width, box.height);
      }
    } catch (thrown) {
      console.error(thrown);
      this.#viewer = null;
      this.#listener.failed(SENTENCES.contextGone);
    }
  }

  /** A view's box in the window. */
  box(side: Side): Box {
    return this.#elements[side].getBoundingClientRect();
  }

  /** Gives the canvas as many pixels as the screen shows; its size in pixels per CSS pixel. */
  #fitCanvas(): number {
    const ratio = window.devicePixelRatio;
    const width = Math.max(1, Math.round(this.#canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.#canvas.clientHeight * ratio));
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    return ratio;
  }

  #fit(viewer: Viewer): void {
    const ratio = this.#fitCanvas();
    const { width, height } = this.#canvas;
    viewer.resize(width, height, ratio);
    const frame = this.#canvas.getBoundingClientRect();
    for (const side of SIDES) {
      const box = this.box(side);
      const left = Math.max(0, Math.round((box.left - frame.left) * ratio));
      const top = Math.max(0, Math.round((box.top - frame.top) * ratio));
      const right = Math.min(width, Math.round((box.left - frame.left + box.width) * ratio));
      const bottom = Math.min(height, Math.round((box.top - frame.top + box.height) * ratio));
      viewer.setViewport(side, left, top, Math.max(1, right - left), Math.max(1, bottom - top));
    }
  }

  #listen(): void {
    const refit = (): void => {
      this.#resized = true;
      this.#requestFrame();
    };
    const observer = new ResizeObserver(refit);
    observer.observe(this.#canvas);
    this.#elements.forEach((element) => {
      observer.observe(element);
    });
    const watchRatio = (): void => {
      window
        .matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`)
        .addEventListener('change', () => {
          refit();
          watchRatio();
        }, { once: true });
    };
    watchRatio();
    this.#dark.addEventListener('change', () => {
      this.#with((viewer) => {
        this.#setStyle(viewer);
      });
    });
    this.#canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.#lost = true;
      this.#listener.failed(SENTENCES.contextLost);
    });
    this.#canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      void this.#rebuild();
    });
    listen(this.#canvas, this.#elements, {
      box: (side) => this.box(side),
      orbit: (side, dx, dy) => {
        this.#with((viewer) => {
          viewer.orbit(side, dx, dy);
        });
      },
      pan: (side, dx, dy) => {
        this.#with((viewer) => {
          viewer.pan(side, dx, dy);
        });
      },
      zoom: (side, factor) => {
        this.#with((viewer) => {
          // The renderer takes the factor of the distance.
          viewer.zoom(side, 1 / factor);
        });
      },
      reset: (side) => {
        this.#with((viewer) => {
          viewer.resetCamera(side);
        });
      },
      pick: (side, x, y) => {
        this.#pick(side, x, y);
      },
      cancelPick: () => {
        this.#listener.pickDropped();
      },
      focus: (side) => {
        this.#elements[side].focus({ preventScroll: true });
      },
    });
  }

  #pick(side: Side, x: number, y: number): void {
    if (this.#state.meshes[side] === null || this.#state.job.kind === 'running') {
      return;
    }
    this.#with((viewer) => {
      const hit = viewer.pick(side, x, y);
      if (hit !== undefined) {
        this.#listener.picked(side, JSON.parse(hit) as SurfacePoint);
      }
    });
  }

  async #rebuild(): Promise<void> {
    const old = this.#viewer;
    this.#viewer = null;
    let cameras: readonly Float32Array[] = [];
    try {
      cameras = SIDES.map((side) => old?.camera(side) ?? new Float32Array());
      old?.free();
    } catch (thrown) {
      console.warn(thrown);
    }
    if (!this.#started) {
      return;
    }
    try {
      const viewer = await Viewer.create(this.#canvas, samplesOf());
      this.#viewer = viewer;
      this.#resized = true;
      this.#sync(null);
      cameras.forEach((camera, side) => {
        viewer.setCamera(side, camera);
      });
      this.#listener.recovered();
    } catch (thrown) {
      console.error(thrown);
      this.#listener.failed(SENTENCES.contextGone);
    }
  }
}
