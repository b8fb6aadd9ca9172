/** The keys of the history. */
import { expect, test } from 'vitest';
import { moveOf } from '../../www/app/keys.ts';

const NONE = { ctrlKey: false, metaKey: false, shiftKey: false, altKey: false };

test.each([
  ['undo', { ctrlKey: true, key: 'z' }],
  ['undo', { metaKey: true, key: 'z' }],
  ['redo', { ctrlKey: true, shiftKey: true, key: 'Z' }],
  ['redo', { metaKey: true, shiftKey: true, key: 'Z' }],
  ['redo', { ctrlKey: true, key: 'y' }],
  [null, { key: 'z' }],
  [null, { shiftKey: true, key: 'Z' }],
  [null, { ctrlKey: true, altKey: true, key: 'z' }],
  [null, { ctrlKey: true, key: 'x' }],
] as const)('%s for %o', (move, keys) => {
  expect(moveOf({ ...NONE, ...keys })).toBe(move);
});
