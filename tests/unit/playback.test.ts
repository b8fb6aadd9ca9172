/** The way to the target's shape and back: its times, and how often the views are told. */
import { expect, test, vi } from 'vitest';
import { play, shareAt, timeOf } from '../../www/panels/playback.ts';

const FRAME = 1000 / 60;

/** A screen that shows a frame when it is told to; `asked` is the number of frames that are requested. */
function screen(): { show: (now: number) => void; asked: () => number } {
  let next = 1;
  const callbacks = new Map<number, FrameRequestCallback>();
  vi.stubGlobal('requestAnimationFrame', (callback: FrameRequestCallback) => {
    callbacks.set(next, callback);
    return next++;
  });
  vi.stubGlobal('cancelAnimationFrame', (id: number) => {
    callbacks.delete(id);
  });
  return {
    show: (now) => {
      const due = [...callbacks.values()];
      callbacks.clear();
      due.forEach((callback) => {
        callback(now);
      });
    },
    asked: () => callbacks.size,
  };
}

/** All calls of the listener from a share on, until the playback ends. */
function played(from: number): { shares: number[]; ended: number; frames: number } {
  const frames = screen();
  const shares: number[] = [];
  let [ended, count] = [0, 0];
  play(from, {
    moved: (share) => {
      shares.push(share);
    },
    ended: () => {
      ended += 1;
    },
  });
  while (frames.asked() > 0 && count < 10_000) {
    frames.show(5000 + FRAME * count);
    count += 1;
  }
  return { shares, ended, frames: count };
}

test('it goes there and back without a jump, and ends', () => {
  const { shares, ended, frames } = played(0);
  expect(ended).toBe(1);
  const top = shares.indexOf(1);
  expect(top).toBeGreaterThan(30);
  const [up, down] = [shares.slice(0, top + 1), shares.slice(top)];
  expect(up).toEqual([...up].sort((a, b) => a - b));
  expect(down).toEqual([...down].sort((a, b) => b - a));
  expect(Math.max(...shares.map((share, index) => Math.abs(share - (shares[index - 1] ?? 0))))).toBeLessThan(0.03);
  // While the target's shape rests the listener is not called, so that no frame is drawn.
  expect(shares.filter((share, index) => share === shares[index - 1])).toEqual([]);
  expect(shares.length).toBeLessThan(frames - 20);
});

test('it goes on from where the slider is', () => {
  for (const from of [0, 0.01, 0.4, 0.99]) {
    expect(shareAt(timeOf(from))).toBeCloseTo(from, 9);
    const { shares, ended } = played(from);
    expect(shares[0] ?? 0).toBeGreaterThan(from - 1e-9);
    expect(shares).toContain(1);
    expect(ended).toBe(1);
  }
  // A playback that begins at the target's shape goes back at once.
  const back = played(1);
  expect(Math.max(...back.shares)).toBeLessThan(1);
  expect(back.ended).toBe(1);
});

test('it is ended before its time', () => {
  const frames = screen();
  const heard = vi.fn();
  const end = play(0, { moved: heard, ended: heard });
  frames.show(100);
  frames.show(116);
  expect(heard).toHaveBeenCalledOnce();
  end();
  expect(frames.asked()).toBe(0);
});
