/** Serves the built page on a port of its own. */
import { preview } from 'vite';
import { freePort } from '../web/free-port.ts';

/** The server of the page. */
export interface Host {
  readonly url: string;
  close(): Promise<void>;
}

export async function serve(): Promise<Host> {
  const port = await freePort();
  const server = await preview({ preview: { host: '127.0.0.1', port, strictPort: true } });
  return { url: `http://127.0.0.1:${port}/`, close: () => server.close() };
}
