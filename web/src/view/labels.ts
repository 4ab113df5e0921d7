// The numbers of the parts, drawn over the picture.
import type { Anchor } from './project';

export interface LabelStyle {
  /** Pixels of the canvas in one CSS pixel. */
  ratio: number;
  dark: boolean;
  selected: number | null;
}

/** Draws the nearest last. */
export function drawLabels(
  context: CanvasRenderingContext2D,
  anchors: readonly Anchor[],
  style: LabelStyle,
): void {
  const { ratio, dark, selected } = style;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.font = '600 12px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const { part, x, y } of [...anchors].sort((a, b) => b.depth - a.depth)) {
    const text = String(part);
    const width = Math.max(20, context.measureText(text).width + 10);
    const strong = part === selected;
    context.beginPath();
    context.roundRect(x - width / 2, y - 10, width, 20, 10);
    context.fillStyle = strong !== dark ? '#16181d' : '#ffffff';
    context.globalAlpha = strong ? 1 : 0.86;
    context.fill();
    context.globalAlpha = 1;
    context.fillStyle = strong !== dark ? '#ffffff' : '#16181d';
    context.fillText(text, x, y + 0.5);
  }
}
