// All pairs as a heat map: to see which shapes belong together, and to pick a pair.
import { make } from '../ui/dom';
import type { Theme } from '../ui/theme';
import { getDatabase, getMatrix, type Choice, type Matrix } from './api';
import { classSelect, picture } from './gallery';
import { drawHeatMap, heatColor, layOut, paint, type Layout } from './heat_map';
import { compareLink } from './links';
import { orderBy, scoreOf, type Order } from './order';
import { filterBox, heading, nameOf, notice, scoreBar, select, waiting } from './parts_of_page';
import { scoreText, verdict } from './words';

const kOrders: [Order, string][] = [
  ['class', 'class, then name'],
  ['name', 'name'],
  ['similarity', 'likeness: alike beside each other'],
];

export async function showPairs(
  host: HTMLElement,
  theme: Theme,
  signal: AbortSignal,
): Promise<void> {
  const database = await getDatabase();
  signal.throwIfAborted();
  const choice: Choice = { text: '', class: null };
  const place = make('div', { class: 'matrix' });
  let order: Order = 'class';
  let matrix: Matrix | null = null;
  let map: HeatMap | null = null;
  let loading = new AbortController();
  const show = () => {
    if (matrix) map = new HeatMap(place, matrix, orderBy(matrix, order), theme);
  };
  const load = async () => {
    loading.abort();
    loading = new AbortController();
    const mine = loading.signal;
    matrix = map = null;
    const bar = make('progress', { max: 1, value: 0, 'aria-label': 'Progress' });
    place.replaceChildren(waiting('Comparing all pairs …'), bar);
    try {
      matrix = await getMatrix(choice, (fraction) => (bar.value = fraction), mine);
      show();
    } catch (error) {
      if (!mine.aborted) place.replaceChildren(notice((error as Error).message));
    }
  };
  signal.addEventListener('abort', () => loading.abort());
  host.append(
    heading('All pairs'),
    make(
      'p',
      { class: 'lead' },
      'Each square is a pair of shapes: the brighter, the more alike. Bright blocks along the ' +
        'diagonal are families. Click a square, or move with the arrow keys, to see the two.',
    ),
    make(
      'form',
      { class: 'filters', submit: (event) => event.preventDefault() },
      select('Order by', kOrders, order, (value) => {
        order = value as Order;
        show();
      }),
      filterBox('Name, class or tag has', '', (text) => {
        choice.text = text;
        void load();
      }),
      ...classSelect(database.classes, choice, () => void load()),
    ),
    legend(),
    place,
  );
  theme.onChange(() => map?.draw(), signal);
  addEventListener('resize', () => map?.draw(), { signal });
  await load();
}

function legend(): HTMLElement {
  const steps = Array.from({ length: 11 }, (_, i) => {
    const step = make('span');
    step.style.backgroundColor = heatColor(i / 10);
    return step;
  });
  return make(
    'p',
    { class: 'legend' },
    '0 nothing in common ',
    make('span', { class: 'ramp', 'aria-hidden': 'true' }, ...steps),
    ' 1 the same',
  );
}

class HeatMap {
  private readonly canvas = make('canvas', { class: 'heat', tabindex: 0, role: 'application' });
  private readonly about = make('div', { class: 'pair-card', 'aria-live': 'polite' });
  private readonly squares: HTMLCanvasElement;
  private layout: Layout | null = null;
  private row = 0;
  private column = 0;
  private chosen = false;

  constructor(
    place: HTMLElement,
    private readonly matrix: Matrix,
    private readonly order: readonly number[],
    private readonly theme: Theme,
  ) {
    const count = order.length;
    this.squares = paint(matrix, order);
    if (count === 0) {
      place.replaceChildren(notice('No shape has this in its name, class or tags.'));
      return;
    }
    this.canvas.setAttribute(
      'aria-label',
      `Scores of all pairs of ${count} shapes. Arrow keys move, Enter compares the two.`,
    );
    place.replaceChildren(this.canvas, this.about);
    this.canvas.addEventListener('pointermove', (event) => this.point(event, false));
    this.canvas.addEventListener('click', (event) => this.point(event, true));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    const hint = 'Point at a square to see which two shapes it stands for.';
    this.about.replaceChildren(make('p', { class: 'note' }, hint));
    this.draw();
  }

  draw(): void {
    if (this.order.length === 0) return;
    this.layout = layOut(this.canvas, this.matrix, this.order);
    const marked = this.chosen || document.activeElement === this.canvas;
    drawHeatMap(this.canvas, this.matrix, this.order, this.layout, {
      squares: this.squares,
      dark: this.theme.dark,
      marked: marked ? [this.row, this.column] : null,
    });
  }

  private point(event: MouseEvent, choose: boolean): void {
    const { left, top, cell } = this.layout!;
    const column = Math.floor((event.offsetX - left) / cell);
    const row = Math.floor((event.offsetY - top) / cell);
    const last = this.order.length - 1;
    if (row < 0 || column < 0 || row > last || column > last) return;
    if (this.chosen && !choose) return;
    this.go(row, column, choose || this.chosen);
  }

  private key(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [0, -1],
      ArrowRight: [0, 1],
      ArrowUp: [-1, 0],
      ArrowDown: [1, 0],
    };
    if (event.key === 'Enter') location.hash = this.link();
    if (!Object.hasOwn(steps, event.key)) return;
    event.preventDefault();
    const [down, right] = steps[event.key];
    const within = (i: number) => Math.max(0, Math.min(this.order.length - 1, i));
    this.go(within(this.row + down), within(this.column + right), true);
  }

  private go(row: number, column: number, choose: boolean): void {
    if (row === this.row && column === this.column && choose === this.chosen) return;
    this.row = row;
    this.column = column;
    this.chosen = choose;
    this.draw();
    this.describe();
  }

  private pair(): [string, string] {
    const name = (i: number) => this.matrix.shapes[this.order[i]].name;
    return [name(this.row), name(this.column)];
  }

  private link(): string {
    const [a, b] = this.pair();
    return compareLink({ name: a }, b);
  }

  private describe(): void {
    const [a, b] = this.pair();
    const score = scoreOf(this.matrix, this.order[this.row], this.order[this.column]);
    this.canvas.setAttribute(
      'aria-description',
      `${a} and ${b}: ${scoreText(score)}, ${verdict(score)}`,
    );
    const side = (name: string) =>
      make('figure', {}, picture(name), make('figcaption', {}, nameOf(name)));
    this.about.replaceChildren(
      side(a),
      side(b),
      scoreBar(score),
      make('a', { class: 'button', href: this.link() }, 'Compare the two'),
    );
  }
}
