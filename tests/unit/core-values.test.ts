/** Values that the page repeats, because it needs them before the core is loaded, are those of the core. */
import { beforeAll, expect, test } from 'vitest';
import { LARGEST_FILE } from '../../www/app/open.ts';
import { Desk, SIZES } from '../../www/bring/desk.ts';
import { MAX_RADIUS, PAIRS_TO_TURN } from '../../www/landmarks.ts';
import { MAP_ENDING } from '../../www/map-files.ts';
import {
  MOST_LANDMARKS_WITH_OWN_CONES,
  MOST_POSE_LANDMARKS_WITH_OWN_CONES,
  USUAL_OPTIONS,
  USUAL_SCHEME,
} from '../../www/options.ts';
import { MAP_EXPORTS } from '../../www/panels/exports.ts';
import { MOST_PAIRS } from '../../www/send/schema.ts';
import { MIN_PAIRS } from '../../www/store/readiness.ts';
import { ALL_ALLOWED } from '../../www/store/refused.ts';
import { NO_WORK } from '../../www/store/work.ts';
import type { CoreValues } from '../../www/wasm/core.js';
import { coreValues } from '../../www/wasm/core.js';
import { startCoreModule } from './modules.ts';

let core: CoreValues;

beforeAll(() => {
  startCoreModule();
  core = JSON.parse(coreValues()) as CoreValues;
});

test('what is chosen of a run where nobody chooses, and where the program adds cones', () => {
  expect(USUAL_OPTIONS).toEqual(core.choices);
  expect(NO_WORK.options).toEqual(core.choices);
  expect(USUAL_SCHEME).toBe(core.scheme);
  expect(MOST_LANDMARKS_WITH_OWN_CONES).toBe(core.mostLandmarksWithOwnCones);
  expect(MOST_POSE_LANDMARKS_WITH_OWN_CONES).toBe(core.mostPoseLandmarksWithOwnCones);
});

test('how a mesh stands, what of it may be repaired, and how large its file may be', () => {
  expect(NO_WORK.up).toEqual([core.up, core.up]);
  expect({ ...ALL_ALLOWED, joinWithin: 0 }).toEqual(core.everyRepair);
  expect(LARGEST_FILE).toBe(core.largestFile);
});

test('how many landmarks there must be and may be, and how soft', () => {
  expect(MIN_PAIRS).toBe(core.leastLandmarks);
  expect(PAIRS_TO_TURN).toBe(core.leastToTurn);
  expect(MOST_PAIRS).toBe(core.mostPairs);
  expect(MAX_RADIUS).toBe(core.largestRadius);
});

test('how something is brought across', () => {
  const { choices } = new Desk({ core: () => null, shown: () => null, save: () => undefined }).state;
  expect([choices.from, choices.method, choices.size]).toEqual([core.giver, core.carrying, core.textureSize]);
  expect(SIZES.at(-1)).toBe(core.largestTextureSize);
  expect(SIZES).toContain(choices.size);
});

test('files of a map by their names', () => {
  const wanted = MAP_EXPORTS.map(({ made }) => made);
  expect(wanted.filter((name) => !core.outputs.includes(name))).toEqual([]);
  expect(core.outputs.filter((name) => name.endsWith(MAP_ENDING))).toHaveLength(1);
});
