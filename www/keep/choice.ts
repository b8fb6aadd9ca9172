/** Which of the kept sessions is offered, and which ones go. */
import * as v from 'valibot';
import type { Reading, SessionRecord } from './record.ts';
import { readSession } from './record.ts';

/** Sessions that are kept beside those that tabs have open. */
const MOST_SESSIONS = 5;

/** What can be said of any record, of whatever version. */
const Outline = v.object({ id: v.string(), saved: v.fallback(v.number(), 0) });

/** What can be done with the sessions that no tab has open. */
export interface Choice {
  /** The latest one that nobody declined. */
  readonly latest: SessionRecord | null;
  /** Ids of all that could be offered, the latest first. */
  readonly offerable: readonly string[];
  /** Ids of those that cannot be read, and of all but the latest. */
  readonly obsolete: readonly string[];
  /** Whether some were kept by another version of the page, which are left as they are. */
  readonly hasOthers: boolean;
  /** Whether some cannot be read. */
  readonly hasBroken: boolean;
}

/** Looks through all records as they were kept; `open` are the ids of sessions that tabs have. */
export function choiceOf(all: readonly unknown[], open: ReadonlySet<string>): Choice {
  const closed = all
    .flatMap((value) => {
      const outline = v.safeParse(Outline, value);
      return outline.success ? [{ ...outline.output, value }] : [];
    })
    .filter(({ id }) => !open.has(id))
    .sort((a, b) => b.saved - a.saved);
  const sound: { readonly id: string; readonly reading: Reading }[] = [];
  let hasBroken = false;
  for (const { id, value } of closed) {
    // Older ones go unread.
    if (sound.length < MOST_SESSIONS) {
      const reading = readSession(value);
      if (reading.kind === 'broken') {
        hasBroken = true;
      } else {
        sound.push({ id, reading });
      }
    }
  }
  const kept = new Set(sound.map(({ id }) => id));
  const records = sound.flatMap(({ reading }) => (reading.kind === 'session' ? [reading.record] : []));
  const offerable = records.filter(({ declined }) => !declined);
  return {
    latest: offerable[0] ?? null,
    offerable: offerable.map(({ id }) => id),
    obsolete: closed.filter(({ id }) => !kept.has(id)).map(({ id }) => id),
    hasOthers: sound.some(({ reading }) => reading.kind === 'other-version'),
    hasBroken,
  };
}
