/** What is wrong with a mesh, or was before it was repaired, as the core found it. */
import type { Side } from '../landmarks.ts';
import type { Fill, MeshDefects, Sign, Stroke } from '../wasm/page.js';

/** All defects of one kind. */
export interface DefectGroup {
  readonly kind: string;
  /** "3 open rims". */
  readonly sentence: string;
  readonly count: number;
  /** So many are drawn, the first. */
  readonly drawn: number;
  /** Of the first ones, in words with a number of the file. */
  readonly labels: readonly string[];
  /** As style sheets write it. */
  readonly colour: string;
  /** How its lines, faces and places are drawn; `null` where it has none. */
  readonly stroke: Stroke | null;
  readonly fill: Fill | null;
  readonly sign: Sign | null;
}

/** A mesh that was looked at. */
export interface Examined {
  /** Of the core's memory; given back when no side shows it. */
  readonly found: MeshDefects;
  readonly groups: readonly DefectGroup[];
  readonly faceCount: number;
}

/** What a state knows of defects. */
interface Shown {
  readonly refused: { readonly meshes: readonly { readonly side: Side; readonly examined: Examined }[] } | null;
  readonly examined: readonly [Examined | null, Examined | null];
}

/** What a side shows of this: of the mesh that was refused, else of its own as it was repaired; `null` for nothing. */
export function shownDefects({ refused, examined }: Shown, side: Side): Examined | null {
  return refused?.meshes.find((mesh) => mesh.side === side)?.examined ?? examined[side];
}
