/** The flows that heat maps show: when they are computed, and that they are dropped with their map. */
import { expect, test } from 'vitest';
import type { Flows } from '../../www/compute/watch-messages.ts';
import { change } from '../../www/store/change.ts';
import type { Event } from '../../www/store/events.ts';
import { shownFlows, wantsFlows } from '../../www/store/flat.ts';
import type { Flattening, State } from '../../www/store/state.ts';
import { DONE, RESULT, RUNNING } from './fixtures.ts';

const LOOKING = change(DONE, [{ kind: 'style', style: { surface: 'curvature' } }]);
const told = (progress: Flattening['progress']): Event => ({ kind: 'flattening', flattening: { of: RESULT, progress } });
const COMPUTING = change(LOOKING, [told({ kind: 'computing', share: 0.3 })]);
const FLOWS = [] as unknown as Flows;

test('flows are wanted once, by whoever looks at a heat map of them while nothing runs', () => {
  expect(wantsFlows(DONE)).toBe(false);
  expect(wantsFlows(LOOKING)).toBe(true);
  expect(wantsFlows({ ...LOOKING, job: RUNNING })).toBe(false);
  expect(wantsFlows(COMPUTING)).toBe(false);
  expect(shownFlows(COMPUTING)).toBeNull();
  const there = change(COMPUTING, [told({ kind: 'there', flows: FLOWS })]);
  expect(shownFlows(there)).toBe(FLOWS);
  expect(wantsFlows(there)).toBe(false);
});

test('flows go with their map, and are wanted again where it comes back', () => {
  const without: State = change(COMPUTING, [{ kind: 'swap-meshes' }]);
  expect(without.flattening).toBeNull();
  expect(wantsFlows(without)).toBe(false);
  // A result that was still being computed is ignored.
  expect(change(without, [told({ kind: 'there', flows: FLOWS })]).flattening).toBeNull();
  const back = change(without, [{ kind: 'undo' }]);
  expect(back.flattening).toBeNull();
  expect(wantsFlows(back)).toBe(true);
});
