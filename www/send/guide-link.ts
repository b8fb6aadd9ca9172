/** Links to the guide: `#guide`, and `#guide=SECTION`. */

/** The section that such a link names, empty for the guide's beginning; `null` where it is another link. */
export function guideSection(hash: string): string | null {
  const found = /^#guide(?:=([a-z]{0,20}))?$/.exec(hash);
  return found === null ? null : (found[1] ?? '');
}
