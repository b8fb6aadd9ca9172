/** Sentences about failures. */
import { expect, test } from 'vitest';
import { failureSentence } from '../../www/messages.ts';

test('options of the command line are left out', () => {
  const message = 'the mesh has 4 separate parts: keep the largest alone (--largest-component), or choose one in the file';
  expect(failureSentence({ code: 'mesh', message })).toBe(
    'The mesh has 4 separate parts: keep the largest alone, or choose one in the file.',
  );
});
