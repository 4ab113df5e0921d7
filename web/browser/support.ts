// What the browser tests share: the browser, a shape of two parts, colours on the screen, axe.
// MORSEL names the program, CHROMIUM the browser; tests/viewer/CMakeLists.txt sets both.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';

export const { MORSEL = 'morsel', CHROMIUM = '/usr/bin/chromium' } = process.env;
export const kArguments = [
  '--no-sandbox',
  '--no-first-run',
  '--disable-quic',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

// Two balls and a bar between them, evenly spread; the right ball is the larger.
export function dumbbell(count: number): string {
  const lines: string[] = [];
  for (let i = 0; i < count; ++i) {
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(1 - z * z);
    const [x, y] = [r * Math.cos(angle), r * Math.sin(angle)];
    const [center, radius] = i % 2 === 0 ? [-2, 1] : [2.1, 1.15];
    if (i % 10 === 0) {
      lines.push(`${1.1 * z} ${0.3 * Math.cos(angle)} ${0.3 * Math.sin(angle)}`);
    } else if (x * center > 0 || radius * Math.hypot(y, z) > 0.3) {
      lines.push(`${center + radius * x} ${radius * y} ${radius * z}`);
    }
  }
  return lines.join('\n');
}

/** Waits until what was asked for is on the screen, however slow the machine: not coarsely either. */
export async function drawn(page: Page): Promise<void> {
  const isDrawn = () =>
    page.evaluate(
      () =>
        new Promise<boolean>((tell) => {
          const look = () => tell(document.querySelector('[data-coarse]') === null);
          requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(look, 100)));
        }),
    );
  while (!(await isDrawn())) continue;
}

let counter: Page; // counts colours

/** Colours are counted in a page of its own. */
export const countWith = (page: Page) => (counter = page);

export interface Colors {
  width: number;
  height: number;
  /** Shares of the pixels. */
  green: number;
  yellow: number;
  dark: number;
  light: number;
  /** Where each colour lies on average, pixels. */
  greenAt: [number, number];
  yellowAt: [number, number];
}

// The first two colours of the palette in a PNG.
export async function colorsOf(png: Buffer): Promise<Colors> {
  return counter.evaluate(
    async (data) => {
      const image = new Image();
      image.src = data;
      await image.decode();
      const { width, height } = image;
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const { data: rgba } = context.getImageData(0, 0, width, height);
      const sums = { green: [0, 0, 0], yellow: [0, 0, 0], dark: [0, 0, 0], light: [0, 0, 0] };
      for (let i = 0; i < rgba.length; i += 4) {
        const [r, g, b] = rgba.subarray(i, i + 3);
        const name =
          g > 60 && r < 0.45 * g && b > 0.5 * g
            ? 'green'
            : g > 60 && r > 0.85 * g && b < 0.6 * g
              ? 'yellow'
              : r + g + b < 180
                ? 'dark'
                : r + g + b > 700
                  ? 'light'
                  : null;
        if (name === null) continue;
        sums[name][0] += 1;
        sums[name][1] += (i / 4) % width;
        sums[name][2] += Math.floor(i / 4 / width);
      }
      const share = ([count]: number[]) => count / (width * height);
      const place = ([count, x, y]: number[]): [number, number] => [x / count, y / count];
      return {
        width,
        height,
        green: share(sums.green),
        yellow: share(sums.yellow),
        dark: share(sums.dark),
        light: share(sums.light),
        greenAt: place(sums.green),
        yellowAt: place(sums.yellow),
      };
    },
    `data:image/png;base64,${png.toString('base64')}`,
  );
}

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core'), 'utf8');

/** What axe finds wrong; the page's context must bypass its content-security policy. */
export async function violationsOf(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { axe } = window as unknown as { axe: typeof import('axe-core') };
    const found = await axe.run();
    return found.violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`);
  });
}

/** Complains of whatever a page logs, throws, asks or requests that is not its own. */
export function watch(
  page: Page,
  isOwn: (url: string) => boolean,
  complain: (text: string) => void,
): void {
  page.on('console', (message) => complain(message.text()));
  page.on('pageerror', (error) => complain(String(error)));
  page.on('dialog', (dialog) => complain(`dialog: ${dialog.message()}`));
  page.on('request', (request) => {
    if (!isOwn(request.url())) complain(request.url());
  });
}
