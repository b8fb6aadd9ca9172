/** Light or dark: as the system has it, or as the user chose. */

/** What the user chose. */
export type Theme = 'system' | 'light' | 'dark';

const SYSTEM = window.matchMedia('(prefers-color-scheme: dark)');
const CHANGED = 'themechange';
const listeners = new EventTarget();

/** Shows the page so; the style sheets read it from the root element. */
export function applyTheme(theme: Theme): void {
  const root = document.documentElement;
  if (root.dataset['theme'] !== theme) {
    root.dataset['theme'] = theme;
    listeners.dispatchEvent(new Event(CHANGED));
  }
}

/** Whether the page is dark now. */
export function isDark(): boolean {
  const chosen = document.documentElement.dataset['theme'];
  return chosen === 'dark' || (chosen !== 'light' && SYSTEM.matches);
}

/** Hears when the page may have turned dark or light. */
export function onThemeChange(listener: () => void): void {
  listeners.addEventListener(CHANGED, listener);
  SYSTEM.addEventListener('change', listener);
}
