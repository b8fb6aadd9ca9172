/** The steps of the work, to go back and forth in. */
import type { MeshFile, Work } from './work.ts';

/** A step by name, with the work on its other side: before it where it is past, after it where it was taken back. */
export interface Step {
  /** As a command: "Place pair 7". */
  readonly name: string;
  readonly work: Work;
}

export interface History {
  /** The latest last. */
  readonly past: readonly Step[];
  /** Steps taken back, the one to make next last. */
  readonly future: readonly Step[];
  /** The drag that made the last step, which its next moves belong to. */
  readonly gesture: number | null;
}

export const NO_HISTORY: History = { past: [], future: [], gesture: null };

/** More steps than anybody takes back; it bounds the memory of a page that stays open for days. */
const MAX_STEPS = 200;
/** What the meshes of the past may take, in bytes: with those of the page and a run, less than the core's 4 GiB. */
const MAX_BYTES = 1e9;
/** The core's memory for a triangle of a checked mesh, in bytes: connectivity, places, and the numbers of its file. */
const BYTES_PER_FACE = 150;

/** What a mesh takes, in bytes. */
function sizeOf(file: MeshFile): number {
  return file.bytes.byteLength + BYTES_PER_FACE * file.faceCount;
}

/** The past without its oldest steps where it is too long or its meshes, beside those of the present, are too large. */
function bounded(past: readonly Step[], present: Work): readonly Step[] {
  const held = new Set<MeshFile | null>([null, ...present.meshes]);
  let bytes = 0;
  let first = past.length;
  while (first > 0 && past.length - first < MAX_STEPS) {
    for (const file of past[first - 1]?.work.meshes ?? []) {
      if (file !== null && !held.has(file)) {
        held.add(file);
        bytes += sizeOf(file);
      }
    }
    if (bytes > MAX_BYTES) {
      break;
    }
    first--;
  }
  return first === 0 ? past : past.slice(first);
}

/** The history after a step away from `before`; the moves of one drag are one step. */
export function recorded(history: History, step: Step, present: Work, gesture: number | null): History {
  if (gesture !== null && gesture === history.gesture) {
    return history;
  }
  return { past: bounded([...history.past, step], present), future: [], gesture };
}

/** One step back: the work before it and what is then the history; `null` at the first. */
export function undone(history: History, present: Work): { readonly work: Work; readonly history: History } | null {
  const step = history.past.at(-1);
  return step === undefined
    ? null
    : {
        work: step.work,
        history: {
          past: history.past.slice(0, -1),
          future: [...history.future, { name: step.name, work: present }],
          gesture: null,
        },
      };
}

/** One step that was taken back made again: the work after it and what is then the history; `null` at the last. */
export function redone(history: History, present: Work): { readonly work: Work; readonly history: History } | null {
  const step = history.future.at(-1);
  return step === undefined
    ? null
    : {
        work: step.work,
        history: {
          past: [...history.past, { name: step.name, work: present }],
          future: history.future.slice(0, -1),
          gesture: null,
        },
      };
}

/** All meshes that the page or its history holds. */
export function heldMeshes(history: History, present: Work): ReadonlySet<MeshFile> {
  const works = [present, ...history.past.map(({ work }) => work), ...history.future.map(({ work }) => work)];
  return new Set(works.flatMap(({ meshes }) => meshes).filter((file) => file !== null));
}
