/** A row of the landmark table. */
import type { VNode } from 'preact';
import type { Pair } from '../landmarks.ts';
import { isWhole, USUAL_RADIUS } from '../landmarks.ts';
import type { Actions } from './actions.ts';
import { IconButton } from './controls.tsx';
import type { Fit } from './fits.ts';
import type { IconName } from './icons.tsx';
import { Icon } from './icons.tsx';
import { memo } from './memo.ts';
import { SIDE_NAMES } from './names.ts';
import { Swatch } from './swatch.tsx';

interface RowProps {
  readonly pair: Pair;
  readonly fit: Fit;
  readonly selected: boolean;
  readonly lit: boolean;
  /** Whether the Tab key reaches this row; it reaches only one of all rows. */
  readonly reached: boolean;
  readonly actions: Actions;
}

const FITS: Readonly<Record<Fit, readonly [IconName | null, string]>> = {
  new: [null, 'not judged yet'],
  fits: ['check', 'fits'],
  doubtful: ['doubt', 'doubtful'],
  missing: ['partner', 'its partner is missing'],
};

function missingText(pair: Pair): string {
  return `click the ${SIDE_NAMES[pair.points[0] === null ? 0 : 1]}`;
}

/** The button that deletes the pair of another row, or that row where its pair is locked. */
function deleteButton(row: Element): HTMLElement | null {
  return row.querySelector<HTMLElement>('.row-tools button:last-child:not(:disabled)') ?? row.closest('tr');
}

/** Deletes a pair; the keyboard goes on at the row after it, or before it where it was the last. */
function remove(id: number, { detail, currentTarget }: MouseEvent, { dispatch }: Actions): void {
  const row = currentTarget instanceof Element ? currentTarget.closest('tr') : null;
  const next = row?.nextElementSibling ?? row?.previousElementSibling ?? null;
  dispatch({ kind: 'pair-deleted', id });
  if (detail === 0 && next !== null && row?.isConnected === false) {
    deleteButton(next)?.focus();
  }
}

function RowTools({ pair, actions }: Pick<RowProps, 'pair' | 'actions'>): VNode {
  const { id, number, locked, radius } = pair;
  return (
    <div class="row-tools">
      <IconButton
        icon="soft"
        label={`Soft pair ${number}`}
        pressed={radius !== undefined}
        onClick={() => {
          actions.dispatch({ kind: 'pair-selected', id });
          actions.dispatch({ kind: 'pair-softened', id, radius: radius === undefined ? USUAL_RADIUS : null });
        }}
      />
      <IconButton
        icon={locked ? 'lock' : 'unlock'}
        label={`Lock pair ${number}`}
        pressed={locked}
        onClick={() => {
          actions.dispatch({ kind: 'pair-locked', id, locked: !locked });
        }}
      />
      <IconButton
        icon="close"
        label={`Delete pair ${number}`}
        disabled={locked}
        onClick={(event) => {
          remove(id, event, actions);
        }}
      />
    </div>
  );
}

function Row({ pair, fit, selected, lit, reached, actions }: RowProps): VNode {
  const { id, number, label } = pair;
  const [icon, words] = FITS[fit];
  const whole = isWhole(pair);
  const classes = [selected && 'selected', lit && 'lit', !whole && 'pending'].filter(Boolean).join(' ');
  const hover = (under: number | null) => (): void => {
    actions.dispatch({ kind: 'pair-hovered', id: under });
  };
  return (
    <tr
      class={classes}
      data-id={id}
      data-pair={whole ? number : undefined}
      aria-selected={selected}
      tabIndex={reached ? 0 : -1}
      onMouseEnter={hover(id)}
      onMouseLeave={hover(null)}
    >
      <td>
        <Swatch number={number} draggable />
      </td>
      <td>
        {/* The text that is being typed stays when the row is drawn again; a label that is changed elsewhere makes a new field. */}
        <input
          key={label}
          type="text"
          defaultValue={label}
          placeholder={whole ? '' : missingText(pair)}
          aria-label={`Name of pair ${number}`}
          tabIndex={-1}
          onChange={(event) => {
            actions.dispatch({ kind: 'pair-labelled', id, label: event.currentTarget.value.trim() });
          }}
        />
      </td>
      <td>
        <span class={`pair-state ${fit}`} title={words}>
          {icon !== null && <Icon name={icon} />}
          <span class="unseen">{words}</span>
        </span>
      </td>
      <td>
        <RowTools pair={pair} actions={actions} />
      </td>
    </tr>
  );
}

/** The row. Of many rows only those are drawn again that change. */
export const LandmarkRow = memo(Row);
