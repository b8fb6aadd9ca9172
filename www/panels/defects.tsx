/** The defects of a mesh: the legend of what the view paints, and a list whose entries turn the camera. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import type { DefectGroup, Examined } from '../store/defects.ts';
import type { Actions } from './actions.ts';

const DASHES: Readonly<Record<NonNullable<DefectGroup['stroke']>, string>> = {
  solid: '',
  double: '',
  dashed: '6 4',
  dotted: '2 3',
  'dash-dot': '6 3 2 3',
};

/** The paths of the strokes of a filling, in a box of 24 by 16. */
const FILLS: Readonly<Record<NonNullable<DefectGroup['fill']>, string>> = {
  stripes: 'M2 2 16 16M9 2 22 15M16 2 22 8M2 9 9 16',
  grid: 'M2 2 16 16M9 2 22 15M16 2 22 8M2 9 9 16M22 2 8 16M15 2 2 15M8 2 2 8M22 9 15 16',
  dots: 'M5 5h.1M12 5h.1M19 5h.1M5 11h.1M12 11h.1M19 11h.1',
  bars: 'M2 4H22M2 8H22M2 12H22',
};

/** A sample of how the view draws a kind of defect. */
function Sample({ group: { colour, stroke, fill, sign } }: { readonly group: DefectGroup }): VNode {
  return (
    <svg class="sample" viewBox="0 0 24 16" aria-hidden="true" fill="none" stroke={colour}>
      {fill !== null && <rect x="1" y="1" width="22" height="14" fill={colour} fill-opacity="0.35" stroke="none" />}
      {fill !== null && <path d={FILLS[fill]} stroke-width={fill === 'dots' ? 3 : 1.5} stroke-linecap="round" />}
      {stroke === 'double' ? (
        <path d="M1 5.5H23M1 10.5H23" stroke-width="2" />
      ) : (
        stroke !== null && <path d={fill === null ? 'M1 8H23' : 'M1 1H23V15H1Z'} stroke-width="2.5" stroke-dasharray={DASHES[stroke]} />
      )}
      {sign === 'diamond' && <path d="M12 2 18 8 12 14 6 8Z" fill={colour} stroke="none" />}
      {sign === 'cross' && <path d="M7 3 17 13M17 3 7 13" stroke-width="3" />}
    </svg>
  );
}

/** A sentence about how many defects of a kind are drawn and listed, where that is not all. */
function Rest({ group: { count, drawn, labels } }: { readonly group: DefectGroup }): VNode | null {
  if (labels.length === count) {
    return null;
  }
  return (
    <p class="quiet small">
      {drawn === count ? 'All' : `The first ${integer(drawn)}`} of {integer(count)} are drawn, {integer(labels.length)} listed.
    </p>
  );
}

/** A kind with at most this many entries is open at first. */
const FEW = 6;

/** The kinds of defects of one mesh, each with its entries. */
export function DefectList({ side, examined, actions }: { readonly side: Side; readonly examined: Examined; readonly actions: Actions }): VNode {
  return (
    <div class="defects" data-side={side}>
      {examined.groups.map((group, place) => (
        <details key={group.kind} data-kind={group.kind} open={group.labels.length <= FEW}>
          <summary>
            <Sample group={group} />
            {group.sentence}
          </summary>
          <div class="entries">
            {group.labels.map((label, index) => (
              <button
                key={label}
                type="button"
                class="bare"
                onClick={() => {
                  actions.lookAtDefect(side, examined, place, index);
                }}
              >
                {label}
              </button>
            ))}
          </div>
          <Rest group={group} />
        </details>
      ))}
    </div>
  );
}
