/** Tells tables whose columns are separated by another sign than commas, which the core does not read. */

/** The most bytes of a file that are looked at. */
const MOST_BYTES = 65_536;

/** The signs that other programs put between columns, also since some languages write numbers with commas. */
const SEPARATORS: readonly (readonly [string, string])[] = [
  [';', 'semicolons'],
  ['\t', 'tabs'],
];

/** The first two lines of a text; none where the bytes are no text. */
function firstLines(bytes: Uint8Array): readonly string[] {
  const lines = new TextDecoder().decode(bytes.subarray(0, MOST_BYTES)).split(/\r?\n/, 2);
  // Control characters other than tabs, and what is no UTF-8.
  return lines.some((line) => /[^\P{Cc}\t]|\ufffd/u.test(line)) ? [] : lines;
}

/** What to do about a table that has another sign between its columns, without a full stop; `null` for other files. */
export function separatorFault(bytes: Uint8Array): string | null {
  const lines = firstLines(bytes);
  const isSeparator = (sign: string): boolean => {
    const [first = 0, second] = lines.map((line) => line.split(sign).length - 1);
    return first > 0 && first === second;
  };
  const name = SEPARATORS.find(([sign]) => isSeparator(sign))?.[1];
  return name === undefined ? null : `its columns are separated by ${name}: save the table with commas between the columns, and with points in the numbers`;
}
