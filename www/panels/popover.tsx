/** A button that opens a small box at its side. */
import type { ComponentChildren, VNode } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { IconName } from './icons.tsx';
import { Icon } from './icons.tsx';
import type { Place } from './placement.ts';
import { keepInPlace } from './placement.ts';

interface PopoverProps {
  readonly icon: IconName;
  /** The label of the button. */
  readonly label: string;
  /** The text beside the icon; without it the label is shown only as the tooltip. */
  readonly text?: string;
  readonly place: Place;
  readonly id?: string;
  readonly disabled?: boolean;
  /** The content of the box; it can call `close` to shut the box. */
  readonly children: (close: () => void) => ComponentChildren;
}

/** Moves the focus to the next or previous button of a box; after the last comes the first. */
function moveFocus(box: HTMLElement, step: 1 | -1): void {
  const buttons = [...box.querySelectorAll<HTMLElement>('button:not(:disabled)')];
  const present = buttons.findIndex((button) => button === document.activeElement);
  if (present >= 0 || !box.contains(document.activeElement)) {
    buttons.at((present + step) % Math.max(1, buttons.length))?.focus();
  }
}

/** The button and, while it is open, the box. Escape, a press elsewhere and leaving the box by Tab shut it. */
export function Popover({ icon, label, text, place, id, disabled, children }: PopoverProps): VNode {
  const [open, setOpen] = useState(false);
  const root = useRef<HTMLDivElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  const body = useRef<HTMLDivElement>(null);
  const close = (): void => {
    if (root.current?.contains(document.activeElement) === true) {
      button.current?.focus();
    }
    setOpen(false);
  };
  useLayoutEffect(
    () => (open && body.current !== null && button.current !== null ? keepInPlace(body.current, button.current, place) : undefined),
    [open, place],
  );
  useEffect(() => {
    if (!open) {
      return undefined;
    }
    const away = (event: Event): void => {
      if (event.target instanceof Node && root.current?.contains(event.target) !== true) {
        setOpen(false);
      }
    };
    document.addEventListener('pointerdown', away, true);
    document.addEventListener('focusin', away);
    return () => {
      document.removeEventListener('pointerdown', away, true);
      document.removeEventListener('focusin', away);
    };
  }, [open]);
  return (
    <div
      ref={root}
      class="popover"
      onKeyDown={(event) => {
        if (event.key === 'Escape' && open) {
          event.stopPropagation();
          close();
        }
        const box = body.current;
        if (open && box !== null && (event.key === 'ArrowDown' || event.key === 'ArrowUp')) {
          const inBox = box.contains(document.activeElement);
          if (!inBox || document.activeElement instanceof HTMLButtonElement) {
            event.preventDefault();
            moveFocus(box, event.key === 'ArrowDown' ? 1 : -1);
          }
        }
      }}
    >
      <button
        ref={button}
        type="button"
        id={id}
        class={text === undefined ? 'square' : 'bare'}
        aria-label={label}
        title={label}
        aria-expanded={open}
        disabled={disabled}
        onClick={() => {
          setOpen(!open);
        }}
      >
        <Icon name={icon} />
        {text !== undefined && <span class="word">{text}</span>}
      </button>
      {open && (
        <div ref={body} class="body" popover="manual">
          {children(close)}
        </div>
      )}
    </div>
  );
}
