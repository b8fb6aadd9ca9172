/** The note about the place that the map proposes for a half pair, with buttons to accept and to drop it. */
import type { VNode } from 'preact';
import { proposed } from '../store/proposal.ts';
import type { PartProps } from './actions.ts';
import { meshName } from './names.ts';

/** The note; `null` while nothing is proposed. */
export function ProposalNote({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  const proposal = proposed(state);
  if (proposal === null) {
    return null;
  }
  const number = state.pairs.find(({ id }) => id === proposal.id)?.number ?? 0;
  return (
    <section id="proposal" aria-label={`Proposal for pair ${number}`}>
      <p>
        Pair {number}: the map takes it to the see-through pin on the {meshName(state, proposal.side)}. Take that place, or click a
        better one.
      </p>
      <div class="row">
        <button
          type="button"
          title="Make the pair with this place (Enter)"
          onClick={() => {
            actions.dispatch({ kind: 'proposal-accepted' });
          }}
        >
          Take it
        </button>
        <button
          type="button"
          class="bare"
          title="Take the pin away (Escape)"
          onClick={() => {
            actions.dispatch({ kind: 'proposal-dropped' });
          }}
        >
          Not there
        </button>
      </div>
    </section>
  );
}
