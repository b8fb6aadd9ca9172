/** Drives WebKitGTK's MiniBrowser by WebDriver. */
import { spawn } from 'node:child_process';
import { Builder, By, Key } from 'selenium-webdriver';
import type { Browser, Launcher } from './browser.ts';
import { firstOf } from './browser.ts';
import { freePort } from '../web/free-port.ts';

const DRIVER = '/usr/bin/WebKitWebDriver';
const FOLDERS = ['x86_64-linux-gnu', 'aarch64-linux-gnu'].flatMap((platform) =>
  ['4.1', '6.0', '4.0'].map((version) => `/usr/lib/${platform}/webkit2gtk-${version}/MiniBrowser`),
);

async function begin(binary: string): Promise<Browser> {
  const port = await freePort();
  const server = spawn(DRIVER, [`--port=${port}`], { stdio: 'ignore' });
  const driver = await new Builder()
    .usingServer(`http://127.0.0.1:${port}`)
    .withCapabilities({ browserName: 'MiniBrowser', 'webkitgtk:browserOptions': { binary, args: ['--automation'] } })
    .build();
  await driver.manage().setTimeouts({ script: 120_000, pageLoad: 120_000 });
  await driver.manage().window().setRect({ width: 1280, height: 800, x: 0, y: 0 });
  return {
    open: async (url) => {
      await driver.get('about:blank');
      await driver.get(url);
    },
    reload: () => driver.navigate().refresh(),
    evaluate: (body) =>
      driver.executeAsyncScript(
        `const done = arguments[arguments.length - 1];
         Promise.resolve((() => { ${body} })()).then(done, (thrown) => done({ thrown: String(thrown) }));`,
      ),
    click: async (selector) => {
      await driver.findElement(By.css(selector)).click();
    },
    pressWithControl: async (letter) => {
      await driver.actions().keyDown(Key.CONTROL).sendKeys(letter).keyUp(Key.CONTROL).perform();
    },
    close: async () => {
      await driver.quit();
      server.kill();
    },
  };
}

export const WEBKIT: Launcher = {
  name: 'WebKit',
  program: firstOf([DRIVER]) === null ? null : firstOf(FOLDERS),
  begin,
};
