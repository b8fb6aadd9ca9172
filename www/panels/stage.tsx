/** The stage: both views with everything that lies on them. */
import type { VNode } from 'preact';
import { integer } from '../numbers.ts';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { shownPreview } from '../store/preview.ts';
import type { MeshFile, State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { CompareBar, comparedCaptions } from './compare-view.tsx';
import { Divider } from './divider.tsx';
import { DropVeil } from './drop.tsx';
import { ErrorBanner } from './error.tsx';
import { DemoLine, Invitation } from './invitation.tsx';
import { MapBar } from './map-bar.tsx';
import { VIEW_IDS } from './names.ts';
import { Notices } from './notices.tsx';
import { Legend, PictureBar } from './picture-bar.tsx';
import { Toasts } from './toasts.tsx';
import { ViewBar } from './view-bar.tsx';
import { WipeLine } from './wipe.tsx';

/** A word about how a mesh was changed when it was read; the panel says more about repairs. */
function changed(file: MeshFile): string {
  if (file.repairs !== '') {
    return ', repaired';
  }
  return file.turnedFaces === 0 ? '' : `, ${integer(file.turnedFaces)} turned to look outwards`;
}

function Caption({ state, side }: { readonly state: State; readonly side: Side }): VNode {
  const compared = comparedCaptions(state);
  const shown: Side = compared === null ? side : 0;
  // Where the view does not show the finished map, the name of what it shows takes the place of the mesh's size.
  const mark = compared?.[side] ?? (side === 0 && shownPreview(state) !== null ? 'coarse map' : null);
  const file = state.meshes[shown];
  const refused = state.refused?.meshes.find((mesh) => mesh.side === side);
  if (refused !== undefined) {
    return (
      <p class="caption">
        <span class="clipped">
          {side === 0 ? 'Source' : 'Target'} <strong>{refused.file.name}</strong>
        </span>{' '}
        <span class="not-accepted">not accepted</span> <span class="facts">{integer(refused.examined.faceCount)} triangles</span>
      </p>
    );
  }
  return (
    <p class="caption">
      {file !== null && (
        <>
          <span class="clipped">
            {shown === 0 ? 'Source' : 'Target'} <strong>{file.name}</strong>
          </span>{' '}
          {mark === null ? (
            <span class="facts">
              {integer(file.faceCount)} triangles{changed(file)}
            </span>
          ) : (
            <span class="coarse-map">{mark}</span>
          )}
        </>
      )}
    </p>
  );
}

/** The side whose view has the bar that is about both: the target's, unless the source is shown alone. */
function pictureSide(split: number): Side {
  return split === 1 ? 0 : 1;
}

function Pane({ side, ...props }: { readonly side: Side } & PartProps): VNode {
  const share = side === 0 ? props.shell.state.split : 1 - props.shell.state.split;
  const isCompared = comparedCaptions(props.state) !== null;
  return (
    <div class={share === 0 ? 'pane shut' : 'pane'}>
      {/* The viewer puts its numbers and rings into this element, before the caption. */}
      <div id={VIEW_IDS[side]} class="view">
        <Caption state={props.state} side={side} />
      </div>
      <Invitation state={props.state} side={side} />
      {side === 0 && !isCompared && <WipeLine {...props} />}
      <div class="bars">
        {side === 1 && isCompared ? <CompareBar {...props} /> : <ViewBar {...props} side={side} />}
        {side === 0 && !isCompared && <MapBar {...props} />}
        {side === pictureSide(props.shell.state.split) && (
          <>
            <PictureBar {...props} />
            <Legend {...props} />
          </>
        )}
      </div>
    </div>
  );
}

/** The stage. */
export function Stage(props: PartProps): VNode {
  const { state, actions, shell } = props;
  return (
    <main id="stage" aria-label="Meshes" style={{ '--split': String(shell.state.split) }}>
      <canvas id="canvas" aria-hidden="true" />
      {SIDES.map((side) => (
        <Pane key={side} {...props} side={side} />
      ))}
      <Divider shell={shell} />
      <DemoLine state={state} actions={actions} />
      <Toasts state={state} actions={actions} />
      <Notices state={state} actions={actions} />
      <ErrorBanner state={state} actions={actions} />
      <DropVeil actions={actions} />
    </main>
  );
}
