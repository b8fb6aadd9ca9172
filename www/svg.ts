/** Text for SVG files. */

/** A text escaped for use as the content of an element or as an attribute's value. */
export function escaped(text: string): string {
  return text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
}
