/** The actions of the visit on a browser, the same for all browsers. */
import { existsSync } from 'node:fs';

/** A browser with one window, in which the page is visited. */
export interface Browser {
  open(url: string): Promise<void>;
  reload(): Promise<void>;
  /** The value of a script in the page: the body of a function that returns a JSON value or a promise of one. */
  evaluate(body: string): Promise<unknown>;
  click(selector: string): Promise<void>;
  /** Presses a letter together with the control key. */
  pressWithControl(letter: string): Promise<void>;
  close(): Promise<void>;
}

/** Begins a browser. */
export interface Launcher {
  readonly name: string;
  /** The path of its program; `null` where it is not installed. */
  readonly program: string | null;
  begin(program: string): Promise<Browser>;
}

/** The first of some paths that exists; `null` for none. */
export function firstOf(paths: readonly (string | undefined)[]): string | null {
  return paths.find((path) => path !== undefined && existsSync(path)) ?? null;
}

/** Evaluates a script again and again until its value is as wanted. */
export async function until(browser: Browser, body: string, isWanted: (value: unknown) => boolean, seconds: number): Promise<void> {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const value = await browser.evaluate(body);
    if (isWanted(value)) {
      return;
    }
    if (Date.now() > end) {
      throw new Error(`after ${seconds} s “${body}” is still ${JSON.stringify(value)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}
