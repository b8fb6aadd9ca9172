/** Plays the way to the target's shape and back. */

/** The time from one shape to the other, in ms. */
const LEG = 1800;
/** How long the target's shape stays, in ms. */
const STAY = 600;

/** A share of the way that moves slowly at both ends, from the share of time, both from 0 to 1. */
function eased(leg: number): number {
  return (1 - Math.cos(Math.PI * leg)) / 2;
}

/** The share of the way at a time in ms; `null` once the source's shape is reached again. */
export function shareAt(time: number): number | null {
  if (time < LEG) {
    return eased(time / LEG);
  }
  const back = time - LEG - STAY;
  return back < LEG ? eased(1 - Math.max(0, back) / LEG) : null;
}

/** The time, in ms, at which a share of the way is first reached; for the share 1 the time at which the way back begins. */
export function timeOf(share: number): number {
  return share >= 1 ? LEG + STAY : (LEG * Math.acos(1 - 2 * Math.max(0, share))) / Math.PI;
}

/** The listener to a playback. */
export interface PlaybackListener {
  /** Called with the share of the way at which the shape is now; not called while the shape rests. */
  readonly moved: (share: number) => void;
  /** Called when the source's shape is reached again. */
  readonly ended: () => void;
}

/** Plays from a share of the way on, with one call of the listener in each frame; the returned function ends the playback. */
export function play(from: number, { moved, ended }: PlaybackListener): () => void {
  let begin: number | null = null;
  let last = from;
  const tick = (now: number): void => {
    begin ??= now - timeOf(from);
    const share = shareAt(now - begin);
    if (share === null) {
      ended();
      return;
    }
    frame = requestAnimationFrame(tick);
    if (share !== last) {
      last = share;
      moved(share);
    }
  };
  let frame = requestAnimationFrame(tick);
  return () => {
    cancelAnimationFrame(frame);
  };
}
