import { expect, test } from 'vitest';
import { placement } from '../../www/panels/placement.ts';

const WINDOW = { width: 640, height: 400 };

function button(left: number, top: number): Pick<DOMRect, 'left' | 'right' | 'top' | 'bottom'> {
  return { left, right: left + 40, top, bottom: top + 32 };
}

test('a box that fits begins at its button’s edge', () => {
  expect(placement(button(300, 340), { width: 200, height: 100 }, WINDOW, 'up end')).toEqual({ left: 140, top: 236, maxHeight: 328 });
  expect(placement(button(300, 40), { width: 200, height: 100 }, WINDOW, 'down start')).toEqual({ left: 300, top: 76, maxHeight: 316 });
});

test('a box that is too high scrolls inside the window', () => {
  expect(placement(button(300, 340), { width: 200, height: 900 }, WINDOW, 'up end')).toMatchObject({ top: 8, maxHeight: 328 });
});

test('a box that fits only the other way opens there', () => {
  expect(placement(button(300, 60), { width: 200, height: 100 }, WINDOW, 'up end').top).toBe(96);
  expect(placement(button(300, 340), { width: 200, height: 100 }, WINDOW, 'down end').top).toBe(236);
});

test('a box never sticks out at the sides', () => {
  expect(placement(button(20, 340), { width: 320, height: 100 }, WINDOW, 'up end').left).toBe(8);
  expect(placement(button(580, 340), { width: 320, height: 100 }, WINDOW, 'up start').left).toBe(312);
});
