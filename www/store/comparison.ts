/** What is kept of a map when another one replaces it. */
import { wholePairs } from './order.ts';
import type { EarlierMap, Pieces, Result } from './state.ts';
import { workName } from './work.ts';

/** The pieces of a map. They share memory with the result, but do not keep its normals, lines and files. */
export function piecesOf({ output }: Result): Pieces {
  const [source, target] = output.sides;
  return { triangles: output.triangles, places: [source.positions, target.positions], areWhole: output.distortion.length > 0 };
}

/** The name of a map among several: its meshes and the number of its pairs. */
export function resultName({ inputs }: Pick<Result, 'inputs'>): string {
  return `${workName(inputs.meshes.map((file) => file?.name ?? null))}, ${wholePairs(inputs).length} pairs`;
}

/** The part of a map that is kept. */
export function earlierOf(result: Result): EarlierMap {
  return { name: resultName(result), report: result.report, pieces: piecesOf(result) };
}
