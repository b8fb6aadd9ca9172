import { createServer } from 'node:net';

/** The number of a free port. */
export async function freePort(): Promise<number> {
  return new Promise((resolve, reject) => {
    const server = createServer();
    server.once('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const address = server.address();
      server.close(() => {
        if (address === null || typeof address === 'string') {
          reject(new Error('no free port'));
        } else {
          resolve(address.port);
        }
      });
    });
  });
}
