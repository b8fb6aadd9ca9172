/** The sentences with which the page refuses files. */
import type { NamedBytes } from '../../www/files.ts';
import { FileRefused } from '../../www/files.ts';
import type { Side } from '../../www/landmarks.ts';
import { openingOf } from './reading.ts';
import type { State } from '../../www/store/state.ts';

/** The sentence that refuses these files; they must be refused. */
export function refusal(files: readonly NamedBytes[], over: Side | null, state: State): string {
  try {
    openingOf(files, over, state);
  } catch (thrown) {
    if (thrown instanceof FileRefused) {
      return thrown.message;
    }
    throw thrown;
  }
  throw new Error('nothing was refused');
}
