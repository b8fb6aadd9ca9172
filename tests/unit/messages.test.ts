/** Sentences about failures. */
import { expect, test } from 'vitest';
import { failureSentence, suggestionName } from '../../www/messages.ts';

test('options of the command line are left out', () => {
  const message = 'the mesh has 4 separate parts: keep the largest alone (--largest-component), or choose one in the file';
  expect(failureSentence({ code: 'mesh', message })).toBe(
    'The mesh has 4 separate parts: keep the largest alone, or choose one in the file.',
  );
});

test('a suggestion says of the one that looks alike whether both are taken', () => {
  const [a, b] = [{ point: 1, reason: 'tip', letter: 'A', partner: 'B' }, { point: 2, reason: 'tip', letter: 'B', partner: 'A' }] as const;
  expect(suggestionName(a, [a, b], 'together')).toBe('A, the end of a limb, looks like B: both are taken together');
  expect(suggestionName(a, [a, b], 'alone')).toBe('A, the end of a limb, looks like B: mind left and right');
  expect(suggestionName(a, [a], 'together')).toBe('A, the end of a limb');
});
