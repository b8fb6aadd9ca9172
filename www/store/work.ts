/** The work: everything that the user made and that undo gives back. */
import type { Pair, Side } from '../landmarks.ts';
import { USUAL_OPTIONS } from '../options.ts';
import type { RunOptions } from '../report.ts';
import type { LoadedMesh, LookKind, UpAxis } from '../wasm/page.js';

/**
 * A mesh with the bytes it came from; the bytes go to the worker. One object for one opened file: two are the same mesh only
 * if they are the same object. What comes with a mesh later (repairs, textures) belongs here and goes where it goes.
 */
export interface MeshFile {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** Where a link to this mesh finds it; there is none for a file from a disk. */
  readonly address?: string;
  /** Of the core's memory; given back when neither the page nor its history holds the mesh. */
  readonly mesh: LoadedMesh;
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly turnedFaces: number;
  /** What came with it to be laid on it: a picture, or its materials with theirs; there is none where its own file holds all. */
  readonly picture?: Uint8Array;
  /** What its file says of its colours, with what came with it. */
  readonly look: LookKind;
  /** What was repaired, in a sentence without a full stop; empty where the mesh was good as given. */
  readonly repairs: string;
}

export interface Demo {
  readonly id: string;
  readonly title: string;
  readonly sentence: string;
}

/** The direction of a mesh's file that is up on the screen. */
export type Axis = UpAxis;

/** Whole works are kept by the history; those of neighbouring steps share what did not change. */
export interface Work {
  readonly meshes: readonly [MeshFile | null, MeshFile | null];
  /** How each mesh stands. It comes and goes with its mesh, and to turn one is no step. */
  readonly up: readonly [Axis, Axis];
  readonly demo: Demo | null;
  /** In the order of the landmark file; pairs that wait for a partner are among them. */
  readonly pairs: readonly Pair[];
  /** Names the landmark file gave to the meshes, without folders. */
  readonly named: readonly [string | null, string | null];
  readonly groundTruth: string | null;
  readonly options: RunOptions;
}

/** Nothing but the options. */
export const NO_WORK: Work = {
  meshes: [null, null],
  up: ['y', 'y'],
  demo: null,
  pairs: [],
  named: [null, null],
  groundTruth: null,
  options: USUAL_OPTIONS,
};

/** The work alone, of a state that has more. */
export function workOf({ meshes, up, demo, pairs, named, groundTruth, options }: Work): Work {
  return { meshes, up, demo, pairs, named, groundTruth, options };
}

/** Whether nothing that makes a step has changed. */
export function isSameWork(a: Work, b: Work): boolean {
  return (
    a.meshes === b.meshes &&
    a.demo === b.demo &&
    a.pairs === b.pairs &&
    a.named === b.named &&
    a.groundTruth === b.groundTruth &&
    a.options === b.options
  );
}

/** The side whose colours a map carries to the other one: the target's, where its file has some; `null` where neither has. */
export function giverOf({ meshes: [source, target] }: Pick<Work, 'meshes'>): Side | null {
  if (target?.look === 'colours') {
    return 1;
  }
  return source?.look === 'colours' ? 0 : null;
}

/** A mesh's name for the eye: without the ending of its file. */
export function shortName(name: string): string {
  return name.replace(/\.[^.]{1,8}$/, '');
}

/** What work is about, by its meshes' names: "cat and lion". */
export function workName(names: readonly (string | null)[]): string {
  const known = names.flatMap((name) => (name === null ? [] : [shortName(name)]));
  return known.length === 0 ? 'landmarks alone' : known.join(' and ');
}

/** The direction that is up in files of this name: STL comes from machines whose beds lie flat, the others from screens. */
export function upOf(name: string): Axis {
  return name.toLowerCase().endsWith('.stl') ? 'z' : 'y';
}
