/** Asks the core for the planes that mirror the meshes while left and right go together, and the views for the points across them. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import type { FileReader } from '../reading/reader.ts';
import { lastTwo, planeInUse, twinOf } from '../store/across.ts';
import type { Event } from '../store/events.ts';
import type { Across, PlaneAnswer, PlaneChoice } from '../store/left-right.ts';
import { holder } from '../store/pairs.ts';
import { proposed } from '../store/proposal.ts';
import type { State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { MeshFile } from '../store/work.ts';
import { errorOf } from './task.ts';

/** Finds the point that lies across the plane of a side; `null` where there is none. */
export type Mirror = (side: Side, point: SurfacePoint) => Across | null;

/** The question for the core, as JSON, that finds the chosen plane; `null` where the plane needs two pins that are not there. */
function wishOf(state: State, side: Side, choice: PlaneChoice): string | null {
  if (choice === 'found') {
    return JSON.stringify({ kind: 'found' });
  }
  if (choice !== 'pins') {
    return JSON.stringify({ kind: 'axis', axis: ['x', 'y', 'z'].indexOf(choice) });
  }
  const two = lastTwo(state, side);
  return two === null ? null : JSON.stringify({ kind: 'points', points: two.map(({ points }) => points[side]) });
}

/** The point that an event places, with its side; `null` where it places none. */
function placedBy(state: State, event: Event): { readonly side: Side; readonly point: SurfacePoint } | null {
  if (event.kind === 'proposal-accepted') {
    return proposed(state);
  }
  return event.kind === 'point-picked' || event.kind === 'point-moved' ? event : null;
}

/** Where left and right go together, the event with the mirror image of the point that it places; else the event itself. */
export function completed(state: State, event: Event, mirror: Mirror): Event {
  const placed = placedBy(state, event);
  const isAsked = placed !== null && planeInUse(state, placed.side) !== null && !('across' in event);
  return isAsked ? ({ ...event, across: mirror(placed.side, placed.point) } as Event) : event;
}

/** Pairs that are already there and mirror each other on a side, by their ids. */
function twinsOn(state: State, side: Side, mirror: Mirror): [number, number][] {
  const across = new Map<number, number | null>();
  for (const { id, points } of state.pairs) {
    const point = points[side];
    if (point !== null && twinOf(state, id) === null) {
      across.set(id, mirror(side, point)?.pair ?? null);
    }
  }
  return [...across].flatMap(([a, b]) => (b !== null && a < b && across.get(b) === a ? [[a, b] as [number, number]] : []));
}

/** The number of points on a side. */
function countOn({ pairs }: Pick<State, 'pairs'>, side: Side): number {
  return pairs.filter(({ points }) => points[side] !== null).length;
}

/** The pairs that now hold a suggested point of a side which has just been taken, by their ids. */
function justTaken(state: State, previous: State, side: Side): ReadonlySet<number> {
  const gone = previous.suggestions[side].filter((suggestion) => !state.suggestions[side].includes(suggestion));
  const takers = gone.flatMap(({ point }) => (holder(previous, side, point, null) === null ? (holder(state, side, point, null)?.id ?? []) : []));
  return new Set(state.meshes[side] === previous.meshes[side] ? takers : []);
}

/** Owns the planes that were found for the meshes, and brings the suggested places in line with them. */
export class Planes {
  readonly #store: Store;
  readonly #reader: FileReader;
  readonly #mirror: Mirror;
  readonly #found = new WeakMap<MeshFile, PlaneAnswer | null>();

  constructor(store: Store, reader: FileReader, mirror: Mirror) {
    this.#store = store;
    this.#reader = reader;
    this.#mirror = mirror;
    store.subscribe((state) => {
      for (const side of SIDES) {
        const file = state.meshes[side];
        if (state.leftRight.isOn && file !== null && state.leftRight.planes[side]?.of !== file) {
          // The question is asked only after the store has told all listeners of the present change.
          queueMicrotask(() => {
            this.#askOnce(side, file);
          });
        }
      }
    });
    store.subscribe((state, previous) => {
      for (const side of SIDES) {
        if (previous.suggestions[side].length > 0 && planeInUse(state, side) !== null && countOn(state, side) > countOn(previous, side)) {
          const taken = justTaken(state, previous, side);
          queueMicrotask(() => {
            if (taken.size > 0) {
              this.#findTwins(side, taken);
            }
            this.#removeTaken(side);
          });
        }
      }
    });
  }

  /** Chooses another plane for a side. */
  choose(side: Side, choice: PlaneChoice): void {
    const of = this.#store.state.meshes[side];
    const wish = wishOf(this.#store.state, side, choice);
    if (of === null || wish === null) {
      return;
    }
    const known = choice === 'found' ? this.#found.get(of) : undefined;
    this.#store.dispatch({ kind: 'plane', side, plane: { of, choice, answer: known === undefined ? 'awaited' : known } });
    if (known === undefined) {
      void this.#ask(side, of, choice, wish);
    } else {
      this.#findTwins(side);
    }
  }

  #askOnce(side: Side, file: MeshFile): void {
    const { leftRight, meshes } = this.#store.state;
    if (leftRight.isOn && meshes[side] === file && leftRight.planes[side]?.of !== file) {
      this.choose(side, 'found');
    }
  }

  async #ask(side: Side, of: MeshFile, choice: PlaneChoice, wish: string): Promise<void> {
    const { dispatch } = this.#store;
    let answer: PlaneAnswer | null = null;
    try {
      answer = JSON.parse(await this.#reader.ask({ kind: 'plane', mesh: of.mesh.packed(), wish }, null)) as PlaneAnswer | null;
      if (choice === 'found') {
        this.#found.set(of, answer);
      }
    } catch (thrown) {
      // No plane is stored after a failure, so that choosing the plane again asks for it again.
      dispatch(errorOf(thrown));
    }
    // The meshes may have changed sides since, or another plane may have been chosen.
    const at = SIDES.find((candidate) => this.#store.state.meshes[candidate] === of) ?? side;
    const waiting = this.#store.state.leftRight.planes[at];
    if (waiting?.of === of && waiting.choice === choice && waiting.answer === 'awaited') {
      dispatch({ kind: 'plane', side: at, plane: { of, choice, answer } });
      this.#findTwins(at);
    }
  }

  /** Removes the suggested places at which one of two pairs that go together has its point already. */
  #removeTaken(side: Side): void {
    const { state, dispatch } = this.#store;
    const suggestions = state.suggestions[side].filter(({ point }) => {
      const pair = planeInUse(state, side) === null ? null : (this.#mirror(side, point)?.pair ?? null);
      const there = pair === null ? null : twinOf(state, pair);
      return (there?.points[side] ?? null) === null;
    });
    if (suggestions.length < state.suggestions[side].length) {
      dispatch({ kind: 'suggested', side, suggestions });
    }
  }

  /**
   * Links pairs that were placed before as left and right, so that they go together from now on; where `among` is given, only those with one
   * of its pairs.
   */
  #findTwins(side: Side, among?: ReadonlySet<number>): void {
    const { state, dispatch } = this.#store;
    const all = planeInUse(state, side) === null ? [] : twinsOn(state, side, this.#mirror);
    const twins = among === undefined ? all : all.filter((pair) => pair.some((id) => among.has(id)));
    if (twins.length > 0) {
      dispatch({ kind: 'twins', twins });
    }
  }
}
