/** Whether the page is light or dark now. */
import { useEffect, useState } from 'preact/hooks';

/** Follows the system where the page's theme does: `light`, `dark` or `system`. */
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
