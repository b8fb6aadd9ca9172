/** The demos as pictures, each with a sentence about what to see in it and with its link. */
import type { VNode } from 'preact';
import { copied } from '../dom.ts';
import type { Demo } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';

/** A sentence about what to see in each demo, by its id; `npm run thumbnails` draws the pictures. */
const SIGHTS: Readonly<Record<string, string>> = {
  'horse-camel': 'See where the hump comes from, and how the horse’s neck takes the camel’s bend.',
  'wolf-cow': 'See paws become hooves, a bushy tail a thin one, and where the skin for the horns is found.',
  'cat-lion': 'See the mane: every tuft has its place on the cat’s smooth neck.',
  'horse-gallop': 'See how the skin keeps its size while every leg bends: the two meshes share no triangle.',
  'horse-turning': 'See one flank shorten and the other stretch: here the true map is known, and this one is close to it.',
  'horse-rearing': 'See one horse from its nose in the grass to its forelegs in the air.',
  'figure-running': 'See knees and elbows: the stretch gathers where a body bends, and nowhere else.',
  hands: 'See every finger find its own, down to the nails.',
  'ball-cone': 'See the texture of the cone on the ball, cut along the red lines from landmark to landmark.',
  'horse-cat': 'See how the pattern keeps its squares from the cat’s short legs to the horse’s long ones.',
  poses: 'See how the skin keeps its size while arms and legs bend: the two meshes share no triangle.',
  'sphere-tetrahedron': 'See how a ball spreads over corners, and where the stretch gathers.',
};

/** A sentence about what to see in a demo. */
export function sightOf({ id, sentence }: Demo): string {
  return SIGHTS[id] ?? `${sentence}.`;
}

/** The address of a demo's picture; `null` where it has none. */
function pictureOf(id: string): string | null {
  return id in SIGHTS ? `demos/${id}.webp` : null;
}

/** The link to a demo. */
function linkOf(id: string): string {
  const url = new URL(document.baseURI);
  url.hash = `demo=${encodeURIComponent(id)}`;
  return url.href;
}

async function copy(url: string, { dispatch }: Pick<Actions, 'dispatch'>): Promise<void> {
  const sentence = (await copied(url)) ? 'The link is copied.' : `The browser does not let the page copy. The link is ${url}`;
  dispatch({ kind: 'toast', sentence, undo: false });
}

interface CardProps {
  readonly demo: Demo;
  /** Whether the demo is on the page. */
  readonly isPresent: boolean;
  readonly disabled: boolean;
  readonly actions: Actions;
}

function Card({ demo, isPresent, disabled, actions }: CardProps): VNode {
  const picture = pictureOf(demo.id);
  return (
    <li class="demo-card">
      <button
        type="button"
        class="open-demo"
        data-demo-id={demo.id}
        disabled={disabled}
        aria-pressed={isPresent}
        onClick={() => {
          actions.openDemo(demo.id);
        }}
      >
        {picture !== null && <img src={picture} alt="" width={240} height={100} loading="lazy" decoding="async" />}
        <strong>{demo.title}</strong>
        <span class="quiet small">{sightOf(demo)}</span>
      </button>
      <IconButton
        icon="copy"
        label={`Copy the link to the demo “${demo.title}”`}
        onClick={() => {
          void copy(linkOf(demo.id), actions);
        }}
      />
    </li>
  );
}

/** The gallery of demos; a click opens one. */
export function Gallery({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <ul class="gallery">
      {state.demos.map((demo) => (
        <Card
          key={demo.id}
          demo={demo}
          isPresent={state.demo?.id === demo.id}
          disabled={state.job.kind === 'running'}
          actions={actions}
        />
      ))}
    </ul>
  );
}
