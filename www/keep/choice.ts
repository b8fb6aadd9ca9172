/** Chooses which of the kept sessions is offered, and which ones are removed. */
import * as v from 'valibot';
import type { Reading, SessionRecord } from './record.ts';
import { readSession } from './record.ts';

/** The most sessions that are kept beside those that tabs have open. */
const MOST_SESSIONS = 5;

/** The fields that records of all versions have. */
const Outline = v.object({ id: v.string(), saved: v.fallback(v.number(), 0) });

/** The choice among the sessions that no tab has open. */
export interface Choice {
  /** The latest session that was not declined; `null` for none. */
  readonly latest: SessionRecord | null;
  /** Ids of all that could be offered, the latest first. */
  readonly offerable: readonly string[];
  /** Ids of the sessions that cannot be read, and of those beyond the latest few. */
  readonly obsolete: readonly string[];
  /** Whether some sessions were kept by another version of the page; these are left alone. */
  readonly hasOthers: boolean;
  /** Whether some cannot be read. */
  readonly hasBroken: boolean;
}

/** Chooses among all records as they were kept; `open` has the ids of the sessions that tabs have open. */
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
    // Sessions beyond these are not read.
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
