// The web app of `morsel serve` as its user meets it, in Chromium.
import { execFileSync, spawn, type ChildProcess } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
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
} from './support';

const kOdd = `odd/<img src=x onerror=alert(1)>&"'.xyz`;
const kShapes = ['bells/one.xyz', 'bells/two.xyz', 'balls/round.xyz', kOdd];

interface Server {
  process: ChildProcess;
  address: string;
}

let folder: string;
let server: Server;
let browser: Browser;
let complaints: string[] = [];

const morsel = (...args: string[]) => execFileSync(MORSEL, args, { cwd: folder, stdio: 'pipe' });

async function serve(database: string, args: string[] = [], input = ''): Promise<Server> {
  const process = spawn(MORSEL, ['serve', '--database', database, '--port', '0', ...args], {
    cwd: folder,
    stdio: ['pipe', 'pipe', 'inherit'],
  });
  process.stdin!.end(input);
  const greeting = await new Promise<string>((done) =>
    process.stdout!.once('data', (data) => done(String(data))),
  );
  return { process, address: greeting.split(' ')[0] };
}

const stop = (running: Server | undefined) =>
  new Promise<void>((done) => {
    if (!running) return done();
    running.process.once('exit', () => done());
    running.process.kill('SIGTERM');
  });

function ball(count: number): string {
  return Array.from({ length: count }, (_, i) => {
    const z = 1 - (2 * i + 1) / count;
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    const r = Math.sqrt(1 - z * z);
    return `${2 * r * Math.cos(angle)} ${r * Math.sin(angle)} ${z}`;
  }).join('\n');
}

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'morsel-app-'));
  for (const name of ['bells', 'balls', 'odd']) mkdirSync(join(folder, name));
  writeFileSync(join(folder, kShapes[0]), dumbbell(4000));
  writeFileSync(join(folder, kShapes[1]), dumbbell(3000));
  writeFileSync(join(folder, kShapes[2]), ball(2000));
  writeFileSync(join(folder, kShapes[3]), ball(1500));
  writeFileSync(join(folder, 'query.xyz'), dumbbell(3500));
  writeFileSync(join(folder, 'bad.ply'), 'ply\nformat nonsense 1.0\n');
  morsel('index', '--database', 's.db', '--class', 'folder', 'bells', 'balls', 'odd');
  morsel('index', '--database', 'empty.db', kShapes[2]);
  morsel('remove', '--database', 'empty.db', kShapes[2]);
  server = await serve('s.db');
  browser = await chromium.launch({ executablePath: CHROMIUM, args: kArguments });
  countWith(await browser.newPage());
});

afterAll(async () => {
  await browser?.close();
  await stop(server);
  rmSync(folder, { recursive: true });
});

afterEach(() => {
  expect(complaints).toEqual([]);
  complaints = [];
});

async function open(
  page: string,
  options: BrowserContextOptions = {},
  address = server.address,
): Promise<Page> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const tab = await context.newPage();
  tab.setDefaultTimeout(120_000);
  watch(
    tab,
    (url) => url.startsWith(address),
    (text) => complaints.push(text),
  );
  await tab.goto(address + page);
  return tab;
}

const like = (name: string) => `#/like?${new URLSearchParams({ name })}`;
const title = (page: Page, text: RegExp) =>
  page.getByRole('heading', { level: 1, name: text }).waitFor();
const hits = (page: Page) => page.locator('.hits li');
/** Waits until the pictures of all hits are there. */
const pictured = async (page: Page, count: number) => {
  await expect.poll(() => page.locator('.hits canvas').count(), { timeout: 120_000 }).toBe(count);
  await drawn(page);
};
const overflow = (page: Page) =>
  page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

describe('the gallery', () => {
  test('shows all shapes and narrows them', async () => {
    const page = await open('');
    await title(page, /4 shapes in s\.db/);
    await expect.poll(() => page.locator('.tile').count()).toBe(4);
    await expect
      .poll(() =>
        page
          .locator('.tile img')
          .evaluateAll((images) =>
            images.every((image) => (image as HTMLImageElement).naturalWidth === 192),
          ),
      )
      .toBe(true);
    const picture = await colorsOf(await page.locator('.tile img').nth(1).screenshot());
    expect(picture.green + picture.yellow).toBeGreaterThan(0.05);
    await page.getByRole('searchbox', { name: 'Name, class or tag has' }).fill('ONE.X');
    await expect.poll(() => page.locator('.tile').count()).toBe(1);
    await page.getByRole('searchbox').fill('nothing has this');
    await page.getByText('No shape has this').waitFor();
    await page.getByRole('searchbox').fill('');
    await page.getByRole('combobox', { name: 'Class' }).selectOption('=bells');
    await expect.poll(() => page.locator('.tile').count()).toBe(2);
    await page.context().close();
  });

  test('an empty database says how to fill it', async () => {
    const empty = await serve('empty.db');
    const page = await open('', {}, empty.address);
    await page.getByText('morsel index --database empty.db').waitFor();
    await page.goto(`${empty.address}#/pairs`);
    await title(page, /All pairs/);
    await page.context().close();
    await stop(empty);
  });
});

describe('look-alikes', () => {
  test('a click on a shape shows its look-alikes in one pose and colours', async () => {
    const page = await open('');
    await page.getByRole('link', { name: 'one.xyz' }).click();
    await title(page, /Look-alikes of bells\/one\.xyz/);
    await pictured(page, 3);
    expect(await hits(page).first().textContent()).toMatch(/bells\/two\.xyz.*0\.\d\d/);
    const query = await colorsOf(await page.locator('.query canvas').screenshot());
    const best = await colorsOf(await hits(page).first().locator('canvas').screenshot());
    for (const colors of [query, best]) {
      expect(colors.green).toBeGreaterThan(0.02);
      expect(colors.yellow).toBeGreaterThan(0.02);
    }
    // The same way round: green on the same side of yellow.
    const side = (c: typeof query) => Math.sign(c.greenAt[0] - c.yellowAt[0]);
    expect(side(best)).toBe(side(query));
    await page.context().close();
  });

  test('dragging one picture, or the arrow keys, turn all', async () => {
    const page = await open(like(kShapes[0]));
    await pictured(page, 3);
    const canvas = hits(page).first().locator('canvas');
    const before = await colorsOf(await canvas.screenshot());
    const box = (await page.locator('.query canvas').boundingBox())!;
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 190, box.y + 100, { steps: 3 });
    await page.mouse.up();
    await drawn(page);
    const turned = await colorsOf(await canvas.screenshot());
    expect(Math.abs(turned.greenAt[0] - before.greenAt[0])).toBeGreaterThan(3);
    await page.locator('.query canvas').focus();
    await page.keyboard.press('0');
    await drawn(page);
    const back = await colorsOf(await canvas.screenshot());
    expect(back.greenAt[0]).toBeCloseTo(before.greenAt[0], 0);
    await page.context().close();
  });

  test('a match can be followed, and says why', async () => {
    const page = await open(like(kShapes[0]));
    await hits(page).first().getByRole('link', { name: /^Why/ }).click();
    await title(page, /Why bells\/one\.xyz and bells\/two\.xyz score 0\.\d\d/);
    await page.getByText(/two shapes that have nothing to do with each other/).waitFor();
    expect(await page.getByRole('table', { name: 'Measures' }).getByRole('row').count()).toBe(5);
    const parts = page.getByRole('table', { name: 'Parts' });
    expect(await parts.textContent()).toMatch(/\+adds.*lies on part/);
    await page.getByRole('link', { name: 'Look-alikes of bells/two.xyz', exact: true }).click();
    await title(page, /Look-alikes of bells\/two\.xyz/);
    await page.context().close();
  });

  test('its parts open in the viewer', async () => {
    const page = await open(like(kShapes[0]));
    await page.getByRole('link', { name: 'Look at its parts' }).click();
    const slider = page.getByRole('slider', { name: 'How many parts' });
    await slider.waitFor();
    expect(await slider.count()).toBe(1);
    expect(await page.getByText(/Drawn with .* of .* points/).count()).toBe(1);
    await drawn(page);
    const colors = await colorsOf(await page.locator('.stage').screenshot());
    expect(colors.green).toBeGreaterThan(0.02);
    await page.mouse.click(...(colors.greenAt.map((x, i) => x + [0, 56][i]) as [number, number]));
    await expect
      .poll(() => page.getByRole('region', { name: 'Selected part' }).isVisible())
      .toBe(true);
    await page.goBack();
    await title(page, /Look-alikes of/);
    await page.context().close();
  });

  test('any name is text and no markup', async () => {
    const page = await open(like(kOdd));
    await pictured(page, 3);
    expect(await page.getByRole('heading', { level: 1 }).textContent()).toBe(
      `Look-alikes of ${kOdd}`,
    );
    await page.context().close();
  });

  test('an unknown shape is named in plain words', async () => {
    const page = await open(like('nobody'));
    expect(await page.getByRole('alert').textContent()).toMatch(/no shape called nobody/);
    expect(complaints.splice(0).every((text) => /404/.test(text))).toBe(true);
    await page.context().close();
  });
});

describe('files', () => {
  test('a chosen file is segmented and looked up', async () => {
    const page = await open('');
    await page.locator('input[type=file]').setInputFiles(join(folder, 'query.xyz'));
    await title(page, /Look-alikes of query\.xyz/);
    await pictured(page, 4);
    expect(await hits(page).first().textContent()).toMatch(/bells\//);
    await page.getByRole('link', { name: 'Look at its parts' }).click();
    await page.getByRole('slider', { name: 'How many parts' }).waitFor();
    await page.context().close();
  });

  test('a dropped file too', async () => {
    const page = await open('');
    await title(page, /shapes in/);
    const data = await page.evaluateHandle((text) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], 'dropped.xyz'));
      return transfer;
    }, dumbbell(2500));
    await page.dispatchEvent('main', 'dragover', { dataTransfer: data });
    expect(await page.locator('body.dropping').count()).toBe(1);
    await page.dispatchEvent('main', 'drop', { dataTransfer: data });
    await title(page, /Look-alikes of dropped\.xyz/);
    expect(await page.locator('body.dropping').count()).toBe(0);
    await page.context().close();
  });

  test('a bad file is explained', async () => {
    const page = await open('');
    await page.locator('input[type=file]').setInputFiles(join(folder, 'bad.ply'));
    await title(page, /bad\.ply/);
    await expect.poll(() => page.getByRole('alert').count()).toBe(1);
    expect(await page.getByRole('alert').textContent()).toMatch(/^bad\.ply:.*format/);
    await page.context().close();
  });

  test('long work shows how far it is and can be cancelled', async () => {
    const page = await open('');
    writeFileSync(join(folder, 'large.xyz'), dumbbell(120_000));
    await page.locator('input[type=file]').setInputFiles(join(folder, 'large.xyz'));
    await page.getByRole('progressbar').waitFor();
    await page.getByRole('button', { name: 'Cancel' }).click();
    await page.getByText('You cancelled this file.').waitFor();
    await page.context().close();
  });
});

describe('all pairs', () => {
  test('a heat map to order and to pick pairs from', async () => {
    const page = await open('#/pairs');
    const map = page.getByRole('application');
    await map.waitFor();
    const bright = await colorsOf(await map.screenshot());
    expect(bright.yellow).toBeGreaterThan(0.15); // the diagonal at least
    await map.click({ position: { x: 160, y: 150 } });
    await page.getByRole('link', { name: 'Compare the two' }).waitFor();
    await map.focus();
    for (const key of ['ArrowUp', 'ArrowUp', 'ArrowUp', 'ArrowUp', 'ArrowLeft', 'ArrowLeft']) {
      await page.keyboard.press(key);
    }
    for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowLeft');
    expect(await map.getAttribute('aria-description')).toMatch(/1\.00, the same/);
    for (const order of ['name', 'similarity', 'class']) {
      await page.getByRole('combobox', { name: 'Order by' }).selectOption(order);
      await map.waitFor();
    }
    await map.focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await title(page, /^Why .* and .* score/);
    await page.context().close();
  });
});

describe('the whole', () => {
  test('works with the keyboard alone', async () => {
    const page = await open('');
    await title(page, /shapes in/);
    await page.getByRole('searchbox').focus();
    await page.keyboard.type('two');
    await expect.poll(() => page.locator('.tile').count()).toBe(1);
    await page.keyboard.press('Tab');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await title(page, /Look-alikes of bells\/two\.xyz/);
    expect(await page.evaluate(() => document.activeElement?.tagName)).toBe('H1');
    await page.context().close();
  });

  test('light and dark', async () => {
    const page = await open('', { colorScheme: 'dark' });
    await title(page, /shapes in/);
    expect((await colorsOf(await page.screenshot())).dark).toBeGreaterThan(0.3);
    await page.getByRole('button', { name: 'Light' }).click();
    expect((await colorsOf(await page.screenshot())).light).toBeGreaterThan(0.5);
    await page.context().close();
  });

  test('asks for the token, or takes it from the address', async () => {
    const token = 'correct-horse-battery';
    const locked = await serve('s.db', ['--token', '-'], `${token}\n`);
    const page = await open('', {}, locked.address);
    await page.getByLabel('Token').fill('wrong-wrong-wrong-wrong');
    await page.getByRole('button', { name: 'Enter' }).click();
    expect(await page.getByRole('alert').textContent()).toMatch(/not the token/);
    await page.getByLabel('Token').fill(token);
    await page.getByRole('button', { name: 'Enter' }).click();
    await title(page, /4 shapes/);
    await page.context().close();
    const other = await open(`#token=${token}`, {}, locked.address);
    await title(other, /4 shapes/);
    expect(other.url()).not.toContain(token);
    await other.context().close();
    expect(complaints.splice(0).filter((text) => !/401/.test(text))).toEqual([]);
    await stop(locked);
  });

  test.each(['', like(kShapes[0]), '#/pairs'])('fits a phone: %s', async (path) => {
    const page = await open(path, { viewport: { width: 390, height: 844 }, hasTouch: true });
    await page.locator('.tile, .hits canvas, canvas.heat').first().waitFor();
    expect(await overflow(page)).toBe(0);
    await page.context().close();
  });

  const compare = `#/compare?${new URLSearchParams({ name: kShapes[0], with: kShapes[2] })}`;
  test.each([
    ['', 'light', 1280],
    ['', 'dark', 390],
    [like(kShapes[0]), 'light', 390],
    [like(kShapes[0]), 'dark', 1280],
    [compare, 'light', 1280],
    [compare, 'dark', 390],
    ['#/pairs', 'light', 1280],
    [`#/parts?name=${kShapes[0]}`, 'light', 1280],
    [like('nobody'), 'light', 1280],
  ] as const)('axe finds nothing: %s, %s, %i pixels', async (path, colorScheme, width) => {
    const page = await open(path, {
      colorScheme,
      viewport: { width, height: 844 },
      bypassCSP: true,
    });
    await page.getByRole('heading', { level: 1 }).waitFor();
    await page.locator('.tile, .hits canvas, canvas, .notice').first().waitFor();
    expect(await violationsOf(page)).toEqual([]);
    complaints = complaints.filter((text) => !/404/.test(text));
    await page.context().close();
  });
});
