/**
 * The base domain of the map as a picture that can be turned: its parts light up on the meshes, and the patch under the mouse lights up in
 * it.
 */
import type { VNode } from 'preact';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { BaseOutput } from '../compute/messages.ts';
import { useDarkness } from '../darkness.ts';
import { download } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { pngOf } from '../plots/png.ts';
import type { Axes, Vector } from './axes.ts';
import { dragged } from './axes.ts';
import './base-domain.css';
import type { Palette } from './drawing.ts';
import { DARK, LIGHT, mixed, outline, pictureSvg, stroke, strokes } from './drawing.ts';
import type { BaseHands } from './hands.ts';
import type { BasePart, PartHands } from './parts.ts';
import { faceCount, PART_KEYS, stepped } from './parts.ts';
import type { Ball, Facet, Look, Picture, Solid, Spot } from './picture.ts';
import { partAt, pictureOf, solidOf } from './picture.ts';
import { coneName, degrees, reading, summary } from './words.ts';

export interface BaseDomainProps {
  readonly base: BaseOutput;
  /** The names of the landmarks, in the order of the run. */
  readonly names: readonly string[];
  readonly hands: BaseHands;
  readonly theme: string;
  /** Whether the picture turns with the views; else it turns by itself. */
  readonly isLinked: boolean;
  /** The axis of each mesh that points up. */
  readonly up: readonly [Vector, Vector];
  /** The base triangle whose patch is under the mouse on a mesh, where the views light it up themselves; `null` for none. */
  readonly under: number | null;
  readonly parts: PartHands;
}

/** Size of an exported drawing, in pixels. */
const EXPORTED = { width: 900, height: 700 };
/** How many pixels of a PNG stand for one of the drawing. */
const PNG_TIMES = 2;
/** The turn of an arrow key, in heights of the picture, and the factor of a zoom key. */
const KEY_TURN = 0.06;
const KEY_ZOOM = 1.25;
const ZOOMS = [1, 12] as const;
/** How far a pointer may move between press and release of a click, in pixels. */
const CLICK_SLACK = 4;
/** The axes from the front, for use while nothing is drawn. */
const FRONT: Axes = { right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1] };

const SHAPES = [['Target', 1], ['Source', 0]] as const;

const HELP =
  'Arrow keys turn it, plus and minus change its size, v, e and f go to the next corner, side and triangle, with Shift to the last one.';

function isPart(part: BasePart | null, kind: BasePart['kind'], index: number): boolean {
  return part?.kind === kind && part.index === index;
}

/** The size of an element in pixels, as it changes. */
function useSize(element: { readonly current: SVGSVGElement | null }): { readonly width: number; readonly height: number } {
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

function FacetPaths({ facet, lit, palette }: { readonly facet: Facet; readonly lit: BasePart | null; readonly palette: Palette }): VNode {
  const fill = mixed(isPart(lit, 'face', facet.face) ? palette.litFace : palette.face, facet.light);
  return (
    <>
      <path class="facet" data-face={facet.face} d={outline(facet)} fill={fill} stroke={fill} stroke-width="0.6" />
      <path d={strokes(facet)} stroke={palette.side} fill="none" />
      {facet.sides
        .filter(({ side }) => isPart(lit, 'side', side))
        .map((side) => (
          <path key={side.side} d={stroke(side)} stroke={palette.lit} stroke-width="4" fill="none" />
        ))}
    </>
  );
}

function BallCircle({ ball, lit, palette }: { readonly ball: Ball; readonly lit: BasePart | null; readonly palette: Palette }): VNode {
  const { at, cone, radius, sign, isHidden } = ball;
  const isLit = isPart(lit, 'cone', cone);
  return (
    <circle
      class={`cone ${sign}${isHidden ? ' hidden-cone' : ''}`}
      data-cone={cone}
      cx={at.x}
      cy={at.y}
      r={radius}
      fill={isHidden ? 'none' : palette[sign]}
      stroke={isLit ? palette.lit : isHidden ? palette[sign] : palette.rim}
      stroke-width={isLit ? 3 : 1}
      stroke-opacity={isHidden && !isLit ? 0.35 : 1}
    />
  );
}

/** The part that is lit up, drawn through what is in front of it. */
function Through({ solid, picture, lit, palette }: { readonly solid: Solid; readonly picture: Picture; readonly lit: BasePart | null; readonly palette: Palette }): VNode | null {
  const spot = (cone: number): Spot => picture.spots[cone] ?? { x: 0, y: 0 };
  const dashed = (d: string): VNode => <path d={d} stroke={palette.lit} stroke-width="1.5" stroke-dasharray="4 3" fill="none" />;
  if (lit?.kind === 'side') {
    const [from, to] = solid.ends[lit.index] ?? [0, 0];
    return dashed(stroke({ from: spot(from), to: spot(to) }));
  }
  if (lit?.kind === 'face') {
    const [a, b, c] = [0, 1, 2].map((k) => spot(solid.base.triangles[3 * lit.index + k] ?? 0));
    return a === undefined || b === undefined || c === undefined ? null : dashed(`${stroke({ from: a, to: b })}L${c.x} ${c.y}Z`);
  }
  return null;
}

interface TagProps {
  readonly at: Spot;
  readonly text: string;
  readonly width: number;
  readonly palette: Palette;
}

/** A cone's name and curvature, written beside it. */
function Tag({ at, text, width, palette }: TagProps): VNode {
  const isLeft = at.x > width / 2;
  return (
    <text
      class="tag"
      x={at.x + (isLeft ? -14 : 14)}
      y={Math.max(14, at.y - 8)}
      text-anchor={isLeft ? 'end' : 'start'}
      fill={palette.ink}
      stroke={palette.ground}
      stroke-width="4"
      paint-order="stroke"
    >
      {text}
    </text>
  );
}

interface Turning {
  readonly axes: Axes;
  readonly turn: (dx: number, dy: number, way: 'smoothly' | 'at once') => void;
}

/** How the picture is turned: with the view of a side, or by itself. */
function useTurning({ hands, isLinked, up }: Pick<BaseDomainProps, 'hands' | 'isLinked' | 'up'>, side: Side): Turning {
  const [, setTurned] = useState(0);
  const [own, setOwn] = useState<Axes | null>(null);
  useEffect(hands.open, []);
  useEffect(
    () =>
      hands.whenTurned(() => {
        setTurned((count) => count + 1);
      }),
    [],
  );
  useEffect(() => {
    setOwn(isLinked ? null : hands.axes(side));
  }, [isLinked]);
  const axes = own ?? hands.axes(side) ?? FRONT;
  return {
    axes,
    turn: (dx, dy, way) => {
      if (isLinked) {
        hands.orbit(side, dx, dy, way);
      } else {
        setOwn(dragged(axes, up[side], dx, dy));
      }
    },
  };
}

/** What the picture shows, and what pointer and keys can do to it. */
interface Desk {
  readonly solid: Solid;
  readonly picture: Picture;
  readonly height: number;
  readonly held: BasePart | null;
  readonly turn: Turning['turn'];
  readonly hover: (part: BasePart | null) => void;
  readonly hold: (part: BasePart | null) => void;
  /** Multiplies the picture's size; `null` shows the whole. */
  readonly magnify: (factor: number | null) => void;
}

/** What a key does; `null` where the key is not one of the picture's. */
function actionOf({ solid, held, turn, hold, magnify }: Desk, { key, shiftKey }: KeyboardEvent): (() => void) | null {
  const kind = PART_KEYS[key.toLowerCase()];
  if (kind !== undefined) {
    const counts = { cone: solid.cones.length, side: solid.ends.length, face: faceCount(solid.base) };
    return () => {
      hold(stepped(held, kind, shiftKey ? -1 : 1, counts[kind]));
    };
  }
  const turns: Readonly<Partial<Record<string, readonly [number, number]>>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const way = turns[key];
  if (way !== undefined) {
    return () => {
      turn(KEY_TURN * way[0], KEY_TURN * way[1], 'smoothly');
    };
  }
  const others: Readonly<Partial<Record<string, () => void>>> = {
    '+': () => { magnify(KEY_ZOOM); },
    '-': () => { magnify(1 / KEY_ZOOM); },
    '0': () => { magnify(null); },
    Escape: () => { hold(null); },
  };
  return others[key] ?? null;
}

function press(desk: Desk, event: KeyboardEvent): void {
  const action = event.ctrlKey || event.metaKey || event.altKey ? null : actionOf(desk, event);
  if (action !== null) {
    event.preventDefault();
    event.stopPropagation();
    action();
  }
}

interface Pointing {
  /** The last position of the pointer, and how far it has moved since it was pressed. */
  readonly x: number;
  readonly y: number;
  readonly travelled: number;
}

type PointerHandlers = Readonly<Record<'onPointerDown' | 'onPointerMove' | 'onPointerUp' | 'onPointerCancel' | 'onPointerLeave', (event: PointerEvent) => void>>;

/** Handlers by which a drag turns the picture, a click selects a part, and the part under the pointer lights up. */
function usePointer(svg: { readonly current: SVGSVGElement | null }, { picture, height, held, turn, hover, hold }: Desk): PointerHandlers {
  const pressed = useRef<Pointing | null>(null);
  const partUnder = (event: PointerEvent): BasePart | null => {
    const box = svg.current?.getBoundingClientRect();
    return partAt(picture, { x: event.clientX - (box?.left ?? 0), y: event.clientY - (box?.top ?? 0) });
  };
  return {
    onPointerDown: (event) => {
      svg.current?.setPointerCapture(event.pointerId);
      pressed.current = { x: event.clientX, y: event.clientY, travelled: 0 };
    },
    onPointerMove: (event) => {
      const from = pressed.current;
      if (from === null) {
        hover(partUnder(event));
        return;
      }
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      const travelled = from.travelled + Math.hypot(dx, dy);
      pressed.current = { x: event.clientX, y: event.clientY, travelled };
      if (travelled > CLICK_SLACK) {
        turn(dx / height, -dy / height, 'at once');
      }
    },
    onPointerUp: (event) => {
      if ((pressed.current?.travelled ?? Infinity) <= CLICK_SLACK) {
        const part = partUnder(event);
        hold(part !== null && isPart(held, part.kind, part.index) ? null : part);
      }
      pressed.current = null;
    },
    onPointerCancel: () => {
      pressed.current = null;
    },
    onPointerLeave: () => {
      hover(null);
    },
  };
}

interface RowProps {
  readonly side: Side;
  readonly isLarge: boolean;
  readonly onSide: (side: Side) => void;
  readonly onLarge: (isLarge: boolean) => void;
  readonly onSave: (format: 'svg' | 'png') => Promise<void>;
}

/** The row of controls below the picture. */
function Row({ side, isLarge, onSide, onLarge, onSave }: RowProps): VNode {
  return (
    <div class="base-row">
      <div role="radiogroup" aria-label="Shape of the base domain" class="base-shapes">
        {SHAPES.map(([text, value]) => (
          <label class="check" key={value}>
            <input
              type="radio"
              name="base-shape"
              checked={side === value}
              onChange={() => {
                onSide(value);
              }}
            />
            <span>{text}</span>
          </label>
        ))}
      </div>
      <button
        type="button"
        aria-pressed={isLarge}
        onClick={() => {
          onLarge(!isLarge);
        }}
      >
        Large
      </button>
      {(['png', 'svg'] as const).map((format) => (
        <button
          type="button"
          key={format}
          aria-label={`Save the base domain as ${format.toUpperCase()}`}
          onClick={() => {
            void onSave(format);
          }}
        >
          {format.toUpperCase()}
        </button>
      ))}
    </div>
  );
}

interface ShapesProps {
  readonly solid: Solid;
  readonly picture: Picture;
  readonly lit: BasePart | null;
  readonly palette: Palette;
  readonly names: readonly string[];
  readonly width: number;
}

/** The shapes of the picture. */
function Shapes({ solid, picture, lit, palette, names, width }: ShapesProps): VNode {
  return (
    <>
      {picture.facets.map((facet, k) => (
        <FacetPaths key={k} facet={facet} lit={lit} palette={palette} />
      ))}
      <Through solid={solid} picture={picture} lit={lit} palette={palette} />
      {picture.balls.map((ball) => (
        <BallCircle key={ball.cone} ball={ball} lit={lit} palette={palette} />
      ))}
      {lit?.kind === 'cone' && (
        <Tag
          at={picture.spots[lit.index] ?? { x: 0, y: 0 }}
          text={`${coneName(names, lit.index)}: ${degrees(solid.curvatures[lit.index] ?? 0)}`}
          width={width}
          palette={palette}
        />
      )}
    </>
  );
}

/** The whole picture with its controls. */
export default function BaseDomain(props: BaseDomainProps): VNode {
  const { base, names, hands, theme, under, parts } = props;
  const { lit, held, hold, hover } = parts;
  const [side, setSide] = useState<Side>(1);
  const [zoom, setZoom] = useState(1);
  const [isLarge, setLarge] = useState(false);
  const svg = useRef<SVGSVGElement>(null);
  const palette = useDarkness(theme) ? DARK : LIGHT;
  const { width, height } = useSize(svg);
  const { axes, turn } = useTurning(props, side);
  const solid = useMemo(() => solidOf(base, side), [base, side]);
  const look: Look = { axes, width, height, zoom };
  const picture = pictureOf(solid, look);
  useEffect(() => {
    if (under === null) {
      hands.light(lit);
    }
  }, [lit?.kind, lit?.index, under]);
  const desk: Desk = {
    ...{ solid, picture, height, held, turn, hover, hold },
    magnify: (factor) => {
      setZoom(factor === null ? 1 : Math.min(ZOOMS[1], Math.max(ZOOMS[0], zoom * factor)));
    },
  };
  const save = async (format: 'svg' | 'png'): Promise<void> => {
    const saved = pictureOf(solid, { ...look, ...EXPORTED });
    const svgText = pictureSvg(saved, EXPORTED, solid.cones.map((_, cone) => coneName(names, cone)));
    const file = format === 'svg' ? svgText : await pngOf(svgText, EXPORTED, PNG_TIMES);
    if (file !== null) {
      download(`conemap-base-domain.${format}`, format === 'svg' ? 'image/svg+xml' : 'image/png', file);
    }
  };
  return (
    <div class={`base-domain${isLarge ? ' large' : ''}`}>
      <svg
        ref={svg}
        id="base-picture"
        role="group"
        tabindex={0}
        aria-label={`The base domain. ${summary(solid)} ${HELP}`}
        stroke-linejoin="round"
        stroke-linecap="round"
        onKeyDown={(event) => {
          press(desk, event);
        }}
        {...usePointer(svg, desk)}
      >
        <Shapes {...{ solid, picture, lit, palette, names, width }} />
      </svg>
      <p class="base-reading small" role="status">
        {lit === null ? summary(solid) : reading(solid, lit, names)}
      </p>
      <Row side={side} isLarge={isLarge} onSide={setSide} onLarge={setLarge} onSave={save} />
    </div>
  );
}
