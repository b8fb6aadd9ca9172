/** Suggested landmarks: a button asks for them, and they are taken one by one or all at once. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { otherSide, SIDES } from '../landmarks.ts';
import { suggestionName } from '../messages.ts';
import { takingOn } from '../store/across.ts';
import type { PartProps } from './actions.ts';
import { SIDE_NAMES } from './names.ts';

type Props = Pick<PartProps, 'state' | 'actions'>;

function Ask({ state, actions, side }: { readonly side: Side } & Props): VNode {
  const name = SIDE_NAMES[side];
  return (
    <button
      type="button"
      id={`suggest-${name}`}
      title={`Mark places of the ${name} that are worth a landmark`}
      aria-label={`Suggest landmarks on the ${name}`}
      disabled={state.job.kind === 'running' || state.meshes[side] === null}
      onClick={() => {
        actions.suggest(side);
      }}
    >
      On the {name}
    </button>
  );
}

function Found({ state, actions, side }: { readonly side: Side } & Props): VNode | null {
  const suggestions = state.suggestions[side];
  const [name, other] = [SIDE_NAMES[side], SIDE_NAMES[otherSide(side)]];
  const taking = takingOn(state, side);
  if (suggestions.length === 0) {
    return null;
  }
  return (
    <div class="found" role="group" aria-label={`Suggestions on the ${name}`}>
      <p class="quiet small">
        Rings on the {name}: click those that you want, then the same places on the {other}.
      </p>
      <ol>
        {suggestions.map((suggestion) => {
          const words = suggestionName(suggestion, suggestions, taking);
          return (
            <li key={suggestion.point}>
              <button
                type="button"
                class="ring"
                title={words}
                aria-label={`Take ${words}`}
                onClick={() => {
                  actions.dispatch({ kind: 'point-picked', side, point: suggestion.point });
                }}
              >
                {suggestion.letter}
              </button>
            </li>
          );
        })}
      </ol>
      <div class="row">
        <button
          type="button"
          title={`Take all of them, then pick their places on the ${other} one after the other`}
          onClick={() => {
            actions.dispatch({ kind: 'suggestions-taken', side });
          }}
        >
          Take all {suggestions.length}
        </button>
        <button
          type="button"
          class="bare"
          onClick={() => {
            actions.dispatch({ kind: 'suggested', side, suggestions: [] });
          }}
        >
          Hide
        </button>
      </div>
    </div>
  );
}

/** The section about suggestions in the panel of the landmarks. */
export function Suggestions({ state, actions }: Props): VNode {
  return (
    <div class="suggestions">
      <h3>Suggest places</h3>
      <div class="row">
        {SIDES.map((side) => (
          <Ask key={side} state={state} actions={actions} side={side} />
        ))}
      </div>
      {SIDES.map((side) => (
        <Found key={side} state={state} actions={actions} side={side} />
      ))}
    </div>
  );
}
