/** The letters of suggested places. */
import { expect, test } from 'vitest';
import { lettered } from '../../www/app/suggest.ts';

test('suggestions get letters in their order, and partners each other’s', () => {
  const found = lettered([
    { point: 40, reason: 'tip', partner: 2 },
    { point: 50, reason: 'far', partner: null },
    { point: 60, reason: 'tip', partner: 0 },
  ]);
  expect(found).toEqual([
    { point: 40, reason: 'tip', letter: 'A', partner: 'C' },
    { point: 50, reason: 'far', letter: 'B', partner: null },
    { point: 60, reason: 'tip', letter: 'C', partner: 'A' },
  ]);
});
