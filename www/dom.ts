/** Small helpers for plain DOM. */

type Attributes = Readonly<Record<string, string | number | boolean | undefined>>;

/** Makes an element. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: readonly (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === true) {
      element.setAttribute(key, '');
    } else if (value !== false && value !== undefined) {
      element.setAttribute(key, String(value));
    }
  }
  element.append(...children);
  return element;
}

/** The element with this id; the page is broken without it. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (element === null) {
    throw new Error(`the page has no element #${id}`);
  }
  return element;
}

/** The types of input fields into which text or numbers are typed. */
const TYPED = ['text', 'search', 'number', 'url'];

/** Whether the keys that go to this element are typed into it, so that they mean nothing to the page. */
export function isTyped(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLTextAreaElement ||
    (target instanceof HTMLInputElement && TYPED.includes(target.type)) ||
    (target instanceof HTMLElement && target.isContentEditable)
  );
}

/**
 * Copies a text to the clipboard; returns whether that succeeded. A browser may forbid it, and gives a page that was loaded by http no
 * clipboard.
 */
export async function copied(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** How long a download's bytes are kept, in ms: browsers give no sign when they have read them, but begin at once. */
const DOWNLOAD_KEPT = 60_000;

/** Offers bytes as a file. */
export function download(name: string, type: string, data: BlobPart): void {
  const url = URL.createObjectURL(new Blob([data], { type }));
  const link = make('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => {
    URL.revokeObjectURL(url);
  }, DOWNLOAD_KEPT);
}

/** The name of the first folder among what was dropped; `null` where there is none. A folder cannot be told by its file. */
export function folderAmong(items: Iterable<Pick<DataTransferItem, 'webkitGetAsEntry'>> = []): string | null {
  for (const item of items) {
    const entry = item.webkitGetAsEntry();
    if (entry?.isDirectory === true) {
      return entry.name;
    }
  }
  return null;
}
