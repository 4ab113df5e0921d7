// A table of scores as coloured squares on a canvas.
import { make } from '../ui/dom';
import { scoreOf } from './order';
import type { Matrix } from './api';
import { splitName } from './words';

export interface Layout {
  /** Side of a square and where the first one begins, CSS pixels. */
  cell: number;
  left: number;
  top: number;
}

// Even steps of lightness, told apart by colour-blind people too (after "viridis").
const kRamp = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

// Of a score, 0 dark and 1 bright; 0 … 255 a channel.
function heat(score: number): number[] {
  const at = Math.max(0, Math.min(1, score)) * (kRamp.length - 1);
  const i = Math.min(kRamp.length - 2, Math.floor(at));
  return kRamp[i].map((from, k) => Math.round(from + (at - i) * (kRamp[i + 1][k] - from)));
}

/** The same as CSS. */
export const heatColor = (score: number) => `rgb(${heat(score).join(' ')})`;

/** The table with one pixel a pair. */
export function paint(matrix: Matrix, order: readonly number[]): HTMLCanvasElement {
  const count = order.length;
  const canvas = make('canvas', { width: count, height: count });
  if (count === 0) return canvas;
  const image = new ImageData(count, count);
  const colors = Uint8ClampedArray.from(
    Array.from({ length: 256 }, (_, i) => [...heat(i / 255), 255]).flat(),
  );
  const [of, to] = [colors, image.data].map(({ buffer }) => new Uint32Array(buffer));
  order.forEach((i, row) =>
    order.forEach((j, column) => {
      const score = Math.max(0, Math.min(1, scoreOf(matrix, i, j)));
      to[row * count + column] = of[Math.round(255 * score)];
    }),
  );
  canvas.getContext('2d')!.putImageData(image, 0, 0);
  return canvas;
}

const kMostSide = 760;
const kNameWidth = 150;
const kLeastNamed = 11; // pixels of a row that bears a name

/** Gives the canvas its size; names stand on the left where there is room. */
export function layOut(
  canvas: HTMLCanvasElement,
  matrix: Matrix,
  order: readonly number[],
): Layout {
  const width = Math.min(kMostSide + kNameWidth, canvas.parentElement!.clientWidth);
  const count = order.length;
  const named = width > 560 && (width - kNameWidth) / count >= kLeastNamed;
  const classed = !named && width > 560 && matrix.shapes.some((shape) => shape.class);
  const left = named || classed ? kNameWidth : 0;
  const side = Math.min(kMostSide, width - left);
  const cell = Math.min(48, side / count);
  const ratio = Math.min(2, devicePixelRatio);
  canvas.style.width = `${left + cell * count}px`;
  canvas.style.height = `${cell * count}px`;
  canvas.width = Math.round(ratio * (left + cell * count));
  canvas.height = Math.round(ratio * cell * count);
  return { cell, left, top: 0 };
}

export interface HeatStyle {
  /** As paint() gives them. */
  squares: HTMLCanvasElement;
  dark: boolean;
  marked: readonly [row: number, column: number] | null;
}

export function drawHeatMap(
  canvas: HTMLCanvasElement,
  matrix: Matrix,
  order: readonly number[],
  { cell, left }: Layout,
  { squares, dark, marked }: HeatStyle,
): void {
  const context = canvas.getContext('2d')!;
  const ratio = Math.min(2, devicePixelRatio);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  const side = order.length * cell;
  context.imageSmoothingEnabled = cell * ratio < 1; // several pairs a pixel: their mean
  context.imageSmoothingQuality = 'high';
  context.drawImage(squares, left, 0, side, side);
  const text = dark ? '#eceef2' : '#16181d';
  context.fillStyle = text;
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  context.font = '12px system-ui, sans-serif';
  if (left > 0) writeNames(context, matrix, order, cell, left);
  if (!marked) return;
  const [row, column] = marked;
  const box = Math.max(cell, 5);
  for (const [color, width] of [
    ['#000', 4],
    ['#fff', 2],
  ] as const) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.strokeRect(left + column * cell, row * cell, box, box);
  }
}

// Class and name of each shape, or of each run of a class where rows are too low for that.
function writeNames(
  context: CanvasRenderingContext2D,
  matrix: Matrix,
  order: readonly number[],
  cell: number,
  left: number,
): void {
  const write = (text: string, y: number) =>
    context.fillText(fitted(context, text, left - 8), left - 6, y);
  if (cell >= kLeastNamed) {
    order.forEach((i, row) => {
      const { name, class: of } = matrix.shapes[i];
      write(`${of ? `${of} · ` : ''}${splitName(name)[1]}`, (row + 0.5) * cell);
    });
    return;
  }
  for (let row = 0; row < order.length;) {
    const { class: of } = matrix.shapes[order[row]];
    let end = row + 1;
    while (end < order.length && matrix.shapes[order[end]].class === of) ++end;
    if (of && (end - row) * cell >= kLeastNamed) write(of, 0.5 * (row + end) * cell);
    row = end;
  }
}

function fitted(context: CanvasRenderingContext2D, text: string, width: number): string {
  if (context.measureText(text).width <= width) return text;
  let kept = text.length;
  while (kept > 1 && context.measureText(`${text.slice(0, kept)}…`).width > width) --kept;
  return `${text.slice(0, kept)}…`;
}
