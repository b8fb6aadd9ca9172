/** Links and project files as their senders and receivers use them. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Page, Request } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Link } from '../../www/send/link.ts';
import { readLink } from '../../www/send/link.ts';
import { dropContents } from './page.ts';
import { staticHost } from './static-host.ts';

const DIST = fileURLToPath(new URL('../../dist', import.meta.url));

/** A closed surface in a few lines: an octahedron, stretched to this height. */
function octahedron(height: number): string {
  const vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, height], [0, 0, -height]];
  const faces = [[1, 3, 5], [3, 2, 5], [2, 4, 5], [4, 1, 5], [3, 1, 6], [2, 3, 6], [4, 2, 6], [1, 4, 6]];
  return [...vertices.map((vertex) => `v ${vertex.join(' ')}`), ...faces.map((face) => `f ${face.join(' ')}`), ''].join('\n');
}

const CAT = octahedron(1);
const LION = octahedron(2);
const PAIRS = JSON.stringify({ pairs: [[0, 0], [1, 1], [2, 2], [{ face: 3, barycentric: [0.2, 0.3, 0.5] }, 4]], labels: ['a', 'b', '', 'd'] });

async function open(page: Page, address: string): Promise<void> {
  // An address that differs only behind the `#` would be no new visit.
  await page.goto('about:blank');
  await page.goto(address);
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
}

/** The link of the Share button, and the sentence about its receiver. */
async function share(page: Page): Promise<{ readonly url: string; readonly sentence: string }> {
  await page.getByRole('button', { name: 'Share', exact: true }).click();
  const field = page.locator('#link');
  await expect(field).toHaveValue(/#s=1\./);
  const url = await field.inputValue();
  const sentence = await page.locator('.share p').innerText();
  await page.keyboard.press('Escape');
  return { url, sentence };
}

function linkIn(url: string): Link {
  const reading = readLink(new URL(url).hash, new URL(url));
  if (reading.kind !== 'link') {
    throw new Error(`no link: ${url}`);
  }
  return reading.link;
}

/** Checks that two links have the same content, up to the rounding of cameras. */
function expectSame(one: Link, other: Link): void {
  const still = (link: Link): Link => ({ ...link, work: link.work && { ...link.work, cameras: [null, null] } });
  expect(still(one)).toEqual(still(other));
  for (const side of [0, 1] as const) {
    const [camera, same] = [one, other].map((link) => link.work?.cameras[side] ?? null);
    camera?.forEach((value, index) => {
      expect(same?.[index]).toBeCloseTo(value, 3);
    });
  }
}

/** A host that gives meshes and landmarks to every page; its requests are recorded. */
async function otherHost(page: Page): Promise<Request[]> {
  const asked: Request[] = [];
  const files: Readonly<Record<string, string>> = { '/cat.obj': CAT, '/lion.obj': LION, '/pairs.json': PAIRS };
  await page.route('https://data.example/**', async (route) => {
    asked.push(route.request());
    const body = files[new URL(route.request().url()).pathname];
    await route.fulfill(
      body === undefined
        ? { status: 404, headers: { 'access-control-allow-origin': '*' } }
        : { body, headers: { 'access-control-allow-origin': '*' } },
    );
  });
  return asked;
}

const ADDRESSES = 'source=https://data.example/cat.obj&target=https://data.example/lion.obj&landmarks=https://data.example/pairs.json';

test('an old link opens its demo', async ({ page }) => {
  const demo = 'sphere-tetrahedron';
  await open(page, `/#demo=${demo}`);
  await expect(page.locator('body')).toHaveAttribute('data-demo', demo, { timeout: 60_000 });
  const { url, sentence } = await share(page);
  expect(sentence).toContain('sees everything: meshes, landmarks, options and both views');
  const link = linkIn(url);
  expect(link.demo).toBe(demo);
  expect(link.work?.pairs.length).toBeGreaterThanOrEqual(4);
  await open(page, url);
  await expect(page.locator('body')).toHaveAttribute('data-demo', demo, { timeout: 60_000 });
  expectSame(linkIn((await share(page)).url), link);
});

test('a link reopens landmarks, options, cameras and picture', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await open(page, '/');
  await dropContents(page, [
    { name: 'cat.obj', content: CAT },
    { name: 'lion.obj', content: LION },
    { name: 'pairs.json', content: PAIRS },
  ]);
  await expect(page.locator('#view-source')).toContainText('cat.obj');
  await page.locator('#view-source').focus();
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp', '+']) {
    await page.keyboard.press(key);
  }
  // The page stores a camera when it has come to rest.
  await page.waitForTimeout(2000);
  const { url, sentence } = await share(page);
  expect(sentence).toContain('needs cat.obj and lion.obj as well');
  const sent = linkIn(url);
  expect(sent.work?.cameras[0]).not.toBeNull();
  expect(sent.work?.pairs.map(({ points, label }) => [...points, label])).toEqual([
    [0, 0, 'a'],
    [1, 1, 'b'],
    [2, 2, ''],
    [{ face: 3, barycentric: [0.2, 0.3, 0.5] }, 4, 'd'],
  ]);

  await page.getByRole('button', { name: 'Share', exact: true }).click();
  await page.getByRole('button', { name: 'Copy link' }).click();
  await expect(page.getByRole('button', { name: 'Copied' })).toBeVisible();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(url);

  // A receiver has another browser; another tab is close enough to that.
  page = await context.newPage();
  await open(page, url);
  const notice = page.locator('#link-notice');
  await expect(notice).toContainText('This link needs cat.obj and lion.obj: drop them here.');
  // A file that has only the right name is distinguished from the right one.
  await dropContents(page, [{ name: 'cat.obj', content: octahedron(3) }]);
  await expect(page.locator('#error')).toContainText('cat.obj is not a file of this link. The name fits, but the content differs.');
  await dropContents(page, [{ name: 'renamed.obj', content: LION }]);
  await expect(notice).toContainText('This link needs cat.obj: drop it here.');
  await expect(page.locator('#error')).toBeHidden();
  await dropContents(page, [{ name: 'cat.obj', content: CAT }]);
  await expect(notice).toBeHidden();
  await expect(page.locator('#view-source')).toContainText('cat.obj');
  await expect(page.locator('#view-target')).toContainText('lion.obj');
  // The link is removed from the address, so that a reload does not undo what follows.
  expect(new URL(page.url()).hash).toBe('');
  expectSame(linkIn((await share(page)).url), sent);
});

test('a link to another host asks first, and can be refused', async ({ page }) => {
  const asked = await otherHost(page);
  await open(page, `/#${ADDRESSES}`);
  const notice = page.locator('#link-notice');
  await expect(notice).toContainText('Load cat.obj, lion.obj and pairs.json (3 files) from data.example?');
  await page.waitForTimeout(500);
  expect(asked).toHaveLength(0);
  await notice.getByRole('button', { name: 'Don’t load' }).click();
  await expect(notice).toBeHidden();
  // The page shows what a new visitor sees.
  await expect(page.locator('body')).not.toHaveAttribute('data-demo', '', { timeout: 60_000 });
  expect(asked).toHaveLength(0);
  expect(page.url()).not.toContain('data.example');
});

test('a link to another host brings its meshes after one click, without a word about the visitor', async ({ page, context }) => {
  const asked = await otherHost(page);
  await context.addCookies([{ name: 'secret', value: '1', domain: 'data.example', path: '/', secure: true, sameSite: 'None' }]);
  await open(page, `/#${ADDRESSES}`);
  await page.locator('#link-notice').getByRole('button', { name: 'Load', exact: true }).click();
  await expect(page.locator('#view-source')).toContainText('cat.obj');
  await expect(page.locator('#view-target')).toContainText('lion.obj');
  expect(asked.map((request) => new URL(request.url()).pathname)).toEqual(['/cat.obj', '/lion.obj', '/pairs.json']);
  for (const request of asked) {
    const headers = await request.allHeaders();
    expect(headers['cookie']).toBeUndefined();
    expect(headers['referer']).toBeUndefined();
  }
  // The link can be shared again, and the sentence says what its receiver will see.
  const { url, sentence } = await share(page);
  expect(sentence).toContain('sees everything, after one click that loads the meshes from data.example');
  expect(linkIn(url).work?.pairs).toHaveLength(4);
  await open(page, url);
  await page.locator('#link-notice').getByRole('button', { name: 'Load', exact: true }).click();
  await expect(page.locator('#view-target')).toContainText('lion.obj');
  expectSame(linkIn((await share(page)).url), linkIn(url));
});

test('what cannot be loaded is said in a sentence', { tag: '@long' }, async ({ page }) => {
  await otherHost(page);
  const error = page.locator('#error');
  const loading = async (hash: string): Promise<void> => {
    await open(page, `/${hash}`);
    await page.locator('#link-notice').getByRole('button', { name: 'Load', exact: true }).click();
  };
  await loading('#source=https://data.example/none.obj');
  await expect(error).toContainText('data.example has no none.obj at this address');
  await page.route('https://closed.example/**', async (route) =>
    route.fulfill({ body: CAT, headers: { 'access-control-allow-origin': 'https://someone.example' } }),
  );
  await loading('#source=https://closed.example/cat.obj');
  await expect(error).toContainText('closed.example does not answer, or does not let other pages read cat.obj');
  await page.route('https://moving.example/**', async (route) =>
    route.fulfill({ status: 302, headers: { location: 'https://data.example/cat.obj', 'access-control-allow-origin': '*' } }),
  );
  await loading('#source=https://moving.example/cat.obj');
  await expect(error).toContainText(/moving\.example (redirects cat\.obj|does not answer)/);
  for (const [hash, sentence] of [
    ['#source=http://data.example/cat.obj', 'does not begin with https'],
    ['#s=1.AAAA', 'This link is damaged'],
    ['#s=3.AAAA', 'newer version'],
    ['#demo=there-is-none', 'no demo of that name'],
  ] as const) {
    await open(page, `/${hash}`);
    await expect(error).toContainText(sentence);
  }
});

test('a file that is too large is given up while it comes', async ({ page }) => {
  const megabyte = Buffer.alloc(1_000_000, '# no mesh\n');
  let sent = 0;
  let isOver = false;
  const host = await staticHost(DIST, '/maps/', {
    '/maps/large.obj': (_, response) => {
      response.writeHead(200, { 'content-type': 'text/plain' });
      response.on('close', () => {
        isOver = true;
      });
      const more = (): void => {
        while (!isOver && sent < 1000) {
          sent++;
          if (!response.write(megabyte)) {
            response.once('drain', more);
            return;
          }
        }
        response.end();
      };
      more();
    },
  });
  try {
    await open(page, `${host.address}#source=large.obj`);
    await expect(page.locator('#error')).toContainText('large.obj is larger than 256 MB', { timeout: 120_000 });
    await expect.poll(() => isOver).toBe(true);
    expect(sent).toBeLessThan(500);
  } finally {
    await host.close();
  }
});

test('a project file brings everything back', async ({ page }) => {
  await open(page, '/');
  await dropContents(page, [
    { name: 'cat.obj', content: CAT },
    { name: 'lion.obj', content: LION },
    { name: 'pairs.json', content: PAIRS },
  ]);
  await expect(page.locator('#view-target')).toContainText('lion.obj');
  const { url } = await share(page);
  await page.getByRole('button', { name: 'Share', exact: true }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save project file' }).click();
  const saved = await download;
  expect(saved.suggestedFilename()).toBe('cat and lion.conemap.zip');
  const content = readFileSync(await saved.path());

  // Another tab has a session of its own.
  const other = await page.context().newPage();
  await open(other, '/');
  await expect(other.locator('body')).not.toHaveAttribute('data-demo', '', { timeout: 60_000 });
  await dropContents(other, [{ name: saved.suggestedFilename(), content }]);
  await expect(other.locator('#view-source')).toContainText('cat.obj');
  await expect(other.locator('#view-target')).toContainText('lion.obj');
  expectSame(linkIn((await share(other)).url), linkIn(url));

  await dropContents(other, [{ name: 'broken.conemap.zip', content: content.subarray(0, content.length / 2) }]);
  await expect(other.locator('#error')).toContainText('broken.conemap.zip');
});

test('the picture of the views has twice the pixels of the screen', async ({ page }) => {
  await open(page, '/');
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  const canvas = await page.locator('#canvas').evaluate((element: HTMLCanvasElement) => [element.width, element.height]);
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Picture of the views' }).click();
  const bytes = readFileSync(await (await download).path());
  expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual(canvas.map((side) => 2 * side));
  // A picture of one colour would be much smaller.
  expect(bytes.length).toBeGreaterThan(20_000);
  await expect
    .poll(() => page.locator('#canvas').evaluate((element: HTMLCanvasElement) => [element.width, element.height]))
    .toEqual(canvas);
});

test('the page works from any folder of a host', async ({ page }) => {
  const host = await staticHost(DIST, '/some/sub/path/');
  const failed: string[] = [];
  page.on('requestfailed', (request) => {
    // The address that a run watches is no request to the host.
    if (request.url().startsWith('http')) {
      failed.push(request.url());
    }
  });
  page.on('response', (response) => {
    if (response.status() >= 400) {
      failed.push(response.url());
    }
  });
  try {
    await open(page, host.address);
    await expect(page.locator('body')).not.toHaveAttribute('data-demo', '', { timeout: 60_000 });
    await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
    expect(host.asked.filter((path) => !path.startsWith('/some/sub/path/'))).toEqual([]);
    expect(failed).toEqual([]);
    const { url } = await share(page);
    expect(url.startsWith(`${host.address}#s=1.`)).toBe(true);
  } finally {
    await host.close();
  }
});
