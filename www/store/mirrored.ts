/** Changes of points that come in pairs of left and right: what is done to a point is done to its mirror image. */
import type { Pair, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import { isSamePoint, rounded } from '../landmarks.ts';
import { farPartner } from '../messages.ts';
import { planeInUse, twinOf, withTwins } from './across.ts';
import type { Across } from './left-right.ts';
import {
  holder,
  pairOf,
  replaced,
  selecting,
  withAllTaken,
  withLabel,
  withNewPairs,
  withPick,
  withPickDropped,
  withPoint,
  withPointMoved,
  withProposalAccepted,
  withSuggestions,
} from './pairs.ts';
import { otherName } from './side-names.ts';
import type { State } from './state.ts';
import { asked, missingSide } from './waiting.ts';

/**
 * The distance of a mirror image from the surface, in units of the mesh's size, from which on the page mentions it: about as far as the eye
 * can see.
 */
const FAR = 0.01;

/** The state with a sentence, where the mirror image was far off the surface. */
function telling(state: State, side: Side, { distance }: Across): State {
  return distance <= FAR ? state : { ...state, toast: { sentence: farPartner(side, distance), undo: true } };
}

/** After a pair was begun, begins the pair of its mirror image, or links it with the pair that is already there. */
function withPartnerBegun(state: State, begun: Pair, side: Side, across: Across): State {
  if (across.point === null) {
    return state;
  }
  const point = rounded(across.point);
  const there = holder(state, side, point, null)?.id ?? across.pair;
  if (there !== null) {
    return withTwins(state, begun.id, there);
  }
  const partner = state.nextId;
  const both = withNewPairs(state, [{ points: withPoint([null, null], side, point), label: '' }]);
  return telling(withTwins(both, begun.id, partner), side, across);
}

/**
 * Places the point of a pair's twin across the plane; it stays where the twin is locked, where there is no place, and where another pair
 * has the place.
 */
function withPartnerPlaced(state: State, twin: Pair, side: Side, across: Across): State {
  const point = across.point === null ? null : rounded(across.point);
  if (point === null || twin.locked || isSamePoint(twin.points[side], point) || holder(state, side, point, twin.id) !== null) {
    return state;
  }
  return { ...state, pairs: replaced(state.pairs, { ...twin, points: withPoint(twin.points, side, point) }) };
}

/** The pair that a point has made or changed; `null` where the point was refused. */
function touched(before: State, after: State): Pair | null {
  return after.pairs.find((pair) => !before.pairs.includes(pair)) ?? null;
}

/** Does to the twin of a pair what a point has done to the pair. */
function withPartnerOf(before: State, after: State, side: Side, across: Across): State {
  const pair = touched(before, after);
  if (pair === null) {
    return after;
  }
  if (pairOf(before, pair.id) === null) {
    return withPartnerBegun(after, pair, side, across);
  }
  const twin = twinOf(after, pair.id);
  if (twin?.points[side] !== null) {
    return after;
  }
  const both = withPartnerPlaced(after, twin, side, across);
  const next = both.pairs.find(({ points }) => points[side] === null);
  return both === after ? after : telling(selecting(both, next?.id ?? pair.id), side, across);
}

/** The suggestion that looks like the one at a point; `null` where the point is not suggested or no other looks like it. */
function likeSuggested({ suggestions }: State, side: Side, point: SurfacePoint): Suggestion | null {
  const letter = suggestions[side].find((suggestion) => suggestion.point === point)?.partner ?? null;
  return suggestions[side].find((suggestion) => suggestion.letter === letter) ?? null;
}

/** Picks a point of one side and its mirror image. A suggestion at the mirror image is taken with it. */
export function withMirroredPick(state: State, side: Side, point: SurfacePoint, across: Across | null): State {
  const after = withPick(state, side, point);
  if (across === null || after.pairs === state.pairs) {
    return after;
  }
  const both = withPartnerOf(state, after, side, across);
  const like = likeSuggested(state, side, point);
  const left = both.suggestions[side].filter((suggestion) => suggestion !== like);
  return like === null || both.pairs === after.pairs ? both : { ...both, suggestions: withSuggestions(both, side, left) };
}

/**
 * Takes all suggestions of a side as half pairs. Where left and right go together, those that look alike become each other's mirror image.
 */
export function withAllMirrored(state: State, side: Side): State {
  const after = withAllTaken(state, side);
  if (planeInUse(state, side) === null) {
    return after;
  }
  const idOf = (point: SurfacePoint): number | null => holder(after, side, point, null)?.id ?? null;
  const alike = state.suggestions[side].map(({ point }) => [idOf(point), idOf(likeSuggested(state, side, point)?.point ?? -1)] as const);
  return alike.reduce((present, [a, b]) => (a === null || b === null ? present : withTwins(present, a, b)), after);
}

/** Completes the half pair whose turn it is with the place that the map proposes, and its twin with the mirror image of that place. */
export function withMirroredProposal(state: State, across: Across | null): State {
  const side = state.proposal?.side;
  const after = withProposalAccepted(state);
  return across === null || side === undefined ? after : withPartnerOf(state, after, side, across);
}

/** Moves a point of a pair, and its twin with it. */
export function withMirroredMove(state: State, id: number, side: Side, point: SurfacePoint, across: Across | null): State {
  const after = withPointMoved(state, id, side, point);
  const twin = after.pairs === state.pairs || across === null ? null : twinOf(after, id);
  // The twin moves along if it has a point on this side, or if the pair's point on this side has just been placed.
  const goesAlong = twin !== null && (twin.points[side] !== null || pairOf(state, id)?.points[side] === null);
  return goesAlong && across !== null ? withPartnerPlaced(after, twin, side, across) : after;
}

/** Gives up the half pair whose turn it is, and its twin where that is half as well. */
export function withMirroredDrop(state: State): State {
  const turn = asked(state);
  const twin = turn === null || !state.leftRight.isOn ? null : twinOf(state, turn.pair.id);
  const goes = twin !== null && !twin.locked && missingSide(twin) === turn?.side;
  const alone = goes ? { ...state, pairs: state.pairs.filter((pair) => pair !== twin) } : state;
  return withPickDropped(alone);
}

/** Changes the label of a pair. The label of its twin follows where the label names a side and the user has not chosen another one. */
export function withMirroredLabel(state: State, id: number, label: string): State {
  const before = pairOf(state, id)?.label ?? '';
  const after = withLabel(state, id, label);
  const twin = state.leftRight.isOn ? twinOf(after, id) : null;
  const name = otherName(label);
  const follows = twin !== null && (twin.label === '' || twin.label === otherName(before));
  return follows && name !== null ? withLabel(after, twin.id, name) : after;
}
