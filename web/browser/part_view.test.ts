// A page as its user meets it: written by the program, opened from the disk in Chromium.
// MORSEL names the program, CHROMIUM the browser; tests/viewer/CMakeLists.txt sets both.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import {
  CHROMIUM,
  MORSEL,
  colorsOf,
  countWith,
  drawn,
  dumbbell,
  kArguments,
  violationsOf,
  watch,
  type Colors,
} from './support';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';

const kName = `<img src=x onerror=alert(1)>&"'\u202e.xyz`;
let folder: string;
let address: string;
let browser: Browser;
let complaints: string[] = [];

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'morsel-viewer-'));
  const input = join(folder, kName);
  const page = join(folder, 'parts.html');
  writeFileSync(input, dumbbell(6000));
  execFileSync(MORSEL, ['segment', input, '--parts', '2', '--html', page], { stdio: 'pipe' });
  address = pathToFileURL(page).href;
  browser = await chromium.launch({ executablePath: CHROMIUM, args: kArguments });
  countWith(await browser.newPage());
});

afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

afterEach(() => {
  expect(complaints).toEqual([]);
  complaints = [];
});

/** `first` runs in the page before its own script. */
async function open(options: BrowserContextOptions = {}, first = () => {}): Promise<Page> {
  const context = await browser.newContext({
    viewport: { width: 960, height: 640 },
    ...options,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  watch(
    page,
    (url) => /^(file|blob|data):/.test(url),
    (text) => complaints.push(text),
  );
  await page.addInitScript(first);
  await page.goto(address);
  await drawn(page);
  return page;
}

const stageOf = (page: Page) => page.locator('.stage');
const canvasOf = (page: Page) => page.getByRole('application');
const cardOf = (page: Page) => page.getByRole('region', { name: 'Selected part' });
const sliderOf = (page: Page) => page.getByRole('slider', { name: 'How many parts' });
const partsShown = (page: Page) => page.locator('output').textContent();

const pictureOf = async (page: Page) => colorsOf(await stageOf(page).screenshot());

describe('the page', () => {
  test('shows both parts in their colours', async () => {
    const page = await open();
    expect(await page.title()).toBe(`${kName} – morsel`);
    expect(await page.getByRole('heading', { level: 1 }).textContent()).toBe(kName);
    expect(await partsShown(page)).toBe('2');
    const colors = await pictureOf(page);
    expect(colors.green).toBeGreaterThan(0.03);
    expect(colors.yellow).toBeGreaterThan(0.03);
    expect(colors.light).toBeGreaterThan(0.4);
    expect(Math.abs(colors.greenAt[0] - colors.yellowAt[0])).toBeGreaterThan(200);
    await page.context().close();
  });

  test('lets no script in', async () => {
    const page = await open();
    const ran = await page.evaluate(() => {
      try {
        const script = document.createElement('script');
        script.text = 'window.hacked = true';
        document.body.append(script);
        document.body.setAttribute('onclick', 'window.hacked = true');
        document.body.click();
      } catch {
        // What the policy forbids may throw.
      }
      return 'hacked' in window;
    });
    expect(ran).toBe(false);
    // The browser says so on the console.
    expect(complaints.length).toBeGreaterThan(0);
    expect(complaints.every((text) => /Content Security Policy|Trusted/i.test(text))).toBe(true);
    complaints = [];
    await page.context().close();
  });
});

describe('with the pointer', () => {
  test('a click on a part shows its measures, another on it closes them', async () => {
    const page = await open();
    const { greenAt, yellowAt } = await pictureOf(page);
    await page.mouse.move(...yellowAt);
    await expect.poll(() => page.locator('.tip').textContent()).toMatch(/^Part 1: \d+% of the/);
    await page.mouse.click(...yellowAt);
    const card = cardOf(page);
    await expect.poll(() => card.getByRole('heading').textContent()).toBe('Part 1');
    expect(await card.textContent()).toMatch(/Volume\d+% of the shape.*Thickness\d.*Touches0/);
    await card.getByRole('button', { name: 'Part 0' }).click();
    expect(await card.getByRole('heading').textContent()).toBe('Part 0');
    await page.mouse.click(...greenAt);
    await expect.poll(() => card.isVisible()).toBe(false);
    await page.context().close();
  });

  test('dragging turns the shape and selects nothing', async () => {
    const page = await open();
    const before = await pictureOf(page);
    await page.mouse.move(...before.greenAt);
    await page.mouse.down();
    await page.mouse.move(before.greenAt[0] + 250, before.greenAt[1] + 20, { steps: 4 });
    await page.mouse.up();
    await drawn(page);
    const after = await pictureOf(page);
    expect(Math.abs(after.greenAt[0] - before.greenAt[0])).toBeGreaterThan(20);
    expect(await cardOf(page).isVisible()).toBe(false);
    await page.getByRole('button', { name: 'First view' }).click();
    await drawn(page);
    expect((await pictureOf(page)).greenAt[0]).toBeCloseTo(before.greenAt[0], 0);
    await page.context().close();
  });

  test('parts hide, stand alone and come back', async () => {
    const page = await open();
    await page.getByRole('checkbox', { name: 'Show part 0' }).uncheck();
    await drawn(page);
    expect((await pictureOf(page)).green).toBeLessThan(0.001);
    await page.getByRole('button', { name: 'Show all' }).click();
    await page.getByRole('button', { name: 'Part 0', exact: true }).click();
    await cardOf(page).getByRole('button', { name: 'Only this' }).click();
    await drawn(page);
    const alone = await pictureOf(page);
    expect(alone.green).toBeGreaterThan(0.02);
    expect(alone.yellow).toBeLessThan(0.001);
    await page.context().close();
  });

  test('parts are pulled apart', async () => {
    const page = await open();
    const before = await pictureOf(page);
    await page.getByLabel('Pull apart').fill('100');
    await drawn(page);
    const after = await pictureOf(page);
    const gap = (c: Colors) => Math.abs(c.greenAt[0] - c.yellowAt[0]);
    // Farther apart, measured by their size, as the camera steps back.
    expect(gap(after) / Math.sqrt(after.green)).toBeGreaterThan(
      1.3 * (gap(before) / Math.sqrt(before.green)),
    );
    await page.context().close();
  });
});

describe('the slider', () => {
  test('walks from one part to all and back', async () => {
    const page = await open();
    const slider = sliderOf(page);
    await slider.focus();
    await page.keyboard.press('Home');
    expect(await partsShown(page)).toBe('1');
    expect(await slider.getAttribute('aria-valuetext')).toBe('1 part');
    await drawn(page);
    expect((await pictureOf(page)).yellow).toBeLessThan(0.001);
    const counts = [1];
    for (let i = 0; i < 3; ++i) {
      await page.keyboard.press('ArrowRight');
      counts.push(Number(await partsShown(page)));
    }
    expect(counts).toEqual([...counts].sort((a, b) => a - b));
    expect(counts[1]).toBe(2);
    await page.keyboard.press('End');
    const all = Number(await partsShown(page));
    expect(all).toBeGreaterThanOrEqual(counts[3]);
    expect(await page.locator('tbody tr').count()).toBe(Math.min(all, 100));
    await page.getByRole('button', { name: 'Back to 2 parts' }).click();
    expect(await partsShown(page)).toBe('2');
    await page.context().close();
  });
});

describe('with the keyboard alone', () => {
  test('turns, zooms, selects, hides and cuts', async () => {
    const page = await open();
    const before = await pictureOf(page);
    await page.keyboard.press('Tab');
    expect(await canvasOf(page).evaluate((canvas) => canvas === document.activeElement)).toBe(true);
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowRight');
    await drawn(page);
    const turned = await pictureOf(page);
    expect(Math.abs(turned.greenAt[0] - before.greenAt[0])).toBeGreaterThan(10);
    await page.keyboard.press('0');
    await page.keyboard.press('+');
    await page.keyboard.press('+');
    await drawn(page);
    expect((await pictureOf(page)).green).toBeGreaterThan(1.2 * before.green);
    await page.keyboard.press('n');
    await page.keyboard.press('n');
    expect(await cardOf(page).getByRole('heading').textContent()).toBe('Part 1');
    expect(await page.locator('[aria-live]').textContent()).toMatch(/^Part 1: \d+% of the volume/);
    await page.keyboard.press('h');
    expect(await page.getByRole('checkbox', { name: 'Show part 1' }).isChecked()).toBe(false);
    await page.keyboard.press('a');
    await page.keyboard.press('Escape');
    expect(await cardOf(page).isVisible()).toBe(false);
    await page.keyboard.press('[');
    expect(await partsShown(page)).toBe('1');
    await page.context().close();
  });
});

describe('what stands for the parts', () => {
  test('balls, ellipsoids and lines are drawn in the colours of the parts', async () => {
    const page = await open();
    for (const form of ['Balls', 'Ellipsoids']) {
      await page.getByRole('radio', { name: form }).check();
      await drawn(page);
      const colors = await pictureOf(page);
      expect(colors.green, form).toBeGreaterThan(0.02);
      expect(colors.yellow, form).toBeGreaterThan(0.02);
      await page.mouse.click(...colors.yellowAt);
      expect(await cardOf(page).getByRole('heading').textContent()).toBe('Part 1');
      await page.keyboard.press('Escape');
    }
    await page.getByRole('radio', { name: 'Surface' }).check();
    await page.getByRole('checkbox', { name: 'Lines between parts' }).check();
    await drawn(page);
    const lines = await pictureOf(page);
    expect(lines.green).toBeGreaterThan(0.0002);
    expect(lines.green).toBeLessThan(0.05);
    await page.context().close();
  });
});

describe('frames', () => {
  interface Work {
    points: number; // draws of points, one a frame
    rest: number; // all other draws
    bytes: number; // handed to the graphics card
  }

  // Counts what the page asks of WebGL, from its first line on.
  const count = () => {
    const work: Work = { points: 0, rest: 0, bytes: 0 };
    const gl = WebGL2RenderingContext.prototype;
    const tell = (names: string[], told: (args: unknown[]) => void) => {
      for (const name of names) {
        const methods = gl as unknown as Record<string, (...args: unknown[]) => unknown>;
        const method = methods[name];
        methods[name] = function (this: unknown, ...args: unknown[]) {
          told(args);
          return method.apply(this, args);
        };
      }
    };
    tell(['drawArrays'], () => (work.points += 1));
    tell(['drawElements', 'drawArraysInstanced', 'drawElementsInstanced'], () => (work.rest += 1));
    tell(['bufferData', 'bufferSubData', 'texImage2D', 'texSubImage2D'], (args) => {
      work.bytes += args.find(ArrayBuffer.isView)?.byteLength ?? 0;
    });
    Object.assign(window, { work });
  };
  const workOf = (page: Page) =>
    page.evaluate(() => ({ ...(window as unknown as { work: Work }).work }));
  /** What is asked for during the next 20 frames of the browser. */
  const workWhile20Frames = async (page: Page): Promise<Work> => {
    const before = await workOf(page);
    for (let i = 0; i < 10; ++i) await drawn(page);
    const after = await workOf(page);
    return {
      points: after.points - before.points,
      rest: after.rest - before.rest,
      bytes: after.bytes - before.bytes,
    };
  };

  test('are drawn only when something changes, and carry nothing but what changed', async () => {
    const page = await open({}, count);
    const still = { points: 0, rest: 0, bytes: 0 };
    await expect.poll(() => workWhile20Frames(page)).toEqual(still);
    const begin = await workOf(page);
    expect(begin.bytes).toBeGreaterThan(16 * 4000); // the points themselves

    await canvasOf(page).focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(async () => (await workOf(page)).points).toBeGreaterThan(begin.points);
    await expect.poll(() => workWhile20Frames(page)).toEqual(still);
    const turned = await workOf(page);
    // A frame is one draw of all points and one of the last pass.
    expect(turned.rest - begin.rest).toBe(turned.points - begin.points);
    expect(turned.bytes).toBe(begin.bytes);

    await page.keyboard.press('[');
    await expect.poll(async () => (await workOf(page)).points).toBeGreaterThan(turned.points);
    await expect.poll(() => workWhile20Frames(page)).toEqual(still);
    // Another cut is a small table, whatever the number of points.
    expect((await workOf(page)).bytes - turned.bytes).toBeLessThan(64 * 1024);
    await page.context().close();
  });
});

describe('pictures and looks', () => {
  test('the saved picture shows what the page shows', async () => {
    const page = await open();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save picture' }).click(),
    ]);
    expect(download.suggestedFilename()).toMatch(/^[\w.-]+-2-parts\.png$/);
    const saved = await colorsOf(readFileSync((await download.path())!));
    const shown = await pictureOf(page);
    expect([saved.width, saved.height]).toEqual([shown.width, shown.height]);
    expect(saved.green).toBeCloseTo(shown.green, 2);
    expect(saved.yellow).toBeCloseTo(shown.yellow, 2);
    await page.context().close();
  });

  test('light and dark follow the system and the button', async () => {
    const page = await open({ colorScheme: 'dark' });
    expect((await pictureOf(page)).dark).toBeGreaterThan(0.4);
    await page.getByRole('button', { name: 'Light' }).click();
    await drawn(page);
    expect((await pictureOf(page)).light).toBeGreaterThan(0.4);
    await page.context().close();
  });

  test('fits a phone', async () => {
    const page = await open({ viewport: { width: 390, height: 844 }, hasTouch: true });
    const overflow = await page.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
    );
    expect(overflow).toBe(0);
    const colors = await pictureOf(page);
    expect(colors.width).toBe(390);
    expect(colors.green).toBeGreaterThan(0.02);
    await page.touchscreen.tap(...colors.yellowAt);
    await expect.poll(() => cardOf(page).isVisible()).toBe(true);
    await page.context().close();
  });

  test('says so when there is no 3D', async () => {
    const plain = await chromium.launch({
      executablePath: CHROMIUM,
      args: ['--no-sandbox', '--no-first-run', '--disable-gpu', '--disable-3d-apis'],
    });
    const page = await plain.newPage();
    await page.goto(address);
    expect(await page.getByRole('alert').textContent()).toMatch(/no 3D/);
    expect(await page.locator('tbody tr').count()).toBe(2);
    await plain.close();
  });
});

describe('accessibility', () => {
  test.each([
    ['light', 1280],
    ['dark', 390],
  ] as const)('axe finds nothing: %s, %i pixels', async (colorScheme, width) => {
    const page = await open({ colorScheme, viewport: { width, height: 844 }, bypassCSP: true });
    await page.getByRole('button', { name: 'Part 0', exact: true }).click();
    await page.getByText('What is this?').click();
    await sliderOf(page).fill('0');
    expect(await violationsOf(page)).toEqual([]);
    await page.context().close();
  });
});
