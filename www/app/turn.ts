/** Turns the views to what the user asks to see. */
import type { Side } from '../landmarks.ts';
import { isWhole } from '../landmarks.ts';
import type { CameraCommand } from '../panels/actions.ts';
import type { Store } from '../store/store.ts';
import type { Views } from '../viewer/viewer.ts';

/** Shows the source in its own shape, where its places are. */
export function showOwnShape(store: Store): void {
  store.dispatch({ kind: 'style', style: { morph: 0 } });
}

/** Opens the list of landmarks, in which the selected pair is shown, and turns both views to the pair. */
export function showPair(store: Store, views: Views, id: number): void {
  store.dispatch({ kind: 'ui', ui: { step: 'landmarks', panel: 'open' } }, { kind: 'style', style: { morph: 0 } });
  views.lookAtPair(id);
}

/**
 * Shows the target as the source is seen whenever the program has found landmarks of meshes that had no pair: the file of one may stand its
 * body upright and the file of the other lay it down.
 */
export function seeFoundAlike(store: Store, views: Pick<Views, 'lookAsOther'>): void {
  store.subscribe((state, previous) => {
    const isFound = state.matching?.kind === 'found' && previous.matching?.kind === 'searching';
    if (isFound && !previous.pairs.some(isWhole)) {
      // Only after the store has told all listeners of the pairs.
      queueMicrotask(() => {
        views.lookAsOther(1);
      });
    }
  });
}

export function turn(views: Views, side: Side, command: CameraCommand): void {
  switch (command.kind) {
    case 'fit':
      views.fit(side);
      break;
    case 'reset':
      views.reset(side);
      break;
    case 'look':
      views.lookFrom(side, command.from);
      break;
    case 'as-other':
      views.lookAsOther(side);
      break;
    case 'roll':
      views.roll(side, command.degrees);
      break;
  }
}
