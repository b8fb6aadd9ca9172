/** A listener for the core where only the progress is of interest. */

/** Passes the progress on, ignores everything else, and never asks for an early result. */
export function progressListener(progress: (share: number) => void): {
  readonly progress: (stage: string, sentence: string, share: number) => void;
  readonly relaxes: () => void;
  readonly found: () => void;
  readonly preview: () => void;
  readonly wantsResult: () => boolean;
} {
  const nothing = (): void => undefined;
  return {
    progress: (_stage, _sentence, share) => {
      progress(share);
    },
    relaxes: nothing,
    found: nothing,
    preview: nothing,
    wantsResult: () => false,
  };
}
