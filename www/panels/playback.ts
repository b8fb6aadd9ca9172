/** The way to the target's shape and back, played in time. */

/** From one shape to the other, in ms. */
const LEG = 1800;
/** How long the target's shape stays, in ms. */
const STAY = 600;

/** Slow at both ends: from 0 to 1 as its share of a leg goes from 0 to 1. */
function eased(leg: number): number {
  return (1 - Math.cos(Math.PI * leg)) / 2;
}

/** The share of the way at a time in ms; `null` once it is back. */
export function shareAt(time: number): number | null {
  if (time < LEG) {
    return eased(time / LEG);
  }
  const back = time - LEG - STAY;
  return back < LEG ? eased(1 - Math.max(0, back) / LEG) : null;
}

/** When a share of the way is first reached, in ms; at its end it is time to go back. */
export function timeOf(share: number): number {
  return share >= 1 ? LEG + STAY : (LEG * Math.acos(1 - 2 * Math.max(0, share))) / Math.PI;
}

/** Told while it plays. */
export interface PlaybackListener {
  /** The shape moves to this share of the way; not told while it stays. */
  readonly moved: (share: number) => void;
  /** It is back. */
  readonly ended: () => void;
}

/** Plays from a share of the way, a call a frame; returns what ends it before its time. */
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
