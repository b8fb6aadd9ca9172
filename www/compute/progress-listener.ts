/** What a worker gives the core that only wants to be told how far it is. */

/** Where progress goes; nothing else is heard, and no result is asked for early. */
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
