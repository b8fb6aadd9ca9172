/** Helpers for elements and the clipboard. */
import { describe, expect, test, vi } from 'vitest';
import { copied, folderAmong, isTyped } from '../../www/dom.ts';

/** Elements of a browser, with only the members that are used. */
class FakeElement extends EventTarget {
  isContentEditable = false;
}
class FakeArea extends FakeElement {}
class FakeInput extends FakeElement {
  readonly type: string;

  constructor(type: string) {
    super();
    this.type = type;
  }
}

test('keys are typed into fields of text and numbers, and into nothing else', () => {
  vi.stubGlobal('HTMLElement', FakeElement);
  vi.stubGlobal('HTMLTextAreaElement', FakeArea);
  vi.stubGlobal('HTMLInputElement', FakeInput);
  for (const type of ['text', 'number', 'search', 'url']) {
    expect(isTyped(new FakeInput(type)), type).toBe(true);
  }
  expect(isTyped(new FakeArea())).toBe(true);
  expect(isTyped(Object.assign(new FakeElement(), { isContentEditable: true }))).toBe(true);
  for (const other of [new FakeInput('range'), new FakeInput('radio'), new FakeInput('checkbox'), new FakeElement(), new EventTarget(), null]) {
    expect(isTyped(other)).toBe(false);
  }
});

describe('a text is copied', () => {
  const written: string[] = [];
  const clipboard = (writeText: (text: string) => Promise<void>): void => {
    vi.stubGlobal('navigator', { clipboard: { writeText } });
  };

  test('where the browser lets it', async () => {
    clipboard((text) => {
      written.push(text);
      return Promise.resolve();
    });
    expect([await copied('a link'), written]).toEqual([true, ['a link']]);
  });

  test('but not where it forbids that, or has no clipboard for the page', async () => {
    clipboard(() => Promise.reject(new Error('not allowed')));
    expect(await copied('a link')).toBe(false);
    vi.stubGlobal('navigator', {});
    expect(await copied('a link')).toBe(false);
  });
});

test('a folder among what was dropped is told by its name', () => {
  const dropped = (name: string, isDirectory: boolean): Pick<DataTransferItem, 'webkitGetAsEntry'> => ({
    webkitGetAsEntry: () => ({ name, isDirectory }) as FileSystemEntry,
  });
  const text = { webkitGetAsEntry: (): null => null };
  expect(folderAmong([text, dropped('cat.obj', false), dropped('meshes', true)])).toBe('meshes');
  expect(folderAmong([text, dropped('cat.obj', false)])).toBeNull();
  expect(folderAmong()).toBeNull();
});
