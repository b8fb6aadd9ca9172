/** How the page writes numbers. */

const INTEGER = new Intl.NumberFormat('en');

/** An integer with thousands separated, such as 12,345. */
export function integer(value: number): string {
  return INTEGER.format(value);
}

/** A share in percent with two decimals, rounded down so that only the whole is shown as 100 %. */
export function percent(share: number): string {
  return `${(Math.floor(share * 10_000) / 100).toFixed(2)} %`;
}

/** A number for reading: three or four digits, with a power of ten where it is very small or large. */
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
