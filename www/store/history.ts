/** The history: the steps of the work, which can be undone and redone. */
import type { MeshFile, Work } from './work.ts';

/** A step with its name, and the work on its other side: the work before it where it is past, the work after it where it was undone. */
export interface Step {
  /** The name as a command, such as "Place pair 7". */
  readonly name: string;
  readonly work: Work;
}

export interface History {
  /** The past steps, the latest last. */
  readonly past: readonly Step[];
  /** The steps that were undone; the one to redo next is last. */
  readonly future: readonly Step[];
  /** The number of the drag that made the last step; further moves of that drag belong to the step. `null` where no drag made it. */
  readonly gesture: number | null;
}

export const NO_HISTORY: History = { past: [], future: [], gesture: null };

/** The most steps, more than anybody undoes; it limits the memory of a page that stays open for days. */
const MAX_STEPS = 200;
/** The most memory of the meshes of the past, in bytes: together with those of the page and a run it stays below the core's 4 GiB. */
const MAX_BYTES = 1e9;
/** The core's memory for a triangle of a checked mesh, in bytes: connectivity, positions, and the numbers of its file. */
const BYTES_PER_FACE = 150;

/** The memory of a mesh, in bytes. */
function sizeOf(file: MeshFile): number {
  return file.bytes.byteLength + BYTES_PER_FACE * file.faceCount;
}

/** The past without its oldest steps, where it is too long or its meshes, beside the present ones, are too large. */
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

/** The history after a step from `step.work` to the present work; the moves of one drag are one step. */
export function recorded(history: History, step: Step, present: Work, gesture: number | null): History {
  if (gesture !== null && gesture === history.gesture) {
    return history;
  }
  return { past: bounded([...history.past, step], present), future: [], gesture };
}

/** Undoes a step: the work before it and the history then; `null` where nothing can be undone. */
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

/** Redoes a step: the work after it and the history then; `null` where nothing can be redone. */
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
