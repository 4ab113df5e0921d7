// The measures of the part that is selected.
import type { View } from '../shape/model';
import { percent, thickness } from '../shape/text';
import { make } from './dom';

export interface PartEvents {
  select(part: number | null): void;
  toggle(part: number): void;
  isolate(part: number): void;
  hover(part: number | null): void;
}

const kMostNeighbors = 16;

/** "#rrggbb". */
export const cssColor = (color: readonly number[]) =>
  `#${color
    .map((x) =>
      Math.round(255 * x)
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;

/** A patch of a part's colour. */
export function swatch(color: readonly number[]): HTMLElement {
  const patch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
  patch.style.backgroundColor = cssColor(color);
  return patch;
}

export class PartCard {
  readonly element = make('section', { class: 'card', 'aria-label': 'Selected part' });

  constructor(private readonly events: PartEvents) {}

  refresh(view: View, selected: number | null, hidden: boolean): void {
    const children = selected === null ? [] : this.measures(view, selected, hidden);
    this.element.hidden = selected === null;
    // The button that was just pressed keeps the keyboard.
    const focused = this.focusedName();
    this.element.replaceChildren(...children);
    const again = [...this.element.querySelectorAll('button')].find(
      (button) => focused !== null && button.dataset.name === focused,
    );
    again?.focus();
  }

  private focusedName(): string | null {
    const active = document.activeElement;
    return active instanceof HTMLElement && this.element.contains(active)
      ? (active.dataset.name ?? null)
      : null;
  }

  private measures(view: View, selected: number, hidden: boolean): HTMLElement[] {
    const part = view.parts[selected];
    const row = (name: string, ...value: (Node | string)[]) => [
      make('dt', {}, name),
      make('dd', {}, ...value),
    ];
    const button = (name: string, text: string, click: () => void) =>
      make('button', { type: 'button', 'data-name': name, click }, text);
    return [
      make('h3', {}, swatch(view.colors[selected]), `Part ${selected}`),
      make(
        'dl',
        {},
        ...row('Volume', `${percent(part.volume / view.volume)} of the shape`),
        ...row(
          'Points',
          `${percent(part.pointCount / view.pointCount)} of them (${part.pointCount.toLocaleString('en')})`,
        ),
        ...row('Thickness', thickness(part.ballRadius)),
        ...row('Touches', ...this.neighbors(view, selected)),
      ),
      make(
        'div',
        { class: 'actions' },
        button('toggle', hidden ? 'Show' : 'Hide', () => this.events.toggle(selected)),
        button('isolate', 'Only this', () => this.events.isolate(selected)),
        button('close', 'Close', () => this.events.select(null)),
      ),
    ];
  }

  private neighbors(view: View, selected: number): (Node | string)[] {
    const { neighbors } = view.parts[selected];
    if (neighbors.length === 0) return ['no other part'];
    const shown = neighbors.slice(0, kMostNeighbors).map(({ part }) =>
      make(
        'button',
        {
          type: 'button',
          class: 'neighbor',
          'data-name': `neighbor${part}`,
          'aria-label': `Part ${part}`,
          click: () => this.events.select(part),
        },
        swatch(view.colors[part]),
        String(part),
      ),
    );
    const more = neighbors.length - shown.length;
    return more > 0 ? [...shown, ` and ${more} more`] : shown;
  }
}
