/**
 * The comparison with another map of the same meshes and landmarks: the choice, the progress, and its figures beside those of the map on
 * the page.
 */
import type { VNode } from 'preact';
import type { OtherMap } from '../report.ts';
import type { Comparison, Result } from '../store/state.ts';
import { wordsOf } from '../unions.ts';
import './compare.css';
import { figuresOf } from './compared-figures.ts';
import { OTHER_NAMES } from './compared-words.ts';
import './watched.css';

export interface CompareProps {
  /** The map on the page. */
  readonly result: Result;
  readonly comparison: Comparison | null;
  /** Compares the map on the page with another one; `null` ends the comparison. */
  readonly choose: (other: OtherMap | null) => void;
}

const ABOUT: Readonly<Record<OtherMap, string>> = {
  start: 'The certified map that relaxation begins with: each mesh was relaxed over the flat triangles by itself.',
  'equal-cones': 'The thesis’ patchwise map over flat metrics whose cones are all alike. The certified map does not go over these metrics.',
  patchwise: 'The thesis’ patchwise map over flat metrics with the base domain’s cones. What it leaves unmapped is grey.',
  tutte: 'Each patch by Tutte’s embedding onto its flat triangle, as in methods before this one: continuous, with kinks along the patch lines. An unmarked limb that shrinks below rounding is grey.',
};

const CHOICES: readonly (OtherMap | null)[] = [null, ...wordsOf(OTHER_NAMES)];

function Choices({ comparison, choose }: Omit<CompareProps, 'result'>): VNode {
  const chosen = comparison?.which ?? null;
  return (
    <div role="radiogroup" aria-label="The map is compared with" class="compared-with">
      {CHOICES.map((which) => (
        <label class="check" key={which ?? 'none'}>
          <input
            type="radio"
            name="compared-with"
            value={which ?? 'none'}
            checked={which === chosen}
            onChange={() => {
              choose(which);
            }}
          />
          <span>{which === null ? 'None' : OTHER_NAMES[which].choice}</span>
        </label>
      ))}
    </div>
  );
}

function Table({ result, comparison }: { readonly result: Result; readonly comparison: Comparison }): VNode {
  const { progress, which } = comparison;
  const others = progress.kind === 'there' ? figuresOf(progress.map.report) : [];
  return (
    <table class="compared-figures small">
      <thead>
        <tr>
          <th scope="col">
            <span class="unseen">Figure</span>
          </th>
          <th scope="col">This map</th>
          <th scope="col">{OTHER_NAMES[which].choice}</th>
        </tr>
      </thead>
      <tbody>
        {figuresOf(result.report).map(({ name, note, value }, row) => (
          <tr key={name}>
            <th scope="row" title={note}>
              {name}
            </th>
            <td>{value}</td>
            <td>{others[row]?.value ?? ''}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Compared({ result, comparison, choose }: CompareProps & { readonly comparison: Comparison }): VNode {
  const { progress } = comparison;
  switch (progress.kind) {
    case 'computing':
      return (
        <>
          <p role="status">Making the other map…</p>
          <progress value={progress.share} aria-label="Progress of the other map" />
          <div class="watched-row">
            <button
              type="button"
              id="cancel-comparison"
              onClick={() => {
                choose(null);
              }}
            >
              Cancel
            </button>
          </div>
        </>
      );
    case 'failed':
      return <p role="status">There is no such map of these meshes. {progress.sentence}</p>;
    case 'there':
      return (
        <>
          <Table result={result} comparison={comparison} />
          <p class="quiet small">Both views show the source: the first with what this map carries from the target, the second with what the other map carries.</p>
        </>
      );
  }
}

/** The choices, and the result of the chosen one. */
export default function Compare(props: CompareProps): VNode {
  const { comparison } = props;
  return (
    <div class="watched">
      <Choices {...props} />
      <p class="quiet small">
        {comparison === null ? 'Another map of the same meshes and landmarks beside this one, with linked cameras.' : ABOUT[comparison.which]}
      </p>
      {comparison !== null && <Compared {...props} comparison={comparison} />}
    </div>
  );
}
