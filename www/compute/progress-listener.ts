/** A listener for the core where only the progress is of interest, and previews where they are asked for. */

const nothing = (): void => undefined;

/** Passes the progress and the previews on, ignores everything else, and never asks for an early result. */
export function progressListener(
  progress: (share: number) => void,
  preview: (places: Float32Array, pairs: Uint32Array) => void = nothing,
): {
  readonly progress: (stage: string, sentence: string, share: number) => void;
  readonly relaxes: () => void;
  readonly found: () => void;
  readonly preview: (places: Float32Array, pairs: Uint32Array) => void;
  readonly wantsResult: () => boolean;
} {
  return {
    progress: (_stage, _sentence, share) => {
      progress(share);
    },
    relaxes: nothing,
    found: nothing,
    preview,
    wantsResult: () => false,
  };
}
