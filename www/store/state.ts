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

/** The textures that can lie on the flat metric and that the map carries. */
export const TEXTURES = ['checkerboard', 'circles', 'ribbons', 'coordinates', 'picture'] as const satisfies readonly SurfaceStyle[];

/**
 * The heat maps of values at places of the map: the distortion, the distortion of angles, the factor of the area, and the distance to the
 * true image.
 */
export const MAP_HEATS = ['distortion', 'angles', 'areas', 'truth'] as const;

/**
 * The heat maps of values at the vertices of either mesh: the conformal factor of the flow, and the Gaussian curvature before the flow and
 * after it.
 */
export const FLOW_HEATS = ['factor', 'curvature', 'flat-curvature'] as const;

/**
 * The surfaces that the views draw beside textures and heat maps: plain clay; the colours of the mesh's file, which the map carries; a
 * pattern in space, which the map carries to the source; and colours by the place on the target.
 */
export type PlainSurface = Exclude<SurfaceStyle, Texture | 'rising' | 'diverging'>;

export type Texture = (typeof TEXTURES)[number];
export type MapHeat = (typeof MAP_HEATS)[number];
export type FlowHeat = (typeof FLOW_HEATS)[number];
export type HeatMap = MapHeat | FlowHeat;

/** How a texture lies on the flat metric. */
export interface TexturePlace {
  /** The number of cells per unit of texture coordinates. */
  readonly cells: number;
  /** The turn, counter-clockwise, in degrees. */
  readonly turn: number;
  /** The shifts, in cells. */
  readonly x: number;
  readonly y: number;
}

/** A picture of the user that lies on the flat metric: red, green, blue and opacity, row by row from the top. */
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
  /** Whether the lines are drawn where the carried texture is cut. */
  readonly textureBoundary: boolean;
  readonly cones: boolean;
  readonly markers: boolean;
  /** How far the source's shape has moved to the target's, as a share from 0 to 1; it is shown only where there is a map. */
  readonly morph: number;
  /** The share of the source's view, from the left, in which the source is drawn plain; `null` while the line is hidden. */
  readonly wipe: number | null;
}

/** A camera, as numbers that the views return and accept. */
export type Camera = readonly number[];

/** How the page is viewed. This is kept with the work, but changing it makes no step. */
export interface Ui {
  readonly step: 'meshes' | 'landmarks' | 'map' | 'use' | 'method';
  readonly theme: 'system' | 'light' | 'dark';
  readonly panel: 'open' | 'folded';
  /** Whether turning one view turns the other: not at all, by the same angle, or to the corresponding places of the map. */
  readonly link: 'free' | 'linked' | 'map';
  /** The camera of each side; `null` for its first position. */
  readonly cameras: readonly [Camera | null, Camera | null];
  readonly style: Style;
  /** The id of the selected pair: keys act on it and, where it is half, the next click completes it. `null` for none. */
  readonly selected: number | null;
  /** The id of the pair under the mouse, in a list or a view; `null` for none. */
  readonly hovered: number | null;
}

/** A finding with the ids of its pairs; the core gives only their places in the order. */
export interface Doubt extends Finding {
  readonly ids: readonly number[];
}

export interface Result {
  readonly output: RunOutput;
  readonly report: Report;
  /** The work that the map was made from. */
  readonly inputs: Work;
  /** The map file that the map was opened from; `null` where the page has made the map. */
  readonly opened: { readonly name: string; readonly isMirrored: boolean } | null;
}

/** The verdict of a second program on a map. */
export interface MapProof {
  /** The map that was judged. */
  readonly of: Result;
  /** The verdict; `null` while the program is at work. */
  readonly answer: ProofReport | null;
}

/** What is kept of a map that another one has replaced, to compare both. */
export interface EarlierMap {
  /** The name of what it was made from. */
  readonly name: string;
  readonly report: Report;
  readonly pieces: Pieces;
}

/** Another map of the same meshes and landmarks. */
export interface ComparedMap {
  readonly output: OtherOutput;
  readonly report: Report;
}

/** The comparison of the map on the page with another one. */
export interface Comparison {
  /** The map on the page. */
  readonly of: Result;
  /** The other one. */
  readonly which: OtherMap;
  readonly progress:
    | { readonly kind: 'computing'; readonly share: number }
    | { readonly kind: 'there'; readonly map: ComparedMap }
    /** The other map could not be made, for this reason. */
    | { readonly kind: 'failed'; readonly sentence: string };
}

/** Both flows of a map to its flat metrics. */
export interface Flattening {
  readonly of: Result;
  readonly progress:
    | { readonly kind: 'computing'; readonly share: number }
    | { readonly kind: 'there'; readonly flows: Flows }
    /** The flows could not be computed, for this reason. */
    | { readonly kind: 'failed'; readonly sentence: string };
}

/** The pieces of a map: triangles of the source that it takes to triangles of the target. */
export interface Pieces {
  /** The corners of the triangles, three each. */
  readonly triangles: Uint32Array;
  /** The places of the corners on the source and on the target, three numbers each. */
  readonly places: readonly [Float32Array, Float32Array];
  /** Whether the pieces cover both meshes, so that their measures are those of the map. */
  readonly areWhole: boolean;
}

/** A place that the map proposes for the missing point of a half pair. */
export interface Proposal {
  /** The id of the pair, and the point that it has. */
  readonly id: number;
  readonly of: SurfacePoint;
  /** The side of the proposed place, which is the image of that point. */
  readonly side: Side;
  readonly point: SurfacePoint;
}

/** A sentence that disappears by itself. */
export interface Toast {
  readonly sentence: string;
  /** Whether the toast has a button that undoes the last step. */
  readonly undo: boolean;
}

/** Work of an earlier visit, which can be continued. */
export interface Offer {
  /** The id of the session that is offered. */
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
  /** The suggested landmarks of each side. */
  readonly suggestions: readonly [readonly Suggestion[], readonly Suggestion[]];
  /** Whether points come in pairs of left and right, and across which planes. */
  readonly leftRight: LeftRight;
  /** The last place that the map has proposed; `proposed` says whether it still applies to what is on the page. */
  readonly proposal: Proposal | null;
  readonly ui: Ui;
  readonly job: Job;
  /** The last map. It stays when its inputs change, and is up to date again when they come back. */
  readonly result: Result | null;
  /** The meshes that were brought back without their map. */
  readonly mapless: Work['meshes'] | null;
  /** The proof of a map, which may be another one than the last. */
  readonly proof: MapProof | null;
  /** The map before the last one, of this visit. */
  readonly earlier: EarlierMap | null;
  /** Another map beside the last one, while the two are compared. */
  readonly comparison: Comparison | null;
  /** The flows of the last map, once a heat map has asked for them. */
  readonly flattening: Flattening | null;
  /** The user's picture for the flat metric; it stays for this visit. */
  readonly texturePicture: TexturePicture | null;
  /** The findings of the last run, and the work that they are about. */
  readonly found: { readonly doubts: readonly Doubt[]; readonly inputs: Work } | null;
  /** Those findings while they are about what is on the page; else empty. */
  readonly findings: readonly Doubt[];
  /** The search for landmarks, or its answer. */
  readonly matching: Matching | null;
  readonly toast: Toast | null;
  /** What the opened link waits for. */
  readonly receiving: Receiving;
  /** A map file that waits for its meshes. */
  readonly awaited: AwaitedMap | null;
  /** Refused meshes that the user has neither repaired nor left out. */
  readonly refused: Refused | null;
  /** What was wrong with each side's mesh before it was repaired, while that is shown. */
  readonly examined: readonly [Examined | null, Examined | null];
  /** Whether a newer build of the page waits for a reload. */
  readonly isOutdated: boolean;
  /** Why the views cannot be drawn; `null` where they can. */
  readonly undrawn: string | null;
  readonly offer: Offer | null;
  readonly error: string | null;
  /** The last breakdown; `toldBreakdown` says whether the shown error is about it. */
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
  mapless: null,
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
