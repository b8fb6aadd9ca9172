/** What the page holds beside its state: how the views share the width, the theme, the open dialog, and the place under the mouse. */
import type { State } from '../store/state.ts';

export type Theme = State['ui']['theme'];

/** The map at the place under the mouse. */
export interface Probe {
  /** The place on the source and on the target, in the files' coordinates. */
  readonly positions: readonly [readonly [number, number, number], readonly [number, number, number]];
  /** The distortion there, 1 for none; `null` where it is not known. */
  readonly distortion: number | null;
  /** The values of the shown heat map at the place: one of the map, or one on each mesh; `null` where no heat map is shown. */
  readonly heat: readonly number[] | null;
  /** The base triangle in whose patch the place lies; `null` while nobody looks at the base domain. */
  readonly patch: number | null;
}

/** The dialogs: the first steps and keys; the guide, from a section on (empty for its beginning); the plots of the last map. */
export type Dialog = { readonly kind: 'help' } | { readonly kind: 'guide'; readonly section: string } | { readonly kind: 'plots' };

export interface ShellState {
  /** The source view's share of the stage, 0 to 1. */
  readonly split: number;
  /** The dialog over the page; `null` for none. */
  readonly dialog: Dialog | null;
  /** The place under the mouse; `null` while the mouse is elsewhere, and where there is no map. */
  readonly probe: Probe | null;
}

interface Remembered {
  readonly split?: number;
  readonly theme?: Theme;
}

const KEY = 'conemap-page';

/** Reads what was stored, and leaves out fields that are not valid. */
export function remembered(text: string | null): Remembered {
  let value: unknown = null;
  try {
    value = JSON.parse(text ?? 'null');
  } catch {
    return {};
  }
  if (typeof value !== 'object' || value === null) {
    return {};
  }
  const { split, theme } = value as Readonly<Record<string, unknown>>;
  return {
    ...(typeof split === 'number' && split >= 0 && split <= 1 ? { split } : {}),
    ...(theme === 'system' || theme === 'light' || theme === 'dark' ? { theme } : {}),
  };
}

function stored(): Remembered {
  try {
    return remembered(localStorage.getItem(KEY));
  } catch {
    // A browser may forbid storage; then nothing is remembered.
    return {};
  }
}

function store(change: Remembered): void {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...stored(), ...change }));
  } catch {
    // Storage may be forbidden, as in stored().
  }
}

/** Holds this and calls one listener at each change. */
export class Shell {
  #state: ShellState = { split: stored().split ?? 0.5, dialog: null, probe: null };
  #listener = (): void => undefined;

  get state(): ShellState {
    return this.#state;
  }

  /** The theme of the last visit. */
  get theme(): Theme {
    return stored().theme ?? 'system';
  }

  subscribe(listener: () => void): void {
    this.#listener = listener;
  }

  readonly set = (change: Partial<ShellState>): void => {
    this.#state = { ...this.#state, ...change };
    if (change.split !== undefined) {
      store({ split: change.split });
    }
    this.#listener();
  };

  readonly rememberTheme = (theme: Theme): void => {
    store({ theme });
  };
}
