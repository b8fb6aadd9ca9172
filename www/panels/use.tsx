/** The fourth step, Use: what the map can be used for, and the files that can be saved. */
import type { VNode } from 'preact';
import { lateModule } from '../late-module.ts';
import { SENTENCES } from '../messages.ts';
import { shownResult } from '../store/staleness.ts';
import type { PartProps } from './actions.ts';
import { exportsOf } from './exports.ts';
import { Late } from './late.tsx';
import { SurfaceChoice } from './picture-bar.tsx';

const loadBring = lateModule(() => import('./bring.tsx'));

/** The content of the panel. */
export function UsePanel(props: PartProps): VNode {
  const { state, actions } = props;
  const files = exportsOf(state, actions);
  return (
    <div class="content">
      {shownResult(state) !== null && (
        <section>
          <h3>What the meshes show</h3>
          <SurfaceChoice state={state} actions={actions} group="carried" />
        </section>
      )}
      <section>
        <h3>Bring across</h3>
        <Late isWanted load={loadBring} given={props} />
      </section>
      <section>
        <h3>Take away</h3>
        {shownResult(state) === null && (
          <p class="quiet">
            {state.result === null
              ? 'The map’s files come here once it is made: the textured mesh, the images of all vertices, the report.'
              : SENTENCES.mapOfOthers}
          </p>
        )}
        <ul class="export-list" aria-label="Downloads">
          {files.map((file) => (
            <li key={file.title}>
              <div>
                <p>{file.title}</p>
                <p class="quiet small">{file.about}</p>
              </div>
              <button type="button" onClick={file.save} title={`Save: ${file.about}`}>
                {file.format}
              </button>
            </li>
          ))}
        </ul>
      </section>
    </div>
  );
}
