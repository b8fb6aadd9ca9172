/** The defects of a mesh, or those that it had before it was repaired, as the core found them. */
import type { Side } from '../landmarks.ts';
import type { Fill, MeshDefects, Sign, Stroke } from '../wasm/page.js';

/** All defects of one kind. */
export interface DefectGroup {
  readonly kind: string;
  /** A sentence such as "3 open rims". */
  readonly sentence: string;
  readonly count: number;
  /** The number of defects that are drawn, the first ones of the kind. */
  readonly drawn: number;
  /** Descriptions of the first ones, with numbers of the file. */
  readonly labels: readonly string[];
  /** The colour, as style sheets write it. */
  readonly colour: string;
  /** The line, filling and sign with which the defects are drawn; `null` where the kind has none. */
  readonly stroke: Stroke | null;
  readonly fill: Fill | null;
  readonly sign: Sign | null;
}

/** The defects of a mesh that was examined. */
export interface Examined {
  /** The object in the core's memory; it is freed when no side shows it. */
  readonly found: MeshDefects;
  readonly groups: readonly DefectGroup[];
  readonly faceCount: number;
}

/** The part of the state with defects. */
interface Shown {
  readonly refused: { readonly meshes: readonly { readonly side: Side; readonly examined: Examined }[] } | null;
  readonly examined: readonly [Examined | null, Examined | null];
}

/** The defects that a side shows: those of the refused mesh, else those of its own mesh before the repair; `null` for none. */
export function shownDefects({ refused, examined }: Shown, side: Side): Examined | null {
  return refused?.meshes.find((mesh) => mesh.side === side)?.examined ?? examined[side];
}
