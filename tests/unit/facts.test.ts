/** The numbers of a result, named in the words of the method. */
import { expect, test } from 'vitest';
import { coverageSentence } from '../../www/panels/facts.tsx';

test('coverage is never told larger than it is', () => {
  expect(coverageSentence({ source: 0.91237, target: 0.99999, hidden: 0.04382 })).toBe(
    '91.23 % of the source’s skin lies on skin, 99.99 % of the target’s is met by skin',
  );
  expect(coverageSentence({ source: 1, target: 0, hidden: 0.5 })).toBe(
    '100.00 % of the source’s skin lies on skin, 0.00 % of the target’s is met by skin',
  );
});
