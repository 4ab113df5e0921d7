// Everything beside the picture: how finely to cut, what to show, the list of parts.
import { counted, percent, thickness } from '../shape/text';
import type { Form } from '../view/stage';
import { make, setText, uniqueId } from './dom';
import { PartCard } from './part_card';
import { PartList } from './part_list';
import type { State } from './state';
import type { Theme } from './theme';

export interface PanelActions {
  /** The state has changed; `news` is read out to those who do not see the picture. */
  change(news?: string): void;
  resetCamera(): void;
  savePicture(): void;
  theme: Theme;
}

const kForms: [Form, string, string][] = [
  ['surface', 'Surface', 'The points, each in the colour of its part.'],
  ['balls', 'Balls', 'A ball for each part: as much volume as the part, at its centre.'],
  [
    'ellipsoids',
    'Ellipsoids',
    'An ellipsoid for each part: as long, wide and thick as it spreads.',
  ],
];

export class Panel {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly count = make('output', { class: 'count' });
  private readonly coarser = make('button', { type: 'button', click: () => this.step(-1) }, '−');
  private readonly finer = make('button', { type: 'button', click: () => this.step(1) }, '+');
  private readonly reset: HTMLButtonElement;
  private readonly levelNote = make('p', { class: 'note' });
  private readonly formNote = make('p', { class: 'note' });
  private readonly showAllButton: HTMLButtonElement;
  private readonly themeButton: HTMLButtonElement;
  readonly card: PartCard;
  private readonly list: PartList;

  constructor(
    private readonly state: State,
    private readonly actions: PanelActions,
  ) {
    const { levels, firstLevel } = state.model;
    this.slider = make('input', {
      type: 'range',
      min: 0,
      max: levels.length - 1,
      step: 1,
      id: uniqueId('level'),
      input: () => this.setLevel(Number(this.slider.value)),
      disabled: levels.length < 2,
    });
    this.coarser.setAttribute('aria-label', 'Fewer parts');
    this.finer.setAttribute('aria-label', 'More parts');
    this.reset = make(
      'button',
      { type: 'button', class: 'link', click: () => this.setLevel(firstLevel) },
      `Back to ${counted(levels[firstLevel].parts, 'part')}`,
    );
    this.showAllButton = make(
      'button',
      { type: 'button', class: 'link', click: () => this.showAll() },
      'Show all',
    );
    this.themeButton = make('button', {
      type: 'button',
      class: 'theme',
      click: () => actions.theme.toggle(),
    });
    this.tools = make(
      'div',
      { class: 'tools' },
      make('button', { type: 'button', click: () => actions.resetCamera() }, 'First view'),
      make('button', { type: 'button', click: () => actions.savePicture() }, 'Save picture'),
      this.themeButton,
    );
    const events = {
      select: (part: number | null) => this.select(part),
      toggle: (part: number) => this.toggle(part),
      isolate: (part: number) => this.isolate(part),
      hover: (part: number | null) => this.hover(part),
    };
    this.card = new PartCard(events);
    this.list = new PartList(events);
    this.element = make(
      'div',
      { class: 'panel' },
      this.header(),
      this.levelSection(),
      this.showSection(),
      this.partsSection(),
      this.help(),
    );
  }

  // ---- sections ---------------------------------------------------------------------------------

  private header(): HTMLElement {
    const { shape } = this.state.model;
    const drawn = shape.points.count;
    const all = counted(shape.pointsOfInput, 'point');
    const points =
      drawn < shape.pointsOfInput ? `Drawn with ${drawn.toLocaleString('en')} of ${all}` : all;
    const objects = shape.tree.objects;
    const apart = objects > 1 ? `, ${objects} separate objects` : '';
    return make(
      'header',
      {},
      make('h1', {}, shape.name),
      make('p', { class: 'note' }, `${points}${apart}.`),
    );
  }

  private levelSection(): HTMLElement {
    return make(
      'section',
      {},
      make('h2', {}, make('label', { for: this.slider.id }, 'How many parts'), this.count),
      make('div', { class: 'level' }, this.coarser, this.slider, this.finer),
      this.levelNote,
      this.reset,
    );
  }

  private showSection(): HTMLElement {
    const { state } = this;
    const group = uniqueId('form');
    const forms = kForms.map(([form, name]) =>
      make(
        'label',
        {},
        make('input', {
          type: 'radio',
          name: group,
          value: form,
          checked: form === state.layers.form,
          change: () => this.setLayers({ form }, `Shown as ${name.toLowerCase()}`),
        }),
        make('span', {}, name),
      ),
    );
    const spread = make('input', {
      type: 'range',
      min: 0,
      max: 100,
      value: 0,
      id: uniqueId('spread'),
    });
    spread.addEventListener('input', () => {
      state.spread = Number(spread.value) / 100;
      this.actions.change();
    });
    return make(
      'section',
      {},
      make('h2', {}, 'Show'),
      make(
        'fieldset',
        { class: 'forms' },
        make('legend', { class: 'unseen' }, 'Show as'),
        ...forms,
      ),
      this.formNote,
      make(
        'div',
        { class: 'checks' },
        this.check('Part numbers', state.layers.numbers, (numbers) => ({ numbers })),
        this.check('Lines between parts that touch', state.layers.graph, (graph) => ({ graph })),
      ),
      make('div', { class: 'spread' }, make('label', { for: spread.id }, 'Pull apart'), spread),
    );
  }

  private check(
    name: string,
    checked: boolean,
    change: (on: boolean) => Partial<State['layers']>,
  ): HTMLElement {
    const box = make('input', { type: 'checkbox', checked });
    box.addEventListener('change', () =>
      this.setLayers(change(box.checked), `${name}: ${box.checked ? 'on' : 'off'}`),
    );
    return make('label', {}, box, name);
  }

  private partsSection(): HTMLElement {
    return make(
      'section',
      {},
      make('h2', {}, 'Parts', this.showAllButton),
      make('p', { class: 'note' }, 'Click a part, in the picture or here, to see its measures.'),
      this.list.element,
    );
  }

  private help(): HTMLElement {
    const { version } = this.state.model.shape;
    return make(
      'details',
      {},
      make('summary', {}, 'What is this?'),
      make(
        'p',
        {},
        'The shape was cut into parts where its inside narrows, bends or changes its thickness: a ' +
          'leg from a body, a handle from a cup. Each colour is one part. All cuts belong to one ' +
          'tree: with fewer parts, neighbours join, the weakest joint first.',
      ),
      make(
        'p',
        {},
        'Part 0 has the largest volume. The numbers are those that morsel segment --parts writes ' +
          'for the same number of parts. Thickness is the diameter of the largest ball inside a ' +
          'part, in the unit of the file.',
      ),
      make(
        'p',
        {},
        'Drag to turn, wheel or pinch to zoom, right button or two fingers to move. Keys in the ' +
          'picture: arrows turn, + and − zoom, 0 first view, [ and ] fewer and more parts, n and p ' +
          'next and previous part, h hide, o only this part, a show all, Esc select none.',
      ),
      make('p', { class: 'note' }, `Made by morsel ${version}.`),
    );
  }

  // ---- changes ----------------------------------------------------------------------------------

  setLevel(level: number): void {
    this.state.setLevel(level);
    this.actions.change(counted(this.state.view.parts.length, 'part'));
  }

  private step(by: number): void {
    this.setLevel(this.state.view.level + by);
  }

  private setLayers(layers: Partial<State['layers']>, news: string): void {
    Object.assign(this.state.layers, layers);
    this.actions.change(news);
  }

  select(part: number | null): void {
    this.state.select(part);
    this.actions.change(part === null ? 'No part selected' : this.describe(part));
  }

  selectNext(by: number): void {
    const count = this.state.view.parts.length;
    const { selected } = this.state;
    this.select(selected === null ? (by > 0 ? 0 : count - 1) : (selected + by + count) % count);
  }

  toggle(part: number): void {
    this.state.toggle(part);
    this.actions.change(`Part ${part} ${this.state.hidden[part] ? 'hidden' : 'shown'}`);
  }

  isolate(part: number): void {
    this.state.isolate(part);
    const alone = this.state.hidden.some(Boolean);
    this.actions.change(alone ? `Only part ${part} is shown` : 'All parts are shown');
  }

  showAll(): void {
    this.state.setHidden(() => false);
    this.actions.change('All parts are shown');
  }

  private hover(part: number | null): void {
    if (part === this.state.hovered) return;
    this.state.hovered = part;
    this.actions.change();
  }

  private describe(part: number): string {
    const { parts, volume } = this.state.view;
    const { volume: own, ballRadius, neighbors } = parts[part];
    const beside = neighbors.map((neighbor) => neighbor.part).join(', ') || 'none';
    return (
      `Part ${part}: ${percent(own / volume)} of the volume, thickness ` +
      `${thickness(ballRadius)}, touches ${beside}`
    );
  }

  // ---- showing the state ------------------------------------------------------------------------

  refresh(): void {
    const { state } = this;
    const { view, model, selected, hidden, layers } = state;
    const last = model.levels.length - 1;
    const count = counted(view.parts.length, 'part');
    this.slider.value = String(view.level);
    this.slider.setAttribute('aria-valuetext', count);
    setText(this.count, String(view.parts.length));
    this.coarser.disabled = view.level === 0;
    this.finer.disabled = view.level === last;
    this.reset.hidden = view.level === model.firstLevel;
    setText(this.levelNote, levelNote(view.parts.length, view.level, model.firstLevel, last));
    setText(this.formNote, kForms.find(([form]) => form === layers.form)![2]);
    this.showAllButton.hidden = !hidden.some(Boolean);
    const next = this.actions.theme.dark ? 'Light' : 'Dark';
    setText(this.themeButton, next);
    this.card.refresh(view, selected, selected !== null && hidden[selected]);
    this.list.refresh(view, selected, hidden);
  }
}

function levelNote(parts: number, level: number, first: number, last: number): string {
  if (parts === 0) return 'No inside was found in it, so it has no parts.';
  if (last === 0) return 'This shape has one cut only.';
  if (level === first) return 'This is the cut of the file: what morsel chose or was asked for.';
  if (level === 0) return 'The coarsest cut.';
  if (level === last) return 'The finest cut: the pieces that parts are joined from.';
  return level < first ? 'Coarser than the cut of the file.' : 'Finer than the cut of the file.';
}
