/** The first step, Meshes: two files, or a demo. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import { meshFormats } from '../wasm/page.js';
import type { RefusedMesh } from '../store/refused.ts';
import type { PartProps } from './actions.ts';
import { DefectList } from './defects.tsx';
import { Gallery } from './gallery.tsx';
import { Icon } from './icons.tsx';
import { choose } from './inputs.tsx';

const BLOCKS = [
  { title: 'Source', chooser: 'source-file', about: 'is carried onto the target' },
  { title: 'Target', chooser: 'target-file', about: 'the source is mapped onto' },
] as const;

/** A refused mesh, and what is wrong with it. */
function RefusedBlock({ mesh, actions }: { readonly mesh: RefusedMesh } & Pick<PartProps, 'actions'>): VNode {
  const { side, file, examined } = mesh;
  return (
    <div class="refused-mesh">
      <p class="mesh-name">{file.name}</p>
      <p class="quiet">{integer(examined.faceCount)} triangles, not accepted. The view shows it as it is in the file:</p>
      <DefectList side={side} examined={examined} actions={actions} />
    </div>
  );
}

/** The repairs that were made to a mesh and, on demand, where they are. */
function Repairs({ state, actions, side }: { readonly side: Side } & Pick<PartProps, 'state' | 'actions'>): VNode {
  const examined = state.examined[side];
  const { job } = state;
  return (
    <>
      <p class="quiet repairs">Repaired: {state.meshes[side]?.repairs}.</p>
      <button
        type="button"
        class="show-repairs"
        aria-pressed={examined !== null}
        disabled={job.kind === 'busy' || job.kind === 'running'}
        onClick={() => {
          actions.showRepairs(side, examined === null ? 'shown' : 'hidden');
        }}
      >
        {examined === null ? 'Show where' : 'Hide the repairs'}
      </button>
      {examined !== null && <DefectList side={side} examined={examined} actions={actions} />}
    </>
  );
}

function MeshBlock({ state, actions, side }: { readonly side: Side } & Pick<PartProps, 'state' | 'actions'>): VNode {
  const file = state.meshes[side];
  const refused = state.refused?.meshes.find((mesh) => mesh.side === side);
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
      {refused !== undefined && <RefusedBlock mesh={refused} actions={actions} />}
      {refused !== undefined ? null : file === null ? (
        <p class="quiet">The mesh that {about}.</p>
      ) : (
        <>
          <p class="mesh-name">{file.name}</p>
          <p class="quiet">
            {integer(file.vertexCount)} vertices, {integer(file.faceCount)} triangles
            {file.repairs === '' && file.turnedFaces > 0 && `, ${integer(file.turnedFaces)} of them turned to look outwards`}
          </p>
          {file.repairs !== '' && <Repairs state={state} actions={actions} side={side} />}
        </>
      )}
    </section>
  );
}

/** The content of the panel. */
export function MeshesPanel({ state, actions }: PartProps): VNode {
  const running = state.job.kind === 'running';
  return (
    <div class="content">
      {SIDES.map((side) => (
        <MeshBlock key={side} state={state} actions={actions} side={side} />
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
