/** Whether the shown result still belongs to the landmarks and options on the page. */
import type { RunOptions } from '../report.ts';
import type { State } from './state.ts';

function differ(a: RunOptions, b: RunOptions): boolean {
  return (Object.keys(a) as (keyof RunOptions)[]).some((key) => a[key] !== b[key]);
}

/** Whether the shown result was made from other landmarks or options than those on the page; labels do not matter. */
export function isStale(state: State): boolean {
  const { result, pairs, options } = state;
  return result !== null && (differ(result.options, options) || result.pairs.length !== pairs.length || !hasItsCones(state));
}

/** Whether cone k of the result still belongs to landmark k; more landmarks may have come after them. */
export function hasItsCones(state: State): boolean {
  return state.result?.pairs.every((pair, index) => pair.points === state.pairs[index]?.points) ?? false;
}
