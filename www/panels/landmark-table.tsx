/** The table of landmark pairs, for mouse and keys. */
import type { VNode } from 'preact';
import { useEffect, useMemo, useRef } from 'preact/hooks';
import type { State } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import { fitsOf } from './fits.ts';
import { LandmarkRow } from './landmark-row.tsx';

const DRAGGED = 'text/x-landmark-pair';

function rowOf(target: EventTarget | null): HTMLTableRowElement | null {
  return target instanceof Element ? target.closest<HTMLTableRowElement>('tr[data-id]') : null;
}

function idOf(row: HTMLTableRowElement): number {
  return Number(row.dataset['id']);
}

/** Selects the pair of a row, and gives the row the keyboard focus. */
function select(row: Element | null | undefined, actions: Actions): void {
  if (row instanceof HTMLTableRowElement) {
    actions.dispatch({ kind: 'pair-selected', id: idOf(row) });
    row.focus();
  }
}

/** Does what a key means for a row; returns whether it means anything. */
function pressed(event: KeyboardEvent, row: HTMLTableRowElement, state: State, actions: Actions): boolean {
  const id = idOf(row);
  const index = state.pairs.findIndex((pair) => pair.id === id);
  const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
  if (step !== 0) {
    if (event.altKey) {
      actions.dispatch({ kind: 'pair-moved', id, to: index + step });
      row.focus();
    } else {
      select(step > 0 ? row.nextElementSibling : row.previousElementSibling, actions);
    }
    return true;
  }
  switch (event.key) {
    case 'Home':
    case 'End':
      select(event.key === 'Home' ? row.parentElement?.firstElementChild : row.parentElement?.lastElementChild, actions);
      return true;
    case 'Delete':
    case 'Backspace': {
      const next = row.nextElementSibling ?? row.previousElementSibling;
      actions.dispatch({ kind: 'pair-deleted', id });
      if (!row.isConnected) {
        select(next, actions);
      }
      return true;
    }
    case 'Enter':
      actions.lookAtPair(id);
      return true;
    case 'F2': {
      const name = row.querySelector('input');
      name?.focus();
      name?.select();
      return true;
    }
    case 'l':
    case 'L':
      actions.dispatch({ kind: 'pair-locked', id, locked: state.pairs[index]?.locked !== true });
      return true;
    default:
      return false;
  }
}

/** The keys in a label's field: Enter and Escape go back to the row, Escape without the change. */
function leaveName(event: KeyboardEvent, input: HTMLInputElement, state: State): void {
  const row = rowOf(input);
  if (event.key === 'Escape') {
    input.value = state.pairs.find((pair) => row !== null && pair.id === idOf(row))?.label ?? '';
  }
  if (event.key === 'Enter' || event.key === 'Escape') {
    event.stopPropagation();
    row?.focus();
  }
}

/** The handlers by which rows are dragged by their numbers; a row takes the place of the row that it is dropped on. */
function useReordering(state: State, actions: Actions): Record<'onDragStart' | 'onDragOver' | 'onDragLeave' | 'onDrop', (event: DragEvent) => void> {
  const mark = (event: DragEvent, over: boolean): void => {
    rowOf(event.target)?.classList.toggle('over', over);
  };
  const isOurs = (event: DragEvent): boolean => event.dataTransfer?.types.includes(DRAGGED) === true;
  return {
    onDragStart: (event) => {
      const row = rowOf(event.target);
      if (row !== null) {
        event.dataTransfer?.setData(DRAGGED, String(idOf(row)));
      }
    },
    onDragOver: (event) => {
      if (isOurs(event)) {
        event.preventDefault();
        mark(event, true);
      }
    },
    onDragLeave: (event) => {
      mark(event, false);
    },
    onDrop: (event) => {
      mark(event, false);
      const row = rowOf(event.target);
      if (isOurs(event) && row !== null) {
        event.preventDefault();
        const id = Number(event.dataTransfer?.getData(DRAGGED));
        const [from, onto] = [id, idOf(row)].map((one) => state.pairs.findIndex((pair) => pair.id === one));
        if (from !== undefined && onto !== undefined && from >= 0 && onto >= 0) {
          actions.dispatch({ kind: 'pair-moved', id, to: onto });
        }
      }
    },
  };
}

/** The table. */
export function LandmarkTable({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const { pairs, findings, result, ui } = state;
  const fits = useMemo(() => fitsOf({ pairs, findings, result }), [pairs, findings, result]);
  const body = useRef<HTMLTableSectionElement>(null);
  const reordering = useReordering(state, actions);
  useEffect(() => {
    body.current?.querySelector(`[data-id="${ui.selected ?? ''}"]`)?.scrollIntoView({ block: 'nearest' });
  }, [ui.selected]);
  const reached = pairs.some(({ id }) => id === ui.selected) ? ui.selected : pairs[0]?.id;
  return (
    <table id="landmark-list" role="grid" aria-label="Landmark pairs">
      <thead>
        <tr>
          <th scope="col">Pair</th>
          <th scope="col">Name</th>
          <th scope="col">
            <span class="unseen">How sure it is</span>
          </th>
          <th scope="col">
            <span class="unseen">Soften, lock and delete</span>
          </th>
        </tr>
      </thead>
      <tbody
        ref={body}
        {...reordering}
        onClick={(event) => {
          const row = rowOf(event.target);
          if (row !== null && row.isConnected && !(event.target instanceof Element && event.target.closest('button'))) {
            actions.dispatch({ kind: 'pair-selected', id: idOf(row) });
          }
        }}
        onDblClick={(event) => {
          const row = rowOf(event.target);
          if (row !== null) {
            actions.lookAtPair(idOf(row));
          }
        }}
        onKeyDown={(event) => {
          const row = rowOf(event.target);
          if (event.target instanceof HTMLInputElement) {
            leaveName(event, event.target, state);
          } else if (row === event.target && row !== null && pressed(event, row, state, actions)) {
            event.preventDefault();
            event.stopPropagation();
          }
        }}
      >
        {pairs.map((pair) => (
          <LandmarkRow
            key={pair.id}
            pair={pair}
            fit={fits.get(pair.id) ?? 'new'}
            selected={pair.id === ui.selected}
            lit={pair.id === ui.hovered}
            reached={pair.id === reached}
            actions={actions}
          />
        ))}
      </tbody>
    </table>
  );
}
