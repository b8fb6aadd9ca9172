/** The controls for left and right: whether points come in pairs of mirror images, and across which planes. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { planeSentence } from '../messages.ts';
import { lastTwo } from '../store/across.ts';
import type { MeshPlane, PlaneChoice } from '../store/left-right.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { Check, Select } from './controls.tsx';
import { meshName } from './names.ts';

type Props = Pick<PartProps, 'state' | 'actions'>;

function choicesOf(state: State, side: Side): Choice<PlaneChoice>[] {
  const numbers = lastTwo(state, side)?.map(({ number }) => number) ?? null;
  return [
    { value: 'found', text: 'Found by its shape' },
    { value: 'x', text: 'Across its x axis' },
    { value: 'y', text: 'Across its y axis' },
    { value: 'z', text: 'Across its z axis' },
    { value: 'pins', text: numbers === null ? 'Between two pins' : `Between pins ${numbers.join(' and ')}`, disabled: numbers === null },
  ];
}

/** A sentence about a mesh's plane. */
function told(name: string, { choice, answer }: MeshPlane): string {
  if (answer === 'awaited') {
    return `Looking how well the ${name} is mirrored…`;
  }
  return answer === null ? `The ${name} has no such plane.` : planeSentence(name, answer, choice !== 'found');
}

function Plane({ state, actions, side }: { readonly side: Side } & Props): VNode | null {
  const plane = state.leftRight.planes[side];
  if (plane?.of !== state.meshes[side]) {
    return null;
  }
  return (
    <div class="plane">
      <Select
        label={`${side === 0 ? 'Source' : 'Target'} plane`}
        value={plane.choice}
        choices={choicesOf(state, side)}
        disabled={plane.answer === 'awaited'}
        onChoice={(choice) => {
          actions.choosePlane(side, choice);
        }}
      />
      <p class="quiet small" role="status">
        {told(meshName(state, side), plane)}
      </p>
    </div>
  );
}

/** The switch, and the choice of the planes while it is on. */
export function LeftAndRight({ state, actions }: Props): VNode {
  const { isOn } = state.leftRight;
  return (
    <section class="left-right" aria-label="Left and right">
      <div title="A point that you place gets its mirror image as a pair of its own; both move together">
        <Check
          name="left-right"
          text="Left and right together"
          checked={isOn}
          disabled={!state.ready}
          onChange={(checked) => {
            actions.dispatch({ kind: 'left-right', isOn: checked });
          }}
        />
      </div>
      {isOn && SIDES.map((side) => <Plane key={side} side={side} state={state} actions={actions} />)}
    </section>
  );
}
