/** The panel beside the views: the open step with its main action. */
import type { ComponentType, VNode } from 'preact';
import type { PartProps } from './actions.ts';
import { lateModule } from '../late-module.ts';
import { IconButton } from './controls.tsx';
import { LandmarksPanel } from './landmarks.tsx';
import { Late } from './late.tsx';
import { MainAction } from './main-action.tsx';
import { MapPanel } from './map.tsx';
import { MeshesPanel } from './meshes.tsx';
import { STEP_NAMES } from './rail.tsx';
import type { Step } from './steps.ts';
import { UsePanel } from './use.tsx';

const loadMethod = lateModule(() => import('./method.tsx'));

/** The step Method, which is loaded late, since it is of no use before there is a map. */
function MethodPanel(props: PartProps): VNode {
  return (
    <div class="content">
      <Late isWanted load={loadMethod} given={props} />
    </div>
  );
}

const CONTENTS: Readonly<Record<Step, ComponentType<PartProps>>> = {
  meshes: MeshesPanel,
  landmarks: LandmarksPanel,
  map: MapPanel,
  use: UsePanel,
  method: MethodPanel,
};

/** The panel with the open step. */
export function Panel(props: PartProps): VNode {
  const { state, actions } = props;
  const { step, panel } = state.ui;
  const Content = CONTENTS[step];
  const folded = panel === 'folded';
  const count = step === 'landmarks' && state.pairs.length > 0 ? state.pairs.length : null;
  return (
    <aside id="panel" aria-label={STEP_NAMES[step]}>
      <div class="head">
        <h2 id="panel-title" tabIndex={-1}>
          <span>
            {STEP_NAMES[step]} {count !== null && <span class="count quiet">{count}</span>}
          </span>
          <span class="sheet-only">
            <IconButton
              icon={folded ? 'up' : 'down'}
              label={folded ? 'Show the panel' : 'Fold the panel away'}
              onClick={() => {
                actions.dispatch({ kind: 'ui', ui: { panel: folded ? 'open' : 'folded' } });
              }}
            />
          </span>
        </h2>
        <MainAction {...props} />
      </div>
      <Content key={step} {...props} />
    </aside>
  );
}
