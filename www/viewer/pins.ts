/** The pins of landmarks: which one is under the pointer, and how pins are taken, dragged and nudged. */
import type { Pair, Side, SurfacePoint } from '../landmarks.ts';
import { twinOf } from '../store/across.ts';
import type { Event } from '../store/events.ts';
import { wholePairs } from '../store/order.ts';
import { ghostPairs } from '../store/preview.ts';
import { proposed } from '../store/proposal.ts';
import { hasItsCones, shownResult } from '../store/staleness.ts';
import type { Proposal, State } from '../store/state.ts';
import type { Viewer } from '../wasm/page.js';
import type { Place } from './gestures.ts';
import type { Label } from './labels.ts';

/** The longest time between nudges of one pin that make one step, in ms. */
const NUDGES_TOGETHER = 1000;

/** How far beside a pin a hovering pointer still finds it, in CSS pixels. */
const HOVER_SLACK = 2;

interface Drag {
  readonly side: Side;
  readonly pair: Pair;
  /** The point of the twin on this side when the drag began; `null` for none. */
  readonly twin: SurfacePoint | null;
  readonly gesture: number;
  /** The vector from the pointer to the point, in coordinates of the view. */
  readonly offset: Place;
  /** The place to which the pointer has moved since the last frame; `null` where it has not moved. */
  at: Place | null;
  /** Whether the store has been given another place of the point. */
  placed: boolean;
}

/**
 * The pairs' colours and cones, the proposed place, and the ghosts of a search, in the renderer's form: a JSON array of the pairs in their
 * order, then the ghosts.
 */
export function marksOf(state: State, side: Side): string {
  const { ui, pairs } = state;
  const cones = conesOf(state);
  const ghost = ghostOn(state, side);
  const marks = pairs.map(({ id, number, points }) => {
    if (id === ghost?.id) {
      return { point: ghost.point, colour: number - 1, stand: 'ghost', cone: null };
    }
    const point = points[side];
    const stand = id === ui.selected || id === ui.hovered ? 'raised' : 'plain';
    return point === null ? null : { point, colour: number - 1, stand, cone: cones.get(id) ?? null };
  });
  const ghosts = ghostPairs(state).map(({ number, points }) => ({ point: points[side], colour: number - 1, stand: 'ghost', cone: null }));
  return JSON.stringify([...marks, ...ghosts]);
}

/** The proposed place on a side; `null` for none. */
function ghostOn(state: State, side: Side): Proposal | null {
  const proposal = proposed(state);
  return proposal?.side === side ? proposal : null;
}

/** The curvatures of the last map's cones by pair id; empty where the pairs are no longer where the cones are. */
function conesOf(state: State): ReadonlyMap<number, number> {
  const result = shownResult(state);
  if (result === null || !hasItsCones(state)) {
    return new Map();
  }
  return new Map(wholePairs(result.inputs).map(({ id }, order) => [id, result.output.cones[order] ?? 0]));
}

/** The numbers of the pairs on a side, in the order of the pairs, then those of ghosts; ghosts and a proposed place have a question mark. */
export function labelsOf(state: State, side: Side): readonly Label[] {
  const { pairs, ui } = state;
  const ghost = ghostOn(state, side);
  const labels = pairs.map(({ id, number }) => ({
    text: id === ghost?.id ? `${number}?` : String(number),
    raised: id === ui.selected || id === ui.hovered,
  }));
  return [...labels, ...ghostPairs(state).map(({ number }) => ({ text: `${number}?`, raised: false }))];
}

/** Moves pins, and dispatches the resulting events. */
export class Pins {
  readonly #dispatch: (event: Event) => void;
  #drag: Drag | null = null;
  #gesture = 0;
  #nudged: { readonly id: number; readonly side: Side; readonly at: number } | null = null;

  constructor(dispatch: (event: Event) => void) {
    this.#dispatch = dispatch;
  }

  /** Whether a pin is being dragged. */
  get isDragging(): boolean {
    return this.#drag !== null;
  }

  /** The pair whose pin is under the pointer; `null` for none. */
  under(viewer: Viewer, state: State, side: Side, at: Place): Pair | null {
    const index = state.ui.style.markers ? viewer.pinAt(side, at.x, at.y, HOVER_SLACK) : undefined;
    return index === undefined ? null : (state.pairs[index] ?? null);
  }

  /** Takes the pin under the pointer; returns whether there is one. */
  take(viewer: Viewer, state: State, side: Side, at: Place, slack: number): boolean {
    const index = state.ui.style.markers ? viewer.pinAt(side, at.x, at.y, slack) : undefined;
    const pair = index === undefined ? undefined : state.pairs[index];
    const place = index === undefined ? undefined : viewer.pinPlace(side, index);
    if (pair === undefined || place === undefined) {
      return false;
    }
    this.#gesture += 1;
    const offset = { x: (place[0] ?? 0) - at.x, y: (place[1] ?? 0) - at.y };
    const twin = twinOf(state, pair.id)?.points[side] ?? null;
    this.#drag = { side, pair, twin, gesture: this.#gesture, offset, at: null, placed: false };
    return true;
  }

  /** Notes the place to which the pin is to follow the pointer in the next frame. */
  drag(at: Place): void {
    if (this.#drag !== null && !this.#drag.pair.locked) {
      this.#drag.at = at;
    }
  }

  /** Moves the dragged pin to the pointer; beside the body it stays where it is. */
  follow(viewer: Viewer): void {
    const drag = this.#drag;
    const at = drag?.at ?? null;
    if (drag === null || at === null) {
      return;
    }
    const { side, pair, gesture, offset } = drag;
    drag.at = null;
    const hit = viewer.pick(side, at.x + offset.x, at.y + offset.y);
    if (hit !== undefined) {
      drag.placed = true;
      this.#dispatch({ kind: 'point-moved', id: pair.id, side, point: JSON.parse(hit) as SurfacePoint, gesture });
    }
  }

  /** Releases the dragged pin; a click selects it, and a drag that is given up takes it back. */
  drop(outcome: 'moved' | 'clicked' | 'given up'): void {
    const drag = this.#drag;
    this.#drag = null;
    if (drag === null) {
      return;
    }
    const { side, pair, twin, gesture, placed } = drag;
    const point = pair.points[side];
    if (outcome === 'clicked') {
      this.#dispatch(point === null ? { kind: 'proposal-accepted' } : { kind: 'pair-selected', id: pair.id });
    } else if (outcome === 'given up' && point !== null) {
      this.#dispatch({ kind: 'point-moved', id: pair.id, side, point, gesture, across: { point: twin, distance: 0, pair: null } });
    } else if (outcome === 'given up' && placed) {
      this.#dispatch({ kind: 'undo' });
    }
  }

  /** Moves the selected pair's pin on a side by CSS pixels, y up; returns whether there is one. */
  nudge(viewer: Viewer, state: State, side: Side, dx: number, dy: number): boolean {
    const index = state.pairs.findIndex(({ id }) => id === state.ui.selected);
    const pair = state.pairs[index];
    if (pair === undefined || pair.points[side] === null) {
      return false;
    }
    const point = viewer.beside(side, index, dx, dy);
    if (point !== undefined) {
      const now = performance.now();
      const last = this.#nudged;
      if (last?.id !== pair.id || last.side !== side || now - last.at > NUDGES_TOGETHER) {
        this.#gesture += 1;
      }
      this.#nudged = { id: pair.id, side, at: now };
      this.#dispatch({ kind: 'point-moved', id: pair.id, side, point: JSON.parse(point) as SurfacePoint, gesture: this.#gesture });
    }
    return true;
  }
}
