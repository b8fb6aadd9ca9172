/**
 * The notices that wait for the user's decision: about a link that was opened, a map and landmarks without their meshes, meshes that a
 * repair would help, and a newer build of the page.
 */
import type { VNode } from 'preact';
import { SIDES } from '../landmarks.ts';
import { missingOf } from '../map-files.ts';
import { filesNeeded, landmarksWait, loadQuestion, loadingSentence, mapWaits, repairCommand, SENTENCES } from '../messages.ts';
import type { AwaitedMap } from '../store/awaited.ts';
import { wholePairs } from '../store/order.ts';
import type { Receiving } from '../store/receiving.ts';
import type { RefusedMesh } from '../store/refused.ts';
import type { State } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';

interface ReceivingProps {
  readonly receiving: Receiving;
  readonly actions: Actions;
}

/** The notice about a link: its question, its error, or the files that it waits for; `null` where there is no link. */
function LinkNotice({ receiving, actions }: ReceivingProps): VNode | null {
  switch (receiving.kind) {
    case 'nothing':
      return null;
    case 'click':
      return (
        <div class="notice" id="link-notice">
          <p>{loadQuestion(receiving.hosts)}</p>
          <button type="button" class="main" onClick={actions.acceptLink}>
            Load
          </button>
          <button type="button" onClick={actions.cancelLink}>
            Don’t load
          </button>
        </div>
      );
    case 'fetch':
      return (
        <div class="notice" id="link-notice">
          <p>{loadingSentence(receiving)}</p>
          <progress
            aria-label="Loaded"
            max={1}
            {...(receiving.expected === null ? {} : { value: receiving.loaded / Math.max(1, receiving.expected) })}
          />
          <button type="button" onClick={actions.cancelLink}>
            Cancel
          </button>
        </div>
      );
    case 'files':
      return (
        <div class="notice" id="link-notice">
          <p>{filesNeeded(receiving.missing.map(({ name }) => name))}</p>
          <button type="button" onClick={actions.cancelLink}>
            Leave the link
          </button>
        </div>
      );
  }
}

/** The notice about a map file that waits for its meshes. */
function MapNotice({ state, map, actions }: { readonly state: State; readonly map: AwaitedMap; readonly actions: Actions }): VNode {
  const missing = missingOf(map, state.meshes).map((side) => ({ side, name: map.meshes[side].name }));
  return (
    <div class="notice" id="map-notice">
      <p>{mapWaits(map.name, missing)}</p>
      <button
        type="button"
        onClick={() => {
          actions.dispatch({ kind: 'map-awaited', map: null });
        }}
      >
        Leave the map
      </button>
    </div>
  );
}

/** The notice about landmark pairs that wait for their meshes; `null` where none do. */
function LandmarksNotice({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  const whole = wholePairs(state);
  const pairs = whole.length;
  // Locked pairs are never deleted, so that where there are no others the notice offers to unlock them.
  const areLocked = whole.every(({ locked }) => locked);
  const missing = SIDES.filter((side) => state.meshes[side] === null).map((side) => ({ side, name: state.named[side] }));
  return pairs === 0 || missing.length === 0 ? null : (
    <div class="notice" id="landmarks-notice">
      <p>{landmarksWait(pairs, missing)}</p>
      <button
        type="button"
        onClick={() => {
          if (areLocked) {
            actions.dispatch(...whole.map(({ id }) => ({ kind: 'pair-locked', id, locked: false }) as const));
          } else {
            actions.dispatch({ kind: 'pairs-cleared' });
          }
        }}
      >
        {areLocked ? 'Unlock' : 'Delete'} the landmarks
      </button>
    </div>
  );
}

/** The notice about a refused mesh, with the repair that would help, where there is one. */
function RefusedNotice({ mesh, state, actions }: { readonly mesh: RefusedMesh } & Pick<PartProps, 'state' | 'actions'>): VNode {
  const { kind } = state.job;
  return (
    <div class="notice refused" data-side={mesh.side}>
      <p>{mesh.sentence}</p>
      {mesh.offer !== null && (
        <button
          type="button"
          class="main"
          disabled={kind === 'running' || kind === 'busy'}
          onClick={() => {
            actions.repairMesh(mesh);
          }}
        >
          {repairCommand(mesh.offer)}
        </button>
      )}
      <button
        type="button"
        onClick={() => {
          actions.dispatch({ kind: 'refused-closed', side: mesh.side });
        }}
      >
        Leave it out
      </button>
    </div>
  );
}

/** The notices over the views. Their element always stays in the page, so that screen readers read out what appears in it. */
export function Notices({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div class="notices" role="status">
      <LinkNotice receiving={state.receiving} actions={actions} />
      {state.awaited !== null && <MapNotice state={state} map={state.awaited} actions={actions} />}
      <LandmarksNotice state={state} actions={actions} />
      {state.refused?.meshes.map((mesh) => (
        <RefusedNotice key={mesh.side} mesh={mesh} state={state} actions={actions} />
      ))}
      {state.undrawn !== null && (
        <div class="notice" id="undrawn">
          <p>{state.undrawn}</p>
        </div>
      )}
      {state.isOutdated && (
        <div class="notice" id="new-version">
          <p>{SENTENCES.newVersion}</p>
          <button type="button" onClick={actions.reload}>
            Reload
          </button>
        </div>
      )}
    </div>
  );
}
