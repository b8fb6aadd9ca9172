/** The field for the radius within which a run may move the point of a soft pair. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import { MAX_RADIUS } from '../landmarks.ts';
import type { PartProps } from './actions.ts';

interface RadiusProps {
  readonly label: string;
  /** The radius as a share of the target's size. */
  readonly radius: number;
  readonly chosen: (radius: number) => void;
}

/** The radius in percent. The text that is being typed stays until it is entered, even when the field is drawn again. */
function Radius({ label, radius, chosen }: RadiusProps): VNode {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <input
      type="number"
      min={0.1}
      max={100 * MAX_RADIUS}
      step={0.1}
      value={typed ?? String(Number((100 * radius).toFixed(2)))}
      aria-label={label}
      onInput={(event) => {
        setTyped(event.currentTarget.value);
      }}
      onChange={(event) => {
        const percent = event.currentTarget.valueAsNumber;
        setTyped(null);
        if (!Number.isNaN(percent)) {
          chosen(Math.min(Math.max(percent, 0.1), 100 * MAX_RADIUS) / 100);
        }
      }}
    />
  );
}

/** The radius of the selected pair in percent of the target's size; `null` where the pair is not soft. */
export function SoftRadius({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  const pair = state.pairs.find(({ id }) => id === state.ui.selected);
  if (pair?.radius === undefined) {
    return null;
  }
  const { id, number, radius } = pair;
  const label = `Radius of pair ${number}, in percent of the target’s size`;
  const chosen = (wanted: number): void => {
    actions.dispatch({ kind: 'pair-softened', id, radius: wanted });
  };
  return (
    <div class="soft-radius">
      <label>
        Pair {number} may move by <Radius key={id} label={label} radius={radius} chosen={chosen} /> % of the target’s size
      </label>
      <p class="quiet small">When the map is made, its point on the target goes to where the map around it leads, and is held there.</p>
    </div>
  );
}
