/** The line between both views: it is dragged or moved by keys, and a double-click gives one view the whole width. */
import type { VNode } from 'preact';
import { useRef, useState } from 'preact/hooks';
import type { Shell } from './shell.ts';

/** The step of an arrow key, as a share of the stage's width. */
const KEY_STEP = 0.05;
/** A divider that is dropped within this share of an edge moves to the edge. */
const SNAP = 0.08;

function snapped(share: number): number {
  return share < SNAP ? 0 : share > 1 - SNAP ? 1 : share;
}

/** The split after a double-click: the wider view alone, or both again. */
function exchanged(split: number): number {
  return split === 0 || split === 1 ? 0.5 : split < 0.5 ? 0 : 1;
}

function afterKey(key: string, split: number): number | null {
  switch (key) {
    case 'ArrowLeft':
    case 'ArrowUp':
      return Math.max(0, split - KEY_STEP);
    case 'ArrowRight':
    case 'ArrowDown':
      return Math.min(1, split + KEY_STEP);
    case 'Home':
      return 0;
    case 'End':
      return 1;
    case 'Enter':
      return exchanged(split);
    default:
      return null;
  }
}

/** The divider; it lies in the stage, whose split it sets. */
export function Divider({ shell }: { readonly shell: Shell }): VNode {
  const { split } = shell.state;
  const [held, setHeld] = useState(false);
  const element = useRef<HTMLDivElement>(null);
  const shareAt = (event: PointerEvent): number => {
    const stage = element.current?.parentElement?.getBoundingClientRect();
    if (stage === undefined) {
      return split;
    }
    const above = (element.current?.clientWidth ?? 0) > (element.current?.clientHeight ?? 0);
    const share = above ? (event.clientY - stage.top) / stage.height : (event.clientX - stage.left) / stage.width;
    return snapped(Math.min(1, Math.max(0, share)));
  };
  const release = (): void => {
    setHeld(false);
  };
  return (
    <div
      ref={element}
      class={held ? 'divider held' : 'divider'}
      role="separator"
      tabIndex={0}
      aria-label="Width of the source view"
      aria-orientation="vertical"
      aria-valuenow={Math.round(100 * split)}
      aria-valuemin={0}
      aria-valuemax={100}
      title="Drag to share the width; double-click gives one view all of it"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        setHeld(true);
      }}
      onPointerMove={(event) => {
        if (held) {
          shell.set({ split: shareAt(event) });
        }
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onDblClick={() => {
        shell.set({ split: exchanged(split) });
      }}
      onKeyDown={(event) => {
        const next = afterKey(event.key, split);
        if (next !== null) {
          event.preventDefault();
          shell.set({ split: next });
        }
      }}
    />
  );
}
