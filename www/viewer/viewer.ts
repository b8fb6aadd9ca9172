/** Both views on one canvas. They are drawn on demand, follow the state, and are rebuilt after a lost context. */
import { failureOf } from '../compute/messages.ts';
import type { Way } from '../compute/saved-messages.ts';
import { byId } from '../dom.ts';
import type { Side, SurfacePoint } from '../landmarks.ts';
import { isWhole, SIDES } from '../landmarks.ts';
import { failureSentence, SENTENCES, unreadPictures } from '../messages.ts';
import type { Axes } from '../method/axes.ts';
import { axesOf } from '../method/axes.ts';
import type { FlowFrame, StageFrame, Stops } from '../method/hands.ts';
import type { BasePart } from '../method/parts.ts';
import { planeInUse, takingOn } from '../store/across.ts';
import { otherMap, shownStyle } from '../store/compared.ts';
import type { Event } from '../store/events.ts';
import { shownFlows } from '../store/flat.ts';
import { shownGhosts, shownPreview } from '../store/preview.ts';
import type { Across } from '../store/left-right.ts';
import { hasItsCones, shownResult } from '../store/staleness.ts';
import type { Axis, Camera, Proposal, Result, State } from '../store/state.ts';
import type { MeshFile } from '../store/work.ts';
import { giverOf } from '../store/work.ts';
import type { LookFrom, MeshDefects } from '../wasm/page.js';
import { Viewer } from '../wasm/page.js';
import { cameraOf, Cameras } from './cameras.ts';
import type { Box } from './gestures.ts';
import { Hands } from './hands.ts';
import { showDefects, showPreview, showStage, showStops } from './instead.ts';
import { HELP } from './keys.ts';
import { Labels } from './labels.ts';
import { drawnSurface, Picture } from './picture.ts';
import { labelsOf, marksOf } from './pins.ts';
import type { Probe } from './probe.ts';
import { probeOf } from './probe.ts';
import { Rings } from './rings.ts';
import { decoded } from './decoded.ts';
import { fitCanvas, fitViewer, samplesOf, whenResized } from './screen.ts';

/** The listener of the views. */
export interface ViewListener {
  dispatch(event: Event): void;
  failed(sentence: string): void;
  /** Called when the views cannot be drawn, with the reason, or with `null` when they can again. */
  undrawn(sentence: string | null): void;
  /** Called with the map at the place under the mouse; `null` when the mouse has left. */
  probed(probe: Probe | null): void;
}

/** How far from the middle a pin counts as in sight, as a share of the way to the edge. */
const IN_SIGHT = 0.95;

/** The time without a move after which a camera counts as at rest, in ms. */
const REST = 400;

/** The views of the page. */
export class Views {
  readonly #canvas: HTMLCanvasElement;
  readonly #elements: readonly [HTMLElement, HTMLElement];
  readonly #labels: readonly [Labels, Labels];
  readonly #rings: readonly [Rings, Rings];
  readonly #listener: ViewListener;
  readonly #cameras: Cameras;
  readonly #picture = new Picture();
  readonly #hands: Hands;
  readonly #dark = window.matchMedia('(prefers-color-scheme: dark)');
  #viewer: Viewer | null = null;
  #state: State;
  #frame = 0;
  /** Whether a frame is being made, which will include changes that are made now. */
  #drawing = false;
  #resized = true;
  #started = false;
  #lost = false;
  /** The cameras that the page was last given. */
  #told: [Camera | null, Camera | null] = [null, null];
  #rest = 0;
  #preparing = 0;
  #isPreparing = false;
  /** The listeners to turns of the cameras. */
  readonly #turned = new Set<() => void>();
  /** The orientations of the cameras at the last call of these listeners. */
  #toldTurns = '';

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
    this.#cameras = new Cameras((action) => {
      this.#with(action);
    });
    for (const side of SIDES) {
      const element = this.#elements[side];
      element.tabIndex = 0;
      element.setAttribute('role', 'group');
    }
    this.#nameViews();
    this.#hands = new Hands(this.#canvas, this.#elements, {
      viewer: () => (this.#lost ? null : this.#viewer),
      state: () => this.#state,
      picture: this.#picture,
      cameras: this.#cameras,
      box: (side) => this.box(side),
      act: (action) => {
        this.#with(action);
      },
      moved: (side) => {
        this.#moved(side);
      },
      dispatch: (event) => {
        listener.dispatch(event);
      },
      probed: (probe) => {
        listener.probed(probe);
      },
    });
    this.#listenToWindow();
  }

  /** Makes the renderer; shows a sentence where that fails. */
  async start(): Promise<void> {
    this.#started = true;
    if (!this.#lost) {
      await this.#make(SENTENCES.noWebGl);
    }
  }

  /** Shows the source on its way to the target's shape until the style changes: 0 is the source's shape, 1 the target's. */
  morph(share: number): void {
    this.#with((viewer) => {
      this.#picture.morph(viewer, share);
    });
  }

  /** Lets the points of a map move on this way to the target's shape from now on. */
  takeWay(output: Result['output'], way: Way): void {
    this.#with((viewer) => {
      this.#picture.takeWay(viewer, output, way);
    });
  }

  /** Brings the views in line with the state. */
  sync(state: State, previous: State): void {
    this.#state = state;
    if (this.#viewer !== null && !this.#lost) {
      this.#sync(previous);
    }
  }

  /** Shows the whole mesh in a view; the direction stays. */
  fit(side: Side | 'both'): void {
    this.#command(side, (each) => {
      this.#cameras.fit(each);
    });
  }

  /** Goes back to the first position. */
  reset(side: Side | 'both' = 'both'): void {
    this.#command(side, (each) => {
      this.#cameras.reset(each);
    });
  }

  /** Shows the whole mesh from one of six sides. */
  lookFrom(side: Side | 'both', from: LookFrom): void {
    this.#command(side, (each) => {
      this.#cameras.lookFrom(each, from);
    });
  }

  /** Turns a view so that its mesh is seen as the other one is, by the pairs on the page; it stays where fewer than three tell how. */
  lookAsOther(side: Side): void {
    const pairs = JSON.stringify(this.#state.pairs.filter(isWhole).map(({ points }) => points));
    this.#cameras.lookAsOther(side, pairs, (axis) => {
      // With the same axis up both bodies turn alike where the cameras are linked.
      this.#listener.dispatch({ kind: 'up', side, axis });
      this.#moved();
    });
  }

  /** Turns the picture counter-clockwise, in degrees. */
  roll(side: Side | 'both', degrees: number): void {
    this.#command(side, (each) => {
      this.#cameras.roll(each, (degrees * Math.PI) / 180);
    });
  }

  /** Multiplies the size of what is seen in the middle of a view. */
  zoom(side: Side | 'both', factor: number): void {
    this.#command(side, (each) => {
      this.#cameras.zoom(each, factor, { x: 0, y: 0 });
    });
  }

  /** The axis of a mesh that seems to point up by its shape, to be offered; `null` where the shape does not show it. */
  proposedUp(side: Side): Axis | null {
    return (this.#viewer?.proposedUp(side) as Axis | undefined) ?? null;
  }

  /** Turns a view to a point and moves near it. */
  lookAt(side: Side, point: SurfacePoint): void {
    this.#cameras.face(side, JSON.stringify(point));
    this.#moved();
  }

  /** Turns a view to a defect that it shows. */
  lookAtDefect(side: Side, found: MeshDefects, group: number, index: number): void {
    this.#cameras.faceDefect(side, found, group, index);
    this.#moved();
  }

  /** Turns both views to a pair's points. */
  lookAtPair(id: number): void {
    const pair = this.#state.pairs.find((candidate) => candidate.id === id);
    for (const side of SIDES) {
      const point = pair?.points[side] ?? null;
      if (point !== null) {
        this.lookAt(side, point);
      }
    }
  }

  /** Asks the map about a point, and marks the point and its partner with rings until the mouse moves; `null` without a map. */
  ask(side: Side, point: SurfacePoint): Probe | null {
    let probe: Probe | null = null;
    this.#with((viewer) => {
      probe = this.#picture.bringMap(viewer) ? probeOf(side, viewer.probePoint(side, JSON.stringify(point)), this.#picture.known) : null;
    });
    return probe;
  }

  /** The image of a point of a side on the other side; `null` without a map, and where no landmark can be placed. */
  imageOf(side: Side, point: SurfacePoint): SurfacePoint | null {
    let image: string | undefined;
    this.#with((viewer) => {
      image = this.#picture.bringMap(viewer) ? viewer.imageOf(side, JSON.stringify(point)) : undefined;
    });
    return image === undefined ? null : (JSON.parse(image) as SurfacePoint);
  }

  /** The mirror image of a point across the plane of its side; `null` without a plane, and where no landmark can be placed. */
  across(side: Side, point: SurfacePoint): Across | null {
    let found: string | undefined;
    this.#with((viewer) => {
      found = viewer.across(side, JSON.stringify(point));
    });
    if (found === undefined) {
      return null;
    }
    const { near, ...across } = JSON.parse(found) as Omit<Across, 'pair'> & { readonly near: number | null };
    return { ...across, pair: near === null ? null : (this.#state.pairs[near]?.id ?? null) };
  }

  /** Turns a view to a proposed place that is out of sight, behind the body or beyond the view. */
  bringIntoSight({ id, side, point }: Proposal): void {
    const index = this.#state.pairs.findIndex((pair) => pair.id === id);
    const [x = 0, y = 0, visible = 0] = this.#viewer?.labels(side).subarray(3 * index) ?? [];
    if (visible < 0.5 || Math.max(Math.abs(x), Math.abs(y)) > IN_SIGHT) {
      this.lookAt(side, point);
    }
  }

  /** Calls `heard` whenever a camera has turned, until the returned function is called. */
  whenTurned(heard: () => void): () => void {
    this.#turned.add(heard);
    // The next frame then reports the present orientations.
    this.#toldTurns = '';
    return () => {
      this.#turned.delete(heard);
    };
  }

  /** Lets patches light up under the mouse, until the returned function is called. */
  openBase(): () => void {
    this.#picture.wantsPatches = true;
    return () => {
      this.#with((viewer) => {
        this.#picture.leavePatches(viewer);
      });
    };
  }

  /** The axes of the camera of a side; `null` without a renderer. */
  axes(side: Side): Axes | null {
    return this.#viewer === null || this.#lost ? null : axesOf(this.#viewer.axes(side));
  }

  /** Turns a view like a drag, in units of the view's height, y up. */
  orbit(side: Side, dx: number, dy: number, way: 'smoothly' | 'at once'): void {
    this.#cameras.orbit(side, dx, dy, way);
    this.#moved(side);
  }

  /** Shows the flows on both meshes; `null` shows the meshes as they were before. */
  showFlow(frame: FlowFrame | null): void {
    this.#with((viewer) => {
      this.#picture.showFlow(viewer, frame);
    });
  }

  /** Marks the triangles that stopped a flow; `null` shows the meshes as they were before. */
  markStops(stops: Stops | null): void {
    this.#with((viewer) => {
      showStops(viewer, this.#state, stops);
    });
  }

  /** Shows a stage of the simplification of both meshes; `null` shows the meshes as they were before. */
  showStage(frame: StageFrame | null): void {
    this.#with((viewer) => {
      showStage(viewer, frame);
    });
  }

  /** Lights up a part of the base domain on both meshes. */
  light(part: BasePart | null): void {
    this.#with((viewer) => {
      this.#picture.light(viewer, part);
    });
  }

  #command(side: Side | 'both', action: (side: Side) => void): void {
    if (side !== 'both') {
      action(side);
    } else if (this.#cameras.linked) {
      action(0);
    } else {
      SIDES.forEach(action);
    }
    this.#moved();
  }

  #sync(previous: State | null): void {
    const state = this.#state;
    const result = shownResult(state);
    const isOther = previous === null || shownResult(previous) !== result;
    const isOtherMesh = previous?.meshes !== state.meshes;
    const changes = {
      compared: isOther || otherMap(previous) !== otherMap(state),
      picture:
        isOther ||
        isOtherMesh ||
        previous.ui.style !== state.ui.style ||
        previous.ui.theme !== state.ui.theme ||
        previous.flattening !== state.flattening ||
        previous.texturePicture !== state.texturePicture,
      up: isOtherMesh || previous.up !== state.up,
      pins:
        isOther ||
        isOtherMesh ||
        previous.pairs !== state.pairs ||
        previous.proposal !== state.proposal ||
        shownGhosts(previous) !== shownGhosts(state) ||
        previous.ui.selected !== state.ui.selected ||
        previous.ui.hovered !== state.ui.hovered,
      suggestions:
        isOtherMesh ||
        previous.suggestions !== state.suggestions ||
        SIDES.some((side) => planeInUse(previous, side) !== planeInUse(state, side)),
      mirrors: isOtherMesh || previous.leftRight !== state.leftRight,
      cameras: previous?.ui.cameras !== state.ui.cameras,
      preview: isOtherMesh || shownPreview(previous) !== shownPreview(state),
      defects: isOtherMesh || previous.refused !== state.refused || previous.examined !== state.examined,
    };
    this.#cameras.linked = state.ui.link !== 'free';
    if (!Object.values(changes).includes(true)) {
      return;
    }
    this.#with((viewer) => {
      if (isOther) {
        this.#picture.take(viewer, result, giverOf(state));
      }
      if (isOtherMesh) {
        this.#setMeshes(viewer, previous);
      }
      if (previous?.texturePicture !== state.texturePicture && state.texturePicture !== null) {
        const { width, height, pixels } = state.texturePicture;
        viewer.setTexture(width, height, pixels);
      }
      if (changes.up) {
        this.#setUp(previous);
      }
      if (changes.cameras) {
        this.#setCameras();
      }
      if (changes.pins) {
        this.#setLandmarks(viewer);
      }
      if (changes.suggestions) {
        this.#setSuggestions(viewer);
      }
      if (changes.mirrors) {
        this.#setMirrors(viewer, previous);
      }
      if (changes.preview) {
        showPreview(viewer, state);
      }
      if (changes.defects) {
        showDefects(viewer, state, previous);
      }
      if (changes.compared) {
        const other = otherMap(state);
        this.#picture.compare(viewer, other);
        this.#nameViews();
        this.#cameras.showsSourceTwice = other !== null;
      }
      if (changes.picture || changes.compared) {
        this.#setStyle(viewer);
      }
    });
  }

  #setMeshes(viewer: Viewer, previous: State | null): void {
    for (const side of SIDES) {
      const file = this.#state.meshes[side];
      if (previous?.meshes[side] === file) {
        continue;
      }
      this.#told[side] = null;
      if (file === null) {
        viewer.clearMesh(side);
      } else {
        viewer.setMesh(side, file.mesh);
        void this.#layPictures(viewer, side, file);
      }
    }
    this.#prepare();
  }

  /** Lays the pictures of a mesh on it, each once it is decoded. */
  async #layPictures(viewer: Viewer, side: Side, file: MeshFile): Promise<void> {
    const count = file.mesh.pictureCount;
    let unread = 0;
    for (let number = 0; number < count; number++) {
      // Another mesh may have come since, or another renderer.
      if (this.#viewer !== viewer || this.#state.meshes[side] !== file) {
        return;
      }
      const pixels = await decoded(file.mesh.picture(number) as Uint8Array<ArrayBuffer>, count);
      if (pixels === null) {
        unread += 1;
      } else if (this.#viewer === viewer && this.#state.meshes[side] === file) {
        this.#with((viewer) => {
          viewer.setPicture(side, number, pixels.width, pixels.height, pixels.pixels);
        });
      }
    }
    if (unread > 0) {
      this.#listener.dispatch({ kind: 'error', sentence: unreadPictures(file.name, unread) });
    }
  }

  /** Prepares large meshes for picking, part by part, so that frames are drawn meanwhile. */
  #prepare(): void {
    clearTimeout(this.#preparing);
    this.#preparing = window.setTimeout(() => {
      if (this.#viewer === null || this.#lost) {
        return;
      }
      if (this.#viewer.prepare()) {
        this.#isPreparing = true;
        this.#prepare();
      } else if (this.#isPreparing) {
        // From now on it is known which pins the body hides.
        this.#isPreparing = false;
        this.#requestFrame();
      }
    }, 0);
  }

  /** Sets the axis that points up: at once for a mesh that has just come, in a visible turn for one that is there. */
  #setUp(previous: State | null): void {
    const { up, meshes } = this.#state;
    for (const side of SIDES) {
      if (previous?.meshes[side] !== meshes[side]) {
        this.#cameras.setUp(side, up[side], 'at once');
      } else if (previous.up[side] !== up[side]) {
        this.#cameras.setUp(side, up[side]);
        this.#moved();
      }
    }
  }

  /** Moves the cameras that the state has moved. */
  #setCameras(): void {
    for (const side of SIDES) {
      const camera = this.#state.ui.cameras[side];
      if (camera !== this.#told[side]) {
        this.#told[side] = camera;
        this.#cameras.restore(side, camera);
      }
    }
  }

  #setStyle(viewer: Viewer): void {
    const { theme } = this.#state.ui;
    const style = shownStyle(this.#state);
    const result = shownResult(this.#state);
    if (result !== null) {
      this.#picture.bring(viewer, style);
      this.#picture.morph(viewer, style.morph);
    }
    this.#picture.showHeat(viewer, style.surface, shownFlows(this.#state));
    viewer.setStyle(
      JSON.stringify({
        ...style,
        surface: result === null && style.surface !== 'look' ? 'shaded' : drawnSurface(style.surface, this.#state.texturePicture),
        cones: style.cones && hasItsCones(this.#state),
        dark: theme === 'dark' || (theme === 'system' && this.#dark.matches),
        holes: result !== null && result.report.certificate === null,
        comparedHoles: otherMap(this.#state)?.report.certificate === null,
      }),
    );
  }

  #setLandmarks(viewer: Viewer): void {
    for (const side of SIDES) {
      if (this.#state.meshes[side] !== null) {
        viewer.setLandmarks(side, marksOf(this.#state, side));
      }
    }
  }

  #setSuggestions(viewer: Viewer): void {
    for (const side of SIDES) {
      const suggestions = this.#state.meshes[side] === null ? [] : this.#state.suggestions[side];
      viewer.setSuggestions(side, JSON.stringify(suggestions.map((suggestion) => suggestion.point)));
      this.#rings[side].show(suggestions, takingOn(this.#state, side), ({ point }) => {
        this.#listener.dispatch({ kind: 'point-picked', side, point });
      });
    }
  }

  #setMirrors(viewer: Viewer, previous: State | null): void {
    for (const side of SIDES) {
      const plane = planeInUse(this.#state, side);
      const isOther = previous?.meshes[side] !== this.#state.meshes[side] || planeInUse(previous, side) !== plane;
      if (isOther && this.#state.meshes[side] !== null) {
        viewer.setMirror(side, JSON.stringify(plane));
      }
    }
  }

  /** Calls a function with the renderer, and asks for a frame; an error of the renderer becomes a sentence. */
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
    if (this.#frame === 0 && !this.#drawing) {
      this.#frame = requestAnimationFrame((now) => {
        this.#frame = 0;
        this.#drawing = true;
        const more = this.#draw(now);
        this.#drawing = false;
        if (more) {
          this.#requestFrame();
        }
      });
    }
  }

  /** Draws a frame; returns whether another one is to follow. */
  #draw(now: number): boolean {
    const viewer = this.#viewer;
    if (viewer === null || this.#lost) {
      return false;
    }
    try {
      if (this.#resized) {
        this.#resized = false;
        fitViewer(viewer, this.#canvas, this.#elements);
      }
      this.#hands.follow(viewer);
      const more = viewer.render(now);
      this.#placeMarks(viewer);
      this.#tellTurns(viewer);
      return more;
    } catch (thrown) {
      console.error(thrown);
      this.#viewer = null;
      this.#listener.undrawn(SENTENCES.contextGone);
      return false;
    }
  }

  /** Calls the listeners to turns, such as pictures in the panel that turn with the views. */
  #tellTurns(viewer: Viewer): void {
    if (this.#turned.size === 0) {
      return;
    }
    const turns = SIDES.map((side) => viewer.axes(side).join(' ')).join(';');
    if (this.#toldTurns !== turns) {
      this.#toldTurns = turns;
      this.#turned.forEach((heard) => {
        heard();
      });
    }
  }

  #placeMarks(viewer: Viewer): void {
    for (const side of SIDES) {
      const labels = this.#state.ui.style.markers ? labelsOf(this.#state, side) : [];
      const { width, height } = this.box(side);
      this.#labels[side].place(labels, viewer.labels(side), width, height);
      this.#rings[side].place(viewer.suggestions(side), width, height);
    }
  }

  /** Called when cameras have moved. Where the map links them the other camera follows, and the page is informed when they rest. */
  #moved(leader?: Side): void {
    if (leader !== undefined && this.#state.ui.link === 'map') {
      this.#with((viewer) => {
        if (this.#picture.bringMap(viewer)) {
          viewer.follow(leader);
        }
      });
    }
    clearTimeout(this.#rest);
    this.#rest = window.setTimeout(() => {
      this.#tell();
    }, REST);
  }

  #tell(): void {
    const viewer = this.#viewer;
    if (viewer === null || this.#lost) {
      return;
    }
    for (const side of SIDES) {
      const camera = cameraOf(viewer, side);
      if (JSON.stringify(camera) !== JSON.stringify(this.#told[side])) {
        this.#told[side] = camera;
        this.#listener.dispatch({ kind: 'camera-moved', side, camera });
      }
    }
  }

  /** The views as they are, with `times` as many pixels on each side as on the screen, as a PNG; `null` without a renderer. */
  async picture(times: number): Promise<Blob | null> {
    const viewer = this.#viewer;
    if (viewer === null || this.#lost) {
      return null;
    }
    fitViewer(viewer, this.#canvas, this.#elements, times);
    viewer.render(performance.now());
    // The browser reads the pixels at once, before the next frame has the screen's size again, and encodes them later.
    const picture = new Promise<Blob | null>((resolve) => {
      this.#canvas.toBlob(resolve, 'image/png');
    });
    this.#resized = true;
    this.#requestFrame();
    return picture;
  }

  /** Gives the views their names; while two maps are compared both show the source. */
  #nameViews(): void {
    const second = otherMap(this.#state) === null ? 'Target' : 'Second source';
    this.#elements[0].setAttribute('aria-label', `Source view. ${HELP}`);
    this.#elements[1].setAttribute('aria-label', `${second} view. ${HELP}`);
  }

  /** A view's box in the window. */
  box(side: Side): Box {
    return this.#elements[side].getBoundingClientRect();
  }

  #listenToWindow(): void {
    whenResized([this.#canvas, ...this.#elements], () => {
      this.#resized = true;
      this.#requestFrame();
    });
    this.#dark.addEventListener('change', () => {
      this.#with((viewer) => {
        this.#setStyle(viewer);
      });
    });
    this.#canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.#lost = true;
      this.#listener.undrawn(SENTENCES.contextLost);
    });
    this.#canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      void this.#rebuild();
    });
  }

  /** Makes a renderer; shows a sentence where that fails. */
  async #make(otherwise: string): Promise<'made' | 'failed'> {
    fitCanvas(this.#canvas);
    try {
      this.#viewer = await Viewer.create(this.#canvas, samplesOf());
      this.#resized = true;
      this.#sync(null);
      return 'made';
    } catch (thrown) {
      console.error(thrown);
      this.#listener.undrawn(otherwise);
      return 'failed';
    }
  }

  /** Makes a new renderer in place of the one whose context was lost. */
  async #rebuild(): Promise<void> {
    const old = this.#viewer;
    this.#viewer = null;
    let cameras: readonly (Camera | null)[] = [null, null];
    try {
      cameras = SIDES.map((side) => (old === null ? null : cameraOf(old, side)));
      old?.free();
    } catch (thrown) {
      console.warn(thrown);
    }
    if (!this.#started) {
      return;
    }
    if ((await this.#make(SENTENCES.contextGone)) === 'made') {
      for (const side of SIDES) {
        this.#cameras.restore(side, cameras[side] ?? null);
      }
      this.#listener.undrawn(null);
    }
  }
}
