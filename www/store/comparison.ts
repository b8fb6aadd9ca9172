/** What stays of a map when another one takes its place. */
import { wholePairs } from './order.ts';
import type { EarlierMap, Pieces, Result } from './state.ts';
import { workName } from './work.ts';

/** The pieces of a map. They share the memory of the result, without its normals, lines and files. */
export function piecesOf({ output }: Result): Pieces {
  const [source, target] = output.sides;
  return { triangles: output.triangles, places: [source.positions, target.positions], areWhole: output.distortion.length > 0 };
}

/** What a map is called among several: its meshes and the number of its pairs. */
export function resultName({ inputs }: Pick<Result, 'inputs'>): string {
  return `${workName(inputs.meshes.map((file) => file?.name ?? null))}, ${wholePairs(inputs).length} pairs`;
}

/** What is kept of a map. */
export function earlierOf(result: Result): EarlierMap {
  return { name: resultName(result), report: result.report, pieces: piecesOf(result) };
}
