/** Holds what the user has chosen to bring across and the results; it stays while other steps are open. */
import type { Core } from '../compute/core.ts';
import { SENTENCES } from '../messages.ts';
import { endingOf } from '../named-file.ts';
import type { Result } from '../store/state.ts';
import { bringAcross, lookAt } from './client.ts';
import type { BringFailure, Brought, GivenFileReport, Kind, TransferWhat, TransferWish } from './messages.ts';
import type { Giver } from './words.ts';
import { bringSentence, notTogether, receiverOf, savedSentence, WORDS } from './words.ts';

/** What a column of a table holds. */
export type Role = 'numbers' | 'labels' | 'weights';

type Values = Extract<TransferWhat, { readonly kind: 'values' }>;

/** The choices beside the files. */
export interface Choices {
  readonly from: Giver;
  readonly method: Values['method'];
  /** What all columns hold; `own` where each has its own role. */
  readonly columns: Role | 'own';
  /** The role of each column where each has its own; a column that is not listed holds numbers. */
  readonly roles: ReadonlyMap<string, Role>;
  readonly valueFormat: Values['format'];
  readonly curveFormat: Extract<TransferWhat, { readonly kind: 'curves' }>['format'];
  /** Texels in a row of a baked picture. */
  readonly size: number;
}

/** Files that were looked at, with what they may be. */
export interface Given {
  readonly files: readonly File[];
  /** The kinds that they may be taken for; at least one. */
  readonly kinds: readonly Kind[];
  readonly kind: Kind;
  readonly columns: readonly string[];
}

/** A file that was brought across. */
export interface MadeFile {
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly sentence: string;
}

export interface DeskState {
  /** What is being done now, with the share of it that is done; `null` for nothing. */
  readonly work: { readonly kind: 'looking' | 'bringing'; readonly share: number } | null;
  readonly given: Given | null;
  readonly choices: Choices;
  /** Why the last request failed; `null` where it did not. */
  readonly error: string | null;
  /** The last file that was brought across. */
  readonly made: MadeFile | null;
}

/** What the desk needs of the page. */
export interface DeskHands {
  readonly core: () => Core | null;
  /** The map of the meshes on the page. */
  readonly shown: () => Result | null;
  readonly save: (file: MadeFile) => void;
}

/** The sizes of a baked picture that can be chosen, up to the core's largest. */
export const SIZES = [512, 1024, 2048, 4096, 8192] as const;

/** The most bytes of all files together. */
const MOST_BYTES = 2 ** 30;

/** The choices at first; a test compares them with the usual ones of the core. */
const BEGINNING: DeskState = {
  work: null,
  given: null,
  choices: { from: 'target', method: 'projection', columns: 'numbers', roles: new Map(), valueFormat: 'csv', curveFormat: 'json', size: 1024 },
  error: null,
  made: null,
};

/** What the files may be taken for together; a sentence where they can be taken for nothing. */
function together(files: readonly File[], reports: readonly GivenFileReport[]): Given | string {
  const [first] = reports;
  const [kind] = first?.kinds ?? [];
  if (first === undefined || kind === undefined) {
    return notTogether(files[0]?.name ?? '');
  }
  if (files.length === 1) {
    return { files, kinds: first.kinds, kind, columns: first.columns };
  }
  const other = reports.findIndex(({ kinds }) => !kinds.includes('frames'));
  return other === -1 ? { files, kinds: ['frames'], kind: 'frames', columns: [] } : notTogether(files[other]?.name ?? '');
}

/** The sentence about a failure, which goes into the log, too. */
function told(failure: BringFailure, files: readonly File[], meshes: Readonly<Record<Giver, string>> = { source: 'source', target: 'target' }): string {
  console.error(failure);
  return bringSentence(
    failure,
    files.map(({ name }) => name),
    meshes,
  );
}

/** The request to the core for these choices. */
export function wishOf({ kind, columns }: Pick<Given, 'kind' | 'columns'>, choices: Choices): TransferWish {
  const having = (role: Role): string[] => columns.filter((name) => (choices.columns === 'own' ? choices.roles.get(name) : choices.columns) === role);
  const { from, method, valueFormat, curveFormat, size } = choices;
  switch (kind) {
    case 'values':
      return { from, what: { kind, method, labels: having('labels'), weights: having('weights'), format: valueFormat } };
    case 'curves':
      return { from, what: { kind, format: curveFormat } };
    case 'texture':
      return { from, what: { kind, size } };
    case 'frames':
      return { from, what: { kind } };
  }
}

/** The name under which a result is saved, made from the name of the given file. */
function savedName(given: string, { only }: Brought, giver: Giver): string {
  const stem = given.replace(/\.[^.]*$/, '');
  return only === null ? `${stem}-and-others-on-${receiverOf(giver)}.zip` : `${stem}-on-${receiverOf(giver)}.${endingOf(only)}`;
}

/** Owns the files, the choices and the worker. */
export class Desk {
  readonly #hands: DeskHands;
  #state = BEGINNING;
  #listeners = new Set<() => void>();
  #end = (): void => undefined;
  /** The map by which files are being brought across. */
  #by: Result | null = null;

  constructor(hands: DeskHands) {
    this.#hands = hands;
  }

  get state(): DeskState {
    return this.#state;
  }

  subscribe(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => {
      this.#listeners.delete(listener);
    };
  }

  choose(choices: Partial<Choices>): void {
    this.#set({ choices: { ...this.#state.choices, ...choices } });
  }

  /** Takes the files for another kind that they may be. */
  takeFor(kind: Kind): void {
    const { given } = this.#state;
    if (given?.kinds.includes(kind) === true) {
      this.#set({ given: { ...given, kind } });
    }
  }

  /** Looks at files; the earlier ones stay until it is known what the new ones are, and are gone where these are refused. */
  take(files: readonly File[]): void {
    const core = this.#begin('looking');
    const large = files.find(({ size }) => size > MOST_BYTES);
    if (large !== undefined) {
      this.#refuse(`${large.name} ${WORDS.tooLarge}`);
    } else if (files.reduce((sum, { size }) => sum + size, 0) > MOST_BYTES) {
      this.#refuse(WORDS.tooMuch);
    } else if (core !== null) {
      this.#end = lookAt({ module: core, files }, {
        progress: this.#progress,
        done: (reports) => {
          this.#looked(files, reports);
        },
        failed: (failure) => {
          this.#refuse(told(failure, files));
        },
      });
    }
  }

  /** Refuses a folder that was dropped. */
  refuseFolder(name: string): void {
    void this.#begin('looking');
    this.#refuse(`${name} ${SENTENCES.folder}`);
  }

  /** Brings the files across, and saves the result. */
  bring(): void {
    const { given, choices } = this.#state;
    if (given !== null) {
      this.#ask(given.files, wishOf(given, choices), (brought) => savedName(given.files[0]?.name ?? 'file', brought, choices.from));
    }
  }

  /** Makes each mesh in the shape of the other, with distances, and saves them. */
  bringShapes(): void {
    this.#ask([], { from: this.#state.choices.from, what: { kind: 'shapes' } }, () => 'shapes.zip');
  }

  /** Saves the last result once more. */
  saveAgain(): void {
    const { made } = this.#state;
    if (made !== null) {
      this.#hands.save(made);
    }
  }

  /** Ends what is being done now; files and choices stay. */
  cancel(): void {
    this.#end();
    this.#set({ work: null });
  }

  /** Ends what is being brought by a map that is no longer the one on the page. */
  follow(): void {
    if (this.#state.work?.kind === 'bringing' && this.#hands.shown() !== this.#by) {
      this.#end();
      this.#fail(WORDS.mapChanged);
    }
  }

  /** Ends what was being done; returns the core, or `null` where it is missing, and shows that. */
  #begin(kind: 'looking' | 'bringing'): Core | null {
    this.#end();
    this.#end = () => undefined;
    const core = this.#hands.core();
    this.#set(core === null ? { work: null, error: WORDS.noCore } : { work: { kind, share: 0 }, error: null });
    return core;
  }

  #ask(files: readonly File[], wish: TransferWish, name: (brought: Brought) => string): void {
    const result = this.#hands.shown();
    const [source, target] = result?.inputs.meshes ?? [];
    const map = result?.output.map ?? null;
    if (map === null || source === null || source === undefined || target === null || target === undefined) {
      return;
    }
    const core = this.#begin('bringing');
    this.#by = result;
    this.#set({ made: null });
    if (core === null) {
      return;
    }
    const request = { module: core, files, wish, map, source: source.bytes, target: target.bytes };
    this.#end = bringAcross(request, {
      progress: this.#progress,
      done: (brought) => {
        this.#came(brought, name(brought));
      },
      failed: (failure) => {
        this.#fail(told(failure, files, { source: source.name, target: target.name }));
      },
    });
  }

  readonly #progress = (share: number): void => {
    const { work } = this.#state;
    if (work !== null) {
      this.#set({ work: { ...work, share } });
      this.follow();
    }
  };

  #looked(files: readonly File[], reports: readonly GivenFileReport[]): void {
    const given = together(files, reports);
    if (typeof given === 'string') {
      this.#refuse(given);
      return;
    }
    const valueFormat = endingOf(files[0]?.name ?? '') === 'ply' ? 'ply' : 'csv';
    const { choices } = this.#state;
    // The roles of columns hold only for files with the same columns.
    const isSame = given.columns.join() === this.#state.given?.columns.join();
    const columns = isSame ? {} : ({ columns: 'numbers', roles: new Map<string, Role>() } as const);
    this.#set({ work: null, given, made: null, choices: { ...choices, valueFormat, ...columns } });
  }

  #came(brought: Brought, name: string): void {
    this.follow();
    if (this.#state.work === null) {
      return;
    }
    const remark = brought.remark === null ? '' : ` ${brought.remark.charAt(0).toUpperCase()}${brought.remark.slice(1)}.`;
    const made = { name, bytes: brought.bytes, sentence: `${savedSentence(name, brought.count)}${remark}` };
    this.#set({ work: null, made });
    this.#hands.save(made);
  }

  /** Says why files were refused. The earlier ones are no longer chosen, so that the button does not bring them in place of these. */
  #refuse(error: string): void {
    this.#set({ work: null, error, given: null, made: null });
  }

  #fail(error: string): void {
    this.#set({ work: null, error });
  }

  #set(change: Partial<DeskState>): void {
    this.#state = { ...this.#state, ...change };
    this.#listeners.forEach((listener) => {
      listener();
    });
  }
}
