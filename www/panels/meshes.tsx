/** The first step: the two meshes, or a demo. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import { meshFormats } from '../wasm/conemap.js';
import type { PartProps } from './actions.ts';
import { Gallery } from './gallery.tsx';
import { Icon } from './icons.tsx';
import { choose } from './inputs.tsx';

const BLOCKS = [
  { title: 'Source', chooser: 'source-file', about: 'is carried onto the target' },
  { title: 'Target', chooser: 'target-file', about: 'is what the source is mapped onto' },
] as const;

function MeshBlock({ state, side }: { readonly side: Side } & Pick<PartProps, 'state'>): VNode {
  const file = state.meshes[side];
  const { title, chooser, about } = BLOCKS[side];
  const running = state.job.kind === 'running';
  return (
    <section>
      <div class="mesh-block">
        <h3>{title}</h3>
        <button
          type="button"
          disabled={!state.ready || running}
          aria-label={`${file === null ? 'Choose' : 'Replace'} the ${title.toLowerCase()} mesh…`}
          onClick={() => {
            choose(chooser);
          }}
        >
          {file === null ? 'Choose…' : 'Replace…'}
        </button>
      </div>
      {file === null ? (
        <p class="quiet">The mesh that {about}.</p>
      ) : (
        <>
          <p class="mesh-name">{file.name}</p>
          <p class="quiet">
            {integer(file.vertexCount)} vertices, {integer(file.faceCount)} triangles
            {file.repairs === '' && file.turnedFaces > 0 && `, ${integer(file.turnedFaces)} of them turned to look outwards`}
          </p>
          {file.repairs !== '' && <p class="quiet repairs">Repaired: {file.repairs}.</p>}
        </>
      )}
    </section>
  );
}

/** The panel's content. */
export function MeshesPanel({ state, actions }: PartProps): VNode {
  const running = state.job.kind === 'running';
  return (
    <div class="content">
      {SIDES.map((side) => (
        <MeshBlock key={side} state={state} side={side} />
      ))}
      <div class="row">
        <button
          type="button"
          title="Meshes, landmarks, a map or a project"
          disabled={!state.ready || running}
          onClick={() => {
            choose('mesh-files');
          }}
        >
          <Icon name="open" />
          Open files…
        </button>
        <button
          type="button"
          disabled={running || state.meshes.every((file) => file === null)}
          aria-label="Swap source and target"
          title="The source becomes the target, and the other way round"
          onClick={() => {
            actions.dispatch({ kind: 'swap-meshes' });
          }}
        >
          <Icon name="swap" />
          Swap
        </button>
      </div>
      <section>
        <h3>Demos</h3>
        <Gallery state={state} actions={actions} />
      </section>
      {state.ready && (
        <p class="quiet small">
          A mesh is a closed surface: {meshFormats()}. Its holes are capped, and handles are cut where you ask for it. Drop files
          anywhere, two meshes and a landmark file at once.
        </p>
      )}
    </div>
  );
}
