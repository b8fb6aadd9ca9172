/** Drives Firefox and Chromium by WebDriver BiDi. */
import type { LaunchOptions } from 'puppeteer-core';
import puppeteer from 'puppeteer-core';
import type { Browser, Launcher } from './browser.ts';
import { firstOf } from './browser.ts';

async function begin(options: LaunchOptions): Promise<Browser> {
  const driver = await puppeteer.launch(options);
  const page = await driver.newPage();
  await page.setViewport({ width: 1280, height: 800 });
  return {
    open: async (url) => {
      // An address that differs only behind the `#` would not load the page again.
      await page.goto('about:blank');
      await page.goto(url);
    },
    reload: async () => {
      await page.reload();
    },
    evaluate: (body) => page.evaluate(`(() => { ${body} })()`),
    click: (selector) => page.click(selector),
    pressWithControl: async (letter) => {
      await page.keyboard.down('Control');
      await page.keyboard.press(letter as 'z');
      await page.keyboard.up('Control');
    },
    close: () => driver.close(),
  };
}

/** Firefox. Without a graphics card it has no WebGL 2 when it is headless, but has it with a window. */
function firefox(name: string, headless: boolean): Launcher {
  return {
    name,
    program: firstOf([process.env['FIREFOX'], '/usr/bin/firefox-esr', '/usr/bin/firefox']),
    begin: (executablePath) =>
      begin({
        browser: 'firefox',
        executablePath,
        headless,
        extraPrefsFirefox: headless
          ? { 'webgl.disabled': true }
          : { 'webgl.force-enabled': true, 'webgl.out-of-process': false },
      }),
  };
}

export const FIREFOX = firefox('Firefox', false);
export const FIREFOX_WITHOUT_WEBGL = firefox('Firefox without WebGL 2', true);

export const CHROMIUM: Launcher = {
  name: 'Chromium',
  program: firstOf([process.env['CHROMIUM'], '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']),
  begin: (executablePath) =>
    begin({
      browser: 'chrome',
      executablePath,
      headless: true,
      args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
    }),
};
