/** The work: everything that the user has made and that undo brings back. */
import type { Pair, Side } from '../landmarks.ts';
import { USUAL_OPTIONS } from '../options.ts';
import type { RunOptions } from '../report.ts';
import type { LoadedMesh, LookKind, UpAxis } from '../wasm/page.js';

/**
 * A mesh with the bytes of its file, which are sent to workers. There is one object for each opened file: two meshes are the same only if
 * they are the same object. Fields that belong to a mesh (repairs, textures) are here, so that they go wherever the mesh goes.
 */
export interface MeshFile {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** The address at which a link finds this mesh; missing for a file from a disk. */
  readonly address?: string;
  /** The demo that has this mesh, from which a link builds it; missing for other files. */
  readonly ofDemo?: DemoMesh;
  /** The mesh in the core's memory; it is freed when neither the page nor its history holds the mesh. */
  readonly mesh: LoadedMesh;
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly turnedFaces: number;
  /** The picture or the materials, with their pictures, that came with the file; missing where the mesh's own file holds everything. */
  readonly picture?: Uint8Array;
  /** Which colours the file and its companions give. */
  readonly look: LookKind;
  /** A sentence about the repairs, without a full stop; empty where the mesh was good as given. */
  readonly repairs: string;
}

export interface Demo {
  readonly id: string;
  readonly title: string;
  readonly sentence: string;
}

/** The mesh that a demo has on a side. */
export interface DemoMesh {
  /** The id of the demo. */
  readonly id: string;
  readonly side: Side;
}

/** The direction in a mesh's file that points up on the screen. */
export type Axis = UpAxis;

/** The history keeps whole works; those of neighbouring steps share what did not change. */
export interface Work {
  readonly meshes: readonly [MeshFile | null, MeshFile | null];
  /** The axis of each mesh that points up. It comes and goes with its mesh, and changing it makes no step. */
  readonly up: readonly [Axis, Axis];
  readonly demo: Demo | null;
  /** The pairs in the order of the landmark file, half pairs among them. */
  readonly pairs: readonly Pair[];
  /** The names that the landmark file gave to the meshes, without folders. */
  readonly named: readonly [string | null, string | null];
  readonly groundTruth: string | null;
  readonly options: RunOptions;
}

/** Empty work, with the usual options. */
export const NO_WORK: Work = {
  meshes: [null, null],
  up: ['y', 'y'],
  demo: null,
  pairs: [],
  named: [null, null],
  groundTruth: null,
  options: USUAL_OPTIONS,
};

/** The work in a state, without the rest of the state. */
export function workOf({ meshes, up, demo, pairs, named, groundTruth, options }: Work): Work {
  return { meshes, up, demo, pairs, named, groundTruth, options };
}

/** Whether two works are equal in everything whose change makes a step. */
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

/** A mesh's name without the ending of its file. */
export function shortName(name: string): string {
  return name.replace(/\.[^.]{1,8}$/, '');
}

/** The name of a work, from the names of its meshes, such as "cat and lion". */
export function workName(names: readonly (string | null)[]): string {
  const known = names.flatMap((name) => (name === null ? [] : [shortName(name)]));
  return known.length === 0 ? 'landmarks alone' : known.join(' and ');
}

/** The direction that points up in files of this name: STL files come from machines whose beds lie flat, the others from screens. */
export function upOf(name: string): Axis {
  return name.toLowerCase().endsWith('.stl') ? 'z' : 'y';
}
