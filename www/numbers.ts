/** Numbers as the page writes them. */

const INTEGER = new Intl.NumberFormat('en');

/** 12,345 */
export function integer(value: number): string {
  return INTEGER.format(value);
}

/** A share in percent, rounded down so that only what is whole is called so. */
export function percent(share: number): string {
  return `${(Math.floor(share * 10_000) / 100).toFixed(2)} %`;
}

/** A number to read: three or four figures, powers of ten where very small or large. */
export function figure(value: number): string {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) {
    return '–';
  }
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    return value.toExponential(1).replace('e-', '·10⁻').replace('e+', '·10').replace(/(?<=10⁻?)\d+$/, superscript);
  }
  return value.toPrecision(4).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
}

function superscript(digits: string): string {
  return digits.replace(/\d/g, (digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'.charAt(Number(digit)));
}
