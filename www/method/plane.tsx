/** Both flat metrics in the plane, grown from a patch that is chosen here or in the base domain. */
import type { VNode } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { useDarkness } from '../darkness.ts';
import { download } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import type { Listener } from './hands.ts';
import type { BasePart, PartHands } from './parts.ts';
import { PART_KEYS, stepped } from './parts.ts';
import type { Planes } from './plane-client.ts';
import type { GrownSide, PlaneFileWish, PlaneFrame } from './plane-messages.ts';
import './plane.css';
import { usePlayed } from './played.ts';
import { Computed, Transport } from './watched.tsx';

export interface PlaneProps {
  readonly hands: { readonly start: (listener: Listener<Planes>) => () => void };
  /** The names of the landmarks, in the order of the run. */
  readonly names: readonly string[];
  readonly theme: string;
  readonly parts: PartHands;
  /** How many parts of each kind the base domain has. */
  readonly counts: Readonly<Record<BasePart['kind'], number>>;
  /** Closes the layouts. */
  readonly onClose: () => void;
}

/** The time of the whole growth, in ms, and the least time of one ring. */
const GROWING = 6000;
const LEAST_RING = 40;
/** How near the pointer must be to a side to mean it, in pixels. */
const REACH = 5;
/** How far a pointer may move between press and release of a click, in pixels. */
const CLICK_SLACK = 4;
const KEY_MOVE = 40;
const KEY_ZOOM = 1.25;
const BUTTON_ZOOM = 1.6;
const WHEEL_ZOOM = 0.0015;
const ZOOMS = [0.5, 400] as const;
/** The margin around the whole, in pixels. */
const MARGIN = 14;

const SIDES = [['Source', 0], ['Target', 1]] as const;

const HELP =
  'Arrow keys move it, plus and minus change its size, 0 shows all, v, e and f go to the next corner, side and triangle of the base domain; from a triangle’s patch the layout grows.';

/**
 * The part of the plane that a picture shows: the point in its middle, and the zoom as a multiple of the size at which the whole fits;
 * `null` shows the whole.
 */
interface View {
  readonly x: number;
  readonly y: number;
  readonly zoom: number;
}

type Grown = readonly [GrownSide, GrownSide];

interface Size {
  readonly width: number;
  readonly height: number;
}

/** The size of an element in pixels, as it changes. */
function useSize(element: { readonly current: HTMLCanvasElement | null }): Size {
  const [size, setSize] = useState({ width: 288, height: 240 });
  useEffect(() => {
    const { current } = element;
    if (current === null) {
      return undefined;
    }
    const observer = new ResizeObserver(() => {
      setSize({ width: Math.max(1, current.clientWidth), height: Math.max(1, current.clientHeight) });
    });
    observer.observe(current);
    return () => {
      observer.disconnect();
    };
  }, []);
  return size;
}

/** A function that answers one question at a time; of the questions that come meanwhile it answers only the latest. */
function useLatest<Q>(answer: (question: Q) => Promise<void>): (question: Q) => void {
  const waiting = useRef<{ question: Q } | null>(null);
  const busy = useRef(false);
  const latest = useRef(answer);
  latest.current = answer;
  const next = async (): Promise<void> => {
    busy.current = true;
    try {
      while (waiting.current !== null) {
        const { question } = waiting.current;
        waiting.current = null;
        await latest.current(question);
      }
    } finally {
      busy.current = false;
    }
  };
  return (question) => {
    waiting.current = { question };
    if (!busy.current) {
      void next();
    }
  };
}

/** The middle and the scale of a view, in pixels of the page per unit of the plane. */
function placing(view: View | null, [left, low, right, high]: GrownSide['box'], { width, height }: Size): Pick<PlaneFrame, 'x' | 'y' | 'scale'> {
  const fit = Math.min(Math.max(1, width - 2 * MARGIN) / Math.max(right - left, 1e-9), Math.max(1, height - 2 * MARGIN) / Math.max(high - low, 1e-9));
  return view === null ? { x: (left + right) / 2, y: (low + high) / 2, scale: fit } : { x: view.x, y: view.y, scale: view.zoom * fit };
}

interface PictureProps extends Pick<PlaneProps, 'parts' | 'counts'> {
  readonly name: string;
  readonly side: Side;
  readonly planes: Planes;
  readonly grown: GrownSide;
  readonly shown: number;
  readonly circles: PlaneFrame['circles'];
  readonly look: PlaneFrame['look'];
}

/** The part of the plane that a picture shows, and the functions that change it. */
interface Looking extends Pick<PlaneFrame, 'x' | 'y' | 'scale'> {
  readonly isWhole: boolean;
  readonly showAll: () => void;
  /** Moves the picture, in pixels. */
  readonly move: (dx: number, dy: number) => void;
  /** Multiplies the picture's size; the point at (dx, dy), in pixels from the picture's middle, stays where it is. */
  readonly zoom: (factor: number, dx?: number, dy?: number) => void;
}

function useLooking(grown: GrownSide, size: Size): Looking {
  const [view, setView] = useState<View | null>(null);
  useEffect(() => {
    setView(null);
  }, [grown]);
  const fit = placing(null, grown.box, size).scale;
  const { x, y, scale } = placing(view, grown.box, size);
  return {
    ...{ x, y, scale },
    isWhole: view === null,
    showAll: () => {
      setView(null);
    },
    move: (dx, dy) => {
      setView({ x: x - dx / scale, y: y + dy / scale, zoom: scale / fit });
    },
    zoom: (factor, dx = 0, dy = 0) => {
      const to = fit * Math.min(ZOOMS[1], Math.max(ZOOMS[0], (scale / fit) * factor));
      setView({ x: x + dx / scale - dx / to, y: y - dy / scale + dy / to, zoom: to / fit });
    },
  };
}

/** Has the picture drawn whenever it changes; frames that were overtaken are skipped. */
function useDrawn(canvas: { readonly current: HTMLCanvasElement | null }, { side, planes, grown, shown, circles, look, parts }: PictureProps, size: Size, { x, y, scale }: Looking): void {
  const density = Math.min(2, window.devicePixelRatio);
  const draw = useLatest(async (frame: PlaneFrame) => {
    const bitmap = await planes.ask('draw', frame);
    canvas.current?.getContext('bitmaprenderer')?.transferFromImageBitmap(bitmap);
    canvas.current?.setAttribute('data-drawn', String(frame.shown));
  });
  const { lit } = parts;
  useEffect(() => {
    const [width, height] = [Math.round(size.width * density), Math.round(size.height * density)];
    draw({ side, width, height, density, x, y, scale: scale * density, shown, lit, circles, look });
  }, [grown, size, x, y, scale, shown, lit?.kind, lit?.index, circles, look]);
}

/** What a key does; `undefined` where the key is not one of the picture's. */
function actionOf({ key, shiftKey }: KeyboardEvent, { parts, counts }: PictureProps, { move, zoom, showAll }: Looking): (() => void) | undefined {
  const kind = PART_KEYS[key.toLowerCase()];
  if (kind !== undefined && counts[kind] > 0) {
    return () => {
      parts.hold(stepped(parts.held, kind, shiftKey ? -1 : 1, counts[kind]));
    };
  }
  const actions: Readonly<Partial<Record<string, () => void>>> = {
    ArrowLeft: () => { move(KEY_MOVE, 0); },
    ArrowRight: () => { move(-KEY_MOVE, 0); },
    ArrowUp: () => { move(0, KEY_MOVE); },
    ArrowDown: () => { move(0, -KEY_MOVE); },
    '+': () => { zoom(KEY_ZOOM); },
    '-': () => { zoom(1 / KEY_ZOOM); },
    '0': showAll,
    Escape: () => { parts.hold(null); },
  };
  return actions[key];
}

type PointerHandlers = Readonly<Record<'onPointerDown' | 'onPointerMove' | 'onPointerUp' | 'onPointerCancel' | 'onPointerLeave', (event: PointerEvent) => void>>;

/** Handlers by which a drag moves the picture, a click holds a part, and the part under the pointer lights up. */
function usePointer(canvas: { readonly current: HTMLCanvasElement | null }, { side, planes, shown, parts }: PictureProps, size: Size, { x, y, scale, move }: Looking): PointerHandlers {
  const isOver = useRef(false);
  const pressed = useRef<{ readonly x: number; readonly y: number; readonly travelled: number } | null>(null);
  const partUnder = async ({ clientX, clientY }: PointerEvent): Promise<BasePart | null> => {
    const box = canvas.current?.getBoundingClientRect();
    const [dx, dy] = [clientX - (box?.left ?? 0) - size.width / 2, clientY - (box?.top ?? 0) - size.height / 2];
    return planes.ask('ask', { side, x: x + dx / scale, y: y - dy / scale, reach: REACH / scale, shown });
  };
  const hover = useLatest(async (event: PointerEvent) => {
    const part = await partUnder(event);
    parts.hover(isOver.current ? part : null);
  });
  return {
    onPointerDown: (event) => {
      canvas.current?.setPointerCapture(event.pointerId);
      pressed.current = { x: event.clientX, y: event.clientY, travelled: 0 };
    },
    onPointerMove: (event) => {
      isOver.current = true;
      const from = pressed.current;
      if (from === null) {
        hover(event);
        return;
      }
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      const travelled = from.travelled + Math.hypot(dx, dy);
      pressed.current = { x: event.clientX, y: event.clientY, travelled };
      if (travelled > CLICK_SLACK) {
        move(dx, dy);
      }
    },
    onPointerUp: (event) => {
      if ((pressed.current?.travelled ?? Infinity) <= CLICK_SLACK) {
        void partUnder(event).then(parts.hold);
      }
      pressed.current = null;
    },
    onPointerCancel: () => {
      pressed.current = null;
    },
    onPointerLeave: () => {
      isOver.current = false;
      parts.hover(null);
    },
  };
}

/** The caption with buttons for users who have neither a wheel nor keys. */
function Caption({ name, looking: { zoom, showAll } }: { readonly name: string; readonly looking: Looking }): VNode {
  const plane = `the plane of the ${name.toLowerCase()}`;
  return (
    <figcaption class="small">
      <span>{name}</span>
      <button type="button" aria-label={`Make ${plane} smaller`} onClick={() => { zoom(1 / BUTTON_ZOOM); }}>
        −
      </button>
      <button type="button" aria-label={`Make ${plane} larger`} onClick={() => { zoom(BUTTON_ZOOM); }}>
        +
      </button>
      <button type="button" aria-label={`Show all of ${plane}`} onClick={showAll}>
        All
      </button>
    </figcaption>
  );
}

/** The picture of one mesh in the plane. */
function PlanePicture(props: PictureProps): VNode {
  const { name, side, grown } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const size = useSize(canvas);
  const looking = useLooking(grown, size);
  useDrawn(canvas, props, size, looking);
  return (
    <figure>
      <canvas
        ref={canvas}
        data-plane={side}
        class={looking.isWhole ? 'whole' : undefined}
        role="group"
        tabIndex={0}
        aria-label={`${name} in the plane, ${integer(grown.cutEdges)} edges along the cut. ${HELP}`}
        onKeyDown={(event) => {
          const action = event.ctrlKey || event.metaKey || event.altKey ? undefined : actionOf(event, props, looking);
          if (action !== undefined) {
            event.preventDefault();
            event.stopPropagation();
            action();
          }
        }}
        {...usePointer(canvas, props, size, looking)}
        onWheel={(event) => {
          // The wheel scrolls the panel unless the picture was clicked before.
          if (document.activeElement !== event.currentTarget && !event.ctrlKey) {
            return;
          }
          event.preventDefault();
          const box = event.currentTarget.getBoundingClientRect();
          looking.zoom(Math.exp(-WHEEL_ZOOM * event.deltaY), event.clientX - box.left - size.width / 2, event.clientY - box.top - size.height / 2);
        }}
      />
      <Caption name={name} looking={looking} />
    </figure>
  );
}

/** The number of a mesh's triangles that are placed up to a ring. */
function countAt({ rings }: GrownSide, ring: number): number {
  return rings[Math.min(ring, rings.length - 1)] ?? 0;
}

interface FilesProps extends Pick<PlaneProps, 'names'> {
  readonly planes: Planes;
  readonly circles: PlaneFrame['circles'];
  readonly shown: readonly [number, number];
}

/** Saves the layout of one mesh as PNG, SVG or OBJ. */
function Files({ planes, names, circles, shown }: FilesProps): VNode {
  const [side, setSide] = useState<Side>(1);
  const save = async (format: PlaneFileWish['format']): Promise<void> => {
    const file = await planes.ask('save', { side, format, names, circles, shown: shown[side] });
    download(`conemap-plane-${side === 0 ? 'source' : 'target'}.${format}`, file.type, file);
  };
  return (
    <div class="plane-files">
      <div role="radiogroup" aria-label="Mesh to save in the plane" class="base-shapes">
        {SIDES.map(([text, value]) => (
          <label class="check" key={value}>
            <input
              type="radio"
              name="plane-side"
              checked={side === value}
              onChange={() => {
                setSide(value);
              }}
            />
            <span>{text}</span>
          </label>
        ))}
      </div>
      {(['png', 'svg', 'obj'] as const).map((format) => (
        <button
          type="button"
          key={format}
          aria-label={`Save the plane as ${format.toUpperCase()}`}
          onClick={() => {
            void save(format);
          }}
        >
          {format.toUpperCase()}
        </button>
      ))}
    </div>
  );
}

/** A sentence about both layouts. */
function summary(grown: Grown, isDone: boolean): string {
  const turned = grown[0].turnedOver + grown[1].turnedOver;
  const crossing = turned === 0 ? '' : ` ${integer(turned)} triangles lie turned over: straight edges of the meshes cross there in the flat metric.`;
  return isDone ? `Both meshes are cut along a tree that joins the cones; everywhere else the triangles fit together.${crossing}` : 'Growing ring by ring…';
}

interface PlayerProps extends Omit<PlaneProps, 'hands'> {
  readonly planes: Planes;
  readonly grown: Grown;
  /** The seed of the growth. A new seed means that the layouts have grown anew. */
  readonly seed: number | null;
}

function Player({ planes, grown, seed, names, theme, parts, counts, onClose }: PlayerProps): VNode {
  const [circles, setCircles] = useState<PlaneFrame['circles']>('hidden');
  const last = Math.max(...grown.map(({ rings }) => rings.length - 1));
  const { time, isPlaying, rest, toggle, restart } = usePlayed(last, Math.max(LEAST_RING, GROWING / last));
  useLayoutEffect(() => {
    // At first the whole is shown. A newly chosen patch plays its growth, except where the user wants less motion. This is decided before
    // anything of the new layout is drawn.
    if (seed === null || window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
      rest(last);
    } else {
      restart();
    }
  }, [grown]);
  const ring = Math.min(Math.floor(time), last);
  const shown = [countAt(grown[0], ring), countAt(grown[1], ring)] as const;
  const look = useDarkness(theme) ? 'dark' : 'light';
  const words = `${integer(shown[0])} of ${integer(countAt(grown[0], last))} triangles of the source, ${integer(shown[1])} of ${integer(countAt(grown[1], last))} of the target`;
  return (
    <div class="watched plane-layouts">
      <div class="planes">
        {SIDES.map(([name, side]) => (
          <PlanePicture key={name} {...{ name, side, planes, circles, look, parts, counts }} grown={grown[side]} shown={shown[side]} />
        ))}
      </div>
      <ul class="plane-key small">
        <li class="cut">cut</li>
        <li>patch lines</li>
      </ul>
      <Transport name="growth" {...{ last, time, isPlaying, words, rest, toggle }} />
      <p class="small growth-words">{words}</p>
      <p class="small quiet" role="status">
        {summary(grown, ring === last)}
      </p>
      <label class="check">
        <input
          type="checkbox"
          name="circles"
          checked={circles === 'shown'}
          onChange={(event) => {
            setCircles(event.currentTarget.checked ? 'shown' : 'hidden');
          }}
        />
        <span>Circles of the packing</span>
      </label>
      <Files {...{ planes, names, circles, shown }} />
      <div class="watched-row">
        <button type="button" id="close-plane" onClick={onClose}>
          Close
        </button>
      </div>
    </div>
  );
}

/** Lays both meshes out from the patch that was held last. */
function Growing(props: Omit<PlayerProps, 'grown' | 'seed'>): VNode {
  const { planes, parts } = props;
  const [layout, setLayout] = useState<{ readonly grown: Grown; readonly seed: number | null } | null>(null);
  const wanted = parts.held?.kind === 'face' ? parts.held.index : null;
  const grow = useLatest(async (patch: number | null) => {
    setLayout({ grown: await planes.ask('grow', patch ?? 0), seed: patch });
  });
  useEffect(() => {
    if (layout === null || (wanted !== null && wanted !== layout.seed)) {
      grow(wanted);
    }
  }, [wanted]);
  return layout === null ? <p role="status">Laying both meshes out…</p> : <Player {...props} {...layout} />;
}

/** The layouts, once the metrics are computed. */
export default function Plane({ hands, ...props }: PlaneProps): VNode {
  return (
    <Computed hands={hands} sentence="Computing both flat metrics…" onClose={props.onClose}>
      {(planes) => <Growing {...props} planes={planes} />}
    </Computed>
  );
}
