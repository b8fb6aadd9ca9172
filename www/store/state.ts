/** The state of the page: everything that it shows follows from it. */
import type { RunOutput } from '../compute/messages.ts';
import type { Flows, OtherOutput } from '../compute/watch-messages.ts';
import type { Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import type { Finding, OtherMap, ProofReport, Report } from '../report.ts';
import type { SurfaceStyle } from '../wasm/page.js';
import type { AwaitedMap } from './awaited.ts';
import type { Breakdown } from './breakdown.ts';
import type { Examined } from './defects.ts';
import type { History } from './history.ts';
import { NO_HISTORY } from './history.ts';
import type { Job } from './job.ts';
import type { LeftRight } from './left-right.ts';
import { NO_LEFT_RIGHT } from './left-right.ts';
import type { Matching } from './matching.ts';
import type { Receiving } from './receiving.ts';
import type { Refused } from './refused.ts';
import type { Demo, Work } from './work.ts';
import { NO_WORK } from './work.ts';

export type { Axis, Demo, MeshFile, Work } from './work.ts';

/** What can lie on the flat metric, which the map carries. */
export const TEXTURES = ['checkerboard', 'circles', 'ribbons', 'coordinates', 'picture'] as const satisfies readonly SurfaceStyle[];

/** Values by place of the map as colours: the distortion, that of angles, the factor of the area, and the distance to the true image. */
export const MAP_HEATS = ['distortion', 'angles', 'areas', 'truth'] as const;

/** Values by vertex of either mesh as colours: the conformal factor of the flow, and the Gaussian curvature before it and after. */
export const FLOW_HEATS = ['factor', 'curvature', 'flat-curvature'] as const;

/**
 * Plain clay; the colours of the mesh's file, which the map carries; a pattern in space, which the map carries to the source; colours of the
 * place on the target: what the views draw but textures, and but the scales of heat maps.
 */
export type PlainSurface = Exclude<SurfaceStyle, Texture | 'rising' | 'diverging'>;

export type Texture = (typeof TEXTURES)[number];
export type MapHeat = (typeof MAP_HEATS)[number];
export type FlowHeat = (typeof FLOW_HEATS)[number];
export type HeatMap = MapHeat | FlowHeat;

/** How a texture lies on the flat metric. */
export interface TexturePlace {
  /** Cells to a unit of texture coordinates. */
  readonly cells: number;
  /** Counter-clockwise, in degrees. */
  readonly turn: number;
  /** Shifts in cells. */
  readonly x: number;
  readonly y: number;
}

/** A picture of the user's that lies on the flat metric: red, green, blue and opacity, row by row from the top. */
export interface TexturePicture {
  readonly name: string;
  readonly width: number;
  readonly height: number;
  readonly pixels: Uint8Array;
}

export interface Style {
  readonly surface: PlainSurface | Texture | HeatMap;
  readonly texture: TexturePlace;
  readonly patchLines: boolean;
  /** Where the texture is cut that the map carries. */
  readonly textureBoundary: boolean;
  readonly cones: boolean;
  readonly markers: boolean;
  /** Share of the way that the source's shape has gone to the target's, 0 to 1; it takes a map to be seen. */
  readonly morph: number;
  /** Share of the source's view, from the left, in which the source is seen as it is by itself; `null` for none of it. */
  readonly wipe: number | null;
}

/** A camera as the views give it and take it back. */
export type Camera = readonly number[];

/** How the page is looked at. It is kept with the work, but changes of it are no steps. */
export interface Ui {
  readonly step: 'meshes' | 'landmarks' | 'map' | 'use' | 'method';
  readonly theme: 'system' | 'light' | 'dark';
  readonly panel: 'open' | 'folded';
  /** Whether a turn of one view turns the other: not, by the same angle, or to the places that the map gives. */
  readonly link: 'free' | 'linked' | 'map';
  /** By side; `null` as at the start. */
  readonly cameras: readonly [Camera | null, Camera | null];
  readonly style: Style;
  /** The id of the pair that keys act on and that, where it is half, the next click completes. */
  readonly selected: number | null;
  /** The id of the pair under the mouse, in a list or a view. */
  readonly hovered: number | null;
}

/** A finding with the ids of its pairs, which the core tells by their order. */
export interface Doubt extends Finding {
  readonly ids: readonly number[];
}

export interface Result {
  readonly output: RunOutput;
  readonly report: Report;
  /** What it was made from. */
  readonly inputs: Work;
  /** The map file that it was opened from; `null` where it was made here. */
  readonly opened: { readonly name: string; readonly isMirrored: boolean } | null;
}

/** What a second program says of a map. */
export interface MapProof {
  /** The map that it is about. */
  readonly of: Result;
  /** `null` while it is at work. */
  readonly answer: ProofReport | null;
}

/** What is kept of a map that another one has taken the place of, to compare both. */
export interface EarlierMap {
  /** What it was made from. */
  readonly name: string;
  readonly report: Report;
  readonly pieces: Pieces;
}

/** Another map of the same meshes and landmarks. */
export interface ComparedMap {
  readonly output: OtherOutput;
  readonly report: Report;
}

/** A map beside another one. */
export interface Comparison {
  /** The map on the page. */
  readonly of: Result;
  /** The other one. */
  readonly which: OtherMap;
  readonly progress:
    | { readonly kind: 'computing'; readonly share: number }
    | { readonly kind: 'there'; readonly map: ComparedMap }
    /** There is none, for this reason. */
    | { readonly kind: 'failed'; readonly sentence: string };
}

/** Both flows of a map to its flat metrics. */
export interface Flattening {
  readonly of: Result;
  readonly progress:
    | { readonly kind: 'computing'; readonly share: number }
    | { readonly kind: 'there'; readonly flows: Flows }
    /** There are none, for this reason. */
    | { readonly kind: 'failed'; readonly sentence: string };
}

/** The pieces of a map, triangles that it takes to triangles. */
export interface Pieces {
  /** Three corners each. */
  readonly triangles: Uint32Array;
  /** The corners' places on the source and on the target, three numbers each. */
  readonly places: readonly [Float32Array, Float32Array];
  /** Whether they cover both meshes, so that measures of them are those of the map. */
  readonly areWhole: boolean;
}

/** A place that the map proposes for the point that a half pair lacks. */
export interface Proposal {
  /** The pair's id, and the point that it has. */
  readonly id: number;
  readonly of: SurfacePoint;
  /** The image of that point, on this side. */
  readonly side: Side;
  readonly point: SurfacePoint;
}

/** A sentence that goes by itself. */
export interface Toast {
  readonly sentence: string;
  /** Whether the last step can be taken back from it. */
  readonly undo: boolean;
}

/** Work of an earlier visit. */
export interface Offer {
  /** The session that is offered. */
  readonly session: string;
  readonly names: readonly [string | null, string | null];
  readonly pairs: number;
  /** When it was last changed, in ms since 1970. */
  readonly saved: number;
}

export interface State extends Work {
  readonly ready: boolean;
  readonly demos: readonly Demo[];
  readonly history: History;
  /** The id of the next pair. */
  readonly nextId: number;
  /** Suggested landmarks by side. */
  readonly suggestions: readonly [readonly Suggestion[], readonly Suggestion[]];
  /** Whether points come in pairs of left and right, and by which planes. */
  readonly leftRight: LeftRight;
  /** The last place that the map proposed; `proposed` tells whether it still is about what is on the page. */
  readonly proposal: Proposal | null;
  readonly ui: Ui;
  readonly job: Job;
  /** The last map. It stays when its inputs change, and is current again when they come back. */
  readonly result: Result | null;
  /** The proof of a map, which may be another one than that. */
  readonly proof: MapProof | null;
  /** The map before it, of this visit. */
  readonly earlier: EarlierMap | null;
  /** Another map beside the last one, while both are compared. */
  readonly comparison: Comparison | null;
  /** The flows of the last map, once a heat map has asked for them. */
  readonly flattening: Flattening | null;
  /** The picture that lies on the flat metric where that style is chosen; it stays in this visit. */
  readonly texturePicture: TexturePicture | null;
  /** The doubts of the last run, and what it was about. */
  readonly found: { readonly doubts: readonly Doubt[]; readonly inputs: Work } | null;
  /** Those doubts while they are about what is on the page; else none. */
  readonly findings: readonly Doubt[];
  /** Landmarks that the program looks for or has found. */
  readonly matching: Matching | null;
  readonly toast: Toast | null;
  /** What the link that was opened waits for. */
  readonly receiving: Receiving;
  /** A map file that waits for its meshes. */
  readonly awaited: AwaitedMap | null;
  /** Meshes that were refused and not left out. */
  readonly refused: Refused | null;
  /** By side what was wrong with the mesh before it was repaired, while it is shown. */
  readonly examined: readonly [Examined | null, Examined | null];
  /** Whether a newer build of the page waits for a reload. */
  readonly isOutdated: boolean;
  /** Why the views cannot be drawn; `null` where they can. */
  readonly undrawn: string | null;
  readonly offer: Offer | null;
  readonly error: string | null;
  /** The last failure that nobody foresaw; `toldBreakdown` says whether the error is of it. */
  readonly breakdown: Breakdown | null;
}

export const INITIAL: State = {
  ...NO_WORK,
  ready: false,
  demos: [],
  history: NO_HISTORY,
  nextId: 1,
  suggestions: [[], []],
  leftRight: NO_LEFT_RIGHT,
  proposal: null,
  ui: {
    step: 'meshes',
    theme: 'system',
    panel: 'open',
    link: 'linked',
    cameras: [null, null],
    style: {
      surface: 'shaded',
      texture: { cells: 36, turn: 0, x: 0, y: 0 },
      patchLines: false,
      cones: false,
      markers: true,
      textureBoundary: false,
      morph: 0,
      wipe: null,
    },
    selected: null,
    hovered: null,
  },
  job: { kind: 'idle' },
  result: null,
  proof: null,
  earlier: null,
  comparison: null,
  flattening: null,
  texturePicture: null,
  found: null,
  findings: [],
  matching: null,
  toast: null,
  receiving: { kind: 'nothing' },
  awaited: null,
  refused: null,
  examined: [null, null],
  isOutdated: false,
  undrawn: null,
  offer: null,
  error: null,
  breakdown: null,
};
