/** The shape of everything beside the meshes that comes with links and project files, and the limits of its parts. */
import * as v from 'valibot';
import type { Pair, SurfacePoint } from '../landmarks.ts';
import { MAX_RADIUS } from '../landmarks.ts';
import { BASES, BORDERS, CLASSES, CONES, METHODS } from '../options.ts';
import type { RunOptions } from '../report.ts';
import type { Axis as UpAxis, Camera, PlainSurface, Style, TexturePlace, Work } from '../store/state.ts';
import { FLOW_HEATS, INITIAL, MAP_HEATS, TEXTURES } from '../store/state.ts';
import { wordsOf } from '../unions.ts';

/** The most pairs: more than any map was ever made from. */
export const MOST_PAIRS = 10_000;
/** The most characters of a text, more than any name, label or sentence has. */
const LONGEST_TEXT = 10_000;
/** The most numbers of a camera, which has about ten. */
const LONGEST_CAMERA = 32;
const MOST_OWN_CONES = 1000;
/** The most cells of a texture per unit of texture coordinates. */
const MOST_CELLS = 1000;

const Share = v.pipe(v.number(), v.minValue(0), v.maxValue(1));

/** The number of a vertex or face, or an index in a list. */
export const Index = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(2 ** 32 - 1));
/** A barycentric weight. Whether three of them belong together is checked by the core, as for a landmark file. */
export const Weight = v.pipe(v.number(), v.finite(), v.minValue(-1), v.maxValue(2));
export const Text = v.pipe(v.string(), v.maxLength(LONGEST_TEXT));
export const Axis = v.picklist(wordsOf<UpAxis>({ x: true, '-x': true, y: true, '-y': true, z: true, '-z': true }));
export const Options = v.object({
  method: v.picklist(wordsOf(METHODS)),
  base: v.picklist(wordsOf(BASES)),
  cones: v.picklist(wordsOf(CONES)),
  class: v.picklist(wordsOf(CLASSES)),
  ownCones: v.nullable(v.pipe(Index, v.maxValue(MOST_OWN_CONES))),
  // Links and maps from before this was a choice do not have it.
  borders: v.optional(v.picklist(wordsOf(BORDERS)), 'guess'),
}) satisfies v.GenericSchema<unknown, RunOptions>;

/** The options in a text; `null` where the text holds none. */
export function optionsIn(text: string): RunOptions | null {
  try {
    const parsed = v.safeParse(Options, JSON.parse(text));
    return parsed.success ? parsed.output : null;
  } catch {
    return null;
  }
}
export const Cameras = v.strictTuple([
  v.nullable(v.pipe(v.array(v.pipe(v.number(), v.finite())), v.maxLength(LONGEST_CAMERA))),
  v.nullable(v.pipe(v.array(v.pipe(v.number(), v.finite())), v.maxLength(LONGEST_CAMERA))),
]) satisfies v.GenericSchema<readonly [Camera | null, Camera | null]>;
const Cells = v.pipe(v.number(), v.minValue(-MOST_CELLS), v.maxValue(MOST_CELLS));
const TexturePlaceSchema = v.object({
  cells: v.pipe(v.number(), v.minValue(1), v.maxValue(MOST_CELLS)),
  turn: v.pipe(v.number(), v.minValue(-180), v.maxValue(180)),
  x: Cells,
  y: Cells,
}) satisfies v.GenericSchema<unknown, TexturePlace>;

export const StyleSchema = v.object({
  surface: v.picklist([
    ...wordsOf<PlainSurface>({ shaded: true, look: true, pattern: true, colours: true }),
    ...TEXTURES,
    ...MAP_HEATS,
    ...FLOW_HEATS,
  ]),
  patchLines: v.boolean(),
  cones: v.boolean(),
  markers: v.boolean(),
  // Links, projects and sessions of earlier versions of the page do not have these.
  texture: v.optional(TexturePlaceSchema, INITIAL.ui.style.texture),
  textureBoundary: v.optional(v.boolean(), false),
  morph: v.optional(Share, 0),
  wipe: v.optional(v.nullable(Share), null),
}) satisfies v.GenericSchema<unknown, Style>;

const Point = v.nullable(
  v.union([Index, v.object({ face: Index, barycentric: v.strictTuple([Weight, Weight, Weight]) })]),
) satisfies v.GenericSchema<SurfacePoint | null>;

/** The radius within which a soft pair may be moved. Earlier versions of the page ignore it and hold the pair. */
export const Radius = v.pipe(v.number(), v.gtValue(0), v.maxValue(MAX_RADIUS));

/** A pair without its id, which is valid on one page only. */
export type SentPair = Omit<Pair, 'id'>;

/** Everything but the meshes: the work on them, and how it was viewed. */
export interface SentWork extends Pick<Work, 'up' | 'groundTruth' | 'options'> {
  readonly pairs: readonly SentPair[];
  readonly cameras: readonly [Camera | null, Camera | null];
  readonly style: Style;
}

/** Whether every pair has a point, and no two pairs have the same number. */
export function areSound(pairs: readonly SentPair[]): boolean {
  const numbers = new Set(pairs.map(({ number }) => number));
  return numbers.size === pairs.length && pairs.every(({ points }) => points[0] !== null || points[1] !== null);
}

/** The shape of the work in a project file. */
export const SentWorkSchema = v.object({
  pairs: v.pipe(
    v.array(
      v.object({
        number: v.pipe(Index, v.minValue(1)),
        points: v.strictTuple([Point, Point]),
        label: Text,
        locked: v.boolean(),
        radius: v.exactOptional(Radius),
      }),
    ),
    v.maxLength(MOST_PAIRS),
    v.check((pairs) => areSound(pairs)),
  ),
  up: v.strictTuple([Axis, Axis]),
  groundTruth: v.nullable(Text),
  options: Options,
  cameras: v.fallback(Cameras, [null, null]),
  style: v.fallback(StyleSchema, INITIAL.ui.style),
}) satisfies v.GenericSchema<unknown, SentWork>;
