/** The base domain in the step Method, and both flat metrics in the plane beside it. */
import type { VNode } from 'preact';
import { useMemo, useState } from 'preact/hooks';
import { lateModule } from '../late-module.ts';
import { pairName } from '../messages.ts';
import { upVector } from '../method/axes.ts';
import type { BaseDomainProps } from '../method/base-domain.tsx';
import type { BasePart, PartHands } from '../method/parts.ts';
import { endsOfSides, faceCount } from '../method/parts.ts';
import type { PlaneProps } from '../method/plane.tsx';
import { wholePairs } from '../store/order.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';
import { Late } from './late.tsx';

interface OfResult extends PartProps {
  readonly result: Result;
  readonly names: readonly string[];
  readonly parts: PartHands;
}

const loadBase = lateModule(() => import('../method/base-domain.tsx'));
const loadPlane = lateModule(() => import('../method/plane.tsx'));

function BaseOf({ state, actions, shell, result, names, parts }: OfResult): VNode {
  const { base } = result.output;
  if (base === null) {
    return <p class="quiet">It is not known how the base domain of this map lies on the meshes.</p>;
  }
  const given: BaseDomainProps = {
    ...{ base, names, parts },
    hands: actions.baseView,
    theme: state.ui.theme,
    isLinked: state.ui.link !== 'free',
    up: [upVector(state.up[0]), upVector(state.up[1])],
    under: shell.state.probe?.patch ?? null,
  };
  return <Late isWanted load={loadBase} given={given} />;
}

function PlaneOf({ state, actions, result, names, parts }: OfResult): VNode {
  const [isOpen, setOpen] = useState(false);
  const { base } = result.output;
  const counts = useMemo(
    () => (base === null ? { cone: 0, side: 0, face: 0 } : { cone: base.shapes[0].cones.length / 3, side: endsOfSides(base).length, face: faceCount(base) }),
    [base],
  );
  if (isOpen) {
    const given: PlaneProps = {
      ...{ names, parts, counts },
      hands: actions.plane,
      theme: state.ui.theme,
      onClose: () => {
        setOpen(false);
      },
    };
    return <Late isWanted load={loadPlane} given={given} />;
  }
  return (
    <>
      <p class="quiet">Both meshes with their flat metrics laid out in the plane, each triangle beside one that is there. Choose a patch, here or in the base domain, and the layout grows from it.</p>
      <div class="row">
        <button
          type="button"
          id="open-plane"
          onClick={() => {
            setOpen(true);
          }}
        >
          <Icon name="play" />
          Lay both out
        </button>
      </div>
    </>
  );
}

function PicturesOf(props: PartProps & { readonly result: Result }): VNode {
  const { result, shell } = props;
  const names = useMemo(() => wholePairs(result.inputs).map(pairName), [result]);
  const [hovered, setHovered] = useState<BasePart | null>(null);
  const [held, setHeld] = useState<BasePart | null>(null);
  const under = shell.state.probe?.patch ?? null;
  const parts: PartHands = {
    lit: under === null ? (hovered ?? held) : { kind: 'face', index: under },
    held,
    hover: (part) => {
      if (part?.kind !== hovered?.kind || part?.index !== hovered?.index) {
        setHovered(part);
      }
    },
    hold: setHeld,
  };
  return (
    <>
      <section id="base-domain">
        <h3>The base domain</h3>
        <BaseOf {...props} names={names} parts={parts} />
      </section>
      <section id="plane">
        <h3>The flat metric in the plane</h3>
        <PlaneOf {...props} names={names} parts={parts} />
      </section>
    </>
  );
}

/** The base domain of the map on the page and its flat metrics; where there is no map, a sentence about how to get one. */
export function BaseView(props: PartProps): VNode {
  const result = shownResult(props.state);
  return result === null ? (
    <section id="base-domain">
      <h3>The base domain</h3>
      <p class="quiet">Make a map, and the coarse mesh that it goes through comes here.</p>
    </section>
  ) : (
    <PicturesOf key={result.output.report} {...props} result={result} />
  );
}
