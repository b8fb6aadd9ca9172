/** Modules that did not load are requested again at another address. */
import { expect, test } from 'vitest';
import { lateModule, missingModule } from '../../www/late-module.ts';

const OWN = 'https://host.example/app/assets/index-2.js';
const GUIDE = 'https://host.example/app/assets/guide-1.js';

test('the address is read from what browsers say', () => {
  const read = (message: string): string | undefined => missingModule(new TypeError(message), OWN)?.href;
  expect(read(`Failed to fetch dynamically imported module: ${GUIDE}`)).toBe(GUIDE);
  expect(read(`error loading dynamically imported module: ${GUIDE}`)).toBe(GUIDE);
  expect(read('Importing a module script failed.')).toBeUndefined();
  expect(read('Failed to fetch dynamically imported module: https://other.example/app/assets/guide-1.js')).toBeUndefined();
  expect(missingModule(GUIDE, OWN)).toBeNull();
});

test('each further try has an address of its own, and what came is given', async () => {
  const asked: string[] = [];
  const load = lateModule(
    () => {
      asked.push('first');
      return Promise.reject<number>(new TypeError(`Failed to fetch dynamically imported module: ${GUIDE}`));
    },
    OWN,
    (address) => {
      asked.push(address);
      return asked.length === 3 ? Promise.resolve(7) : Promise.reject<number>(new TypeError('no network'));
    },
  );
  await expect(load()).rejects.toThrow('dynamically');
  await expect(load()).rejects.toThrow('no network');
  await expect(load()).resolves.toBe(7);
  expect(asked).toEqual(['first', `${GUIDE}?try=2`, `${GUIDE}?try=3`]);
});

test('where the address is not told the same is asked again', async () => {
  let tries = 0;
  const load = lateModule(() => {
    tries += 1;
    return tries === 1 ? Promise.reject<number>(new TypeError('Importing a module script failed.')) : Promise.resolve(tries);
  }, OWN);
  await expect(load()).rejects.toThrow('Importing');
  await expect(load()).resolves.toBe(2);
});
