/** Whether the page is light or dark now. */
import { useEffect, useState } from 'preact/hooks';

/** Whether the page is dark, by its theme `light`, `dark` or `system`; with `system` it follows the operating system. */
export function useDarkness(theme: string): boolean {
  const query = window.matchMedia('(prefers-color-scheme: dark)');
  const [isDark, setDark] = useState(query.matches);
  useEffect(() => {
    const told = (): void => {
      setDark(query.matches);
    };
    query.addEventListener('change', told);
    return () => {
      query.removeEventListener('change', told);
    };
  }, []);
  return theme === 'dark' || (theme !== 'light' && isDark);
}
