/** Links to the guide: `#guide`, and `#guide=SECTION`. */

/** The section that a link to the guide names, empty for the guide's beginning; `null` where the link is another one. */
export function guideSection(hash: string): string | null {
  const found = /^#guide(?:=([a-z]{0,20}))?$/.exec(hash);
  return found === null ? null : (found[1] ?? '');
}
