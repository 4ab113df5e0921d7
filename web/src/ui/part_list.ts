// All parts of the cut, the largest first.
import type { View } from '../shape/model';
import { percent, thickness } from '../shape/text';
import { make, setText } from './dom';
import { cssColor, swatch, type PartEvents } from './part_card';

const kMostRows = 100;

interface Row {
  element: HTMLTableRowElement;
  swatch: HTMLElement;
  name: HTMLButtonElement;
  volume: HTMLElement;
  thickness: HTMLElement;
  show: HTMLInputElement;
}

export class PartList {
  readonly element: HTMLElement;
  private readonly body = make('tbody');
  private readonly more = make('p', { class: 'note' });
  private readonly rows: Row[] = [];

  constructor(private readonly events: PartEvents) {
    const head = ['Part', 'Volume', 'Thickness', 'Shown'].map((name) =>
      make('th', { scope: 'col' }, name),
    );
    this.element = make(
      'div',
      { class: 'list' },
      make('table', {}, make('thead', {}, make('tr', {}, ...head)), this.body),
      this.more,
    );
    this.body.addEventListener('pointerleave', () => events.hover(null));
  }

  refresh(view: View, selected: number | null, hidden: readonly boolean[]): void {
    const count = Math.min(view.parts.length, kMostRows);
    while (this.rows.length < count) this.rows.push(this.makeRow(this.rows.length));
    while (this.rows.length > count) this.rows.pop()!.element.remove();
    this.rows.forEach((row, i) => {
      const part = view.parts[i];
      row.swatch.style.backgroundColor = cssColor(view.colors[i]);
      setText(row.volume, percent(part.volume / view.volume));
      setText(row.thickness, thickness(part.ballRadius));
      row.show.checked = !hidden[i];
      row.element.classList.toggle('selected', i === selected);
      row.name.setAttribute('aria-pressed', String(i === selected));
    });
    const left = view.parts.length - count;
    setText(this.more, left > 0 ? `… and ${left.toLocaleString('en')} smaller` : '');
  }

  private makeRow(part: number): Row {
    const { events } = this;
    const patch = swatch([0, 0, 0]);
    const name = make(
      'button',
      { type: 'button', click: () => events.select(name.ariaPressed === 'true' ? null : part) },
      patch,
      `Part ${part}`,
    );
    const show = make('input', {
      type: 'checkbox',
      'aria-label': `Show part ${part}`,
      change: () => events.toggle(part),
    });
    const volume = make('td');
    const thickness = make('td');
    const element = make(
      'tr',
      { pointerenter: () => events.hover(part) },
      make('th', { scope: 'row' }, name),
      volume,
      thickness,
      make('td', {}, show),
    );
    this.body.append(element);
    return { element, swatch: patch, name, volume, thickness, show };
  }
}
